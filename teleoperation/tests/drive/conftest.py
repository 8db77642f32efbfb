"""Fixtures: a hand-written FMU that is pushed, and what a drive of it is made of."""

from __future__ import annotations

import subprocess
import zipfile
from pathlib import Path

import fmpy
import pytest
from fmu_regression.fmi.fmu import read_description
from interactive_drive.machine.controls import choose_controls
from interactive_drive.operation.key_map import default_key_map
from interactive_drive.process.worker import Plan
from interactive_drive.server.drive_session import DriveSession

FIXTURES = Path(__file__).parent / "fixtures"
SIGNALS = ("x", "v", "force", "damping", "pause")


@pytest.fixture(scope="session")
def pushed_mass(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An FMU of a mass of 1 kg: input force, tunable damping (1 kg/s)."""
    folder = tmp_path_factory.mktemp("fmu")
    library, headers = folder / "pushed_mass.so", Path(fmpy.__file__).parent / "c-code"
    source = FIXTURES / "pushed_mass.c"
    subprocess.run(
        ["gcc", "-std=c11", "-D_GNU_SOURCE", "-O1", "-shared", "-fPIC", f"-I{headers}", "-o", library, source, "-lm"],
        check=True,
    )
    target = folder / "pushed_mass.fmu"
    with zipfile.ZipFile(target, "w") as archive:
        archive.write(FIXTURES / "pushed_mass.xml", "modelDescription.xml")
        archive.write(library, f"binaries/{fmpy.platform}/pushed_mass.so")
    return target


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
