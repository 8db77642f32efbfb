"""How large an error of a step is beside the tolerance, and of which order steps are at most.

The FMU does the same in co-simulation (fmurt_tolerance.c).
"""

from __future__ import annotations

from typing import Final

import numpy as np

from fmu_regression.results.result import FloatArray

LONG_STEP: Final = 0.2
"""s; the errors of shorter steps are held to less than the tolerance, in proportion to their length."""
LEAST_SHARE: Final = 0.08
FINEST_TOLERANCE: Final = 8e-6
"""Not below this: what is promised of impacts is kept with it."""
FINE_TOLERANCE: Final = 1e-6
"""From it down steps may be of order 5; at it small balls that bounce without events come out worse with order 4."""


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


def highest_order(tolerance: float) -> int:
    """The highest order of CVODE's backward differentiation formulas.

    Where a contact opens, the formula of order 5 keeps what was before in swings that die out slowly, within the
    tolerance: a ball's energy rose in flight.

    Args:
        tolerance: relative tolerance, > 0.
    """
    return 5 if tolerance <= FINE_TOLERANCE else 4


def error_weights(states: FloatArray, absolute: FloatArray, tolerance: float, last_step: float) -> FloatArray:
    """Reciprocals of the errors that a step may make; ``absolute`` has the shape of ``states``, (n,)."""
    permitted: FloatArray = tolerance * np.abs(states) + absolute
    return np.asarray(1.0 / (share_of_tolerance(last_step, tolerance) * permitted))
