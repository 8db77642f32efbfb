"""The regular grid of output times."""

from __future__ import annotations

import numpy as np

from fmu_regression.results.result import FloatArray

_SLACK = 1e-9


def output_grid(start: float, stop: float, interval: float) -> FloatArray:
    """Times start, start + interval, ... and stop, shape (n,); the last step may be shorter.

    Computed by multiplication, so that rounding does not add up; a last point nearer to stop than 1e-9 of the
    interval is stop itself.
    """
    count = int(np.floor((stop - start) / interval * (1 + _SLACK) + _SLACK))
    grid = start + interval * np.arange(count + 1, dtype=np.float64)
    if stop - grid[-1] > _SLACK * interval:
        grid = np.append(grid, stop)
    else:
        grid[-1] = stop
    return grid
