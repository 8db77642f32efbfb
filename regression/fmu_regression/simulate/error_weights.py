"""How large an error of a step is beside the tolerance; the FMU does the same in co-simulation (fmurt_weight.c)."""

from __future__ import annotations

from typing import Final

import numpy as np

from fmu_regression.results.result import FloatArray

LONG_STEP: Final = 0.05
"""s; the errors of shorter steps are held to less than the tolerance, in proportion to their length."""
LEAST_SHARE: Final = 0.1
FINEST_TOLERANCE: Final = 1e-5
"""Not below this: what is promised of impacts is kept with it."""


def share_of_tolerance(last_step: float, tolerance: float) -> float:
    """The share of the tolerance by which the next step may err.

    An impact takes some fifty steps however short it is, and their errors add up to tens of tolerances. At rest, in
    free flight and in smooth motion steps are long, and few.

    Args:
        last_step: length of the last step in s; 0 if there was none since the start.
        tolerance: relative tolerance, > 0.
    """
    least = min(1.0, max(LEAST_SHARE, FINEST_TOLERANCE / tolerance))
    return min(1.0, max(least, abs(last_step) / LONG_STEP))


def error_weights(states: FloatArray, absolute: FloatArray, tolerance: float, last_step: float) -> FloatArray:
    """Reciprocals of the errors that a step may make; ``absolute`` has the shape of ``states``, (n,)."""
    permitted: FloatArray = tolerance * np.abs(states) + absolute
    return np.asarray(1.0 / (share_of_tolerance(last_step, tolerance) * permitted))
