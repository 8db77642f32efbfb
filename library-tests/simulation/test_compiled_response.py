"""The engine's forces are those of the library's equations, over hundreds of random scenes and under every law."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from fmpy import simulate_fmu
from library_compiler import REPOSITORY
from modelica2fmu.build import BuildOptions, build_fmu
from numpy.typing import NDArray

LAWS = (
    "exact",
    "juhasz",
    "huntCrossley",
    "herbertMcWhannell",
    "leeWang",
    "lankaraniNikravesh",
    "gonthier",
    "flores",
    "huGuo",
)
# Restitution; spring and damper with spin and rolling friction; constant damping without friction.
SHAPES = ("restitution", "springDamper", "constantDamping")
DIFFERENCES = (
    ("forceDifference", "largestForce"),
    ("torqueDifference", "largestTorque"),
    ("energyDifference", "energy[1]"),
)

Trajectories = Callable[[str, tuple[str, ...]], NDArray[np.void]]

pytestmark = pytest.mark.skipif(
    not (REPOSITORY / "ContactMultiBody" / "Resources" / "Library" / "linux64" / "libContactMultiBody.a").is_file(),
    reason="the contact engine is not installed; run scripts/setup",
)


@pytest.fixture(scope="module")
def trajectories(tmp_path_factory: pytest.TempPathFactory, fmu_cache: Path) -> Trajectories:
    folder: Path = tmp_path_factory.mktemp("both_ways")

    @cache
    def trajectory(model: str, parts: tuple[str, ...]) -> NDArray[np.void]:
        sources = [REPOSITORY / "ContactMultiBodyTest", REPOSITORY / "ContactMultiBody"]
        options = BuildOptions(msl=REPOSITORY / "Resources" / "MultiBodyCore", cache=fmu_cache)
        report = build_fmu(f"ContactMultiBodyTest.{model}", sources, folder / f"{model}.fmu", options)
        names = [f"{part}comparison.{name}" for part in parts for pair in DIFFERENCES for name in pair]
        result: NDArray[np.void] = simulate_fmu(
            str(report.fmu), stop_time=50.0, output_interval=0.1, fmi_type="CoSimulation", output=names
        )
        return result

    return trajectory


def check(result: NDArray[np.void], part: str) -> None:
    assert len(result) > 450
    assert (result[f"{part}comparison.largestForce"] > 1).sum() > 400, "the bodies hardly touch"
    for difference, size in DIFFERENCES:
        relative = result[f"{part}comparison.{difference}"] / (result[f"{part}comparison.{size}"] + 1e-9)
        assert relative.max() < 1e-10, f"{part}{difference} at {result['time'][relative.argmax()]} s"


@pytest.mark.full
def test_spheres_under_the_exact_law(trajectories: Trajectories) -> None:
    check(trajectories("Agreement.SpheresByBothWays", ("",)), "")


@pytest.mark.full
@pytest.mark.parametrize("law", LAWS)
def test_every_law_of_restitution(trajectories: Trajectories, law: str) -> None:
    check(trajectories("Agreement.LawsByBothWays", tuple(f"{each}." for each in LAWS)), f"{law}.")


@pytest.mark.full
@pytest.mark.parametrize("part", SHAPES)
def test_shapes_with_many_points(trajectories: Trajectories, part: str) -> None:
    check(trajectories("Agreement.ShapesByBothWays", tuple(f"{each}." for each in SHAPES)), f"{part}.")
