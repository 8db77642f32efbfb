"""Experiment files: what they say, and what is refused."""

from __future__ import annotations

from pathlib import Path

import pytest
from cmb.experiment import FILE_NAME, Experiment, find_experiment, read_experiment
from contact_foundation.errors import InputError
from contact_foundation.toml_text import MAXIMUM_BYTES


def write(folder: Path, text: str) -> Path:
    file = folder / FILE_NAME
    file.write_text(text)
    return file


def test_without_a_file_nothing_changes(tmp_path: Path) -> None:
    assert find_experiment(tmp_path) == Experiment()


def test_model_sources_and_figures(tmp_path: Path) -> None:
    (tmp_path / "Walk.mo").write_text("model Walk end Walk;")
    write(
        tmp_path,
        """
        model = "Walk"
        sources = ["Walk.mo"]
        [[number]]
        title = "Way"
        signal = "x"
        taken = "last"
        """,
    )
    experiment = find_experiment(tmp_path)
    assert experiment.model == "Walk"
    assert experiment.sources == ((tmp_path / "Walk.mo").resolve(),)
    assert experiment.figures.signals == ("x",)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("modell = 'A'", "modell has no meaning"),
        ("model = 3", "model is not a name"),
        ("sources = 'A.mo'", "sources is not a list"),
        ("sources = [3]", "sources is not a list"),
        ("sources = ['Missing.mo']", "does not exist"),
        ("sources = ['../outside']", "outside the folder"),
        ("sources = ['/etc/passwd']", "outside the folder"),
        ("sources = ['link']", "outside the folder"),
        ("model = ", "is no TOML"),
        ("[[plot]]\ntitle = 'Heights'", "label, signals is missing"),
        ("#" * (MAXIMUM_BYTES + 1), "larger than 5 MB"),
    ],
)
def test_wrong_files(tmp_path: Path, text: str, message: str) -> None:
    folder = tmp_path / "assembly"
    folder.mkdir()
    (tmp_path / "outside").mkdir()
    (folder / "link").symlink_to(tmp_path / "outside")
    file = write(folder, text)
    with pytest.raises(InputError, match=message) as caught:
        find_experiment(folder)
    assert caught.value.place.file == file


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="cannot be read"):
        read_experiment(tmp_path / FILE_NAME)
