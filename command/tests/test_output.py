"""Output appears whole or not at all."""

from pathlib import Path

import pytest
from cmb_base.errors import InputError
from cmb_base.output import whole_file, whole_folder


class Interrupted(Exception):
    pass


def entries(folder: Path) -> list[str]:
    return sorted(entry.name for entry in folder.iterdir())


def test_folder_appears_when_the_block_ends(tmp_path: Path) -> None:
    target = tmp_path / "deep" / "out"
    with whole_folder(target) as staging:
        (staging / "a").write_text("1")
        assert not target.exists()
    assert (target / "a").read_text() == "1"
    assert entries(tmp_path / "deep") == ["out"]


def test_failed_block_leaves_the_old_folder_and_nothing_else(tmp_path: Path) -> None:
    target = tmp_path / "out"
    with whole_folder(target) as staging:
        (staging / "a").write_text("old")
    with pytest.raises(Interrupted), whole_folder(target) as staging:
        (staging / "a").write_text("new")
        raise Interrupted
    assert (target / "a").read_text() == "old"
    assert entries(tmp_path) == ["out"]


def test_second_run_replaces_every_file(tmp_path: Path) -> None:
    target = tmp_path / "out"
    with whole_folder(target) as staging:
        (staging / "stale").write_text("")
    with whole_folder(target) as staging:
        (staging / "fresh").write_text("")
    assert not (target / "stale").exists()
    assert (target / "fresh").exists()
    assert entries(tmp_path) == ["out"]


def test_a_foreign_folder_is_never_replaced(tmp_path: Path) -> None:
    target = tmp_path / "thesis"
    target.mkdir()
    (target / "chapter1.tex").write_text("years of work")
    with pytest.raises(InputError, match="not written by cmb"), whole_folder(target):
        pass
    assert (target / "chapter1.tex").read_text() == "years of work"


def test_failed_file_keeps_the_old_one(tmp_path: Path) -> None:
    target = tmp_path / "a.csv"
    target.write_text("old")
    with pytest.raises(Interrupted), whole_file(target) as staging:
        staging.write_text("half")
        raise Interrupted
    assert target.read_text() == "old"
    assert entries(tmp_path) == ["a.csv"]
