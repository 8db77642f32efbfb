"""Scenes that take a minute each: that they can still be built at all is a part of what is tested."""

from __future__ import annotations

from pathlib import Path

import pytest
from program import CaseCheck, cases_of


@pytest.mark.parametrize("path", cases_of("large", set()))
def test_case(path: Path, check_case: CaseCheck) -> None:
    check_case(path)
