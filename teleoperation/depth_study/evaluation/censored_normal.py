"""A normal distribution of which only the part beyond a border is known to hold a value."""

from __future__ import annotations

import numpy as np
from scipy import special

from depth_study.arrays import FloatArray


def mean_beyond(
    mean: FloatArray, deviation: FloatArray, border: FloatArray | float, sign: float
) -> tuple[FloatArray, FloatArray]:
    """Expected value and variance of normally distributed values beyond a border.

    Args:
        mean, deviation: of the whole distribution; same shape.
        border: what the values lie beyond.
        sign: 1 if they are greater than the border, -1 if less.

    Source: N. L. Johnson, S. Kotz, N. Balakrishnan, Continuous Univariate Distributions 1, 1994, section 10.1.
    """
    deviation = np.maximum(deviation, 1e-9)
    alpha = sign * (border - mean) / deviation
    # Density over upper tail, also where both underflow.
    ratio = np.sqrt(2 / np.pi) / special.erfcx(alpha / np.sqrt(2))
    # The difference of the two squares loses all digits far out, where the ratio nears alpha + 1 / alpha.
    share = np.where(alpha > 1e4, 1 / np.maximum(alpha, 1.0) ** 2, 1 + alpha * ratio - ratio**2)
    expected = np.where(np.isfinite(ratio), mean + sign * deviation * ratio, mean)
    return expected, np.clip(share, 0.0, 1.0) * deviation**2
