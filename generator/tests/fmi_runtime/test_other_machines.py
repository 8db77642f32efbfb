"""An FMU runs the same on a bare machine, on Windows and on 64-bit ARM as here."""

from __future__ import annotations

import zipfile
from pathlib import Path

import numpy as np
import pytest
from contact_data import checkout
from contact_foundation.errors import BuildError, InputError
from modelica2fmu.build import BuildOptions, build_fmu
from modelica2fmu.library.external_code import ExternalCode
from modelica2fmu.packaging.binary import BinarySources, build_binary
from modelica2fmu.packaging.dependencies import find_sundials
from modelica2fmu.packaging.platforms import AARCH64_LINUX, LINUX64, WIN64, Platform, find_platforms
from numpy.typing import NDArray
from other_machines import ARM, BARE, HERE, WINDOWS, Machine, simulate

LIBRARY = checkout() / "ContactMultiBody"
MODEL = "ContactMultiBody.Examples.BallOnFloor"
VARIABLES = ("ball.frame_a.r_0[3]", "contacts.normalForce[1]", "contacts.elasticEnergy")
STOP, STEPS = 1.0, 100

pytestmark = pytest.mark.skipif(
    not (LIBRARY / "Resources" / "Library" / "linux64" / "libContactMultiBody.a").is_file(),
    reason="the contact engine is not installed",
)


def why_not(platform: Platform, machine: Machine) -> str:
    """What keeps this machine from building for a platform and running the result; empty if nothing does."""
    try:
        platform.compiler()
        find_sundials(platform)
    except BuildError as error:
        return f"{error}; run scripts/setup cross"
    folders = platform.searched([LIBRARY / "Resources" / "Library"])
    if not any((folder / "libContactMultiBody.a").is_file() for folder in folders):
        return f"the contact engine is not built for {platform.name}; run scripts/setup cross"
    missing = machine.missing()
    return f"{missing} is missing; run scripts/setup cross" if missing else ""


OTHERS = [(platform, machine) for platform, machine in ((WIN64, WINDOWS), (AARCH64_LINUX, ARM))]


def build(folder: Path, *platforms: Platform) -> Path:
    fmu = folder / "ball.fmu"
    build_fmu(MODEL, [LIBRARY], fmu, BuildOptions(platforms=tuple(platform.name for platform in platforms)))
    return fmu


def run(machine: Machine, fmu: Path, folder: Path) -> NDArray[np.float64]:
    folder.mkdir()
    return simulate(machine, fmu, VARIABLES, STOP, STEPS, folder)


@pytest.mark.full
@pytest.mark.skipif(bool(BARE.missing()), reason=f"missing: {BARE.missing()}")
def test_it_runs_on_a_machine_with_nothing_but_the_c_library(tmp_path: Path) -> None:
    fmu = build(tmp_path, LINUX64)
    here = run(HERE, fmu, tmp_path / "here")
    assert here[:, 1].min() < here[0, 1] - 0.1  # it fell,
    assert np.diff(here[:, 1]).max() > 0.01 * STOP / STEPS  # and rebounded
    assert np.array_equal(run(BARE, fmu, tmp_path / "bare"), here)


@pytest.mark.full
@pytest.mark.parametrize(("platform", "machine"), OTHERS, ids=[platform.name for platform, _ in OTHERS])
def test_it_runs_on_other_platforms(platform: Platform, machine: Machine, tmp_path: Path) -> None:
    if reason := why_not(platform, machine):
        pytest.skip(reason)
    fmu = build(tmp_path, LINUX64, platform)
    with zipfile.ZipFile(fmu) as archive:
        folders = {name.split("/")[1] for name in archive.namelist() if name.startswith("binaries/")}
    assert folders == {"linux64", platform.name}
    here, there = run(HERE, fmu, tmp_path / "here"), run(machine, fmu, tmp_path / "there")
    # Their functions of mathematics round otherwise; impacts pass that on, a few orders above rounding.
    scale = np.abs(here).max(axis=0)
    assert np.all(np.abs(there - here) <= 1e-6 * scale)


@pytest.mark.full
@pytest.mark.parametrize(("platform", "machine"), OTHERS, ids=[platform.name for platform, _ in OTHERS])
def test_builds_for_other_platforms_are_the_same_again(platform: Platform, machine: Machine, tmp_path: Path) -> None:
    if reason := why_not(platform, machine):
        pytest.skip(reason)
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
    assert build(tmp_path / "one", platform).read_bytes() == build(tmp_path / "two", platform).read_bytes()


def test_platforms_that_are_not_known_are_refused() -> None:
    with pytest.raises(InputError, match="there is no platform 'amiga'"):
        find_platforms(["linux64", "amiga"])
    assert find_platforms(["win64", "win64"]) == (WIN64,)


def test_a_back_end_that_a_platform_does_not_have_is_refused(tmp_path: Path) -> None:
    sources = BinarySources(
        tmp_path, frozenset(), "", ExternalCode(modules=("libContactMultiBodyFcl.so",)), objects_folder=None
    )
    with pytest.raises(BuildError, match=r"there is no libContactMultiBodyFcl\.so for win64"):
        build_binary(WIN64, sources, find_sundials(), tmp_path / "x.dll", tmp_path)
