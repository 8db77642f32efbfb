"""Which numbers of a source can be computed with."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

LARGEST = 1e30
"""Largest number that is read, in any unit: integrals over a mesh are products of five lengths, and squares of them."""
SMALLEST = 1e-30
"""Smallest mass (kg) and size (m) that is no zero."""


def are_usable(values: ArrayLike) -> bool:
    """Whether all numbers are finite and of at most ``LARGEST``."""
    return bool((np.abs(np.asarray(values, dtype=np.float64)) <= LARGEST).all())
