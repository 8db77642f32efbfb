"""The program under test and its sample."""

from __future__ import annotations

import subprocess
from collections.abc import Callable, Collection
from pathlib import Path

import pytest
from contact_data import checkout
from fmu_regression.cases.case import find_cases

ROOT = checkout()
CASES = ROOT / "regression" / "cases"

Cmb = Callable[..., "subprocess.CompletedProcess[str]"]

CaseCheck = Callable[[Path], None]

HANGS = 600.0
"""Wall time, s, after which a simulation is taken to hang, however busy the machine is."""

HAMMER = ROOT / "Resources" / "cad" / "hammer"


def cases_of(folder: str, quick: Collection[str]) -> list[object]:
    """The regression cases of one folder of ``regression/cases``; all but the ``quick`` ones are marked ``full``."""
    paths = list(find_cases(CASES / folder))
    unknown = set(quick) - {path.stem for path in paths}
    assert not unknown, f"no such case: {', '.join(sorted(unknown))}"
    return [pytest.param(path, id=path.stem, marks=() if path.stem in quick else pytest.mark.full) for path in paths]
