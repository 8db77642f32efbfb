"""What `cmb` shows in a terminal: progress bars and short tables."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager

from contact_foundation.progress import Progress


@contextmanager
def progress_bars() -> Iterator[Progress]:
    """Yields a `Progress` that draws one bar a phase on standard error.

    Where standard error is no terminal, each phase is one line when it begins.
    """
    if not sys.stderr.isatty():
        yield _LinePerPhase()
        return
    from rich.console import Console
    from rich.progress import BarColumn, TaskID, TextColumn, TimeElapsedColumn
    from rich.progress import Progress as Bars

    bars = Bars(
        TextColumn("{task.description:<28.28}"),
        BarColumn(bar_width=28),
        TextColumn("{task.percentage:>3.0f} %"),
        TimeElapsedColumn(),
        TextColumn("{task.fields[remark]:.40}", style="dim"),
        console=Console(stderr=True),
    )
    with bars:
        tasks: dict[str, TaskID] = {}

        def report(phase: str, fraction: float, message: str = "") -> None:
            if phase not in tasks:
                tasks[phase] = bars.add_task(phase, total=1.0, remark=message)
            bars.update(tasks[phase], completed=min(max(fraction, 0.0), 1.0), remark=message)

        yield report


class _LinePerPhase:
    def __init__(self) -> None:
        self._begun: set[str] = set()

    def __call__(self, phase: str, fraction: float, message: str = "") -> None:
        if phase not in self._begun:
            self._begun.add(phase)
            remark = f": {message}" if message and fraction >= 1.0 else ""  # of one that began and ended at once
            sys.stderr.write(f"{phase}{remark}\n")
            sys.stderr.flush()
