"""Polygons in space to triangles."""

from __future__ import annotations

import heapq
import math
from collections.abc import Sequence

import numpy as np

from cad2modelica.geometry.spatial import Array

Triangle = tuple[int, int, int]
Point = tuple[float, float]


def newell_normal(points: Array) -> Array:
    """Area-weighted normal of a closed polygon, planar or not: half its length is the projected area."""
    products = points.T @ np.concatenate([points[1:], points[:1]])
    return np.array([products[1, 2] - products[2, 1], products[2, 0] - products[0, 2], products[0, 1] - products[1, 0]])


def split(points: Array, corners: Sequence[int]) -> list[Triangle]:
    """Splits the polygon of some of many points into triangles.

    Args:
        points: shape (n, 3).
        corners: numbers of points, in order; fewer than three have no triangles.
    """
    if len(corners) < 3:
        return []
    return [(corners[a], corners[b], corners[c]) for a, b, c in triangulate(points[list(corners)])]


def triangulate(points: Array) -> list[Triangle]:
    """Splits a simple polygon, convex or not, into triangles of the same sense of rotation.

    Ears are cut in the plane at a right angle to the Newell normal; of all ears the one with the shortest
    new edge is cut first, which avoids slivers on faces that are not quite planar.

    Args:
        points: corners in order, shape (k, 3), k >= 3.

    Returns:
        k - 2 triangles of corner indices, fewer if corners coincide; empty if the polygon has no area.
    """
    centred = points - points.mean(axis=0)
    normal = newell_normal(centred)
    length = float(np.linalg.norm(normal))
    scale = float(np.abs(centred).max())
    if length <= 1e-14 * scale * scale or scale == 0.0:
        return []
    if len(points) == 3:
        return [(0, 1, 2)]
    clipping = _EarClipping(_project(centred, normal / length), 1e-13 * scale * scale)
    return clipping.triangles()


def _project(points: Array, normal: Array) -> list[Point]:
    """Coordinates in the plane; plain floats, since most polygons have too few corners for array arithmetic to pay."""
    x, y, z = normal.tolist()
    if abs(x) <= min(abs(y), abs(z)):
        first = np.array([0.0, z, -y])
    elif abs(y) <= abs(z):
        first = np.array([-z, 0.0, x])
    else:
        first = np.array([y, -x, 0.0])
    first /= math.sqrt(first @ first)
    u, v, w = first.tolist()
    second = np.array([y * w - z * v, z * u - x * w, x * v - y * u])
    flat = np.column_stack([points @ first, points @ second])
    return [(x, y) for x, y in flat.tolist()]


class _EarClipping:
    """Ears of a plane polygon, shortest new edge first.

    A corner is looked at again only when a neighbour or the corner that kept it from being an ear is cut off.
    """

    def __init__(self, flat: list[Point], tolerance: float) -> None:
        count = len(flat)
        self._flat = flat
        self._tolerance = tolerance
        self._before = [(index - 1) % count for index in range(count)]
        self._after = [(index + 1) % count for index in range(count)]
        self._left = dict.fromkeys(range(count))
        self._version = [0] * count
        self._blocked: dict[int, list[int]] = {}
        self._ears: list[tuple[float, int, int]] = []

    def triangles(self) -> list[Triangle]:
        for index in range(len(self._flat)):
            self._look_at(index)
        found: list[Triangle] = []
        while len(self._left) > 3:
            corner = self._next_ear()
            if corner is None:
                return found + _fan(list(self._left))
            before, after = self._before[corner], self._after[corner]
            found.append((before, corner, after))
            del self._left[corner]
            self._after[before], self._before[after] = after, before
            for other in {before: None, after: None} | dict.fromkeys(self._blocked.pop(corner, ())):
                if other in self._left:
                    self._look_at(other)
        a, b, c = self._left
        found.append((a, b, c))
        return [triangle for triangle in found if _cross(*(self._flat[corner] for corner in triangle)) != 0.0]

    def _next_ear(self) -> int | None:
        while self._ears:
            _, corner, version = heapq.heappop(self._ears)
            if corner in self._left and version == self._version[corner]:
                return corner
        return None

    def _look_at(self, corner: int) -> None:
        self._version[corner] += 1
        before, after = self._before[corner], self._after[corner]
        a, b, c = self._flat[before], self._flat[corner], self._flat[after]
        area = _cross(a, b, c)
        if area < -self._tolerance:
            return
        blocker = self._corner_inside(a, b, c) if area > self._tolerance else None
        if blocker is None:
            heapq.heappush(self._ears, (math.dist(a, c), corner, self._version[corner]))
        else:
            self._blocked.setdefault(blocker, []).append(corner)

    def _corner_inside(self, a: Point, b: Point, c: Point) -> int | None:
        lowest_x, highest_x = min(a[0], b[0], c[0]), max(a[0], b[0], c[0])
        for index in self._left:
            point = self._flat[index]
            if not lowest_x <= point[0] <= highest_x or point in (a, b, c):
                continue
            if _cross(a, b, point) >= 0.0 and _cross(b, c, point) >= 0.0 and _cross(c, a, point) >= 0.0:
                return index
        return None


def _cross(a: Point, b: Point, c: Point) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _fan(remaining: list[int]) -> list[Triangle]:
    return [(remaining[0], remaining[k], remaining[k + 1]) for k in range(1, len(remaining) - 1)]
