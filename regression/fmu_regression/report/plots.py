"""Plots as data for the page's scripts."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_regression.results.result import FloatArray
from fmu_regression.results.thinning import display_rows

TIME_LABEL = "time in s"
PER_PLOT = 8
_TOTAL_POINTS = 400_000
_MIN_POINTS = 2_000
_MAX_POINTS = 20_000


@dataclass(frozen=True)
class Series:
    """A curve.

    Attributes:
        name: for the legend.
        x, y: shape (n,); x ascending.
        dashed: whether the line is dashed.
        color: number of the colour; by position if None.
        note: what the hover text calls each point; the name if empty.
    """

    name: str
    x: FloatArray
    y: FloatArray
    dashed: bool = False
    color: int | None = None
    note: tuple[str, ...] = ()


@dataclass(frozen=True)
class Plot:
    """Curves over a common axis.

    Attributes:
        identity: of the element in the page; letters, digits and "-".
        title: heading.
        x_label, y_label: axis labels with units.
        series: the curves.
        points: whether the values are single points joined by lines instead of a sampled signal.
        x_log, y_log: logarithmic axes.
    """

    identity: str
    title: str
    x_label: str
    y_label: str
    series: tuple[Series, ...]
    points: bool = False
    x_log: bool = False
    y_log: bool = False


def plots_over_time(identity: str, title: str, label: str, series: Sequence[Series]) -> list[Plot]:
    """As many plots as the curves need, eight in each."""
    parts = [series[k : k + PER_PLOT] for k in range(0, len(series), PER_PLOT)]
    return [
        Plot(
            identity if len(parts) == 1 else f"{identity}-{k + 1}",
            title if len(parts) == 1 else f"{title}, {k + 1} of {len(parts)}",
            TIME_LABEL,
            label,
            tuple(part),
        )
        for k, part in enumerate(parts)
        if any(np.isfinite(curve.y).any() for curve in part)
    ]


def encode_plots(plots: Sequence[Plot]) -> list[dict[str, Any]]:
    """JSON-ready form: times as base64 of little-endian doubles, values of floats; thinned for display."""
    count = sum(len(plot.series) for plot in plots)
    limit = max(_MIN_POINTS, min(_MAX_POINTS, _TOTAL_POINTS // max(1, count)))
    return [_encode(plot, limit) for plot in plots]


def encode_array(values: NDArray[Any], kind: str) -> str:
    """Base64 of an array in row order as little-endian numbers of a NumPy kind such as "f4" or "u4"."""
    return base64.b64encode(np.ascontiguousarray(values, dtype=np.dtype(f"<{kind}")).tobytes()).decode("ascii")


def _encode(plot: Plot, limit: int) -> dict[str, Any]:
    times: dict[str, int] = {}
    series = []
    for curve in plot.series:
        rows = np.arange(curve.x.size) if plot.points else display_rows(curve.y, limit)
        time = times.setdefault(encode_array(curve.x[rows], "f8"), len(times))
        entry: dict[str, Any] = {"name": curve.name, "time": time, "values": encode_array(curve.y[rows], "f4")}
        if curve.dashed:
            entry["dashed"] = True
        if curve.color is not None:
            entry["color"] = curve.color
        if curve.note:
            entry["note"] = list(curve.note)
        series.append(entry)
    return {
        "id": plot.identity,
        "title": plot.title,
        "xLabel": plot.x_label,
        "yLabel": plot.y_label,
        "points": plot.points,
        "xLog": plot.x_log,
        "yLog": plot.y_log,
        "times": list(times),
        "series": series,
    }
