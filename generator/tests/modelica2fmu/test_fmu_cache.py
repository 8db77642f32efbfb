"""The folder of FMUs that were built before."""

from __future__ import annotations

import os
import zipfile
from dataclasses import replace
from pathlib import Path

import pytest
from modelica2fmu.build import BuildOptions, build_fmu
from modelica2fmu.fmu_cache import FmuCache
from modelica2fmu.library.standard_library import StandardLibrary
from modelica2fmu.report import BuildReport, SolvedBlock
from modelica2fmu.source_places import SourcePlaces


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


def made(folder: Path, name: str, content: str = "<fmiModelDescription/>") -> BuildReport:
    path = folder / f"{name}.fmu"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("modelDescription.xml", content)
    return report(path)


def test_what_was_stored_comes_back_with_its_report(tmp_path: Path) -> None:
    cache = FmuCache(tmp_path / "cache")
    original = made(tmp_path, "a")
    cache.store("key", original)
    output = tmp_path / "elsewhere" / "copy.fmu"
    found = cache.fetch("key", output)
    assert found is not None
    assert output.read_bytes() == original.fmu.read_bytes()
    assert found.cached
    assert found.fmu == output
    assert found.text().splitlines()[:-1] == original.text().splitlines()[:-1]
    assert cache.fetch("other", output) is None


def test_what_names_its_place_is_found_there_alone(tmp_path: Path) -> None:
    cache = FmuCache(tmp_path / "cache")
    there, here = SourcePlaces(("Free.mo",), ("/there",)), SourcePlaces(("Free.mo",), ("/here",))
    cache.store("key", made(tmp_path, "a", '<String start="/there/table.txt"/>'), there)
    assert cache.fetch("key", tmp_path / "copy.fmu", here) is None
    assert cache.fetch("key", tmp_path / "copy.fmu", there) is not None


def test_files_that_a_model_names_are_found_beside_it(tmp_path: Path) -> None:
    """They move with it; elsewhere they stay where they are."""
    cache = FmuCache(tmp_path / "cache")
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "part.stl").write_text("solid")
    far = tmp_path / "far.stl"
    far.write_text("solid")
    one, two = (SourcePlaces.of([tmp_path / name]) for name in ("one", "two"))
    named = (tmp_path / "one" / "part.stl", far)
    cache.store("key", replace(made(tmp_path, "a"), files=named), one)
    found = cache.fetch("key", tmp_path / "copy.fmu", two)
    assert found is not None
    assert found.files == (tmp_path / "two" / "part.stl", far)
    (tmp_path / "two" / "part.stl").write_text("another")
    assert cache.fetch("key", tmp_path / "copy.fmu", two) is None
    assert cache.fetch("key", tmp_path / "copy.fmu", one) is not None
    far.unlink()
    assert cache.fetch("key", tmp_path / "copy.fmu", one) is None


@pytest.mark.parametrize("damage", ["", "{}", "[]", '{"digest": 1}', "not json"])
def test_a_damaged_record_counts_as_missing(tmp_path: Path, damage: str) -> None:
    cache = FmuCache(tmp_path / "cache")
    cache.store("key", made(tmp_path, "a"))
    (tmp_path / "cache" / "key.json").write_text(damage)
    assert cache.fetch("key", tmp_path / "copy.fmu") is None
    assert not (tmp_path / "copy.fmu").exists()


def test_what_was_used_longest_ago_goes_first(tmp_path: Path) -> None:
    size = made(tmp_path, "a").fmu.stat().st_size
    cache = FmuCache(tmp_path / "cache", limit=5 * size // 2)
    for age, name in ((300, "a"), (200, "b")):
        cache.store(name, made(tmp_path, name))
        stamp = os.stat(tmp_path / "cache" / f"{name}.fmu").st_mtime - age
        os.utime(tmp_path / "cache" / f"{name}.fmu", (stamp, stamp))
    assert cache.fetch("a", tmp_path / "out.fmu") is not None  # now b is the older one
    cache.store("c", made(tmp_path, "c"))
    assert {path.name for path in (tmp_path / "cache").iterdir()} == {"a.fmu", "a.json", "c.fmu", "c.json"}


def test_a_folder_that_cannot_be_made_is_no_failure(tmp_path: Path) -> None:
    (tmp_path / "cache").write_text("a file")
    cache = FmuCache(tmp_path / "cache")
    cache.store("key", made(tmp_path, "a"))
    assert cache.fetch("key", tmp_path / "out.fmu") is None


FREE = """model Free
  Real x(start=1, fixed=true);
equation
  der(x) = -x;
  assert(x > 2, "low", AssertionLevel.warning);
end Free;
"""


def test_the_same_files_elsewhere_give_the_fmu_that_was_built(tmp_path: Path, fmu_cache: Path) -> None:
    def built_in(folder: Path) -> BuildReport:
        folder.mkdir()
        (folder / "Free.mo").write_text(FREE)
        return build_fmu("Free", [folder / "Free.mo"], folder / "free.fmu", BuildOptions(cache=fmu_cache))

    first, again = built_in(tmp_path / "one"), built_in(tmp_path / "two")
    assert again.cached
    assert again.fmu.read_bytes() == first.fmu.read_bytes()


@pytest.mark.parametrize("name", ["a b", "Ünder", 'q"uote', "<x>", "back\\slash"])
def test_places_that_are_written_in_several_ways_count_as_named(tmp_path: Path, name: str) -> None:
    fmu = made(tmp_path, "empty").fmu
    plain, odd = str(tmp_path / "plain"), str(tmp_path / name)
    assert SourcePlaces((), (plain, odd)).named(fmu, []) == (odd,)
    assert SourcePlaces((), (plain,)).named(fmu, [f"{plain}/Free.mo:3: odd"]) == (plain,)
