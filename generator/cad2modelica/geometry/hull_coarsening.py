"""Convex hulls with fewer corners, within an error."""

from __future__ import annotations

import itertools

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from cad2modelica.geometry.mesh import Indices
from cad2modelica.geometry.spatial import Array
from cad2modelica.geometry.surface_distance import Surface

FEW_CORNERS = 64  # of which none is left out: they cost contacts little
_PRODUCTS = 4_000_000  # points times faces at a time


def coarsened(hull: ConvexHull, error: float) -> tuple[Array, float]:
    """Corners of a hull inside the given one from which none of its corners is farther than an error.

    From the farthest corners of a few directions on, those are added that lie farthest beyond the faces so far, of each
    face one and of all faces the farther half at a time, which needs fewer corners than directions spread evenly.

    Args:
        hull: of points in m.
        error: how far a corner that is left out may lie from what is left, m.

    Returns:
        Corners, shape (n, 3), m, in the order of the hull's, and the Hausdorff distance of the two hulls, m.
    """
    corners = hull.points[hull.vertices]
    if len(corners) <= FEW_CORNERS:
        return corners, 0.0
    axes = np.linalg.svd(corners - corners.mean(axis=0), full_matrices=False)[2]
    directions = np.array([sign for sign in itertools.product((-1.0, 0.0, 1.0), repeat=3) if any(sign)]) @ axes
    kept = np.unique(np.argmax(corners @ directions.T, axis=0)).tolist()
    try:
        while True:
            kept = _with_farthest_of_faces(corners, kept, error)
            rest = ConvexHull(corners[kept])
            counted = np.array(kept)[np.sort(rest.vertices)]
            distances = Surface(rest.points[rest.simplices]).distance(corners)
            distances[counted] = 0.0
            # Beside sharp edges the planes of faces are nearer than the faces.
            far = np.flatnonzero(distances > error)
            if not len(far):
                return corners[counted], float(distances.max())
            kept = np.union1d(kept, far[np.argsort(-distances[far], kind="stable")][: len(far) // 4 + 1]).tolist()
    except QhullError:  # as good as flat
        return corners, 0.0


def _with_farthest_of_faces(corners: Array, kept: list[int], error: float) -> list[int]:
    """Numbers of corners, in order, with those given, beyond the faces of which no corner is farther than an error."""
    hull = ConvexHull(corners[kept], incremental=True)
    every = outside = np.arange(len(corners))
    # Faces turn as the hull grows: what was close to them may not be so any more.
    while len(outside := _outside(hull, corners, outside, error)) or len(
        outside := _outside(hull, corners, every, error)
    ):
        more = _farthest_of_faces(hull, corners, outside)
        kept = kept + more
        hull.add_points(corners[more])
    hull.close()
    return sorted(kept)


def _outside(hull: ConvexHull, points: Array, numbers: Indices, error: float) -> Indices:
    """Those of the numbered points that are farther beyond a face than an error."""
    at_a_time = max(1, _PRODUCTS // len(hull.equations))
    blocks = [numbers[begin : begin + at_a_time] for begin in range(0, len(numbers), at_a_time)]
    return np.concatenate([block[_beyond(hull, points[block]).max(axis=1) > error] for block in blocks])


def _farthest_of_faces(hull: ConvexHull, points: Array, numbers: Indices) -> list[int]:
    """Of the numbered points those that are farthest beyond each face; of them the farther half."""
    if len(numbers) > (most := max(1, _PRODUCTS // len(hull.equations))):
        numbers = numbers[:: len(numbers) // most + 1]
    beyond = _beyond(hull, points[numbers])
    face, distance = beyond.argmax(axis=1), beyond.max(axis=1)
    order = np.argsort(-distance, kind="stable")
    _, first = np.unique(face[order], return_index=True)
    farthest = numbers[order[np.sort(first)]]
    return [int(number) for number in farthest[: (len(farthest) + 1) // 2]]


def _beyond(hull: ConvexHull, points: Array) -> Array:
    """How far each point is beyond the plane of each face, m."""
    return points @ hull.equations[:, :3].T + hull.equations[:, 3]
