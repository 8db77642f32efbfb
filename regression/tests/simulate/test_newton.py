"""Newton's iteration of model exchange on equations that are hard for it, without an FMU."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from fmu_regression.results.result import FloatArray, SolverCounters
from fmu_regression.simulate import newton
from fmu_regression.simulate.cvode import Cvode, IntegrationError, RecoverableError

MOST_STEPS = 20_000
Rates = Callable[[float, Any], list[float]]


def integrate(rates: Rates, start: list[float], stop: float, tolerance: float) -> tuple[FloatArray, SolverCounters]:
    """Rows (time, states...) of all steps."""

    def derivatives(time: float, states: Any, result: Any) -> None:
        for i, rate in enumerate(rates(time, states)):
            result[i] = rate

    size = len(start)
    rows = [[0.0, *start]]
    with Cvode(
        derivatives,
        lambda *_: None,
        0.0,
        np.array(start),
        0,
        tolerance,
        np.full(size, 1e-3 * tolerance),
        np.ones(size),
        math.inf,
    ) as solver:
        while rows[-1][0] < stop:
            time, _ = solver.step(stop)
            rows.append([time, *(solver.states[i] for i in range(size))])
            assert len(rows) < MOST_STEPS, f"creeps at {time}"
        return np.array(rows), solver.counters(0, 0)


STIFFNESS, FRICTION, SLOW = 1e6, 0.5, 1e-3


def spinning_ball(_: float, states: Any) -> list[float]:
    """A ball of 1 kg and 1 m that bounces on a spring; friction drives its spin towards a belt's 10 rad/s."""
    height, speed, spin = (float(states[i]) for i in range(3))
    force = STIFFNESS * max(-height, 0.0)
    slip = spin - 10.0
    return [speed, force - 9.81, -FRICTION * force * slip / math.hypot(slip, SLOW)]


def flight_drift(tolerance: float) -> float:
    """How much the spin changes between the end of a contact and the next contact."""
    rows, _ = integrate(spinning_ball, [0.05, -1.0, 9.0], 0.6, tolerance)
    flying = np.flatnonzero(rows[:, 1] > 1e-3)
    pairs = [(a, b) for a, b in itertools.pairwise(flying) if b == a + 1]
    assert len(pairs) > 10
    return max(abs(rows[b, 3] - rows[a, 3]) for a, b in pairs)


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-4, 1e-5])
def test_the_friction_of_a_contact_that_opened_ends_with_it(tolerance: float) -> None:
    assert flight_drift(tolerance) < tolerance * 10.0


def test_corrections_alone_would_not_show_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """Else the test above could not fail."""
    monkeypatch.setattr(newton, "SMALL_RESIDUAL", math.inf)
    assert max(flight_drift(tolerance) / tolerance for tolerance in (1e-2, 1e-3, 1e-4)) > 10.0


RADIUS = 170.0


def bouncing_giant(_: float, states: Any) -> list[float]:
    """A ball of 1 kg and 340 m that bounces on a spring, by a fraction of a millimetre."""
    depth = max(RADIUS - float(states[0]), 0.0)
    return [float(states[1]), STIFFNESS * depth - 9.81]


FULL = [pytest.param(tolerance, marks=pytest.mark.full) for tolerance in (1e-3, 1e-4, 1e-5)]


@pytest.mark.parametrize("tolerance", [1e-2, *FULL])
def test_bodies_whose_size_times_the_tolerance_is_far_beyond_their_penetration(tolerance: float) -> None:
    """A step that ends in the floor has felt it, though its position may err by more than the floor gives way."""
    rows, _ = integrate(bouncing_giant, [RADIUS + 0.01, 0.0], 2.0, tolerance)
    depth = np.maximum(RADIUS - rows[:, 1], 0.0)
    energy = rows[:, 2] ** 2 / 2 + 9.81 * (rows[:, 1] - RADIUS) + STIFFNESS * depth**2 / 2
    assert np.max(energy - np.minimum.accumulate(energy)) < 0.3 * energy[0]


@pytest.mark.parametrize("tolerance", [1e-2, 1e-4, 1e-6])
def test_states_that_the_model_refuses_are_stepped_around(tolerance: float) -> None:
    """The solution bends where the model ends: predictions go straight on, and steps are made again shorter."""
    refused = 0

    def rates(time: float, states: Any) -> list[float]:
        nonlocal refused
        if states[0] > 1.0 + tolerance:
            refused += 1
            raise RecoverableError("beyond the edge")
        return [(time < 1.0) - 50.0 * (states[0] - min(time, 1.0))]

    rows, counters = integrate(rates, [0.0], 2.0, tolerance)
    assert refused > 0
    assert np.abs(rows[:, 1] - np.minimum(rows[:, 0], 1.0)).max() < 2.0 * tolerance
    assert counters.steps < 300


def test_errors_of_the_model_pass_through() -> None:
    def rates(time: float, _: Any) -> list[float]:
        if time > 0.5:
            raise ZeroDivisionError
        return [1.0]

    with pytest.raises(IntegrationError) as caught:
        integrate(rates, [0.0], 1.0, 1e-4)
    assert isinstance(caught.value.__cause__, ZeroDivisionError)


def test_models_that_bend_within_a_billionth_of_the_nominal_value() -> None:
    """A damper that pushes, at a speed of rest: quotients over a hundred millionth of 1 m/s see its end alone."""
    slow = 1e-9

    def rates(_: float, states: Any) -> list[float]:
        load, speed = float(states[0]), float(states[1])
        return [1.0 - load, 10.0 * (max(1.0 - speed / slow, 0.0) - 1.0 + 0.5 * load)]

    rows, counters = integrate(rates, [0.0, 0.0], 5.0, 1e-6)
    assert rows[-1, 2] == pytest.approx(0.5 * slow * rows[-1, 1], abs=0.1 * slow)
    assert counters.steps < 300
