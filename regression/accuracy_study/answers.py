"""What the runs of a scene are measured against: answers known in closed form, or a trajectory."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from contact_foundation.errors import SimulationError
from fmu_regression.compare.checks import Direction, EventCheck, ValueCheck
from fmu_regression.compare.comparison import evaluate, find_events
from fmu_regression.compare.trajectory_error import largest_differences
from fmu_regression.results.result import SimulationResult


@dataclass(frozen=True)
class KnownValue:
    """The sum of signals has a known value at a time, None: at the end; errors are divided by ``scale``."""

    signals: tuple[str, ...]
    expected: float
    time: float | None
    scale: float


@dataclass(frozen=True)
class KnownEvents:
    """A signal crosses a threshold at known times, s, its first crossings; errors are divided by ``scale``, s."""

    name: str
    threshold: float
    direction: Direction
    times: tuple[float, ...]
    scale: float


@dataclass(frozen=True)
class ClosedForm:
    """Answers known in closed form, and where they come from."""

    values: tuple[KnownValue, ...]
    events: tuple[KnownEvents, ...]
    source: str

    @property
    def signals(self) -> tuple[str, ...]:
        """Every signal that is looked at, each once."""
        names = [name for value in self.values for name in value.signals]
        return tuple(dict.fromkeys([*names, *(event.name for event in self.events)]))


@dataclass(frozen=True)
class GivenTrajectory:
    """A trajectory in a CSV file, and where it comes from."""

    path: Path
    source: str


@dataclass(frozen=True)
class Error:
    """The largest error of a run by the scale of what shows it, and what that is."""

    value: float
    worst: str


def closed_form_error(answers: ClosedForm, result: SimulationResult) -> Error:
    """How far a run is from known answers.

    Raises:
        SimulationError: an event is missing, or a value is no number.
        InputError: the run has no such signal or ends before a time.
    """
    found: dict[str, float] = {}
    for value in answers.values:
        check = ValueCheck(value.signals, value.expected, 0.0, value.time)
        found[check.subject] = _finite(evaluate(check, result, None, 0.0).measured, check.subject) / value.scale
    for event in answers.events:
        check_events = EventCheck(event.name, 0.0, event.threshold, event.direction)
        times = find_events(check_events, result).times[: len(event.times)]
        if times.size < len(event.times):
            raise SimulationError(f"{check_events.subject} {times.size} times instead of {len(event.times)}")
        found[check_events.subject] = float(np.abs(times - np.array(event.times)).max()) / event.scale
    worst = max(found, key=lambda name: found[name])
    return Error(found[worst], worst)


def trajectory_error(truth: SimulationResult, result: SimulationResult, signals: tuple[str, ...]) -> Error:
    """The largest difference of a run from a trajectory, by the range of the signal that shows it.

    Raises:
        SimulationError: a value is no number, or the run ends before the trajectory.
    """
    found = largest_differences(result, truth, signals)
    worst = max(found, key=lambda name: found[name])
    return Error(_finite(found[worst], worst), worst)


def _finite(value: float | None, what: str) -> float:
    if value is None or not np.isfinite(value):
        raise SimulationError(f"{what} is not finite, or the run ends before the reference")
    return value
