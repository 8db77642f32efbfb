"""At every tolerance a simulation is as wrong as the tolerance says, and ends."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from cmb.fmu_provider import FmuProvider
from fmu_regression.cases.case import load_case
from fmu_regression.cases.runner import run_case
from fmu_regression.fmi.binding import Mode
from fmu_regression.results.result import SimulationResult
from fmu_regression.simulate.simulation import simulate
from program import CASES, HANGS

GRAVITY, FRICTION, SPEED = 9.81, 0.3, 2.0
DISTANCE = SPEED**2 / (2.0 * FRICTION * GRAVITY)
FEW = 5000  # tolerance 1e-8 takes a tenth of it


@pytest.fixture(scope="session")
def sliding_block(provide_fmu: FmuProvider) -> Path:
    fmu = provide_fmu(load_case(CASES / "library" / "SlidingBlock.toml"))
    assert isinstance(fmu, Path)
    return fmu


@pytest.mark.full
@pytest.mark.parametrize("mode", ["me", "cs"])
@pytest.mark.parametrize("tolerance", [1e-3, 3e-4, 1e-4])
def test_a_sliding_block_stops_in_few_steps(tolerance: float, mode: Mode, sliding_block: Path) -> None:
    """Steps of any length: beside the kink of dry friction the integrator must not go round in circles."""
    for count in (1, 3, 10, 30):
        result = simulate(
            sliding_block,
            signals=["slider.r_0[1]"],
            stop=1.5,
            interval=1.5 / count,
            max_step=1.5 / count,
            tolerance=tolerance,
            mode=mode,
            time_limit=HANGS,
            cpu_limit=60,
        )
        assert result.counters is not None
        assert result.counters.steps < FEW
        assert result["slider.r_0[1]"][-1] == pytest.approx(DISTANCE, abs=1e-4)


SPREAD = 40.0
"""How many tolerances a result may be off, over some bounces."""
TOLERANCES = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8]


@pytest.fixture(scope="session")
def known_answer(provide_fmu: FmuProvider) -> Callable[[str], Path]:
    def build(case: str) -> Path:
        fmu = provide_fmu(load_case(CASES / "known_answers" / f"{case}.toml"))
        assert isinstance(fmu, Path)
        return fmu

    return build


def run(fmu: Path, mode: Mode, tolerance: float, *signals: str, **parameters: float) -> SimulationResult:
    """Simulates; the energy never rises by more than the tolerance's share."""
    result = simulate(
        fmu,
        signals=["energy", *signals],
        mode=mode,
        tolerance=tolerance,
        parameters=parameters,
        time_limit=HANGS,
        cpu_limit=30,
    )
    energy = result["energy"]
    rise = float(np.max(energy - np.minimum.accumulate(energy)))
    assert rise < SPREAD * tolerance * energy[0]
    return result


@pytest.mark.parametrize("mode", ["me", "cs"])
@pytest.mark.parametrize("tolerance", TOLERANCES)
def test_nothing_turns_a_ball_in_flight(tolerance: float, mode: Mode, known_answer: Callable[[str], Path]) -> None:
    """The steps over the end of a contact must not carry its friction on into free flight."""
    result = run(known_answer("backspin_ball"), mode, tolerance, "spin")
    rolling = 11.0 / 0.7  # by the angular momentum about the point of contact
    assert np.max(result["spin"]) < rolling + 0.2 + SPREAD * tolerance * 20.0
    assert result["spin"][-1] == pytest.approx(rolling, abs=0.2 + SPREAD * tolerance * 20.0)


KEPT_AT_LOOSE_TOLERANCE = [
    "ball_against_wall_020",
    "bouncing_ball",
    "off_centre_impact",
    "off_centre_impact_without_events",
    "painleve_rod_without_events",
    "published_laws_9",
    "second_strike_slower",
    "volume_impact",
]
"""Errors of an impact's steps added up to more than is promised at 1e-6."""


@pytest.mark.full
@pytest.mark.parametrize("case", KEPT_AT_LOOSE_TOLERANCE)
def test_what_is_promised_is_kept_at_loose_tolerance(case: str, known_answer: Callable[[str], Path]) -> None:
    loose = replace(load_case(CASES / "known_answers" / f"{case}.toml"), tolerance=1e-4)
    result = run_case(loose, known_answer(case), time_limit=HANGS)
    assert result.runs
    for one in result.runs:
        assert not one.error
        assert one.outcomes
        assert [outcome.message for outcome in one.outcomes if not outcome.passed] == []


@pytest.mark.full
@pytest.mark.parametrize("mode", ["me", "cs"])
@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8])
def test_a_domino_falls_flat_in_few_steps(tolerance: float, mode: Mode, known_answer: Callable[[str], Path]) -> None:
    """Points that others lever into the floor have no jump in their force, or the integrator would creep."""
    result = run(known_answer("falling_domino"), mode, tolerance, "domino.frame_a.r_0[3]")
    assert result.counters is not None
    assert result.counters.steps < FEW
    assert result["domino.frame_a.r_0[3]"][-1] == pytest.approx(0.00375 - 0.0981 / 1e5, abs=1e-9)


@pytest.mark.full
@pytest.mark.parametrize("mode", ["me", "cs"])
@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-4, 1e-6])
@pytest.mark.parametrize("mu", [0.8, 1.0, 1.2, 1.4, 1.6, 2.0, 3.0])
@pytest.mark.parametrize("case", ["painleve_rod", "painleve_rod_without_events", "painleve_rod_anchored"])
def test_a_jamming_rod_gains_no_energy(
    case: str, mu: float, tolerance: float, mode: Mode, known_answer: Callable[[str], Path]
) -> None:
    """Through jamming and lift-off, and without end to the events at none."""
    run(known_answer(case), mode, tolerance, mu=mu)


FAR_FROM_A_STRIKE = [
    ("painleve_rod_without_events", 1.4),
    ("painleve_rod_without_events", 1.6),
    ("painleve_rod_without_events", 3.0),
    ("painleve_rod", 1.6),
    ("painleve_rod", 3.0),
    ("painleve_rod_anchored", 1.6),
    ("painleve_rod_anchored", 3.0),
]
"""Rods that are thrown off; none whose fastest approach happens to be just one that counts as a strike of its own."""


HEIGHT_OF_ROD = "rod.frame_a.r_0[3]"


@pytest.fixture(scope="module")
def height_at_tight_tolerance(known_answer: Callable[[str], Path]) -> Callable[[str, float], float]:
    """Where a rod of a case and a coefficient of friction ends, in m."""

    @cache
    def height(case: str, mu: float) -> float:
        return float(run(known_answer(case), "cs", 1e-8, HEIGHT_OF_ROD, mu=mu)[HEIGHT_OF_ROD][-1])

    return height


@pytest.mark.full
@pytest.mark.parametrize("mode", ["me", "cs"])
@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-4, 1e-5])
@pytest.mark.parametrize(("case", "mu"), FAR_FROM_A_STRIKE)
def test_a_rod_is_thrown_off_alike_at_every_tolerance(
    case: str,
    mu: float,
    tolerance: float,
    mode: Mode,
    known_answer: Callable[[str], Path],
    height_at_tight_tolerance: Callable[[str, float], float],
) -> None:
    """A jam multiplies the error that it begins with, some ten times; but it throws the same way."""
    expected = height_at_tight_tolerance(case, mu)
    found = run(known_answer(case), mode, tolerance, HEIGHT_OF_ROD, mu=mu)[HEIGHT_OF_ROD][-1]
    assert found == pytest.approx(expected, abs=min(5.0 * SPREAD * tolerance, 0.4))


@pytest.mark.full
@pytest.mark.parametrize("mode", ["me", "cs"])
@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6])
@pytest.mark.parametrize("mu", [1.0, 1.1])
def test_a_sliding_rod_with_anchors_comes_to_rest(
    mu: float, tolerance: float, mode: Mode, known_answer: Callable[[str], Path]
) -> None:
    """Anchors of micrometres have derivatives of their own, and a rod that parts slowly makes no events without end."""
    result = run(known_answer("painleve_rod_anchored"), mode, tolerance, HEIGHT_OF_ROD, mu=mu)
    assert result.counters is not None
    assert result.counters.steps < 3 * FEW
    assert result[HEIGHT_OF_ROD][-1] == pytest.approx(0.00199, abs=1e-6)
