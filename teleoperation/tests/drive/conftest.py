"""Fixtures: a hand-written FMU that is pushed, and what a drive of it is made of."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from fmu_regression.fmi.description import read_description
from interactive_drive.machine.controls import choose_controls
from interactive_drive.operation.key_map import default_key_map
from interactive_drive.process.worker import Plan
from interactive_drive.server.drive_session import DriveSession

FIXTURES = Path(__file__).parent / "fixtures"
SIGNALS = ("x", "v", "force", "damping", "pause")


@pytest.fixture(scope="session")
def pushed_mass(hand_written_fmu: Callable[[Path], Path]) -> Path:
    """An FMU of a mass of 1 kg: input force, tunable damping (1 kg/s)."""
    return hand_written_fmu(FIXTURES / "pushed_mass.c")


@pytest.fixture
def session(pushed_mass: Path, tmp_path: Path) -> DriveSession:
    """A drive of the mass without a scene."""
    controls = choose_controls(read_description(pushed_mass))
    return DriveSession(
        model="PushedMass",
        step=0.01,
        signals=SIGNALS,
        controls=controls,
        key_map=default_key_map(controls),
        scene=None,
        scene_file=None,
        output=tmp_path / "records",
        plots=("x",),
        units={"x": "m"},
    )


@pytest.fixture
def plan(pushed_mass: Path) -> Plan:
    """What the process of such a drive simulates."""
    return Plan(pushed_mass, SIGNALS, 0.01)
