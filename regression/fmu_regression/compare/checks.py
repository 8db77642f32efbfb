"""What a regression case can ask of a result: one small record for each kind of check."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Window = tuple[float, float]
Direction = Literal["rising", "falling", "either"]


@dataclass(frozen=True)
class SignalCheck:
    """A signal follows the reference.

    Attributes:
        name: the signal.
        tolerance: largest difference, relative to the range of the reference in the window.
        nominal: least value that the range counts as, in the unit of the signal.
        window: from and to in s, or None for the whole.
        tube: half-width in time, s, within which the result may run ahead or behind; 0 compares at equal times.
    """

    name: str
    tolerance: float
    nominal: float
    window: Window | None = None
    tube: float = 0.0

    @property
    def signals(self) -> tuple[str, ...]:
        """Signals that the check reads from the result."""
        return (self.name,)

    @property
    def subject(self) -> str:
        """What is checked, for a table."""
        return self.name


@dataclass(frozen=True)
class ValueCheck:
    """The sum of signals has a known value at a time; time None is the end."""

    signals: tuple[str, ...]
    expected: float
    tolerance: float
    time: float | None = None

    @property
    def subject(self) -> str:
        """What is checked, for a table."""
        return f"{' + '.join(self.signals)} at {'the end' if self.time is None else f'{self.time:g} s'}"


@dataclass(frozen=True)
class EventCheck:
    """A signal crosses a threshold, or changes, at known times.

    Attributes:
        name: the signal.
        tolerance: largest difference of a time, s.
        threshold: the value that is crossed, or None: every change of a discrete signal is an event.
        direction: which crossings or changes count.
        times: the expected times, or None: those of the reference.
        count: expected number of events, or None: as many as there are expected times.
        first: how many events, from the first, are compared; None for all.
        window: from and to in s, or None.
        value_of: a signal whose value at the events is checked too.
        values: its expected values.
        value_tolerance: largest difference of a value, in the unit of that signal.
    """

    name: str
    tolerance: float
    threshold: float | None = None
    direction: Direction = "either"
    times: tuple[float, ...] | None = None
    count: int | None = None
    first: int | None = None
    window: Window | None = None
    value_of: str | None = None
    values: tuple[float, ...] | None = None
    value_tolerance: float | None = None

    @property
    def signals(self) -> tuple[str, ...]:
        """Signals that the check reads from the result."""
        return (self.name,) if self.value_of is None else (self.name, self.value_of)

    @property
    def subject(self) -> str:
        """What is checked, for a table."""
        if self.threshold is None:
            return f"changes of {self.name}"
        verb = {"rising": "rises through", "falling": "falls through", "either": "crosses"}[self.direction]
        return f"{self.name} {verb} {self.threshold:g}"


@dataclass(frozen=True)
class MeanCheck:
    """The mean over time of a sum of signals; expected None takes that of the reference.

    tolerance is absolute, or a share of the expected mean if ``relative``.
    """

    signals: tuple[str, ...]
    tolerance: float
    relative: bool = False
    expected: float | None = None
    window: Window | None = None

    @property
    def subject(self) -> str:
        """What is checked, for a table."""
        return f"mean of {' + '.join(self.signals)}"


@dataclass(frozen=True)
class BoundCheck:
    """A sum of signals stays between two bounds; None is no bound."""

    signals: tuple[str, ...]
    minimum: float | None = None
    maximum: float | None = None
    window: Window | None = None

    @property
    def subject(self) -> str:
        """What is checked, for a table."""
        return f"bounds of {' + '.join(self.signals)}"


@dataclass(frozen=True)
class MonotonicCheck:
    """A sum of signals only falls, or only rises, by more than a tolerance in its unit."""

    signals: tuple[str, ...]
    direction: Literal["rising", "falling"]
    tolerance: float
    window: Window | None = None

    @property
    def subject(self) -> str:
        """What is checked, for a table."""
        return f"{' + '.join(self.signals)} only {self.direction}"


Check = SignalCheck | ValueCheck | EventCheck | MeanCheck | BoundCheck | MonotonicCheck


@dataclass(frozen=True)
class Outcome:
    """What came out of a check.

    Attributes:
        check: the check.
        passed: whether it holds.
        measured: the figure that decides, in the same unit as ``allowed``; None where there is none.
        allowed: its limit.
        message: one sentence with numbers and times.
    """

    check: Check
    passed: bool
    measured: float | None
    allowed: float | None
    message: str
