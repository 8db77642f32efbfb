"""How far a trajectory is from a more accurate one, and how fast errors fall with the tolerance."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np

from fmu_regression.compare.comparison import signal_differences
from fmu_regression.results.result import FloatArray, SimulationResult

_NOMINAL = 1e-3
"""The least range of a signal, in its unit, by which its differences are divided."""
_ABOVE_FLOOR = 5.0
_FEWEST_POINTS = 3


def largest_differences(result: SimulationResult, truth: SimulationResult, names: Sequence[str]) -> dict[str, float]:
    """Largest difference of each signal by its range; at times that are no event of the reference."""
    return {name: float(_relative(result, truth, name).max()) for name in names}


def mean_square(result: SimulationResult, truth: SimulationResult, name: str) -> float:
    """Mean square difference of a signal by its range, at the same times."""
    return float(np.mean(_relative(result, truth, name) ** 2))


def convergence_order(points: Iterable[tuple[float, float | None]], floor: float) -> float | None:
    """Exponent p of error ~ tolerance^p by least squares over the points well above the floor.

    Args:
        points: tolerance and error of each run; None where it failed.
        floor: doubt about the errors.

    Returns:
        None if fewer than three points can be used.
    """
    usable = [
        (math.log10(tolerance), math.log10(error))
        for tolerance, error in points
        if error is not None and error > _ABOVE_FLOOR * max(floor, 1e-300)
    ]
    if len(usable) < _FEWEST_POINTS:
        return None
    x, y = np.array(usable).T
    return float(np.polyfit(x, y, 1)[0])


def _relative(result: SimulationResult, truth: SimulationResult, name: str) -> FloatArray:
    still = np.diff(truth.time) == 0
    at_event = np.concatenate([still, [False]]) | np.concatenate([[False], still])
    rows = np.flatnonzero(~at_event)
    if truth.interval:
        steps = (truth.time[rows] - truth.time[0]) / truth.interval
        rows = rows[(np.abs(steps - np.round(steps)) < 1e-6) | (rows == truth.time.size - 1)]
    scale = max(float(np.ptp(truth[name])), _NOMINAL)
    relative: FloatArray = signal_differences(result, truth, name, rows, 0.0, 0.0) / scale
    return relative
