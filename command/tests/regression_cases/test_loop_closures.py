"""A kinematic loop stays in the closure that it starts in, at every tolerance and step.

``CMB_PATHS=400`` takes so many paths of each loop.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from contact_foundation.errors import SimulationError
from fmpy import simulate_fmu
from fmu_regression.fmi.binding import Mode
from fmu_regression.results.result import SimulationResult
from fmu_regression.simulate.simulation import simulate
from modelica2fmu.build import BuildOptions, build_fmu
from program import HANGS, ROOT

SOURCE = Path(__file__).parent / "fixtures" / "ClosingLoops.mo"
STUDIES = (ROOT / "Resources" / "studies" / "StudyScenes.mo", ROOT / "Resources" / "reference" / "ReferenceModels.mo")
SAMPLES = int(os.environ.get("CMB_PATHS", "200"))
MODES: tuple[Mode, ...] = ("cs", "me")


@dataclass(frozen=True)
class Loop:
    """A loop that strikes a stop: its model, and the angles and speeds that follow from the closure."""

    model: str
    sources: tuple[Path, ...]
    angles: tuple[str, ...]
    speeds: tuple[str, ...]


FOUR_BAR = Loop("StudyScenes.FourBarOnStop", STUDIES, ("j2.phi", "j4.phi"), ("j2.w", "j4.w"))
SLIDER = Loop("ClosingLoops.SliderCrank", (SOURCE,), ("j2.phi", "j4.s"), ("j2.w", "j4.v"))
SPATIAL = Loop(
    "ClosingLoops.SpatialFourBar", (SOURCE,), ("j4.phi", "j2.phi_a", "j2.phi_b"), ("j4.w", "j2.w_a", "j2.w_b")
)
TURNING = Loop("ClosingLoops.DoubleCrank", (SOURCE,), ("j2.phi", "j4.phi"), ("j2.w", "j4.w"))
LOOPS = [pytest.param(loop, id=loop.model.split(".")[1]) for loop in (FOUR_BAR, SLIDER, SPATIAL)]
Build = Callable[[Loop], Path]


@pytest.fixture(scope="module")
def build(engine: None, fmu_cache: Path, tmp_path_factory: pytest.TempPathFactory) -> Build:  # noqa: ARG001
    made: dict[str, Path] = {}

    def run(loop: Loop) -> Path:
        if loop.model not in made:
            fmu = tmp_path_factory.mktemp("loops") / f"{loop.model}.fmu"
            sources = [*loop.sources, ROOT / "ContactMultiBody"]
            made[loop.model] = build_fmu(loop.model, sources, fmu, BuildOptions(cache=fmu_cache)).fmu
        return made[loop.model]

    return run


def largest_leap(loop: Loop, result: SimulationResult) -> float:
    """How much more than the speeds at its ends allow an angle changes between two rows; strikes change speeds."""
    lasted = np.diff(result.time)
    leaps = []
    for angle, speed in zip(loop.angles, loop.speeds, strict=True):
        rate = np.abs(result[speed])
        leaps.append(np.abs(np.diff(result[angle])) - 2.0 * np.maximum(rate[1:], rate[:-1]) * lasted)
    return float(np.max(leaps))


@pytest.mark.full
@pytest.mark.parametrize("count", [SAMPLES])
@pytest.mark.parametrize("loop", LOOPS)
def test_no_loop_changes_its_closure(loop: Loop, count: int, build: Build) -> None:
    fmu = build(loop)
    random = np.random.default_rng(1)
    stopped: list[str] = []
    for _ in range(count):
        settings = {
            "mode": MODES[random.integers(2)],
            "tolerance": float(10.0 ** random.uniform(-8, -2)),
            "interval": float(10.0 ** random.uniform(np.log10(0.5e-3), np.log10(20e-3))),
        }
        start = {"j1.phi": float(random.uniform(0.5, 1.2)), "j1.w": float(random.uniform(-4, 8))}
        signals = [*loop.angles, *loop.speeds, "contacts.distance[1]", "contacts.touches[1]"]
        try:
            result = simulate(
                fmu, signals=signals, stop=1.0, parameters=start, time_limit=HANGS, cpu_limit=60, **settings
            )
        except SimulationError as error:
            stopped.append(str(error))
            continue
        assert largest_leap(loop, result) < 0.3, (settings, start)
        assert not result.log, "what a shorter step avoids is nothing to tell"
        apart = result["contacts.distance[1]"] > 1e-6
        assert not np.any(result["contacts.touches[1]"][apart]), (settings, start)
    assert len(stopped) <= count // 100
    assert all("closure" in said for said in stopped)


@pytest.mark.parametrize("count", [4, pytest.param(SAMPLES // 4, marks=pytest.mark.full)])
def test_a_loop_that_turns_keeps_its_closure(count: int, build: Build) -> None:
    """64 turns, at communication steps of up to 0.1 rad: coupler and follower stay on their side of each other."""
    fmu = build(TURNING)
    random = np.random.default_rng(3)
    for number in range(count):
        speed = float(10.0 ** random.uniform(0.5, 1.9))
        settings = {
            "mode": MODES[number % 2],
            "tolerance": float(10.0 ** random.uniform(-8, -2)),
            "interval": float(10.0 ** random.uniform(-2.5, -1.0)) / speed,
        }
        result = simulate(
            fmu, signals=["j1.phi", "j2.phi", "j4.phi"], stop=400.0 / speed, parameters={"j1.w": speed}, **settings
        )
        side = np.sin(result["j1.phi"] + result["j2.phi"] - result["j4.phi"])
        assert np.all(side * side[0] > 0), (settings, speed)
        assert np.abs(result["j4.phi"] - result["j1.phi"]).max() < np.pi, (settings, speed)
        assert not result.log


@pytest.mark.full
@pytest.mark.parametrize("count", [SAMPLES // 4])
@pytest.mark.parametrize("loop", LOOPS)
def test_importers_that_complete_few_steps_keep_the_closure(loop: Loop, count: int, build: Build) -> None:
    """FMPy's model exchange tells of one completed step an output interval, and knows no discarded evaluation.

    What its integrator makes of one is chance; the spatial loop discards where a trial angle is beyond reach.
    """
    random = np.random.default_rng(2)
    stopped: list[list[str]] = []
    for _ in range(count):
        tolerance, interval = float(10.0 ** random.uniform(-8, -4)), float(10.0 ** random.uniform(-3, -1))
        start = {"j1.phi": float(random.uniform(0.5, 1.2)), "j1.w": float(random.uniform(-4, 8))}
        said: list[str] = []
        try:
            result = simulate_fmu(
                str(build(loop)), fmi_type="ModelExchange", stop_time=1.0, relative_tolerance=tolerance,
                output_interval=interval, start_values=start, output=[*loop.angles, *loop.speeds],
                logger=lambda *words, said=said: said.append(words[-1].decode()),
            )  # fmt: skip
        except Exception:
            stopped.append(said)
            continue
        signals = {name: result[name] for name in (*loop.angles, *loop.speeds)}
        leap = largest_leap(loop, SimulationResult(time=result["time"], signals=signals))
        assert leap < 0.3, (tolerance, interval, start)
    assert all("followed" in said[-1] for said in stopped)
    if loop is not SPATIAL:
        assert len(stopped) <= count // 20 + 1
