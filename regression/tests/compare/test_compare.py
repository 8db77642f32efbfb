"""The comparison finds what differs and lets pass what does not."""

from __future__ import annotations

import math

import numpy as np
import pytest
from fmu_regression.compare.checks import (
    BoundCheck,
    Check,
    EventCheck,
    MeanCheck,
    MonotonicCheck,
    Outcome,
    SignalCheck,
    ValueCheck,
)
from fmu_regression.compare.comparison import evaluate, mean_over
from fmu_regression.results.result import SimulationResult


def bounce(
    event: float = 0.5, *, grid: int = 101, scale: float = 1.0, offset: float = 0.0, jump: float = 1.0
) -> SimulationResult:
    """A saw tooth: a rises to its event, falls there to 0 (if ``jump`` is 1) and rises again; n counts events."""
    regular = np.linspace(0, 1, grid)
    time = np.sort(np.concatenate([regular[regular != event], [event, event]]))
    after = np.zeros(time.size)
    after[np.searchsorted(time, event) + 1 :] = 1
    signals = {
        "a": scale * (2 * time - 2 * event * jump * after) + offset,
        "n": after,
        "s": np.sin(2 * math.pi * time),
        "x": np.abs(np.cos(math.pi * time)),
    }
    return SimulationResult(time=time, signals=signals)


def check(what: Check, result: SimulationResult, reference: SimulationResult | None = None) -> Outcome:
    return evaluate(what, result, reference, 1e-4)


def test_equal_trajectories_pass_with_no_difference() -> None:
    outcome = check(SignalCheck("a", 1e-12, 1e-3), bounce(), bounce())
    assert outcome.passed
    assert outcome.measured == 0


def test_other_grid_is_interpolated_without_smearing_the_event() -> None:
    outcome = check(SignalCheck("a", 1e-9, 1e-3), bounce(grid=38), bounce(grid=1001))
    assert outcome.passed, outcome.message


def test_event_a_little_later_passes_within_the_time_tolerance_only() -> None:
    assert check(SignalCheck("a", 1e-3, 1e-3), bounce(0.50005), bounce()).passed
    outcome = check(SignalCheck("a", 1e-3, 1e-3), bounce(0.503), bounce())
    assert not outcome.passed
    assert outcome.measured is not None
    assert outcome.measured > 0.5  # nearly the height of the jump


def test_tube_lets_a_shift_pass() -> None:
    assert not check(SignalCheck("a", 1e-3, 1e-3), bounce(0.503), bounce()).passed
    # At the very end the result could only run ahead, which it cannot have recorded.
    tube = SignalCheck("a", 1e-3, 1e-3, window=(0, 0.98), tube=0.01)
    assert check(tube, bounce(0.503), bounce()).passed
    assert not check(tube, bounce(0.52), bounce()).passed


@pytest.mark.parametrize("wrong", [bounce(scale=1.01), bounce(offset=0.01), bounce(jump=1.02), bounce(jump=0.98)])
def test_scaled_shifted_and_wrong_jumps_fail(wrong: SimulationResult) -> None:
    assert not check(SignalCheck("a", 2e-3, 1e-3), wrong, bounce()).passed


def test_tolerance_is_relative_to_the_range_with_nominal_as_floor() -> None:
    reference = SimulationResult(time=np.array([0.0, 1.0]), signals={"tiny": np.array([0.0, 1e-9])})
    result = SimulationResult(time=np.array([0.0, 1.0]), signals={"tiny": np.array([0.0, 2e-9])})
    assert check(SignalCheck("tiny", 1e-3, 1e-3), result, reference).passed
    assert not check(SignalCheck("tiny", 1e-3, 1e-9), result, reference).passed


def test_window_leaves_the_rest_out() -> None:
    wrong = bounce()
    values = wrong["s"].copy()
    values[wrong.time > 0.8] += 1
    wrong = SimulationResult(time=wrong.time.copy(), signals={"s": values})
    assert check(SignalCheck("s", 1e-6, 1e-3, window=(0, 0.8)), wrong, bounce()).passed
    assert not check(SignalCheck("s", 1e-6, 1e-3), wrong, bounce()).passed


def test_result_that_ends_early_or_is_not_finite_fails() -> None:
    full = bounce()
    short = SimulationResult(time=full.time[:50].copy(), signals={"a": full["a"][:50].copy()})
    outcome = check(SignalCheck("a", 1e-3, 1e-3), short, full)
    assert not outcome.passed
    assert "ends at" in outcome.message
    values = full["a"].copy()
    values[7] = np.nan
    broken = SimulationResult(time=full.time.copy(), signals={"a": values})
    assert not check(SignalCheck("a", 1e-3, 1e-3), broken, full).passed
    assert not check(SignalCheck("a", 1e-3, 1e-3, tube=1.0), broken, full).passed


@pytest.mark.parametrize("rows", [slice(0, 1), slice(0, 60), slice(5, None)])
def test_a_reference_that_does_not_cover_the_time_checks_nothing(rows: slice) -> None:
    whole = bounce()
    cut = SimulationResult(
        whole.time[rows].copy(), {name: values[rows].copy() for name, values in whole.signals.items()}
    )
    checks = (SignalCheck("a", 1.0, 1e-3), EventCheck("n", 1.0), MeanCheck(("a",), 1e6))
    for each in checks:
        assert check(each, whole, whole).passed
        outcome = check(each, whole, cut)
        assert not outcome.passed
        assert "does not cover 0 to 1 s" in outcome.message
    if rows != slice(0, 1):
        assert check(SignalCheck("a", 1.0, 1e-3, window=(0.1, 0.4)), whole, cut).passed


def test_co_simulation_is_compared_at_its_communication_points() -> None:
    full = bounce(0.505)
    keep = np.isin(np.round(full.time, 9), np.round(np.linspace(0, 1, 101), 9))
    values = {"a": full["a"][keep]}
    assert check(SignalCheck("a", 1e-9, 1e-3), SimulationResult(full.time[keep], values, mode="cs"), full).passed
    wrong = {"a": values["a"] + 0.01 * (full.time[keep] > 0.7)}
    assert not check(SignalCheck("a", 1e-9, 1e-3), SimulationResult(full.time[keep], wrong, mode="cs"), full).passed


def test_missing_signal_fails_and_is_named() -> None:
    outcome = check(SignalCheck("b", 1e-3, 1e-3), bounce(), bounce())
    assert not outcome.passed
    assert "'b'" in outcome.message


def test_events_from_the_reference() -> None:
    assert check(EventCheck("n", 1e-6), bounce(0.5000005), bounce()).passed
    outcome = check(EventCheck("n", 1e-6), bounce(0.50001), bounce())
    assert not outcome.passed
    assert outcome.measured == pytest.approx(1e-5, rel=1e-3)


def test_crossings_with_values() -> None:
    what = EventCheck(
        "s", 1e-4, threshold=0.0, direction="falling", times=(0.5,), value_of="x", values=(0.0,), value_tolerance=1e-3
    )
    assert check(what, bounce(0.25)).passed
    for times, values in (((0.501,), (0.0,)), ((0.5,), (0.1,)), ((0.5, 0.9), (0.0, 0.0))):
        wrong = EventCheck(
            "s",
            1e-4,
            threshold=0.0,
            direction="falling",
            times=times,
            value_of="x",
            values=values,
            value_tolerance=1e-3,
        )
        assert not check(wrong, bounce(0.25)).passed


def test_a_crossing_that_an_event_found_is_at_the_event() -> None:
    # A ball leaves at 0.2 s, flies unseen and touches at 0.5 s: rows at the events alone, 1e-11 m beside zero.
    time = np.array([0.0, 0.2, 0.2, 0.5, 0.5, 1.0])
    gap = np.array([-1e-3, 1e-11, 1e-11, -1e-10, -1e-10, -1e-3])
    flight = SimulationResult(time=time, signals={"gap": gap})
    assert check(EventCheck("gap", 1e-6, threshold=0.0, direction="falling", times=(0.5,)), flight).passed
    assert check(EventCheck("gap", 1e-6, threshold=0.0, direction="rising", times=(0.2,)), flight).passed


def test_event_counts() -> None:
    assert check(EventCheck("n", 1e-6, count=1), bounce()).passed
    assert not check(EventCheck("n", 1e-6, count=2), bounce()).passed
    assert not check(EventCheck("n", 1e-6, count=1, direction="falling"), bounce()).passed
    assert check(EventCheck("n", 1e-6, count=0, window=(0.6, 1)), bounce()).passed


def test_mean_uses_the_time_not_the_rows() -> None:
    time = np.concatenate([np.linspace(0, 0.5, 500), np.linspace(0.5, 1, 5)])
    values = np.concatenate([np.zeros(500), np.ones(5)])
    assert mean_over(time, values, None) == pytest.approx(0.5)
    assert mean_over(time, values, (0.5, 1.0)) == pytest.approx(1.0)
    assert mean_over(time, values, (0.0, 0.5)) == pytest.approx(0.0)
    assert mean_over(time, values, (0.4, 0.6)) == pytest.approx(0.5)


def test_mean_of_a_sum() -> None:
    assert check(MeanCheck(("n", "n"), 1e-9, expected=1.0), bounce()).passed
    assert not check(MeanCheck(("n", "n"), 1e-3, expected=1.01), bounce()).passed
    assert check(MeanCheck(("n",), 1e-3, relative=True), bounce(), bounce()).passed
    assert not check(MeanCheck(("a",), 1e-3, relative=True), bounce(scale=1.002), bounce()).passed
    assert not check(MeanCheck(("n",), 1.0, expected=0.0, window=(0.5, 2.0)), bounce()).passed


def test_values() -> None:
    assert check(ValueCheck(("a",), 1.0, 1e-12), bounce()).passed
    assert check(ValueCheck(("a",), 0.5, 1e-12, time=0.25), bounce()).passed
    assert not check(ValueCheck(("a",), 0.5, 1e-3, time=0.26), bounce()).passed
    assert not check(ValueCheck(("a",), 0.5, 1e3, time=1.5), bounce()).passed


def test_bounds() -> None:
    assert check(BoundCheck(("s",), -1, 1), bounce()).passed
    outcome = check(BoundCheck(("s",), maximum=0.9), bounce())
    assert not outcome.passed
    assert outcome.measured == pytest.approx(0.1)
    assert not check(BoundCheck(("s",), minimum=-0.9), bounce()).passed
    assert check(BoundCheck(("s",), minimum=-0.9, window=(0, 0.5)), bounce()).passed


def test_monotonic() -> None:
    assert check(MonotonicCheck(("n",), "rising", 0.0), bounce()).passed
    outcome = check(MonotonicCheck(("a",), "rising", 1e-3), bounce())
    assert not outcome.passed
    assert outcome.measured == pytest.approx(1.0)
    assert check(MonotonicCheck(("x",), "falling", 1e-12, window=(0, 0.5)), bounce()).passed
    assert not check(MonotonicCheck(("x",), "falling", 1e-2), bounce()).passed
