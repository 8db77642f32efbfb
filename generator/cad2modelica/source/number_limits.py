"""Which numbers of a source can be computed with."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

LARGEST = 1e30
"""Largest number that is read, in any unit: integrals over a mesh are products of five lengths, and squares of them."""
SMALLEST = 1e-30
"""Smallest mass (kg) and size (m) that is no zero."""


def plain_number(text: str) -> float:
    """A number as XML and C have it; Python would take more, as ``1_000`` and digits of other scripts.

    Raises:
        ValueError: it is none.
    """
    if not text.isascii() or "_" in text:
        raise ValueError(f"{text!r} is no number")
    return float(text)


def is_usable(value: float) -> bool:
    """Whether a number is finite and of at most ``LARGEST``; quicker than ``are_usable`` for a single one."""
    return -LARGEST <= value <= LARGEST


def are_usable(values: ArrayLike) -> bool:
    """Whether all numbers are finite and of at most ``LARGEST``."""
    return bool((np.abs(np.asarray(values, dtype=np.float64)) <= LARGEST).all())
