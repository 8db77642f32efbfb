"""The faces of parts as joints see them: shafts, holes, balls, sockets and plane faces, in the world."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cad2modelica.brep.step_model import Face, Shape
from cad2modelica.geometry.spatial import Array, Pose

LEAST_COVERAGE = 2.0  # rad of the full turn: rounded edges and fillets cover a quarter of one
ON_LINE = 1e-4  # of the shape's size, rad: faces of one bore


@dataclass(frozen=True, eq=False)
class RoundFace:
    """A cylindrical shaft or hole, or a ball or socket.

    Attributes:
        kind: "cylinder" or "sphere".
        point: on the axis, in the middle of the face, or the centre; shape (3,), m.
        axis: unit vector; of a sphere any.
        radius: m.
        half_length: along the axis, m; of a sphere its radius.
        hollow: whether material is outside.
    """

    kind: str
    point: Array
    axis: Array
    radius: float
    half_length: float
    hollow: bool


@dataclass(frozen=True, eq=False)
class PlaneFace:
    """A plane face.

    Attributes:
        point: on it, shape (3,), m.
        normal: unit vector out of the material.
        triangles: its corners, shape (n, 3, 3), m.
        area: m2.
    """

    point: Array
    normal: Array
    triangles: Array
    area: float


@dataclass(frozen=True, eq=False)
class PartFaces:
    """A part's faces in the world.

    Attributes:
        low, high: corners of the part's box, shape (3,), m.
        volume: m3.
        symmetry_axis: point and direction of the axis about which all round faces turn; None if there is none.
    """

    name: str
    rounds: tuple[RoundFace, ...]
    planes: tuple[PlaneFace, ...]
    low: Array
    high: Array
    volume: float
    symmetry_axis: tuple[Array, Array] | None = None

    @property
    def size(self) -> float:
        """Diagonal of the box, m."""
        return float(np.linalg.norm(self.high - self.low))


def faces_of_shape(name: str, shape: Shape) -> PartFaces:
    """The faces of a shape in its own axes."""
    size = float(np.linalg.norm(np.ptp(shape.vertices, axis=0))) if len(shape.vertices) else 0.0
    rounds = [found for face in shape.faces if (found := _round(face, shape)) is not None]
    merged = _merged(rounds, size)
    planes = tuple(_plane(face, shape) for face in shape.faces if face.kind == "plane" and _count(face))
    low, high = (shape.vertices.min(axis=0), shape.vertices.max(axis=0)) if size else (np.zeros(3), np.zeros(3))
    return PartFaces(name, merged, planes, low, high, shape.volume, _symmetry(shape, merged, size))


def placed_faces(faces: PartFaces, name: str, pose: Pose) -> PartFaces:
    """The faces of a part that stands in a pose."""
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    box = pose.point(faces.low + corners * (faces.high - faces.low))
    rounds = tuple(
        RoundFace(
            item.kind, pose.point(item.point), pose.direction(item.axis), item.radius, item.half_length, item.hollow
        )
        for item in faces.rounds
    )
    planes = tuple(
        PlaneFace(pose.point(item.point), pose.direction(item.normal), pose.point(item.triangles), item.area)
        for item in faces.planes
    )
    axis = faces.symmetry_axis
    turned = (pose.point(axis[0]), pose.direction(axis[1])) if axis is not None else None
    return PartFaces(name, rounds, planes, box.min(axis=0), box.max(axis=0), faces.volume, turned)


def _count(face: Face) -> int:
    return face.triangles[1] - face.triangles[0]


def _corners(face: Face, shape: Shape) -> Array:
    return np.asarray(shape.vertices[shape.triangles[face.triangles[0] : face.triangles[1]]])


def _normals(corners: Array) -> Array:
    """Twice the triangles' areas along their normals."""
    return np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])


@dataclass(frozen=True, eq=False)
class _Patch:
    """A face of a cylinder or sphere: where it is along its axis, and its area."""

    face: RoundFace
    low: float
    high: float
    area: float


def _round(face: Face, shape: Shape) -> _Patch | None:
    if face.kind not in ("cylinder", "sphere") or not _count(face) or face.radius <= 0:
        return None
    corners = _corners(face, shape)
    normals = _normals(corners)
    arms = corners.mean(axis=1) - face.point
    if face.kind == "cylinder":
        heights = (corners - face.point) @ face.axis
        arms = arms - (arms @ face.axis)[:, None] * face.axis
    else:
        heights = np.array([-face.radius, face.radius])
    hollow = bool((normals * arms).sum() < 0)
    area = float(np.linalg.norm(normals, axis=1).sum()) / 2
    low, high = float(heights.min()), float(heights.max())
    middle = face.point + face.axis * (low + high) / 2 if face.kind == "cylinder" else face.point
    found = RoundFace(face.kind, middle, face.axis, face.radius, (high - low) / 2, hollow)
    return _Patch(found, low, high, area)


def _merged(patches: Sequence[_Patch], size: float) -> tuple[RoundFace, ...]:
    """Patches of one cylinder or sphere as one face; those that cover little of a turn are rounded edges."""
    groups: list[list[_Patch]] = []
    for patch in patches:
        for group in groups:
            if _same_surface(group[0].face, patch.face, size) and _meets(group, patch):
                group.append(patch)
                break
        else:
            groups.append([patch])
    found = []
    for group in groups:
        first = group[0].face
        area = sum(patch.area for patch in group)
        if first.kind == "sphere":
            if area > 0.15 * 4 * np.pi * first.radius**2:
                found.append(first)
            continue
        ends = [
            float((patch.face.point - first.point) @ first.axis) + sign * patch.face.half_length
            for patch in group
            for sign in (-1.0, 1.0)
        ]
        length = max(ends) - min(ends)
        if length > 0 and area / (first.radius * length) > LEAST_COVERAGE:
            middle = first.point + first.axis * (max(ends) + min(ends)) / 2
            found.append(RoundFace("cylinder", middle, first.axis, first.radius, length / 2, first.hollow))
    return tuple(found)


def _same_surface(first: RoundFace, second: RoundFace, size: float) -> bool:
    if first.kind != second.kind or first.hollow != second.hollow:
        return False
    if abs(first.radius - second.radius) > ON_LINE * max(first.radius, second.radius):
        return False
    arm = second.point - first.point
    if first.kind == "sphere":
        return bool(np.linalg.norm(arm) < ON_LINE * size)
    parallel = np.linalg.norm(np.cross(first.axis, second.axis)) < ON_LINE
    return bool(parallel and np.linalg.norm(np.cross(arm, first.axis)) < ON_LINE * size)


def _meets(group: Sequence[_Patch], patch: _Patch) -> bool:
    """Whether a patch overlaps one of the group along the axis: bores behind each other stay apart."""
    for item in group:
        apart = abs(float((patch.face.point - item.face.point) @ item.face.axis))
        if apart < item.face.half_length + patch.face.half_length:
            return True
    return patch.face.kind == "sphere"


def _plane(face: Face, shape: Shape) -> PlaneFace:
    corners = _corners(face, shape)
    normals = _normals(corners)
    area = float(np.linalg.norm(normals, axis=1).sum()) / 2
    total = normals.sum(axis=0)
    outward = face.axis if total @ face.axis > 0 else -face.axis
    return PlaneFace(corners.reshape(-1, 3).mean(axis=0), outward, corners, area)


def _symmetry(shape: Shape, rounds: Sequence[RoundFace], size: float) -> tuple[Array, Array] | None:
    """The axis of turned parts (pins, screws, washers), which all cylinders of theirs have."""
    cylinders = [item for item in rounds if item.kind == "cylinder"]
    if not cylinders:
        return None
    first = max(cylinders, key=lambda item: item.radius * item.half_length)
    for item in cylinders:
        across = np.cross(item.point - first.point, first.axis)
        if np.linalg.norm(np.cross(item.axis, first.axis)) > ON_LINE or np.linalg.norm(across) > ON_LINE * size:
            return None
    middle = shape.center if shape.volume > 0 else shape.vertices.mean(axis=0)
    off = np.linalg.norm(np.cross(middle - first.point, first.axis))
    if off > 0.02 * size:
        return None
    # A turned part reaches equally far from its axis all round: a hexagon's corners are 15 % farther than its sides.
    arms = shape.vertices - first.point
    across = arms - (arms @ first.axis)[:, None] * first.axis
    directions = _ring(first.axis)
    reach = (across @ directions.T).max(axis=0)
    if reach.max() > 1.2 * reach.min():
        return None
    return first.point, first.axis


def _ring(axis: Array) -> Array:
    start = np.eye(3)[int(np.argmin(np.abs(axis)))]
    first = np.cross(axis, start)
    first = first / np.linalg.norm(first)
    second = np.cross(axis, first)
    angles = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    return np.asarray(np.outer(np.cos(angles), first) + np.outer(np.sin(angles), second))
