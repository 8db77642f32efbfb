"""A loop whose state comes to a dead centre stops there with a message; elsewhere it runs right.

The reference is the same four-bar linkage whose state is the crank's angle, which turns all the way.
``CMB_DEAD_CENTERS=400`` takes so many motions.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import TypedDict

import numpy as np
import pytest
from contact_foundation.errors import SimulationError
from fmu_regression.fmi.binding import Mode
from fmu_regression.results.result import SimulationResult
from fmu_regression.simulate.simulation import simulate
from modelica2fmu.build import BuildOptions, build_fmu

SOURCE = Path(__file__).parent / "fixtures" / "ClosingLoops.mo"
SAMPLES = int(os.environ.get("CMB_DEAD_CENTERS", "150"))
MODES: tuple[Mode, ...] = ("cs", "me")
STOP = 1.0  # s
BEFORE = 0.95  # of the time of the dead centre


class Settings(TypedDict):
    """Of one simulation."""

    interval: float
    mode: Mode


@pytest.fixture(scope="module")
def linkages(fmu_cache: Path, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    folder = tmp_path_factory.mktemp("linkages")
    return {
        state: build_fmu(
            f"ClosingLoops.{state}AsState", [SOURCE], folder / f"{state}.fmu", BuildOptions(cache=fmu_cache)
        ).fmu
        for state in ("Crank", "Rocker")
    }


def simulated(
    fmu: Path, stop: float, tolerance: float, motion: dict[str, float], *, interval: float, mode: Mode
) -> SimulationResult | str:
    """Or what was said where it stopped."""
    try:
        return simulate(
            fmu, signals=["j1.phi"], stop=stop, parameters=motion, tolerance=tolerance, interval=interval, mode=mode
        )
    except SimulationError as error:
        return str(error)


@pytest.mark.parametrize("count", [12, pytest.param(SAMPLES, marks=pytest.mark.full)])
def test_motions_are_right_up_to_the_dead_centre_and_end_there(count: int, linkages: dict[str, Path]) -> None:
    random = np.random.default_rng(1)
    ran = ended = 0
    for number in range(count):
        fastest = (3.0, 8.0)[number % 2]
        motion = {"speed": float(random.uniform(-fastest, fastest)), "stiffness": float(10 ** random.uniform(-1, 2))}
        tolerance = float(10 ** random.uniform(-8, -2))
        settings: Settings = {
            "interval": float(10 ** random.uniform(-3.3, -1.0)),
            "mode": MODES[random.integers(2)],
        }
        reference = simulate(
            linkages["Crank"],
            signals=["j1.phi", "j2.phi"],
            stop=STOP,
            parameters=motion,
            tolerance=1e-10,
            interval=1e-3,
        )
        side = np.sin(reference["j2.phi"])  # zero where crank and coupler are in line
        passed = np.flatnonzero(side * side[0] <= 0)
        stop, comes_there = STOP, len(passed) > 0
        if comes_there and number % 4 == 0:
            stop, comes_there = BEFORE * float(reference.time[passed[0]]), False
        result = simulated(linkages["Rocker"], stop, tolerance, motion, **settings)
        if isinstance(result, str):
            assert "dead centre" in result or "closure" in result, (motion, tolerance, settings)
            # So near to it the state, within the tolerance, does not say on which side the crank is.
            nearest = np.abs(side[reference.time <= stop]).min()
            assert comes_there or nearest**2 < tolerance, (motion, tolerance, settings, nearest)
            ended += 1
        else:
            assert not comes_there, (motion, tolerance, settings)
            right = np.interp(result.time, reference.time, reference["j1.phi"])
            # Where a crank turns back at a dead centre it is off by a tenth and more.
            assert np.abs(result["j1.phi"] - right).max() < max(1e-3, 100 * tolerance), (motion, tolerance, settings)
            ran += 1
    assert ran > count // 5
    assert ended > count // 5
