"""Comparing a result with a reference and with known answers.

Interpolation never reaches across an event: a signal is a row of smooth stretches, and at an event both of its sides
count.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from contact_foundation.errors import CmbError, InputError
from numpy.typing import NDArray

from fmu_regression.compare.checks import (
    BoundCheck,
    Check,
    EventCheck,
    MeanCheck,
    MonotonicCheck,
    Outcome,
    SignalCheck,
    ValueCheck,
    Window,
)
from fmu_regression.results.result import FloatArray, SimulationResult
from fmu_regression.scene.motion import smooth_segments

_ROUNDING = 1e-9
# A row within this share of a signal's range of a threshold is on it.
_FOUND = 1e-7


def evaluate(
    check: Check, result: SimulationResult, reference: SimulationResult | None, time_tolerance: float
) -> Outcome:
    """Carries out a check.

    Args:
        check: what is asked.
        result: the simulation.
        reference: the trajectory to compare with; may be None where the check does not need one.
        time_tolerance: how far, in s, events of result and reference may lie apart without counting as a difference
            of signals.

    Returns:
        the outcome; a check that cannot be carried out (a missing signal, a result that ends too early) has failed.
    """
    try:
        if isinstance(check, SignalCheck):
            return _signal(check, result, _needed(reference, result, check.window), time_tolerance)
        if isinstance(check, EventCheck):
            return _event(check, result, reference)
        if isinstance(check, MeanCheck):
            return _mean(check, result, reference)
        if isinstance(check, ValueCheck):
            return _value(check, result)
        if isinstance(check, BoundCheck):
            return _bound(check, result)
        return _monotonic(check, result)
    except CmbError as error:
        return Outcome(check, False, None, None, error.message)


# --- signals against a reference ----------------------------------------------------------------------------------


def signal_differences(
    result: SimulationResult,
    reference: SimulationResult,
    name: str,
    rows: NDArray[np.intp],
    tube: float,
    time_tolerance: float,
) -> FloatArray:
    """Differences of a signal at rows of the reference.

    Away from events the result is interpolated linearly at the time of the row. Within ``time_tolerance`` of an event
    of either, and everywhere if there is a ``tube``, the difference is that to the nearest value the result takes
    within the time around.

    Args:
        result: the simulation.
        reference: what it should be.
        name: the signal.
        rows: shape (k,), rows of the reference.
        tube: half-width in time, s.
        time_tolerance: half-width in time around events, s.

    Returns:
        shape (k,), >= 0; infinite where a value is not finite or the result has none.
    """
    times, wanted = reference.time[rows], reference[name][rows]
    values = result[name]
    differences = np.full(rows.size, np.inf)
    segments = smooth_segments(result.time)
    for part in segments:
        t, y = result.time[part], values[part]
        inside = np.flatnonzero((times >= t[0]) & (times <= t[-1]))
        if inside.size:
            here = np.abs(np.interp(times[inside], t, y) - wanted[inside])
            differences[inside] = np.fmin(differences[inside], np.where(np.isnan(here), np.inf, here))
    events = np.concatenate([result.time[result.event_rows()], reference.time[reference.event_rows()]])
    widths = np.full(rows.size, tube)
    if events.size:
        events = np.unique(events)
        place = np.searchsorted(events, times)
        near = np.minimum(
            np.abs(times - events[np.clip(place, 0, events.size - 1)]),
            np.abs(times - events[np.clip(place - 1, 0, events.size - 1)]),
        )
        widths[near <= time_tolerance] = max(tube, time_tolerance)
    for k in np.flatnonzero((widths > 0) & (differences > 0)):
        differences[k] = min(
            differences[k], _nearest(result.time, values, segments, times[k], widths[k], float(wanted[k]))
        )
    differences[~np.isfinite(wanted)] = np.inf
    return differences


def _nearest(
    time: FloatArray, values: FloatArray, segments: list[slice], when: float, width: float, wanted: float
) -> float:
    """Distance of a value to the nearest one that a signal takes from when - width to when + width."""
    best = np.inf
    for part in segments:
        low, high = max(when - width, float(time[part.start])), min(when + width, float(time[part.stop - 1]))
        if low > high:
            continue
        t, y = time[part], values[part]
        taken = np.concatenate([np.interp([low, high], t, y), y[(t >= low) & (t <= high)]])
        if np.isnan(taken).any():
            continue
        best = min(best, max(0.0, float(taken.min()) - wanted, wanted - float(taken.max())))
    return best


def _signal(check: SignalCheck, result: SimulationResult, reference: SimulationResult, slack: float) -> Outcome:
    rows = _window_rows(reference.time, check.window)
    if not rows.size:
        raise InputError("the reference has no rows in the window")
    last = float(reference.time[rows[-1]])
    if result.time[-1] < last - max(slack, _ROUNDING * abs(last)):
        raise InputError(f"the result ends at {result.time[-1]:g} s, the reference at {last:g} s")
    if not np.isfinite(result[check.name][_window_rows(result.time, check.window)]).all():
        raise InputError("a value of the result is not finite")
    if result.mode == "cs":
        rows = _at_samples(rows, reference.time, result.time)
    wanted = reference[check.name][rows]
    scale = max(float(np.ptp(wanted)), check.nominal)
    differences = signal_differences(result, reference, check.name, rows, check.tube, slack)
    worst = int(np.argmax(differences))
    measured = float(differences[worst]) / scale
    passed = measured <= check.tolerance
    return Outcome(
        check,
        passed,
        measured,
        check.tolerance,
        f"differs by {differences[worst]:.3g} at t = {reference.time[rows[worst]]:.6g} s, "
        f"{measured:.3g} of {scale:.3g}",
    )


def _at_samples(rows: NDArray[np.intp], reference: FloatArray, samples: FloatArray) -> NDArray[np.intp]:
    """The rows whose time is a communication point: between them co-simulation shows nothing, events neither.

    All rows if the reference lies on another grid.
    """
    times = reference[rows]
    place = np.clip(np.searchsorted(samples, times), 1, samples.size - 1)
    off = np.minimum(np.abs(times - samples[place - 1]), np.abs(times - samples[place]))
    shared = rows[off <= _ROUNDING * np.maximum(1.0, np.abs(times))]
    return shared if 2 * shared.size > np.unique(times).size else rows


# --- events -------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class FoundEvents:
    """Times of events, shape (k,), s, and the values of another signal there, shape (k,), if asked for."""

    times: FloatArray
    values: FloatArray | None


def find_events(check: EventCheck, result: SimulationResult) -> FoundEvents:
    """The crossings or changes that a check is about, in order of time."""
    signal = result[check.name]
    time = result.time
    if check.threshold is None:
        steps = np.diff(signal)
        rising, falling = steps > 0, steps < 0
        share = np.where(np.diff(time) > 0, 0.5, 0.0)
    else:
        above = signal > check.threshold
        rising, falling = ~above[:-1] & above[1:], above[:-1] & ~above[1:]
        step = np.diff(signal)
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.where(step != 0, (check.threshold - signal[:-1]) / step, 0.0)
        share[_ends_at_event(time, signal, check.threshold)] = 1.0
    hit = {"rising": rising, "falling": falling, "either": rising | falling}[check.direction]
    rows = np.flatnonzero(hit)
    times = time[rows] + share[rows] * (time[rows + 1] - time[rows])
    keep = _in_window(times, check.window)
    values = None
    if check.value_of is not None:
        other = result[check.value_of]
        values = (other[rows] + share[rows] * (other[rows + 1] - other[rows]))[keep]
    return FoundEvents(times[keep], values)


def _ends_at_event(time: FloatArray, signal: FloatArray, threshold: float) -> NDArray[np.bool_]:
    """= true, for steps, shape (n - 1,), that end at an event which found the crossing: its row, doubled, is on time.

    A line from the row before, which may be the event at which the signal crossed back, would lead anywhere between.
    """
    is_event = np.zeros(time.size - 1, dtype=np.bool_)
    is_event[:-1] = time[1:-1] == time[2:]
    within: NDArray[np.bool_] = np.abs(signal[1:] - threshold) <= _FOUND * np.ptp(signal)
    return is_event & within


def _event(check: EventCheck, result: SimulationResult, reference: SimulationResult | None) -> Outcome:
    found = find_events(check, result)
    if check.times is not None:
        expected: FloatArray | None = np.array(check.times)
        expected_values = np.array(check.values) if check.values is not None else None
    elif reference is not None and check.name in reference:
        from_reference = find_events(check, _needed(reference, result, check.window))
        expected, expected_values = from_reference.times, from_reference.values
        if check.values is not None:
            expected_values = np.array(check.values)
    else:
        expected, expected_values = None, np.array(check.values) if check.values is not None else None
    wanted_count = check.count
    if wanted_count is None and check.first is None and expected is not None:
        wanted_count = expected.size
    if wanted_count is not None and found.times.size != wanted_count:
        return Outcome(
            check,
            False,
            float(found.times.size),
            float(wanted_count),
            f"{found.times.size} events instead of {wanted_count}" + _first_times(found.times),
        )
    measured, message = 0.0, f"{found.times.size} events"
    passed = True
    if expected is not None:
        count = expected.size if check.first is None else min(check.first, expected.size)
        if found.times.size < count:
            return Outcome(check, False, float(found.times.size), float(count), f"only {found.times.size} events")
        if count:
            off = np.abs(found.times[:count] - expected[:count])
            worst = int(np.argmax(off))
            measured = float(off[worst])
            passed = measured <= check.tolerance
            message = f"event {worst + 1} at {found.times[worst]:.9g} s instead of {expected[worst]:.9g} s"
    if passed and expected_values is not None and found.values is not None and check.value_tolerance is not None:
        count = min(expected_values.size, check.first or expected_values.size)
        if found.values.size < count:
            return Outcome(check, False, float(found.values.size), float(count), f"only {found.values.size} events")
        off = np.abs(found.values[:count] - expected_values[:count])
        worst = int(np.argmax(off))
        if not off[worst] <= check.value_tolerance:
            return Outcome(
                check,
                False,
                float(off[worst]),
                check.value_tolerance,
                f"{check.value_of} is {found.values[worst]:.9g} at event {worst + 1} "
                f"instead of {expected_values[worst]:.9g}",
            )
        message += f"; {check.value_of} off by at most {off[worst]:.3g}"
    return Outcome(check, passed, measured, check.tolerance, message)


def _first_times(times: FloatArray) -> str:
    return f", the first at {', '.join(f'{t:.6g}' for t in times[:4])} s" if times.size else ""


# --- sums of signals ----------------------------------------------------------------------------------------------


def mean_over(time: FloatArray, values: FloatArray, window: Window | None) -> float:
    """Mean over time by the trapezoidal rule; the window's ends are interpolated.

    Raises:
        InputError: the window is not within the time of the result.
    """
    start, stop = window if window is not None else (float(time[0]), float(time[-1]))
    slack = _ROUNDING * max(1.0, abs(stop))
    if start < time[0] - slack or stop > time[-1] + slack:
        raise InputError(f"the window {start:g} to {stop:g} s is not within {time[0]:g} to {time[-1]:g} s")
    inside = (time > start) & (time < stop)
    # The right side of an event at the start of the window, the left side of one at its end.
    edges = [float(np.interp(start, time, values)), float(np.interp(stop, time, values))]
    at_start, at_stop = np.flatnonzero(time == start), np.flatnonzero(time == stop)
    if at_start.size:
        edges[0] = float(values[at_start[-1]])
    if at_stop.size:
        edges[1] = float(values[at_stop[0]])
    t = np.concatenate([[start], time[inside], [stop]])
    y = np.concatenate([[edges[0]], values[inside], [edges[1]]])
    return float(np.trapezoid(y, t) / (stop - start))


def _mean(check: MeanCheck, result: SimulationResult, reference: SimulationResult | None) -> Outcome:
    expected = check.expected
    if expected is None:
        known = _needed(reference, result, check.window)
        expected = mean_over(known.time, _sum(known, check.signals), check.window)
    mean = mean_over(result.time, _sum(result, check.signals), check.window)
    allowed = check.tolerance * abs(expected) if check.relative else check.tolerance
    measured = abs(mean - expected)
    return Outcome(check, measured <= allowed, measured, allowed, f"mean {mean:.9g} instead of {expected:.9g}")


def _value(check: ValueCheck, result: SimulationResult) -> Outcome:
    values = _sum(result, check.signals)
    when = float(result.time[-1]) if check.time is None else check.time
    if when > result.time[-1] + _ROUNDING * max(1.0, abs(when)) or when < result.time[0]:
        raise InputError(f"the result has no value at {when:g} s, it ends at {result.time[-1]:g} s")
    at = np.flatnonzero(result.time == when)
    value = float(values[at[-1]]) if at.size else float(np.interp(when, result.time, values))
    measured = abs(value - check.expected)
    return Outcome(
        check, measured <= check.tolerance, measured, check.tolerance, f"{value:.9g} instead of {check.expected:.9g}"
    )


def _bound(check: BoundCheck, result: SimulationResult) -> Outcome:
    rows = _window_rows(result.time, check.window)
    values = _sum(result, check.signals)[rows]
    if not values.size:
        raise InputError("the result has no rows in the window")
    if not np.isfinite(values).all():
        raise InputError("a value is not finite")
    problems = []
    excess = -np.inf
    for bound, sign, word in ((check.minimum, -1.0, "falls to"), (check.maximum, 1.0, "rises to")):
        if bound is None:
            continue
        k = int(np.argmax(sign * values))
        over = float(sign * (values[k] - bound))
        excess = max(excess, over)
        if over > 0:
            problems.append(f"{word} {values[k]:.6g} at t = {result.time[rows[k]]:.6g} s, the bound is {bound:.6g}")
    message = "; ".join(problems) or f"from {values.min():.6g} to {values.max():.6g}"
    return Outcome(check, not problems, excess, 0.0, message)


def _monotonic(check: MonotonicCheck, result: SimulationResult) -> Outcome:
    rows = _window_rows(result.time, check.window)
    values = _sum(result, check.signals)[rows]
    if not values.size:
        raise InputError("the result has no rows in the window")
    falling = values if check.direction == "falling" else -values
    against = falling - np.minimum.accumulate(falling)
    worst = int(np.argmax(against))
    measured = float(against[worst])
    passed = bool(measured <= check.tolerance)
    word = "rises" if check.direction == "falling" else "falls"
    return Outcome(
        check, passed, measured, check.tolerance, f"{word} by {measured:.3g} until t = {result.time[rows[worst]]:.6g} s"
    )


def _sum(result: SimulationResult, names: tuple[str, ...]) -> FloatArray:
    total: FloatArray = np.sum([result[name] for name in names], axis=0)
    return total


def _window_rows(time: FloatArray, window: Window | None) -> NDArray[np.intp]:
    return np.flatnonzero(_in_window(time, window))


def _in_window(time: FloatArray, window: Window | None) -> NDArray[np.bool_]:
    if window is None:
        return np.ones(time.shape, dtype=np.bool_)
    slack = _ROUNDING * max(1.0, abs(window[0]), abs(window[1]))
    inside: NDArray[np.bool_] = (time >= window[0] - slack) & (time <= window[1] + slack)
    return inside


def _needed(reference: SimulationResult | None, result: SimulationResult, window: Window | None) -> SimulationResult:
    """The reference, which must cover the window, or all that was simulated: what is cut off checks nothing."""
    if reference is None:
        raise InputError("the case names no reference")
    begin, end = window if window is not None else (float(result.time[0]), float(result.time[-1]))
    first, last = float(reference.time[0]), float(reference.time[-1])
    rounding = _ROUNDING * max(abs(begin), abs(end))
    if first > begin + rounding or last < end - rounding:
        raise InputError(f"the reference, from {first:g} to {last:g} s, does not cover {begin:g} to {end:g} s")
    return reference
