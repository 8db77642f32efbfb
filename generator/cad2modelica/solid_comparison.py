"""How far a set of convex pieces differs from the solid it stands for, by sampling at fixed points."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

from cad2modelica.mesh import Indices
from cad2modelica.spatial import Array

POINTS = 4096  # in the bounding box, at most
EFFORT = 20_000_000  # points times triangles, at most
BLOCK = 200_000  # points times triangles at a time

# Steps of a three-dimensional Kronecker sequence of low discrepancy: powers of 1/g, g the positive root of g^4 = g + 1.
_ROOT = 1.2207440846057596
_STEPS = _ROOT ** -np.arange(1.0, 4.0)

Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class SolidDifference:
    """Differences between a solid and the union of pieces.

    Attributes:
        foreign: volume of the pieces that is not in the solid, over the solid's volume.
        missing: volume of the solid that is in no piece, over the solid's volume.
        distance: Hausdorff distance of the two solids at the sampled points, m: a lower bound of the true one.
    """

    foreign: float
    missing: float
    distance: float


def compare(vertices: Array, triangles: Indices, hulls: Sequence[ConvexHull]) -> SolidDifference:
    """Compares a closed mesh with the union of convex hulls.

    Sampled are 4096 points spread evenly over the common bounding box, and the corners and centres of triangles of the
    mesh and of the hulls; fewer for very fine meshes.

    Args:
        vertices: shape (n, 3), m.
        triangles: shape (m, 3).
        hulls: the pieces.
    """
    corners = vertices[triangles]
    outlines = [hull.points[hull.vertices] for hull in hulls]
    every = np.concatenate([vertices, *outlines])
    low, high = every.min(axis=0), every.max(axis=0)
    count = min(POINTS, max(256, EFFORT // len(triangles)))
    space = low + (high - low) * ((0.5 + np.outer(np.arange(1, count + 1), _STEPS)) % 1.0)
    in_solid, in_pieces = _inside_mesh(space, corners), _inside_hulls(space, hulls)
    inner = max(int(in_solid.sum()), 1)
    of_solid = np.concatenate(
        [space[in_solid & ~in_pieces], _thinned(np.concatenate([vertices, corners.mean(axis=1)]), count)]
    )
    of_pieces = np.concatenate([*outlines, *(hull.points[hull.simplices].mean(axis=1) for hull in hulls)])
    of_pieces = _thinned(of_pieces, count)
    of_pieces = np.concatenate([space[in_pieces & ~in_solid], of_pieces[~_inside_mesh(of_pieces, corners)]])
    of_solid = of_solid[~_inside_hulls(of_solid, hulls)]
    surfaces = [hull.points[hull.simplices] for hull in hulls]
    to_pieces = np.min([_distance(of_solid, surface) for surface in surfaces], axis=0)
    return SolidDifference(
        foreign=float((in_pieces & ~in_solid).sum()) / inner,
        missing=float((in_solid & ~in_pieces).sum()) / inner,
        distance=float(max(to_pieces.max(initial=0.0), _distance(of_pieces, corners).max(initial=0.0))),
    )


def _thinned(points: Array, count: int) -> Array:
    return points[:: max(1, -(-len(points) // count))]


def _inside_hulls(points: Array, hulls: Sequence[ConvexHull]) -> Mask:
    inside = np.zeros(len(points), dtype=np.bool_)
    for hull in hulls:
        inside |= (points @ hull.equations[:, :3].T + hull.equations[:, 3] <= 0.0).all(axis=1)
    return inside


def _inside_mesh(points: Array, corners: Array) -> Mask:
    """Where the winding number is nearer to one (or minus one) than to zero.

    Solid angle of a triangle: A. van Oosterom, J. Strackee, IEEE Transactions on Biomedical Engineering 30 (2), 1983.
    """
    inside = np.zeros(len(points), dtype=np.bool_)
    for part in _blocks(points, corners):
        a, b, c = (corners[None, :, k] - points[part, None] for k in range(3))
        la, lb, lc = (np.sqrt(_dot(edge, edge)) for edge in (a, b, c))
        volume = _dot(a, np.cross(b, c))
        angle = np.arctan2(volume, la * lb * lc + _dot(a, b) * lc + _dot(b, c) * la + _dot(c, a) * lb)
        inside[part] = np.abs(angle.sum(axis=1)) > np.pi
    return inside


def _distance(points: Array, corners: Array) -> Array:
    """Distance of points from a surface of triangles, shape (n,)."""
    result = np.zeros(len(points))
    for part in _blocks(points, corners):
        result[part] = _to_triangles(points[part], corners).min(axis=1)
    return result


def _to_triangles(points: Array, corners: Array) -> Array:
    """Distance of every point from every triangle: from its plane where the foot lies inside, else from its edges."""
    nearest = np.full((len(points), len(corners)), np.inf)
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    over = np.ones_like(nearest, dtype=np.bool_)
    for k in range(3):
        start, edge = corners[:, k], corners[:, (k + 1) % 3] - corners[:, k]
        to_point = points[:, None] - start
        square = np.maximum(_dot(edge, edge), np.finfo(float).tiny)
        share = np.clip(_dot(to_point, edge) / square, 0.0, 1.0)
        away = to_point - share[..., None] * edge
        nearest = np.minimum(nearest, np.sqrt(_dot(away, away)))
        over &= _dot(to_point, np.cross(normal, edge)) >= 0.0
    length = np.maximum(np.sqrt(_dot(normal, normal)), np.finfo(float).tiny)
    height = np.abs(_dot(points[:, None] - corners[:, 0], normal)) / length
    return np.where(over, np.minimum(nearest, height), nearest)


def _blocks(points: Array, corners: Array) -> list[slice]:
    size = max(1, BLOCK // len(corners))
    return [slice(begin, begin + size) for begin in range(0, len(points), size)]


def _dot(first: Array, second: Array) -> Array:
    return np.asarray(np.einsum("...i,...i->...", first, second))
