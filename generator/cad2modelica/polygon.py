"""Polygons in space to triangles."""

from __future__ import annotations

import numpy as np

from cad2modelica.spatial import Array

Triangle = tuple[int, int, int]


def newell_normal(points: Array) -> Array:
    """Area-weighted normal of a closed polygon, planar or not: half its length is the projected area."""
    following = np.roll(points, -1, axis=0)
    return np.asarray(np.cross(points, following).sum(axis=0))


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
    count = len(points)
    if count == 3:
        return [(0, 1, 2)]
    flat = _project(centred, normal / length)
    remaining = list(range(count))
    triangles: list[Triangle] = []
    while len(remaining) > 3:
        position = _best_ear(flat, remaining, 1e-13 * scale * scale)
        if position is None:
            return triangles + _fan(remaining)
        a, b, c = _around(remaining, position)
        triangles.append((a, b, c))
        del remaining[position]
    triangles.append((remaining[0], remaining[1], remaining[2]))
    return [triangle for triangle in triangles if _cross(flat, *triangle) != 0.0]


def _project(points: Array, normal: Array) -> Array:
    helper = np.zeros(3)
    helper[int(np.argmin(np.abs(normal)))] = 1.0
    first = np.cross(normal, helper)
    first /= np.linalg.norm(first)
    return np.column_stack([points @ first, points @ np.cross(normal, first)])


def _around(remaining: list[int], position: int) -> Triangle:
    return remaining[position - 1], remaining[position], remaining[(position + 1) % len(remaining)]


def _cross(flat: Array, a: int, b: int, c: int) -> float:
    ab, ac = flat[b] - flat[a], flat[c] - flat[a]
    return float(ab[0] * ac[1] - ab[1] * ac[0])


def _best_ear(flat: Array, remaining: list[int], tolerance: float) -> int | None:
    best, best_length = None, np.inf
    for position in range(len(remaining)):
        a, b, c = _around(remaining, position)
        area = _cross(flat, a, b, c)
        if area < -tolerance:
            continue
        new_edge = float(np.hypot(*(flat[c] - flat[a])))
        if new_edge < best_length and (area <= tolerance or not _holds_any(flat, remaining, (a, b, c))):
            best, best_length = position, new_edge
    return best


def _holds_any(flat: Array, remaining: list[int], triangle: Triangle) -> bool:
    a, b, c = triangle
    corners = flat[[a, b, c]]
    for index in remaining:
        if index in triangle or (flat[index] == corners).all(axis=1).any():
            continue
        if _cross_point(corners, flat[index]):
            return True
    return False


def _cross_point(corners: Array, point: Array) -> bool:
    edges = np.roll(corners, -1, axis=0) - corners
    offsets = point - corners
    return bool((edges[:, 0] * offsets[:, 1] - edges[:, 1] * offsets[:, 0] >= 0.0).all())


def _fan(remaining: list[int]) -> list[Triangle]:
    return [(remaining[0], remaining[k], remaining[k + 1]) for k in range(1, len(remaining) - 1)]
