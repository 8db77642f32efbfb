"""What observers answered."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from depth_study.arrays import FloatArray, IntArray
from depth_study.design.factors import Design

LEAST = 1
GREATEST = 9
SAME = 5
"""The relative answer "as deep as the one before"; greater is deeper."""


@dataclass(frozen=True)
class Answers:
    """Answers of a study.

    Attributes:
        design: what was studied.
        observers: their numbers; n of them.
        sequences: constellations' numbers in the order of showing, -1 where none was planned; shape (n, positions).
        absolute: absolute answers, 1 to 9, in the order of showing; NaN where not answered; shape (n, positions).
        relative: answers relative to the constellation before, 1 to 9; NaN at the first; shape (n, positions).
    """

    design: Design
    observers: tuple[int, ...]
    sequences: IntArray
    absolute: FloatArray
    relative: FloatArray

    @cached_property
    def by_constellation(self) -> FloatArray:
        """Absolute answers by constellation, NaN where not answered; shape (n, constellations)."""
        return by_constellation(self.sequences, self.absolute, len(self.design.constellations))


def by_constellation(sequences: IntArray, values: FloatArray, count: int) -> FloatArray:
    """Sorts values that are in the order of showing by constellation.

    Args:
        sequences: shape (observers, positions), -1 where none was shown.
        values: shape (..., observers, positions).
        count: constellations.

    Returns:
        Shape (..., observers, count); NaN where a constellation was not shown.
    """
    sorted_values = np.full((*values.shape[:-1], count), np.nan)
    rows, positions = np.nonzero(sequences >= 0)
    sorted_values[..., rows, sequences[rows, positions]] = values[..., rows, positions]
    return sorted_values
