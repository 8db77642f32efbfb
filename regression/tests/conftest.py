"""Fixtures: a hand-written FMU whose motion is known in closed form."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

FIXTURES = Path(__file__).parent / "fixtures"


@pytest.fixture(scope="session")
def bouncing_mass(hand_written_fmu: Callable[[Path], Path]) -> Path:
    """An FMU of a mass that bounces on a rigid floor: h(0) = 1 m, g = 10 m/s2, e = 0.5."""
    return hand_written_fmu(FIXTURES / "bouncing_mass.c")
