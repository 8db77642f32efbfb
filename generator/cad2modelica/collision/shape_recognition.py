"""Recognises boxes, spheres, cylinders, cones and capsules by the corners of their convex hulls."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.spatial import ConvexHull

from cad2modelica.collision.collision_shape import CollisionShape
from cad2modelica.geometry.spatial import Array, Pose
from cad2modelica.mechanism.model import CollisionChoice

FIT_TOLERANCE = 1e-5  # largest distance of a vertex from a recognised surface, relative to the size: six digits
ROUND_VOLUME = 0.85  # a tessellated round body fills at least this share of the exact one
ROUND_PRISM = 0.95  # the same of cylinders: a prism of twelve sides does, one of ten may be meant as such
CAPSULE_CORNERS = 11
"""Fewer corners fill less than the share of a capsule, even where rings of five at its ends stand turned to each other
(an antiprism; by Simpson's rule, exact for it, 0.816 of the long cylinder about it)."""
CAPSULE_STEPS = 30
FLATTEST_END = 0.5  # height of a capsule's end over its radius; rims of long prisms lie on the sides of longer capsules
SHORTEST_GUESS = 0.1  # half the length of a capsule's segment over its radius, where the fit begins
_TINY = np.finfo(float).tiny


def recognise(hull: ConvexHull, choice: CollisionChoice) -> CollisionShape | None:
    """The simple shape that a hull is within tolerance, if the choice allows it; None if it is none.

    Args:
        hull: of the body, in the body's frame, m.
        choice: of the part; a single shape's choice looks for that shape only.
    """
    if choice is CollisionChoice.HULL:
        return None
    points = hull.points[hull.vertices]
    for recogniser in (RECOGNISERS[choice],) if choice in RECOGNISERS else RECOGNISERS.values():
        shape = recogniser(points, hull)
        if shape is not None:
            return shape
    return None


def _as_box(points: Array, hull: ConvexHull) -> CollisionShape | None:
    """Eight corners, three orthogonal directions of faces, and the volume of the box they span."""
    if len(points) != 8:
        return None
    axes = _orthogonal_axes(hull.equations[:, :3])
    if axes is None:
        return None
    local = points @ axes
    low, high = local.min(axis=0), local.max(axis=0)
    size = high - low
    to_corner = np.minimum(np.abs(local - low), np.abs(local - high)).max()
    if to_corner > FIT_TOLERANCE * np.linalg.norm(size):
        return None
    center = axes @ ((low + high) / 2)
    return CollisionShape("box", _tidy(Pose(center, axes), float(np.linalg.norm(size))), size=_triple(size))


def _orthogonal_axes(normals: Array) -> Array | None:
    """A right-handed frame of face normals at right angles, nearest to the body's axes; None if there is none."""
    distinct: list[Array] = []
    for normal in normals:
        if all(abs(abs(float(normal @ other)) - 1.0) > FIT_TOLERANCE for other in distinct):
            distinct.append(normal)
    if len(distinct) != 3:
        return None
    matrix = np.column_stack(distinct)
    if np.abs(matrix.T @ matrix - np.eye(3)).max() > FIT_TOLERANCE:
        return None
    left, _, right = np.linalg.svd(matrix)
    matrix = left @ right
    columns: list[int] = []
    for row in range(3):
        order = np.argsort(-np.abs(matrix[row]), kind="stable")
        columns.append(next(int(k) for k in order if int(k) not in columns))
    axes = matrix[:, columns]
    axes = axes * np.where(np.diag(axes) < 0, -1.0, 1.0)
    return np.asarray(axes if np.linalg.det(axes) > 0 else axes * np.array([1.0, 1.0, -1.0]))


def _as_sphere(points: Array, hull: ConvexHull) -> CollisionShape | None:
    """All corners at one distance from a point, and enough of them to be a tessellated sphere."""
    center = _fitted_center(points)
    if center is None:
        return None
    distances = np.linalg.norm(points - center, axis=1)
    radius = float(distances.mean())
    if np.abs(distances - radius).max() > FIT_TOLERANCE * radius:
        return None
    if hull.volume < ROUND_VOLUME * 4 / 3 * np.pi * radius**3:
        return None
    return CollisionShape("sphere", _tidy(Pose(center, np.eye(3)), radius), radius=_round(radius))


def _as_cylinder(points: Array, hull: ConvexHull) -> CollisionShape | None:
    """All corners in two parallel planes, on circles about one axis at right angles to them."""
    for direction in [*_end_faces(hull), *_axis_candidates(points - points.mean(axis=0))]:
        axis = _upward(direction)
        frame = _frame_along(axis)
        along, flat = points @ axis, points @ frame[:, :2]
        center = _fitted_center(flat)
        if center is None:
            continue
        distances = np.linalg.norm(flat - center, axis=1)
        radius = float(distances.mean())
        low, high = float(along.min()), float(along.max())
        tolerance = FIT_TOLERANCE * (radius + high - low)
        if np.minimum(along - low, high - along).max() > tolerance or np.abs(distances - radius).max() > tolerance:
            continue
        # Means of the ends: an axis that leans within the tolerance would add to the length of a thin disc.
        upper = along > (low + high) / 2
        bottom, top = float(along[~upper].mean()), float(along[upper].mean())
        length = top - bottom
        if hull.volume < ROUND_PRISM * np.pi * radius**2 * length:
            continue
        middle = frame @ np.array([*center, (bottom + top) / 2])
        pose = _tidy(Pose(middle, _frame_along(_snap(axis))), radius + length)
        return CollisionShape("cylinder", pose, radius=_round(radius), length=_round(length))
    return None


def _as_cone(points: Array, hull: ConvexHull) -> CollisionShape | None:
    """All corners but one in a plane, on a circle; the last one over its centre."""
    for direction in [*_end_faces(hull), *_axis_candidates(points - points.mean(axis=0))]:
        axis = direction
        along = points @ axis
        if (along > along.mean()).sum() > (along < along.mean()).sum():
            axis, along = -axis, -along
        frame = _frame_along(axis)
        flat = points @ frame[:, :2]
        apex = int(np.argmax(along))
        rim, heights = np.delete(flat, apex, axis=0), np.delete(along, apex)
        center = _fitted_center(rim)
        if center is None:
            continue
        distances = np.linalg.norm(rim - center, axis=1)
        radius = float(distances.mean())
        tolerance = FIT_TOLERANCE * (radius + float(np.ptp(along)))
        if np.ptp(heights) > tolerance or np.abs(distances - radius).max() > tolerance:
            continue
        bottom, top = float(heights.mean()), float(along[apex])
        length = top - bottom
        beside = float(np.linalg.norm(flat[apex] - center))
        if beside > tolerance or hull.volume < ROUND_PRISM * np.pi * radius**2 * length / 3:
            continue
        middle = frame @ np.array([*center, (bottom + top) / 2])
        pose = _tidy(Pose(middle, _frame_along(_snap(axis))), radius + length)
        return CollisionShape("cone", pose, radius=_round(radius), length=_round(length))
    return None


def _as_capsule(points: Array, hull: ConvexHull) -> CollisionShape | None:
    """All corners at one distance from a segment, found by least squares from the longest direction."""
    if len(points) < CAPSULE_CORNERS:
        return None
    middle = points.mean(axis=0)
    extent = points - middle
    for direction in _axis_candidates(extent):
        along = extent @ direction
        across = np.linalg.norm(extent - np.outer(along, direction), axis=1)
        radius = float(across.max())
        low, high = float(along.min()), float(along.max())
        half = max((high - low) / 2 - radius, SHORTEST_GUESS * radius)
        # Corners crowd where one end is finer than the other; their mean is then far off, the extent's middle is not.
        center = (low + high) / 2
        first, second = direction * (center + half), direction * (center - half)
        first, second, radius = _fitted_capsule(extent, first, second, radius)
        residual = float(np.abs(_segment_offsets(extent, first, second)[0] - radius).max())
        length = float(np.linalg.norm(first - second))
        if not (radius > 0 and length > FIT_TOLERANCE * radius and residual <= FIT_TOLERANCE * (radius + length)):
            continue
        if hull.volume < ROUND_VOLUME * (4 / 3 * np.pi * radius**3 + np.pi * radius**2 * length):
            continue
        axis = (first - second) / length
        ends = float(((extent - first) @ axis).max()), float(((second - extent) @ axis).max())
        if min(ends) < FLATTEST_END * radius:
            continue
        axis = _snap(_upward(axis))
        pose = Pose((first + second) / 2 + middle, _frame_along(axis))
        return CollisionShape("capsule", _tidy(pose, length + radius), radius=_round(radius), length=_round(length))
    return None


def _fitted_capsule(points: Array, first: Array, second: Array, radius: float) -> tuple[Array, Array, float]:
    """Ends and radius of the segment's capsule nearest to points, by Gauss and Newton from a first guess.

    The steps converge quadratically where all points lie on a capsule. Where they do not, a step that fails to halve
    the sum of squares soon tells so, and what was reached is returned.
    """
    reached = np.inf
    for _ in range(CAPSULE_STEPS):
        distance, share, outward = _segment_offsets(points, first, second)
        residual = distance - radius
        square = float(residual @ residual)
        if not square < reached / 2:
            break
        reached = square
        columns = [-(1 - share)[:, None] * outward, -share[:, None] * outward, -np.ones((len(points), 1))]
        step = np.linalg.lstsq(np.hstack(columns), -residual, rcond=None)[0]
        first, second, radius = first + step[:3], second + step[3:6], radius + float(step[6])
    return first, second, radius


def _fitted_center(points: Array) -> Array | None:
    """Centre of the circle or sphere nearest to points of shape (n, 2) or (n, 3); None if on a line or in a plane.

    By linear least squares, not their mean: corners may crowd at one side, and opposite ones need not exist.
    """
    middle = points.mean(axis=0)
    local = points - middle
    matrix = np.column_stack([2 * local, np.ones(len(local))])
    solution, _, rank, _ = np.linalg.lstsq(matrix, (local * local).sum(axis=1), rcond=None)
    return np.asarray(middle + solution[:-1]) if rank == matrix.shape[1] else None


def _axis_candidates(extent: Array) -> list[Array]:
    _, vectors = np.linalg.eigh(extent.T @ extent)
    return [vectors[:, 2], vectors[:, 0], *np.eye(3)]


def _end_faces(hull: ConvexHull) -> list[Array]:
    """Normals of the faces with the largest areas and the most triangles, which ends of cylinders and cones are.

    Main axes lean where rims are uneven, and a body as long as wide has none that stands out.
    """
    corners = hull.points[hull.simplices]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    rounded, group = np.unique(hull.equations[:, :3].round(4), axis=0, return_inverse=True)
    total, triangles = np.bincount(group.ravel(), areas, len(rounded)), np.bincount(group.ravel())
    ends = [*np.argsort(-total, kind="stable")[:2], np.argmax(triangles)]
    return [hull.equations[np.flatnonzero(group.ravel() == k)[0], :3] for k in ends]


def _segment_offsets(points: Array, first: Array, second: Array) -> tuple[Array, Array, Array]:
    """Of points of shape (n, 3): distances from a segment, where along it they are taken (0 to 1), and directions."""
    direction = second - first
    share = np.clip((points - first) @ direction / max(float(direction @ direction), _TINY), 0.0, 1.0)
    offset = points - first - np.outer(share, direction)
    distance = np.linalg.norm(offset, axis=1)
    return distance, share, offset / np.maximum(distance, _TINY)[:, None]


def _frame_along(axis: Array) -> Array:
    helper = np.zeros(3)
    helper[int(np.argmin(np.abs(axis)))] = 1.0
    first = np.cross(helper, axis)
    first /= np.linalg.norm(first)
    return np.column_stack([first, np.cross(axis, first), axis])


def _upward(axis: Array) -> Array:
    """The axis in the sense that makes its greatest component positive."""
    return -axis if axis[int(np.argmax(np.abs(axis)))] < 0 else axis


def _snap(axis: Array) -> Array:
    rounded = np.rint(axis)
    return rounded if np.abs(axis - rounded).max() < FIT_TOLERANCE else axis


def _tidy(pose: Pose, size: float) -> Pose:
    """Removes what is only rounding of the fit: offsets and rotation elements below the fit's accuracy."""
    position = np.array([0.0 if abs(value) < 1e-3 * FIT_TOLERANCE * size else _round(value) for value in pose.position])
    rotation = np.rint(pose.rotation)
    return Pose(position, rotation if np.abs(rotation - pose.rotation).max() < 1e-9 else pose.rotation)


def _round(value: float) -> float:
    """Nine significant digits, as many as exported coordinates carry."""
    return float(f"{value:.9g}")


def _triple(values: Array) -> tuple[float, float, float]:
    x, y, z = (_round(float(value)) for value in values)
    return x, y, z


RECOGNISERS: dict[CollisionChoice, Callable[[Array, ConvexHull], CollisionShape | None]] = {
    CollisionChoice.BOX: _as_box,
    CollisionChoice.SPHERE: _as_sphere,
    CollisionChoice.CYLINDER: _as_cylinder,
    CollisionChoice.CONE: _as_cone,
    CollisionChoice.CAPSULE: _as_capsule,
}
