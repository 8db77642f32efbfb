"""Thinning of long signals for display, extremes kept."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fmu_regression.results.result import FloatArray


def display_rows(values: FloatArray, limit: int) -> NDArray[np.intp]:
    """Rows of a signal that a plot needs.

    The rows are cut into equal buckets; of each the first, the least, the greatest and the last finite value stay, so
    that no spike gets lost.

    Args:
        values: shape (n,).
        limit: about how many rows may stay, >= 8.

    Returns:
        ascending indices, at most ``limit`` of them; all of them if n <= limit.
    """
    count = values.size
    if count <= limit:
        return np.arange(count)
    buckets = max(1, limit // 4)
    size = -(-count // buckets)
    padded = np.full(size * buckets, np.nan)
    padded[:count] = values
    table = padded.reshape(buckets, size)
    begins = np.arange(buckets) * size
    begins = begins[begins < count]
    table = table[: begins.size]
    least = np.argmin(np.where(np.isfinite(table), table, np.inf), axis=1) + begins
    greatest = np.argmax(np.where(np.isfinite(table), table, -np.inf), axis=1) + begins
    ends = np.minimum(begins + size, count) - 1
    return np.unique(np.concatenate([begins, least, greatest, ends]))
