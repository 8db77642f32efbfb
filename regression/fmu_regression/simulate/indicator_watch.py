"""Event indicators that change their sign and change it back within one step of the integrator."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from fmu_regression.results.result import FloatArray

_NEAR_END = 1e-4
IndicatorsAt = Callable[[float], FloatArray | None]


class IndicatorWatch:
    """Looks for zeros of event indicators between the ends of steps, as FMUs of this project do in co-simulation.

    An integrator compares signs at the ends of its steps. Where an indicator may have had zeros between them, this
    looks there, at interpolated states, and shows the indicator as if it had kept the sign that it had in between; so
    the integrator finds the first of the zeros itself.
    """

    def __init__(self, count: int) -> None:
        self._count = count
        self.restart()

    def restart(self) -> None:
        """The integrator starts afresh: all that was seen is forgotten."""
        self._seen: list[tuple[float, FloatArray]] = []
        self._hidden = np.full(self._count, np.inf)
        self._shown = np.zeros(self._count)

    def step(self, time: float, indicators: FloatArray, indicators_at: IndicatorsAt) -> None:
        """Takes the indicators at the start and the end of each step, shape (n,); looks between the last two.

        Args:
            time: of the indicators; earlier ones than the last, where an integrator looks for roots, do nothing.
            indicators: as they are.
            indicators_at: those within the last step; None where they cannot be evaluated.
        """
        if self._seen and time <= self._seen[-1][0]:
            return
        if self._seen:
            self._look_between(time, indicators, indicators_at)
        self._seen = [*self._seen[-1:], (time, indicators.copy())]

    def shown(self, time: float, indicators: FloatArray) -> FloatArray:
        """What the integrator shall see, shape (n,)."""
        kept = np.copysign(np.maximum(np.abs(indicators), np.abs(self._shown)), self._shown)
        return np.where(time >= self._hidden, kept, indicators)

    def _look_between(self, time: float, now: FloatArray, indicators_at: IndicatorsAt) -> None:
        begin, last = self._seen[-1]
        lasted = time - begin
        change = np.abs(now - last)
        if len(self._seen) > 1:
            earlier_time, earlier = self._seen[0]
            change = np.maximum(change, np.abs(last - earlier) / (begin - earlier_time) * lasted)
        suspicious = (last * now > 0) & (np.minimum(np.abs(last), np.abs(now)) < change)
        if not suspicious.any() or lasted <= 16.0 * np.spacing(time):
            return
        middle = indicators_at(begin + 0.5 * lasted)
        if middle is None:
            return
        self._hide(begin + 0.5 * lasted, middle, last)
        curvature = last - 2.0 * middle + now
        towards_zero = np.abs(middle) < np.maximum(np.abs(last), np.abs(now))
        for k in np.flatnonzero(suspicious & towards_zero & (curvature != 0.0) & np.isinf(self._hidden)):
            share = 0.5 + 0.25 * (last[k] - now[k]) / curvature[k]  # where the parabola has its extremum
            if _NEAR_END < share < 1.0 - _NEAR_END and (peak := indicators_at(begin + share * lasted)) is not None:
                self._hide(begin + share * lasted, peak, last)

    def _hide(self, time: float, between: FloatArray, last: FloatArray) -> None:
        """Hides the later sign of indicators that have another one here than at the beginning of the step."""
        other = (last * between < 0.0) & (time < self._hidden)
        self._hidden[other] = time
        self._shown[other] = between[other]
