"""Collision shapes from meshes: spheres, boxes and capsules are recognised, all else becomes hulls."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from cmb_base.errors import InputError
from scipy.optimize import least_squares
from scipy.spatial import ConvexHull, QhullError, cKDTree

from cad2modelica.convex_decomposition import decompose
from cad2modelica.mesh import Indices, bodies, is_closed, join, volume_integrals, weld
from cad2modelica.model import NO_LIMITS, CollisionChoice, DecompositionLimits, Part
from cad2modelica.reach import Ball
from cad2modelica.solid_comparison import compare
from cad2modelica.spatial import IDENTITY, Array, Pose

FIT_TOLERANCE = 1e-6  # largest distance of a vertex from a recognised surface, relative to the size
ROUND_VOLUME = 0.85  # a tessellated round body fills at least this share of the exact one
CONCAVITY_REMARK = 0.01  # a hull that adds more than this share of its volume is reported
DECOMPOSED = 0.05  # a body whose hull adds more than this share of the hull's volume is decomposed
CONVEX = 1e-6  # a hull that adds no more than this is the body itself
DEFAULT_ERROR = 0.025  # concavity of a piece, relative to the diagonal of the body's bounding box
SMALLEST_ERROR = 0.005  # likewise: what a decomposition can resolve
SNAP = 2e-6  # distance below which a piece's corner is one of the body's, relative to the same
DEFAULT_PIECES = 16
MAXIMUM_PIECES = 256
FLAT = 1e-9  # thickness over size below which points span no solid


@dataclass(frozen=True, eq=False)
class CollisionShape:
    """One convex shape of a body.

    Attributes:
        kind: "sphere", "box", "capsule" or "hull".
        pose: of the shape's frame in the body's.
        radius: of spheres and capsules, m.
        length: of a capsule's segment, m.
        size: full lengths of a box, m.
        vertices: corners of a hull in the body's frame, shape (n, 3), m.
    """

    kind: str
    pose: Pose = IDENTITY
    radius: float = 0.0
    length: float = 0.0
    size: tuple[float, float, float] = (0.0, 0.0, 0.0)
    vertices: Array | None = None

    @property
    def outline(self) -> tuple[Array, float]:
        """Points of the body's frame, shape (n, 3), whose convex hull, grown by a margin (m), is the shape."""
        if self.vertices is not None:
            return self.pose.point(self.vertices), 0.0
        if self.kind == "box":
            signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
            return self.pose.point(signs * np.array(self.size) / 2), 0.0
        return self.pose.point(np.array([[0, 0, -self.length / 2], [0, 0, self.length / 2]])), self.radius

    @property
    def descriptor(self) -> str:
        """The contact engine's text for the shape."""
        words = ["cmb/1", self.kind]
        if self.kind == "box":
            words.append(f"size={_numbers(np.array(self.size))}")
        elif self.kind == "hull" and self.vertices is not None:
            words.append(f"vertices={_numbers(self.vertices.ravel())}")
        else:
            words.append(f"radius={_number(self.radius)}")
        if self.kind == "capsule":
            words.append(f"length={_number(self.length)}")
        if self.pose.position.any():
            words.append(f"position={_numbers(self.pose.position)}")
        if (self.pose.rotation != np.eye(3)).any():
            words.append(f"rotation={_numbers(self.pose.rotation.T.ravel())}")
        return " ".join(words)


@dataclass(frozen=True, eq=False)
class CollisionGeometry:
    """The shapes of one part and remarks on how they differ from its geometry."""

    shapes: tuple[CollisionShape, ...]
    notes: tuple[str, ...]

    @property
    def descriptor(self) -> str:
        """The contact engine's text for the body; empty if it does not collide."""
        return ";".join(shape.descriptor for shape in self.shapes)

    def ball(self, pose: Pose) -> Ball:
        """A ball that holds all shapes of the body standing at ``pose``."""
        outlines = [shape.outline for shape in self.shapes]
        if not outlines:
            return Ball(pose.position, 0.0)
        points = np.concatenate([points for points, _ in outlines])
        center = (points.min(axis=0) + points.max(axis=0)) / 2
        radius = max(float(np.linalg.norm(points - center, axis=1).max()) + margin for points, margin in outlines)
        return Ball(pose.point(center), radius)


def collision_geometry(part: Part, limits: DecompositionLimits = NO_LIMITS) -> CollisionGeometry:
    """The shapes that stand for a part in contacts: one or more for each connected body of its geometry.

    Args:
        part: the part.
        limits: of decompositions, where the part says nothing itself.

    Raises:
        InputError: the part asks for a shape that its geometry is not.
    """
    meshes = part.meshes if part.collision_meshes is None else part.collision_meshes
    if part.collision is CollisionChoice.NONE or not meshes:
        return CollisionGeometry((), ())
    shapes: list[CollisionShape] = []
    notes: list[str] = []
    found = bodies(*weld(*join(meshes)))
    for number, (vertices, triangles) in enumerate(found, start=1):
        label = f"part {part.name!r}" + (f", body {number} of {len(found)}" if len(found) > 1 else "")
        hull = _hull(vertices)
        if hull is None:
            notes.append(f"{label}: is flat and was left out of the contacts")
            continue
        own_shapes, remarks = _body_shapes(part, label, hull, (vertices, triangles), part.decomposition.or_else(limits))
        shapes += own_shapes
        notes += [f"{label}: {text}" for text in remarks]
    return CollisionGeometry(tuple(shapes), tuple(notes))


def _body_shapes(
    part: Part, label: str, hull: ConvexHull, body: tuple[Array, Indices], limits: DecompositionLimits
) -> tuple[list[CollisionShape], list[str]]:
    """Shapes of one connected body and remarks on them."""
    vertices, triangles = body
    shape = _recognise(hull, part.collision)
    if shape is None and part.collision in _RECOGNISERS:
        raise InputError(
            f"{label} is to collide as a {part.collision.value}, but its geometry is none",
            place=part.place,
            remedy="Use shape='auto' or shape='hull', or export the geometry finer.",
        )
    if not is_closed(triangles):
        kind = "convex hull" if shape is None else shape.kind
        return [shape or _hull_shape(hull)], [f"the geometry is not closed; collides as its {kind}"]
    volume = volume_integrals(vertices, triangles).volume
    remarks = ["the faces are turned inside out"] if volume < 0 else []
    added = 1.0 - abs(volume) / hull.volume
    threshold = {CollisionChoice.AUTO: DECOMPOSED, CollisionChoice.DECOMPOSITION: CONVEX}.get(part.collision)
    failure = ""
    if threshold is not None and added > threshold:
        outward = triangles if volume > 0 else triangles[:, ::-1]
        pieces, failure = _pieces(vertices, outward, limits)
        if pieces:
            return [_hull_shape(piece) for piece in pieces], [*remarks, _accuracy(vertices, outward, pieces)]
    if added > CONCAVITY_REMARK:
        name = f"its convex hull of {len(hull.vertices)} vertices" if shape is None else f"a {shape.kind}"
        remarks.append(
            f"is not convex; collides as {name}, {100 * added:.0f} % of which is not part of the body"
            + (f" (no decomposition: {failure})" if failure else "")
        )
    return [shape or _hull_shape(hull)], remarks


def _pieces(vertices: Array, triangles: Indices, limits: DecompositionLimits) -> tuple[list[ConvexHull], str]:
    """Convex pieces of a concave body; none, and the reason, if it cannot be decomposed."""
    size = float(np.linalg.norm(vertices.max(axis=0) - vertices.min(axis=0)))
    error = max(limits.error if limits.error is not None else DEFAULT_ERROR * size, SMALLEST_ERROR * size)
    done = decompose(vertices, triangles, error, limits.pieces if limits.pieces is not None else DEFAULT_PIECES)
    hulls = [_hull(_snapped(piece, vertices, SNAP * size)) for piece in done.pieces]
    return [hull for hull in hulls if hull is not None], done.failure


def _snapped(points: Array, vertices: Array, distance: float) -> Array:
    """Corners that are the body's own but for rounding become exactly those."""
    found = cKDTree(vertices).query(points)
    away, nearest = np.asarray(found[0]), np.asarray(found[1])
    result = points.copy()
    close = np.flatnonzero(away <= distance)
    result[close] = vertices[nearest[close]]
    return result


def _accuracy(vertices: Array, triangles: Indices, pieces: list[ConvexHull]) -> str:
    difference = compare(vertices, triangles, pieces)
    return (
        f"is not convex; collides as {len(pieces)} convex piece{'s' if len(pieces) > 1 else ''} with "
        f"{sum(len(piece.vertices) for piece in pieces)} vertices; of the body's volume, "
        f"{100 * difference.foreign:.1f} % is added and {100 * difference.missing:.1f} % missing, "
        f"Hausdorff distance {1000 * difference.distance:.2g} mm (sampled)"
    )


def _hull_shape(hull: ConvexHull) -> CollisionShape:
    return CollisionShape("hull", vertices=hull.points[hull.vertices])


def _hull(vertices: Array) -> ConvexHull | None:
    size = float(np.linalg.norm(vertices.max(axis=0) - vertices.min(axis=0)))
    if len(vertices) < 4 or size == 0.0:
        return None
    singular = np.linalg.svd(vertices - vertices.mean(axis=0), compute_uv=False)
    if singular[2] < FLAT * singular[0]:
        return None
    try:
        return ConvexHull(vertices)
    except QhullError:
        return None


def _recognise(hull: ConvexHull, choice: CollisionChoice) -> CollisionShape | None:
    if choice is CollisionChoice.HULL:
        return None
    points = hull.points[hull.vertices]
    for recogniser in (_RECOGNISERS[choice],) if choice in _RECOGNISERS else _RECOGNISERS.values():
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
    middle = points.mean(axis=0)
    local = points - middle
    matrix = np.column_stack([2 * local, np.ones(len(local))])
    solution, _, rank, _ = np.linalg.lstsq(matrix, (local * local).sum(axis=1), rcond=None)
    if rank < 4:
        return None
    center = solution[:3]
    distances = np.linalg.norm(local - center, axis=1)
    radius = float(distances.mean())
    if np.abs(distances - radius).max() > FIT_TOLERANCE * radius:
        return None
    if hull.volume < ROUND_VOLUME * 4 / 3 * np.pi * radius**3:
        return None
    return CollisionShape("sphere", _tidy(Pose(center + middle, np.eye(3)), radius), radius=_round(radius))


def _as_capsule(points: Array, hull: ConvexHull) -> CollisionShape | None:
    """All corners at one distance from a segment, found by least squares from the longest direction."""
    middle = points.mean(axis=0)
    extent = points - middle
    for direction in _axis_candidates(extent):
        along = extent @ direction
        across = np.linalg.norm(extent - np.outer(along, direction), axis=1)
        radius = float(across.max())
        half = float(along.max() - along.min()) / 2 - radius
        if half <= FIT_TOLERANCE * radius:
            continue
        start = np.concatenate([direction * half, -direction * half, [radius]])
        fit = least_squares(_capsule_residuals, start, args=(extent,), method="lm", xtol=1e-15, ftol=1e-15)
        first, second, radius = fit.x[:3], fit.x[3:6], float(fit.x[6])
        residual = float(np.abs(_segment_distance(extent, first, second) - radius).max())
        length = float(np.linalg.norm(first - second))
        if radius <= 0 or residual > FIT_TOLERANCE * (radius + length):
            continue
        if hull.volume < ROUND_VOLUME * (4 / 3 * np.pi * radius**3 + np.pi * radius**2 * length):
            continue
        axis = (first - second) / length
        if axis[int(np.argmax(np.abs(axis)))] < 0:
            axis = -axis
        axis = _snap(axis)
        pose = Pose((first + second) / 2 + middle, _frame_along(axis))
        return CollisionShape("capsule", _tidy(pose, length + radius), radius=_round(radius), length=_round(length))
    return None


_RECOGNISERS: dict[CollisionChoice, Callable[[Array, ConvexHull], CollisionShape | None]] = {
    CollisionChoice.BOX: _as_box,
    CollisionChoice.SPHERE: _as_sphere,
    CollisionChoice.CAPSULE: _as_capsule,
}


def _axis_candidates(extent: Array) -> list[Array]:
    _, vectors = np.linalg.eigh(extent.T @ extent)
    return [vectors[:, 2], *np.eye(3)]


def _capsule_residuals(unknowns: Array, points: Array) -> Array:
    """Distances from the surface of the capsule with the segment's ends and the radius ``unknowns``, shape (7,)."""
    return np.asarray(_segment_distance(points, unknowns[:3], unknowns[3:6]) - unknowns[6])


def _segment_distance(points: Array, first: Array, second: Array) -> Array:
    direction = second - first
    share = np.clip((points - first) @ direction / (direction @ direction), 0.0, 1.0)
    return np.asarray(np.linalg.norm(points - first - np.outer(share, direction), axis=1))


def _frame_along(axis: Array) -> Array:
    helper = np.zeros(3)
    helper[int(np.argmin(np.abs(axis)))] = 1.0
    first = np.cross(helper, axis)
    first /= np.linalg.norm(first)
    return np.column_stack([first, np.cross(axis, first), axis])


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


def _number(value: float) -> str:
    number = float(value)
    return "0" if number == 0.0 else repr(number).removesuffix(".0")


def _numbers(values: Array) -> str:
    return ",".join(_number(value) for value in values)
