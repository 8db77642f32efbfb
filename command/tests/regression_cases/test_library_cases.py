"""The library's models show the properties they are there to show."""

from __future__ import annotations

from pathlib import Path

import pytest
from program import CaseCheck, cases_of


@pytest.mark.parametrize("path", cases_of("library", quick=()))
def test_case(path: Path, check_case: CaseCheck) -> None:
    check_case(path)
