"""Convex hulls of more corners than the contact engine takes, with fewer."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.spatial import ConvexHull

from cad2modelica.geometry.spatial import Array
from cad2modelica.geometry.surface_distance import Surface

MOST_CORNERS = 8192  # of a hull in the contact engine's descriptors
MOST_TOGETHER = 131_072  # of all hulls of a body: in text 10 MiB, of the 16 MiB that its descriptor may have
_BLOCK = 256  # directions at a time


def thinned(hull: ConvexHull, most: int = MOST_CORNERS) -> tuple[Array, float]:
    """Corners of a hull, or of one inside it that has no more than so many.

    Those stay that lie farthest in directions spread evenly over the sphere, after the hull was stretched to be as long
    as wide: corners stay corners by that, and those of slender bodies come evenly from all their length.

    Args:
        hull: of points in m.
        most: largest number of corners.

    Returns:
        Corners, shape (n, 3), m, in the order of the hull's, and the Hausdorff distance of the two hulls, m: the
        farthest that a corner left out lies from what is left.
    """
    corners = hull.points[hull.vertices]
    if len(corners) <= most:
        return corners, 0.0
    directions = _directions(most)
    blocks = [directions[begin : begin + _BLOCK] for begin in range(0, most, _BLOCK)]
    stretched = _stretched(corners)
    kept = np.unique(np.concatenate([np.argmax(stretched @ block.T, axis=0) for block in blocks]))
    left = corners[kept]
    rest = ConvexHull(left)
    return left, Surface(rest.points[rest.simplices]).farthest(np.delete(corners, kept, axis=0))


def share_of_corners(hulls: Sequence[ConvexHull]) -> int:
    """How many corners each of a body's hulls may keep, so that they are not too many together."""
    if sum(len(hull.vertices) for hull in hulls) <= MOST_TOGETHER:
        return MOST_CORNERS
    return min(MOST_CORNERS, MOST_TOGETHER // len(hulls))


def _stretched(points: Array) -> Array:
    """Points in their principal axes, with the same extent along each."""
    centered = points - points.mean(axis=0)
    local = centered @ np.linalg.eigh(centered.T @ centered)[1]
    return np.asarray(local / np.ptp(local, axis=0))


def _directions(count: int) -> Array:
    """Unit vectors on Fibonacci's spiral, shape (count, 3): equal areas, turned by the golden angle each."""
    height = 1.0 - (2.0 * np.arange(count) + 1.0) / count
    angle = np.pi * (3.0 - np.sqrt(5.0)) * np.arange(count)
    across = np.sqrt(1.0 - height**2)
    return np.column_stack([across * np.cos(angle), across * np.sin(angle), height])
