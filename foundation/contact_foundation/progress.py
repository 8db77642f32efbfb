"""Progress of long work, as library code reports it and a program shows it."""

from __future__ import annotations

from typing import Protocol


class Progress(Protocol):
    """Receives progress: a phase's name, the share of it that is done (0 to 1) and a short remark."""

    def __call__(self, phase: str, fraction: float, message: str = "") -> None:
        """Takes note of progress; called often, so it must be quick."""


def silent(phase: str, fraction: float, message: str = "") -> None:
    """Progress that nobody looks at."""
