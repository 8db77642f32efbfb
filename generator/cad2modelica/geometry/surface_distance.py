"""Distances of points from a surface of triangles, and the greatest of them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from cad2modelica.geometry.spatial import Array, dot

PAIRS = 400_000  # points times triangles at a time
FIRST = 32  # points of the first block
NEAR = 3  # triangles of each size that a bound is taken from
_TINY = np.finfo(float).tiny


class Surface:
    """Triangles, sorted into trees of similar size.

    The distances from a few triangles near a point are bounds of its distance; a triangle that is nearer has its centre
    no farther than the bound and its own radius. Trees of triangles of one size (within a factor of two) keep that
    radius small.

    Args:
        corners: of the triangles, shape (m, 3, 3), m.
    """

    def __init__(self, corners: Array) -> None:
        self._corners = corners
        centers = corners.mean(axis=1)
        radii = np.linalg.norm(corners - centers[:, None], axis=2).max(axis=1)
        sizes = np.frexp(radii)[1]
        self._groups = [
            (members := np.flatnonzero(sizes == size), cKDTree(centers[members]), float(radii[members].max()))
            for size in np.unique(sizes)
        ]

    def farthest(self, points: Array) -> float:
        """The greatest distance of points of shape (n, 3) from the surface, m; 0 of none.

        Points are taken in the order of their bounds, until the next is no greater than what was found.
        """
        bounds = self._bounds(points)
        order = np.argsort(-bounds, kind="stable")
        greatest, begin, count = 0.0, 0, FIRST
        while begin < len(order) and bounds[order[begin]] > greatest:
            block = order[begin : begin + count]
            greatest = max(greatest, float(self._exact(points[block], bounds[block]).max()))
            begin, count = begin + count, 2 * count
        return greatest

    def distance(self, points: Array) -> Array:
        """Distances of points of shape (n, 3) from the surface, shape (n,), m."""
        return self._exact(points, self._bounds(points))

    def _bounds(self, points: Array) -> Array:
        """Distances from the triangles of each size whose centres are nearest."""
        bounds = np.full(len(points), np.inf)
        for members, tree, _ in self._groups:
            found = np.asarray(tree.query(points, k=list(range(1, min(NEAR, len(members)) + 1)))[1], dtype=np.int64)
            for column in found.T:
                bounds = np.minimum(bounds, to_triangles(points, self._corners[members[column]]))
        return bounds

    def _exact(self, points: Array, bounds: Array) -> Array:
        nearest = bounds.copy()
        for members, tree, radius in self._groups:
            reach = nearest + radius
            counts = np.asarray(tree.query_ball_point(points, reach, return_length=True), dtype=np.int64)
            for block in _blocks(counts):
                found = tree.query_ball_point(points[block], reach[block], return_sorted=True)
                point = np.repeat(np.arange(block.start, block.stop), counts[block])
                triangle = members[np.concatenate([np.asarray(item, dtype=np.int64) for item in found])]
                np.minimum.at(nearest, point, to_triangles(points[point], self._corners[triangle]))
        return nearest


def to_triangles(points: Array, corners: Array) -> Array:
    """Distance of each point from its triangle: from its plane where the foot lies inside, else from its edges.

    Args:
        points: shape (n, 3).
        corners: shape (n, 3, 3).
    """
    nearest = np.full(len(points), np.inf)
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    over = np.ones(len(points), dtype=np.bool_)
    for k in range(3):
        edge = corners[:, (k + 1) % 3] - corners[:, k]
        to_point = points - corners[:, k]
        share = np.clip(dot(to_point, edge) / np.maximum(dot(edge, edge), _TINY), 0.0, 1.0)
        away = to_point - share[:, None] * edge
        nearest = np.minimum(nearest, np.sqrt(dot(away, away)))
        over &= dot(to_point, np.cross(normal, edge)) >= 0.0
    length = np.maximum(np.sqrt(dot(normal, normal)), _TINY)
    height = np.abs(dot(points - corners[:, 0], normal)) / length
    return np.where(over, np.minimum(nearest, height), nearest)


def _blocks(counts: NDArray[np.int64]) -> list[slice]:
    """Runs of points with some thousand pairs each; those without any are in a run too."""
    ends = np.cumsum(counts)
    if not len(ends) or not ends[-1]:
        return []
    numbers = ends // PAIRS
    starts = [0, *(int(k) + 1 for k in np.flatnonzero(np.diff(numbers)))]
    blocks = [slice(a, b) for a, b in zip(starts, [*starts[1:], len(counts)], strict=True)]
    return [block for block in blocks if counts[block].any()]
