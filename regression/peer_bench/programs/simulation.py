"""What every program's simulation offers, and the one way in which all are timed."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from peer_bench.scenes import Scene

Settings = Mapping[str, float | str]


class Simulation(Protocol):
    """A scene at its start, with all of a program's start-up done."""

    def advance(self, until: float) -> None:
        """Simulates until a time, s."""

    def values(self) -> list[float]:
        """What is compared, now."""

    def work(self) -> dict[str, float]:
        """Counts of what was done, by name; what a program does not tell is left out."""

    def close(self) -> None:
        """Frees what it holds."""


@dataclass(frozen=True)
class Timed:
    """A simulation that was run.

    Attributes:
        values: at every time of the scene, a row each.
        cpu_time: of the process from the first step to the last value, s.
        work: counts.
    """

    values: list[list[float]]
    cpu_time: float
    work: dict[str, float]


def timed(simulation: Simulation, scene: Scene) -> Timed:
    """Runs a simulation to the end; start-up before and tidying after are not counted.

    Raises:
        ArithmeticError: a value is not finite.
    """
    times = scene.times.tolist()
    try:
        rows = [simulation.values()]
        began = time.process_time()
        for until in times[1:]:
            simulation.advance(until)
            rows.append(simulation.values())
        cpu_time = time.process_time() - began
        if not np.isfinite(rows).all():
            raise ArithmeticError("a value is not finite")
        return Timed(rows, cpu_time, simulation.work())
    finally:
        simulation.close()


def whole_steps(interval: float, step: float) -> int:
    """The number of equal steps in an interval that are no longer than ``step``."""
    return max(1, round(interval / step + 0.499999))
