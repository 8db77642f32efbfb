"""VRML97 geometry nodes to triangles in the node's own coordinates."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from cmb_base.errors import InputError, Place

from cad2modelica.mesh import Indices
from cad2modelica.polygon import triangulate
from cad2modelica.spatial import Array
from cad2modelica.vrml_syntax import Node, Numbers

Surface = tuple[Array, Indices]

SEGMENTS = 32  # of round primitives, around their axis
RINGS = 16  # of spheres, from pole to pole

WITHOUT_SURFACE = frozenset({"IndexedLineSet", "PointSet", "Text"})


def surface_of(node: Node, file: Path) -> Surface | None:
    """The surface of a geometry node: vertices and triangles, counter-clockwise seen from outside.

    Returns:
        None if the node type has no surface this reader knows.

    Raises:
        InputError: a field is missing, has a wrong length, or an index lies outside its list.
    """
    builder = _BUILDERS.get(node.type)
    return builder(node, file) if builder else None


def number_field(node: Node, name: str, default: tuple[float, ...], file: Path) -> Array:
    """A field with a fixed count of numbers.

    Raises:
        InputError: the count is another one.
    """
    value = node.fields.get(name)
    if value is None:
        return np.array(default)
    if not isinstance(value, Numbers) or len(value.values) != len(default) or not np.isfinite(value.values).all():
        raise _wrong(node, f"field {name} needs {len(default)} finite number{'s' if len(default) > 1 else ''}", file)
    return value.values


def list_field(node: Node, name: str, file: Path) -> Array:
    """A field with a list of numbers; empty if it is left out.

    Raises:
        InputError: the field holds something else.
    """
    value = node.fields.get(name)
    if value is None or value == []:
        return np.zeros(0)
    if not isinstance(value, Numbers):
        raise _wrong(node, f"field {name} must be a list of numbers", file)
    return value.values


def boolean_field(node: Node, name: str, default: bool) -> bool:
    """A field with TRUE or FALSE."""
    value = node.fields.get(name, default)
    return value if isinstance(value, bool) else default


def _wrong(node: Node, message: str, file: Path) -> InputError:
    return InputError(
        f"{node.type}: {message}", place=Place(file=file, line=node.line), remedy="Export the geometry again."
    )


def _indexed_face_set(node: Node, file: Path) -> Surface:
    coordinate = node.fields.get("coord")
    if coordinate is None:
        return np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64)
    if not isinstance(coordinate, Node):
        raise _wrong(node, "field coord must be a Coordinate node", file)
    numbers = list_field(coordinate, "point", file)
    if len(numbers) % 3 or not np.isfinite(numbers).all():
        raise _wrong(coordinate, "the list of points needs three finite numbers a point", file)
    points = numbers.reshape(-1, 3)
    index = list_field(node, "coordIndex", file)
    if (index != np.rint(index)).any():
        raise _wrong(node, "coordIndex must hold whole numbers", file)
    indices = index.astype(np.int64)
    if len(indices) and (indices.max() >= len(points) or indices.min() < -1):
        worst = int(indices.max()) if indices.max() >= len(points) else int(indices.min())
        raise _wrong(node, f"coordIndex names point {worst}, but there are {len(points)} points", file)
    triangles = _split_faces(points, indices)
    if not boolean_field(node, "ccw", True):
        triangles = triangles[:, ::-1]
    return points, triangles


def _split_faces(points: Array, indices: Indices) -> Indices:
    if len(indices) and indices[-1] != -1:
        indices = np.append(indices, -1)
    if len(indices) % 4 == 0 and (indices[3::4] == -1).all() and (indices.reshape(-1, 4)[:, :3] >= 0).all():
        return indices.reshape(-1, 4)[:, :3]
    triangles: list[tuple[int, int, int]] = []
    begin = 0
    for end in np.flatnonzero(indices == -1).tolist():
        face = indices[begin:end]
        begin = end + 1
        if len(face) >= 3:
            corners = [int(corner) for corner in face]
            triangles += [(corners[a], corners[b], corners[c]) for a, b, c in triangulate(points[face])]
    return np.array(triangles, dtype=np.int64).reshape(-1, 3)


def _box(node: Node, file: Path) -> Surface:
    half = _positive(node, "size", (2.0, 2.0, 2.0), file) / 2
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * half
    quads = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    return corners, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))], dtype=np.int64)


def _sphere(node: Node, file: Path) -> Surface:
    radius = float(_positive(node, "radius", (1.0,), file)[0])
    angles = np.linspace(0.0, np.pi, RINGS + 1)
    return _revolve(radius * np.sin(angles), radius * np.cos(angles))


def _cylinder(node: Node, file: Path) -> Surface:
    radius = float(_positive(node, "radius", (1.0,), file)[0])
    half = float(_positive(node, "height", (2.0,), file)[0]) / 2
    return _revolve(np.array([0.0, radius, radius, 0.0]), np.array([half, half, -half, -half]))


def _cone(node: Node, file: Path) -> Surface:
    radius = float(_positive(node, "bottomRadius", (1.0,), file)[0])
    half = float(_positive(node, "height", (2.0,), file)[0]) / 2
    return _revolve(np.array([0.0, radius, 0.0]), np.array([half, -half, -half]))


def _positive(node: Node, name: str, default: tuple[float, ...], file: Path) -> Array:
    value = number_field(node, name, default, file)
    if (value <= 0).any():
        raise _wrong(node, f"field {name} must be positive", file)
    return value


def _revolve(radii: Array, heights: Array) -> Surface:
    """Surface of revolution about y of a profile that runs downwards and begins and ends on the axis."""
    turn = 2 * np.pi * np.arange(SEGMENTS) / SEGMENTS
    rings = [
        np.column_stack([radius * np.sin(turn), np.full(SEGMENTS, height), radius * np.cos(turn)])
        for radius, height in zip(radii[1:-1], heights[1:-1], strict=True)
    ]
    vertices = np.concatenate([[[0.0, heights[0], 0.0]], *rings, [[0.0, heights[-1], 0.0]]])
    bottom = len(vertices) - 1
    triangles: list[tuple[int, int, int]] = []
    for k in range(SEGMENTS):
        following = (k + 1) % SEGMENTS
        triangles.append((0, 1 + k, 1 + following))
        for ring in range(len(rings) - 1):
            upper, lower = 1 + ring * SEGMENTS, 1 + (ring + 1) * SEGMENTS
            triangles.append((upper + k, lower + k, lower + following))
            triangles.append((upper + k, lower + following, upper + following))
        last = 1 + (len(rings) - 1) * SEGMENTS
        triangles.append((bottom, last + following, last + k))
    return vertices, np.array(triangles, dtype=np.int64)


_BUILDERS: dict[str, Callable[[Node, Path], Surface]] = {
    "IndexedFaceSet": _indexed_face_set,
    "Box": _box,
    "Sphere": _sphere,
    "Cylinder": _cylinder,
    "Cone": _cone,
}
