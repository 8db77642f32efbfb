"""The phases of a build: how long each takes, and who is told."""

from __future__ import annotations

import time

from contact_foundation.progress import Progress, silent


class PhaseClock:
    """Times phases that follow one another; itself a receiver of progress, for parts that report their own.

    Args:
        progress: told when a phase begins and ends.

    Attributes:
        timings: name and seconds of each phase that has ended, in order; a name occurs once.
    """

    def __init__(self, progress: Progress = silent) -> None:
        self._progress = progress
        self._start = time.perf_counter()
        self._phase = ""
        self._remark = ""
        self.timings: dict[str, float] = {}

    def __call__(self, phase: str, fraction: float, message: str = "") -> None:
        """Progress of a part of the build: a new name ends the phase before it."""
        if phase != self._phase:
            self.begin(phase)
        if fraction < 1.0:  # its end is reported when it is over
            self._progress(phase, fraction, message)

    def begin(self, phase: str) -> None:
        """Ends the present phase and begins another."""
        self.end()
        self._phase, self._start = phase, time.perf_counter()
        self._progress(phase, 0.0)

    def remark(self, message: str) -> None:
        """Something to be known of the present phase; told now and when it ends."""
        self._remark = message
        self._progress(self._phase, 0.0, message)

    def end(self) -> None:
        """Ends the present phase, if there is one."""
        if self._phase:
            self.timings[self._phase] = self.timings.get(self._phase, 0.0) + time.perf_counter() - self._start
            self._progress(self._phase, 1.0, self._remark)
        self._phase = self._remark = ""
