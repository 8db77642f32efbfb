"""Trajectories that another tool computed, judged by the checks of a case."""

from __future__ import annotations

from pathlib import Path

from fmu_regression.cases.case import Case, find_cases, load_case
from fmu_regression.compare.checks import Outcome
from fmu_regression.compare.comparison import evaluate
from fmu_regression.results.result import read_csv


def case_of(model: str, folder: Path) -> Case | None:
    """The case below a folder that compares a model by model exchange with a reference, if there is one."""
    cases = map(load_case, find_cases(folder))
    return next((case for case in cases if case.model == model and "me" in case.modes and case.reference), None)


def outcomes(case: Case, result: Path) -> list[Outcome]:
    """The checks of a case on a trajectory.

    Raises:
        CmbError: the trajectory or the reference cannot be read.
    """
    assert case.reference is not None
    trajectory, reference = read_csv(result), read_csv(case.reference)
    return [evaluate(check, trajectory, reference, case.time_tolerance) for check in case.checks]
