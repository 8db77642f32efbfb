"""Contact scenes with known answers come out as the closed forms say."""

from __future__ import annotations

from pathlib import Path

import pytest
from program import CaseCheck, cases_of

QUICK = {"backspin_ball", "bouncing_ball"}


@pytest.mark.parametrize("path", cases_of("known_answers", QUICK))
def test_case(path: Path, check_case: CaseCheck) -> None:
    check_case(path)
