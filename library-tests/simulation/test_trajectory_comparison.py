"""What `make test-omc` holds against the references: right trajectories pass, wrong ones are named."""

from __future__ import annotations

import csv
import re
import runpy
import subprocess
import sys
from collections.abc import Callable
from contextlib import redirect_stderr, redirect_stdout
from io import StringIO
from pathlib import Path
from unittest.mock import patch

import pytest
from fmu_regression.cases.case import Case, find_cases, load_case
from fmu_regression.compare.checks import BoundCheck
from library_compiler import REPOSITORY

CASES = [load_case(path) for path in find_cases(REPOSITORY / "regression" / "cases" / "openmodelica")]
SCRIPT = REPOSITORY / "scripts" / "compare-trajectory"
PROGRAM = runpy.run_path(str(SCRIPT))
MODEL = "ContactMultiBody.Examples.HammerOnAnvil"
Row = dict[str, str]


def as_program(model: str, result: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, SCRIPT, model, result], capture_output=True, text=True, check=False)


def compare(model: str, result: Path) -> subprocess.CompletedProcess[str]:
    """The same in this process, which spares the program's start."""
    words = [str(SCRIPT), model, str(result)]
    with redirect_stdout(StringIO()) as said, redirect_stderr(StringIO()) as wrong, patch.object(sys, "argv", words):
        status = PROGRAM["main"]()
    return subprocess.CompletedProcess(words, status, said.getvalue(), wrong.getvalue())


def changed(folder: Path, model: str, change: Callable[[Row], Row]) -> Path:
    """The reference with every row changed."""
    with (REPOSITORY / "Resources" / "reference" / "openmodelica" / f"{model}.csv").open(newline="") as stream:
        rows = [change(row) for row in csv.DictReader(stream)]
    path = folder / "result.csv"
    with path.open("w", newline="") as stream:
        writer = csv.DictWriter(stream, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)
    return path


def bounded(case: Case, value: str) -> Row:
    """The signals that a case's bounds are about."""
    return {name: value for check in case.checks if isinstance(check, BoundCheck) for name in check.signals}


def test_every_reference_has_a_case_for_each_way_to_simulate() -> None:
    files = {path.stem for path in (REPOSITORY / "Resources" / "reference" / "openmodelica").glob("*.csv")}
    assert len(files) > 15
    for mode in ("me", "cs"):
        cases = [case for case in CASES if case.modes == (mode,)]
        assert {case.model for case in cases} == files
        for case in cases:
            assert case.reference is not None
            assert case.reference.stem == case.model


@pytest.mark.parametrize("case", [case for case in CASES if case.modes == ("me",)], ids=lambda case: case.name)
def test_a_reference_agrees_with_itself(tmp_path: Path, case: Case) -> None:
    """Bounds are known answers, which references need not hold: their signals are taken to be zero."""
    assert case.model is not None
    found = compare(case.model, changed(tmp_path, case.model, lambda row: {**row, **bounded(case, "0")}))
    assert (found.returncode, found.stderr) == (0, "")
    assert "checks hold" in found.stdout


def test_a_trajectory_that_is_off_is_named(tmp_path: Path) -> None:
    def off(row: Row) -> Row:
        return {**row, "wrist.phi": str(float(row["wrist.phi"]) + (1e-3 if float(row["time"]) > 0.5 else 0.0))}

    found = compare(MODEL, changed(tmp_path, MODEL, off))
    assert found.returncode == 1
    assert "wrist.phi" in found.stdout
    assert "shoulder.phi" not in found.stdout


def test_a_stack_that_creeps_is_named(tmp_path: Path) -> None:
    case = next(case for case in CASES if case.name == "StackOfBoxes")
    assert case.model is not None
    found = compare(case.model, changed(tmp_path, case.model, lambda row: {**row, **bounded(case, "6.5e-6")}))
    assert found.returncode == 1
    assert [line.split(":")[0] for line in found.stdout.splitlines()] == [
        f"bounds of box[{box}].v_0[{axis}]" for box in (1, 2, 3) for axis in (1, 2)
    ]


def test_an_impact_that_comes_late_is_named(tmp_path: Path) -> None:
    model = "ContactMultiBody.Examples.BoxOnEdge"

    def late(row: Row) -> Row:
        return {**row, "time": str(float(row["time"]) * (1 + 1e-4))}

    found = compare(model, changed(tmp_path, model, late))
    assert found.returncode == 1
    assert re.search(r"contacts\.distance\[1\] falls through 0: event \d+ at", found.stdout)


def test_a_trajectory_that_lacks_a_variable_or_ends_early_fails(tmp_path: Path) -> None:
    found = compare(MODEL, changed(tmp_path, MODEL, lambda row: {k: v for k, v in row.items() if k != "wrist.w"}))
    assert found.returncode == 1
    assert "wrist.w" in found.stdout
    early = changed(tmp_path, MODEL, lambda row: {**row, "time": str(float(row["time"]) / 2)})
    assert compare(MODEL, early).returncode == 1


def test_models_without_a_reference_and_files_that_are_not_there_are_told_apart(tmp_path: Path) -> None:
    assert as_program("ContactMultiBody.Examples.SpheresOnFloor", tmp_path / "none.csv").returncode == 0
    assert as_program(MODEL, tmp_path / "none.csv").returncode == 2


def test_a_model_is_simulated_with_the_solver_that_its_annotation_names() -> None:
    flags = runpy.run_path(str(REPOSITORY / "scripts" / "test-omc"))["flags"]
    assert flags("ContactMultiBody.Examples.SpheresInBox") == ["-s=gbode", "-gbm=dopri45"]
    assert flags(MODEL) == []
