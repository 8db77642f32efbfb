"""`cmb fmu`: what its options do, and what it says to wrong ones."""

from __future__ import annotations

import os
import pwd
import re
from pathlib import Path

import pytest
from contact_foundation.cache import user_cache
from fmu_regression.fmi.description import read_description
from program import Cmb

FALLING = """model Falling "A falling point"
  parameter Real g = 9.81;
  output Real h(start = 1, fixed = true);
  Real v(start = 0, fixed = true);
equation
  der(h) = v;
  der(v) = -g;
  annotation (experiment(StopTime = 0.4, Tolerance = 1e-7));
end Falling;
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with a model."""
    work = tmp_path / "work"
    work.mkdir()
    (work / "Falling.mo").write_text(FALLING)
    return work


@pytest.mark.full
def test_unchanged_files_come_from_the_cache(folder: Path, cmb_here: Cmb, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(folder.parent / "cache"))

    def build(*words: str) -> tuple[bool, bytes]:
        done = cmb_here("fmu", "Falling", "--output", "falling.fmu", *words, cwd=folder)
        assert done.returncode == 0, done.stderr
        assert "2 states" in done.stdout
        return "from the cache" in done.stdout, (folder / "falling.fmu").read_bytes()

    cached, first = build()
    assert not cached
    assert build() == (True, first)
    assert build("--no-cache") == (False, first)  # the same bytes
    assert not build("--fmi", "3")[0]
    assert not build("--tolerance", "1e-4")[0]
    assert build() == (True, first)

    (folder / "Falling.mo").write_text(FALLING.replace("9.81", "1.62"))
    cached, changed = build()
    assert not cached
    assert changed != first
    (folder / "Falling.mo").write_text(FALLING)
    assert build() == (True, first)

    (entry,) = [path for path in (folder.parent / "cache").rglob("*.fmu") if path.read_bytes() == first]
    entry.write_bytes(first[:1000])
    assert build() == (False, first)  # a damaged entry is built anew


def test_solver_options_become_the_fmus_defaults(folder: Path, cmb: Cmb) -> None:
    words = ["--tolerance", "1e-5", "--max-step", "0.25", "--max-steps", "5000"]
    done = cmb("fmu", "Falling", *words, cwd=folder)
    assert done.returncode == 0, done.stderr
    variables = read_description(folder / "Falling.fmu").variables
    starts = [variables[f"cmbSolver.{name}"].start for name in ("relativeTolerance", "maximumStep", "maximumSteps")]
    assert [float(start or "nan") for start in starts] == [1e-5, 0.25, 5000]


def test_the_log_says_what_was_chosen(folder: Path, cmb_here: Cmb) -> None:
    done = cmb_here("fmu", "Falling", "--log", "build.log", cwd=folder)
    assert done.returncode == 0, done.stderr
    log = (folder / "build.log").read_text()
    assert re.search(r"^states +2: h, v$", log, re.MULTILINE)
    assert re.search(r"^standard library +\S+", log, re.MULTILINE)
    assert re.search(r"^seconds .*load [\d.]+, .*compile [\d.]+, pack [\d.]+", log, re.MULTILINE)
    printed = cmb_here("fmu", "Falling", "--log", cwd=folder).stdout
    assert "taken from the cache" in printed
    assert log.splitlines()[0] in printed


def test_openmodelica_where_it_is_not_installed(folder: Path, cmb_here: Cmb, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("OPENMODELICAHOME", str(folder / "nowhere"))
    done = cmb_here("fmu", "Falling", "--tool", "omc", cwd=folder)
    assert done.returncode == 1
    assert "omc is not in" in done.stderr
    assert "--tool builtin" in done.stderr
    assert [path.name for path in folder.iterdir()] == ["Falling.mo"]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["Falling", "--fmi", "1"], "--fmi"),
        (["Falling", "--tool", "dymola"], "--tool"),
        (["Falling", "--tolerance", "2"], "tolerance"),
        (["Falling", "--max-step", "-1"], "longest step cannot be -1"),
        (["Falling", "--max-steps", "0"], "0 steps"),
        (["Falling", "--max-steps", "many"], "--max-steps"),
        (["Falling", "--output", "."], "is a folder"),
        (["Falling", "--msl", "no-such-folder"], "no-such-folder"),
        (["Falling", "--source", "Gone.mo"], "Gone.mo"),
        (["Falling.h)"], "no name of a Modelica class"),
        (["Rising"], "Rising"),
        (["Falling", "--tool", "omc", "--tolerance", "1e-4"], "--tolerance is for the built-in translator"),
    ],
)
def test_wrong_options(words: list[str], said: str, folder: Path, cmb_here: Cmb) -> None:
    done = cmb_here("fmu", *words, cwd=folder)
    assert done.returncode == 2, done.stderr
    assert said in done.stderr
    assert "Traceback" not in done.stderr
    assert [path.name for path in folder.iterdir()] == ["Falling.mo"]


@pytest.mark.full
def test_without_a_place_for_the_cache_it_builds_all_the_same(
    folder: Path, cmb_here: Cmb, monkeypatch: pytest.MonkeyPatch
) -> None:
    (folder / "file").touch()
    monkeypatch.setenv("XDG_CACHE_HOME", str(folder / "file"))
    done = cmb_here("fmu", "Falling", cwd=folder)
    assert done.returncode == 0, done.stderr


def test_the_cache_lies_in_the_users_home(monkeypatch: pytest.MonkeyPatch) -> None:
    home = pwd.getpwuid(os.getuid()).pw_dir
    for environment in ({}, {"HOME": ""}, {"HOME": "relative", "XDG_CACHE_HOME": "relative"}):
        assert user_cache("x", environment) == Path(home) / ".cache" / "contactmultibody" / "x"
    monkeypatch.setattr(os, "getuid", lambda: 2**31 - 7)  # as in containers
    assert user_cache("x", {}) == Path("/nonexistent/.cache/contactmultibody/x")
