"""The reference models agree with OpenModelica's trajectories, by model exchange and co-simulation."""

from __future__ import annotations

from pathlib import Path

import pytest
from program import CaseCheck, cases_of

QUICK = {"SlidingBlock"}


@pytest.mark.parametrize("path", cases_of("reference", QUICK))
def test_case(path: Path, check_case: CaseCheck) -> None:
    check_case(path)


@pytest.mark.parametrize("path", cases_of("openmodelica", ()))
def test_case_of_the_library(path: Path, check_case: CaseCheck) -> None:
    """The library's own models, with contacts: co-simulation cases end on CoSimulation."""
    check_case(path)
