"""Signals that are not numbers somewhere: results that look whole and are not."""

from __future__ import annotations

from typing import Final

import numpy as np

from fmu_regression.results.result import SimulationResult

_LISTED: Final = 5  # signals in a message


def undefined_remarks(result: SimulationResult) -> tuple[str, ...]:
    """A line on each of the first signals that are undefined or infinite in a row, and one on how many more are."""
    remarks = []
    for name, values in result.signals.items():
        rows = np.flatnonzero(~np.isfinite(values))
        if rows.size:
            what = "is not a number" if np.isnan(values[rows[0]]) else "is infinite"
            count = f"{rows.size} of {values.size} rows"
            remarks.append(f"{name} {what} at t = {result.time[rows[0]]:.6g} s, and no finite number in {count}")
    more = len(remarks) - _LISTED
    return (*remarks[:_LISTED], *([f"and so are {more} further signals"] if more > 0 else []))
