"""How far a set of convex pieces differs from the solid it stands for, along lines and at fixed points."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

from cad2modelica.geometry.mesh import Indices
from cad2modelica.geometry.ray_crossings import crossings, inside
from cad2modelica.geometry.spatial import Array, dot
from cad2modelica.geometry.surface_distance import Surface

LINES = 1024  # along each axis
POINTS = 4096  # whose distance is computed, at most, from each side

# Steps of a two-dimensional Kronecker sequence of low discrepancy: powers of 1/g, g the real root of g^3 = g + 1.
_ROOT = 1.3247179572447460
_STEPS = _ROOT ** -np.arange(1.0, 3.0)

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


@dataclass(frozen=True, eq=False)
class _Lengths:
    """What lines find: lengths in the solid, in pieces alone, in the solid alone, and points of the last two."""

    solid: float
    foreign: float
    missing: float
    of_pieces: Array
    of_solid: Array


def compare(vertices: Array, triangles: Indices, hulls: Sequence[ConvexHull]) -> SolidDifference:
    """Compares a closed mesh with the union of convex hulls.

    Volumes are lengths on 1024 lines along each axis, spread evenly over the common bounding box. Distances are those
    of the middles and ends of the lines' parts that are in one of the two alone, and of corners and centres of the
    triangles of the mesh and of the hulls; of at most 4096 points from each side.

    Args:
        vertices: shape (n, 3), m.
        triangles: counter-clockwise seen from outside, shape (m, 3).
        hulls: the pieces.
    """
    corners = vertices[triangles]
    pieces = np.concatenate([_outward(hull) for hull in hulls])
    along = [_along(axis, corners, pieces) for axis in range(3)]
    solid = sum(lengths.solid for lengths in along)
    of_solid = np.concatenate([*(lengths.of_solid for lengths in along), vertices, corners.mean(axis=1)])
    of_pieces = np.concatenate(
        [*(lengths.of_pieces for lengths in along), pieces.reshape(-1, 3), pieces.mean(axis=1)],
    )
    of_solid = _thinned(of_solid)
    of_solid = of_solid[~inside(of_solid, pieces)]
    of_pieces = _thinned(of_pieces)
    of_pieces = of_pieces[~inside(of_pieces, corners)]
    return SolidDifference(
        foreign=sum(lengths.foreign for lengths in along) / solid if solid else 0.0,
        missing=sum(lengths.missing for lengths in along) / solid if solid else 0.0,
        distance=max(Surface(pieces).farthest(of_solid), Surface(corners).farthest(of_pieces)),
    )


def _along(axis: int, corners: Array, pieces: Array) -> _Lengths:
    """Lengths along one axis, each over the number of lines times the area of the box that they cross."""
    turn = np.roll(np.arange(3), -(axis + 1))  # a cyclic exchange of axes, which keeps the sense of triangles
    solid, union = corners[..., turn], pieces[..., turn]
    low = np.minimum(solid.min(axis=(0, 1)), union.min(axis=(0, 1)))[:2]
    high = np.maximum(solid.max(axis=(0, 1)), union.max(axis=(0, 1)))[:2]
    lines = low + (high - low) * ((0.5 + np.outer(np.arange(1, LINES + 1), _STEPS)) % 1.0)
    first, second = crossings(lines, solid), crossings(lines, union)
    line = np.concatenate([first.line, second.line])
    height = np.concatenate([first.height, second.height])
    change = np.zeros((len(line), 2), dtype=np.int64)
    change[: len(first.line), 0], change[len(first.line) :, 1] = first.change, second.change
    order = np.lexsort((height, line))
    line, height = line[order], height[order]
    # Every line ends outside of both, so the sums start anew with each.
    within = (np.cumsum(change[order], axis=0) != 0)[:-1]
    length = np.where(line[1:] == line[:-1], np.diff(height), 0.0)
    foreign, missing = within[:, 1] & ~within[:, 0], within[:, 0] & ~within[:, 1]

    def points(mask: Mask) -> Array:
        rows = np.flatnonzero(mask & (length > 0.0))
        ends = [height[rows], (height[rows] + height[rows + 1]) / 2, height[rows + 1]]
        found = np.concatenate([np.column_stack([lines[line[rows]], end]) for end in ends])
        return found[:, np.argsort(turn)]

    share = float(np.prod(high - low)) / LINES
    solid_length, foreign_length, missing_length = (
        share * float(length[mask].sum()) for mask in (within[:, 0], foreign, missing)
    )
    return _Lengths(solid_length, foreign_length, missing_length, points(foreign), points(missing))


def _outward(hull: ConvexHull) -> Array:
    """Triangles of a hull, counter-clockwise seen from outside, shape (m, 3, 3)."""
    corners = hull.points[hull.simplices]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    inward = dot(normal, hull.equations[:, :3]) < 0.0
    return np.where(inward[:, None, None], corners[:, ::-1], corners)


def _thinned(points: Array) -> Array:
    return points[:: max(1, -(-len(points) // POINTS))]
