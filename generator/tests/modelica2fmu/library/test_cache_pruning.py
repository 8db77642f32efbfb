"""Caches stay small, and what a build may be using stays."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest
from contact_data import core_subset
from modelica2fmu.build import translate
from modelica2fmu.library.cache_pruning import mark_used, prune_front_end_cache, prune_unused, pruned_after_use
from modelica2fmu.library.library_repairs import views_folder
from modelica2fmu.library.standard_library import StandardLibrary
from modelica2fmu.packaging.object_store import ObjectStore
from modelica2fmu.packaging.toolchain import DEPENDENCIES, Compilation

DAY = 24 * 3600.0


def aged(path: Path, seconds: float) -> Path:
    then = time.time() - seconds
    os.utime(path, (then, then))
    return path


def parsed(folder: Path, name: str, size: int, age: float) -> None:
    """A file as the front end keeps it: its content is old, the time of its last use beside it."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{name}.bin").write_bytes(b"x" * size)
    aged(folder / f"{name}.bin", age + 100 * DAY)
    (folder / f"{name}.bin.rumoca-access").touch()
    aged(folder / f"{name}.bin.rumoca-access", age)


def names(folder: Path) -> set[str]:
    return {path.name.split(".")[0] for path in folder.iterdir() if not path.name.startswith(".")}


def test_entries_that_were_not_used_for_long_go(tmp_path):
    for name, age in (("old", 40), ("used", 40), ("new", 1)):
        (tmp_path / name).mkdir()
        (tmp_path / name / "file").write_text("text")
        aged(tmp_path / name, age * DAY)
    aged(tmp_path / "used" / "file", 90 * DAY)
    mark_used(tmp_path / "used")
    (tmp_path / "single").write_text("text")
    aged(tmp_path / "single", 31 * DAY)
    prune_unused(tmp_path.iterdir())
    assert {path.name for path in tmp_path.iterdir()} == {"used", "new"}
    assert (tmp_path / "used" / "file").read_text() == "text"


def test_what_a_link_names_stays(tmp_path):
    (tmp_path / "library").mkdir()
    (tmp_path / "library" / "package.mo").write_text("package P end P;")
    view = tmp_path / "cache" / "view"
    view.mkdir(parents=True)
    (view / "P").symlink_to(tmp_path / "library")
    aged(view, 40 * DAY)
    prune_unused([view, tmp_path / "nothing"])
    assert not view.exists()
    assert (tmp_path / "library" / "package.mo").is_file()


def test_the_front_ends_cache_keeps_what_was_used_last(tmp_path):
    folder = tmp_path / "source-roots" / "parsed-files"
    for name, age in (("a", 9), ("b", 2), ("c", 5), ("d", 3)):
        parsed(folder, name, 100, age * DAY)
    prune_front_end_cache(tmp_path, limit=250)
    assert names(folder) == {"b", "d"}
    assert {path.name for path in folder.iterdir()} == {
        "b.bin", "b.bin.rumoca-access", "d.bin", "d.bin.rumoca-access"
    }  # fmt: skip


def test_what_was_just_used_stays_though_it_is_too_much(tmp_path):
    folder = tmp_path / "source-roots"
    for name, age in (("now", 0.0), ("minutes", 600.0), ("old", DAY)):
        parsed(folder, name, 100, age)
    prune_front_end_cache(tmp_path, limit=50)
    assert names(folder) == {"now", "minutes"}


def test_the_front_ends_cache_is_looked_at_once_a_day(tmp_path):
    folder = tmp_path / "source-roots"
    prune_front_end_cache(tmp_path / "nothing")
    assert not (tmp_path / "nothing").exists()
    parsed(folder, "a", 100, 9 * DAY)
    prune_front_end_cache(tmp_path, limit=250)
    parsed(folder, "b", 200, 8 * DAY)
    prune_front_end_cache(tmp_path, limit=250)
    assert names(folder) == {"a", "b"}
    aged(tmp_path / ".pruned", 2 * DAY)
    prune_front_end_cache(tmp_path, limit=250)
    assert names(folder) == {"b"}


def test_nothing_goes_while_another_build_uses_the_folder(tmp_path):
    old, other = tmp_path / "old", tmp_path / "other"
    for path in (old, other):
        path.mkdir()
        aged(path, 40 * DAY)
    with pruned_after_use(tmp_path):
        with pruned_after_use(tmp_path):
            mark_used(other)
        assert old.is_dir()
    assert not old.exists()
    assert other.is_dir()


def test_another_process_that_uses_the_folder_keeps_it(tmp_path):
    old = tmp_path / "old"
    old.mkdir()
    aged(old, 40 * DAY)
    program = (
        "import sys\nfrom pathlib import Path\nfrom modelica2fmu.library.cache_pruning import pruned_after_use\n"
        "with pruned_after_use(Path(sys.argv[1])):\n  print('holds', flush=True)\n  sys.stdin.read()\n"
    )
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True}
    with subprocess.Popen([sys.executable, "-c", program, str(tmp_path)], **pipes) as other:
        assert other.stdout.readline() == "holds\n"
        with pruned_after_use(tmp_path):
            pass
        assert old.is_dir()
        other.stdin.close()
        assert other.wait(60) == 0
    assert not old.exists()  # the other one was the last to leave


def test_a_failed_build_lets_go_and_its_error_stays(tmp_path):
    with pytest.raises(ValueError, match="wrong"), pruned_after_use(tmp_path):
        raise ValueError("wrong")
    (tmp_path / "old").mkdir()
    aged(tmp_path / "old", 40 * DAY)
    with pruned_after_use(tmp_path):
        pass
    assert not (tmp_path / "old").exists()


def test_a_folder_that_cannot_be_made_is_no_failure(tmp_path):
    (tmp_path / "file").write_text("text")
    with pruned_after_use(tmp_path / "file" / "folder"):
        pass


def test_a_translation_prunes_views_that_are_long_unused(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    old = views_folder() / "0123"
    old.mkdir(parents=True)
    aged(old, 40 * DAY)
    (tmp_path / "M.mo").write_text("model M\n  Real x = time;\nend M;\n")
    translate("M", [tmp_path / "M.mo"], StandardLibrary(core_subset(), "", "core subset"))
    assert not old.exists()


def test_objects_that_are_long_unused_go_when_one_is_added(tmp_path):
    source = tmp_path / "a.c"
    source.write_text("int a;\n")
    target = tmp_path / "a.o"
    target.write_bytes(b"object")
    target.with_suffix(DEPENDENCIES).write_bytes(b"a.o: a.c")
    store = ObjectStore(tmp_path / "objects", [])
    used, unused, added = (Compilation(source, flags=(flag,)) for flag in ("-DA", "-DB", "-DC"))
    store.keep(used, target)
    store.keep(unused, target)
    for path in (tmp_path / "objects").glob("*.object"):
        aged(path, 40 * DAY)
    assert store.fetch(used, target)
    store.keep(added, target)
    assert [store.fetch(each, target) for each in (used, unused, added)] == [True, False, True]
