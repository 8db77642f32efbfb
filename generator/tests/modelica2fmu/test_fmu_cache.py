"""The folder of FMUs that were built before."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from modelica2fmu.fmu_cache import FmuCache
from modelica2fmu.library.standard_library import StandardLibrary
from modelica2fmu.report import BuildReport, SolvedBlock


def report(fmu: Path) -> BuildReport:
    return BuildReport(
        fmu=fmu,
        model="Robot.Walk",
        fmi="2.0",
        library=StandardLibrary(Path("/opt/msl"), "4.1.0", "MODELICAPATH"),
        states=("x", "v"),
        derivatives=("der(x)", "der(v)"),
        equations=10,
        equations_left=4,
        differentiations=1,
        simulation_blocks=(SolvedBlock("linear", 6, ("a", "b")),),
        initialization_blocks=(),
        event_indicators=2,
        operations=33,
        warnings=("odd",),
        timings=(("load", 1.5), ("compile", 2.0)),
    )


def made(folder: Path, name: str, size: int) -> BuildReport:
    path = folder / f"{name}.fmu"
    path.write_bytes(name.encode() * size)
    return report(path)


def test_what_was_stored_comes_back_with_its_report(tmp_path: Path) -> None:
    cache = FmuCache(tmp_path / "cache")
    original = made(tmp_path, "a", 10)
    cache.store("key", original)
    output = tmp_path / "elsewhere" / "copy.fmu"
    found = cache.fetch("key", output)
    assert found is not None
    assert output.read_bytes() == original.fmu.read_bytes()
    assert found.cached
    assert found.fmu == output
    assert found.text().splitlines()[:-1] == original.text().splitlines()[:-1]
    assert cache.fetch("other", output) is None


@pytest.mark.parametrize("damage", ["", "{}", "[]", '{"digest": 1}', "not json"])
def test_a_damaged_record_counts_as_missing(tmp_path: Path, damage: str) -> None:
    cache = FmuCache(tmp_path / "cache")
    cache.store("key", made(tmp_path, "a", 10))
    (tmp_path / "cache" / "key.json").write_text(damage)
    assert cache.fetch("key", tmp_path / "copy.fmu") is None
    assert not (tmp_path / "copy.fmu").exists()


def test_what_was_used_longest_ago_goes_first(tmp_path: Path) -> None:
    cache = FmuCache(tmp_path / "cache", limit=250)
    for age, name in ((300, "a"), (200, "b")):
        cache.store(name, made(tmp_path, name, 100))
        stamp = os.stat(tmp_path / "cache" / f"{name}.fmu").st_mtime - age
        os.utime(tmp_path / "cache" / f"{name}.fmu", (stamp, stamp))
    assert cache.fetch("a", tmp_path / "out.fmu") is not None  # now b is the older one
    cache.store("c", made(tmp_path, "c", 100))
    assert {path.name for path in (tmp_path / "cache").iterdir()} == {"a.fmu", "a.json", "c.fmu", "c.json"}


def test_a_folder_that_cannot_be_made_is_no_failure(tmp_path: Path) -> None:
    (tmp_path / "cache").write_text("a file")
    cache = FmuCache(tmp_path / "cache")
    cache.store("key", made(tmp_path, "a", 10))
    assert cache.fetch("key", tmp_path / "out.fmu") is None
