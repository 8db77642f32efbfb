"""Where upright lines cross closed surfaces of triangles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cad2modelica.geometry.mesh import Indices
from cad2modelica.geometry.spatial import Array

PAIRS = 500_000  # lines times triangles at a time


@dataclass(frozen=True, eq=False)
class Crossings:
    """Crossings in no particular order.

    Attributes:
        line: indices into the lines, shape (n,).
        height: third coordinate, shape (n,).
        change: of the winding number on the way up, 1 or -1, shape (n,).
    """

    line: Indices
    height: Array
    change: Indices


def crossings(lines: Array, corners: Array) -> Crossings:
    """Crossings of lines along the third axis with triangles.

    A line through an edge or a corner is taken as if it were moved by a distance smaller than all numbers: so it meets
    exactly one of the triangles at an edge, and a closed surface is entered as often as it is left.

    Args:
        lines: first two coordinates of each, shape (k, 2).
        corners: of the triangles, counter-clockwise seen from outside, shape (m, 3, 3).
    """
    order = np.argsort(lines[:, 0], kind="stable")
    places = lines[order, 0]
    flat = corners[:, :, :2]
    low, high = flat.min(axis=1), flat.max(axis=1)
    first = np.searchsorted(places, low[:, 0], side="left")
    counts = np.searchsorted(places, high[:, 0], side="right") - first
    found: list[Crossings] = []
    ends = np.cumsum(counts)
    begin = 0
    while begin < len(corners):
        before = int(ends[begin - 1]) if begin else 0
        stop = max(begin + 1, int(np.searchsorted(ends, before + PAIRS, side="right")))
        own = counts[begin:stop]
        triangle = np.repeat(np.arange(begin, stop), own)
        line = order[np.arange(len(triangle)) - np.repeat(ends[begin:stop] - own - before, own) + first[triangle]]
        beside = (lines[line, 1] < low[triangle, 1]) | (lines[line, 1] > high[triangle, 1])
        found.append(_crossed(line[~beside], triangle[~beside], lines, corners))
        begin = stop
    if not found:
        return Crossings(np.zeros(0, np.int64), np.zeros(0), np.zeros(0, np.int64))
    return Crossings(
        np.concatenate([item.line for item in found]),
        np.concatenate([item.height for item in found]),
        np.concatenate([item.change for item in found]),
    )


def inside(points: Array, corners: Array) -> NDArray[np.bool_]:
    """Which points, shape (n, 3), a closed surface winds around; those on it may be either."""
    found = crossings(points[:, :2], corners)
    above = found.height > points[found.line, 2]
    winding = np.zeros(len(points), dtype=np.int64)
    np.add.at(winding, found.line[above], -found.change[above])
    return np.asarray(winding != 0)


def _crossed(line: Indices, triangle: Indices, lines: Array, corners: Array) -> Crossings:
    at, own = lines[line], corners[triangle]
    sides = np.stack([_side(at, own[:, (k + 1) % 3, :2], own[:, (k + 2) % 3, :2]) for k in range(3)], axis=1)
    signs = sides[:, :, 1]
    hit = (np.abs(signs.sum(axis=1)) == 3) & (signs[:, 0] != 0)
    weights = np.abs(sides[hit, :, 0])
    total = weights.sum(axis=1)
    weights[total == 0.0] = 1.0
    height = (weights * own[hit, :, 2]).sum(axis=1) / weights.sum(axis=1)
    return Crossings(line[hit], height, -signs[hit, 0].astype(np.int64))


def _side(at: Array, start: Array, end: Array) -> Array:
    """Twice the area of start, end and the line's point, and its sign, which is not zero unless the edge is a point.

    The area is computed from the same end whichever way the edge is passed, so that both its triangles agree; where it
    is zero, the point is moved by (e, e^2) for a vanishing e.
    """
    turned = (start[:, 0] > end[:, 0]) | ((start[:, 0] == end[:, 0]) & (start[:, 1] > end[:, 1]))
    a, b = np.where(turned[:, None], end, start), np.where(turned[:, None], start, end)
    along = b - a
    area = along[:, 0] * (at[:, 1] - a[:, 1]) - along[:, 1] * (at[:, 0] - a[:, 0])
    sign = np.sign(area)
    sign = np.where(sign == 0.0, np.where(along[:, 1] != 0.0, -np.sign(along[:, 1]), np.sign(along[:, 0])), sign)
    way = np.where(turned, -1.0, 1.0)
    return np.stack([area * way, sign * way], axis=1)
