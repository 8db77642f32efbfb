"""The program under test and its sample."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from pathlib import Path

from cmb.project import CASES, ROOT
from fmu_regression.cases.case import find_cases

Cmb = Callable[..., "subprocess.CompletedProcess[str]"]

CaseCheck = Callable[[Path], None]

HAMMER = ROOT / "Resources" / "cad" / "hammer"


def cases_of(folder: str) -> list[Path]:
    """The regression cases of one folder of ``regression/cases``."""
    return list(find_cases(CASES / folder))


def case_name(path: Path) -> str:
    """A case's name, for the test's."""
    return path.stem
