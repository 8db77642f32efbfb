"""The reference models agree with OpenModelica's trajectories, by model exchange and co-simulation."""

from __future__ import annotations

from pathlib import Path

import pytest
from program import CaseCheck, cases_of

QUICK = {"BouncingBall", "DoublePendulum", "PlanarFourBar", "SlidingBlock"}


@pytest.mark.parametrize("path", cases_of("reference", QUICK))
def test_case(path: Path, check_case: CaseCheck) -> None:
    check_case(path)
