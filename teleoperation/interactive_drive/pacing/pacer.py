"""Steps of simulated time released by a monotonic clock; a scene too heavy slows down, no step is skipped."""

from __future__ import annotations

import math
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

LEAST_SPEED, LARGEST_SPEED = 0.01, 100.0
_PATIENCE = 0.1
_WINDOW = 1.0
_KEPT = 200_000


@dataclass(frozen=True)
class PacingRecord:
    """Wall times of the steps since the last pause, reset or change of speed, at most the last 200000.

    Attributes:
        steps: made.
        missed: steps that ended after the next one should have begun.
        lost: wall time by which simulated time fell behind and which was given up, s.
        delays: from the planned to the real beginning of each step that had to wait, s.
        durations: of each step, s.
        work: processor time of each step, s; what is missing to its duration was waited for the processor.
        overruns: of each missed deadline, s.
    """

    steps: int
    missed: int
    lost: float
    delays: tuple[float, ...]
    durations: tuple[float, ...]
    work: tuple[float, ...]
    overruns: tuple[float, ...]


class Pacer:
    """Says when a step begins.

    A step that lasts too long is a missed deadline. Up to a tenth of a second is caught up with, as the following
    steps begin at once; what goes beyond it is given up, so that simulated time is slower than the clock.

    Args:
        step: length of a communication step, s of simulated time.
        clock: monotonic, s.
        sleep: waits for a number of seconds.
        work_clock: processor time of this thread, s.
    """

    def __init__(
        self,
        step: float,
        clock: Callable[[], float] = time.perf_counter,
        sleep: Callable[[float], None] = time.sleep,
        work_clock: Callable[[], float] = time.thread_time,
    ) -> None:
        self._step, self._clock, self._sleep, self._work_clock = step, clock, sleep, work_clock
        self.speed = 1.0
        self._delays: deque[float] = deque(maxlen=_KEPT)
        self._durations: deque[float] = deque(maxlen=_KEPT)
        self._overruns: deque[float] = deque(maxlen=_KEPT)
        self._work: deque[float] = deque(maxlen=_KEPT)
        self._work_begun = 0.0
        self.steps = self.missed = 0
        self._lost = 0.0
        self._recent: deque[float] = deque()
        self._release = self._begun = clock()

    def for_steps_of(self, step: float) -> Pacer:
        """Another pacer by the same clock, for steps of another length, at the same speed."""
        other = Pacer(step, self._clock, self._sleep, self._work_clock)
        other.speed = self.speed
        return other

    def set_speed(self, speed: float) -> None:
        """Simulated over wall time that is aimed at; begins anew."""
        self.speed = min(LARGEST_SPEED, max(LEAST_SPEED, speed))
        self.begin()

    def begin(self) -> None:
        """The next step begins now; for the start and after every pause."""
        self._release = self._clock()
        self._recent.clear()

    def clear_record(self) -> None:
        """Forgets what was measured."""
        for measured in (self._delays, self._durations, self._overruns, self._work):
            measured.clear()
        self.steps = self.missed = 0
        self._lost = 0.0

    def wait(self) -> None:
        """Waits until the next step begins."""
        ahead = self._release - self._clock()
        if ahead > 0:
            self._sleep(ahead)

    def step_begins(self) -> None:
        """To be called when a step begins."""
        self._begun = self._clock()
        self._work_begun = self._work_clock()
        self._delays.append(max(0.0, self._begun - self._release))

    def step_ended(self) -> None:
        """To be called when a step ended."""
        now = self._clock()
        self.steps += 1
        self._durations.append(now - self._begun)
        self._work.append(self._work_clock() - self._work_begun)
        self._recent.append(now)
        while len(self._recent) > 2 and self._recent[-1] - self._recent[0] > _WINDOW:
            self._recent.popleft()
        self._release += self._step / self.speed
        late = now - self._release
        if late > 0:
            self.missed += 1
            self._overruns.append(late)
        if late > _PATIENCE:
            self._lost += late
            self._release = now

    @property
    def factor(self) -> float:
        """Real-time factor: simulated over wall time in the last second; NaN before two steps."""
        if len(self._recent) < 2:
            return math.nan
        span = self._recent[-1] - self._recent[0]
        return (len(self._recent) - 1) * self._step / span if span > 0 else math.nan

    def record(self) -> PacingRecord:
        """What was measured."""
        return PacingRecord(
            self.steps,
            self.missed,
            self._lost,
            tuple(self._delays),
            tuple(self._durations),
            tuple(self._work),
            tuple(self._overruns),
        )
