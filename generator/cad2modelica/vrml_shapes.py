"""VRML97 geometry nodes to triangles in the node's own coordinates."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from cmb_base.errors import InputError, Place

from cad2modelica.mesh import Indices
from cad2modelica.polygon import triangulate
from cad2modelica.primitive_meshes import Surface, box_surface, cone_surface, cylinder_surface, sphere_surface
from cad2modelica.spatial import Array
from cad2modelica.vrml_syntax import Node, Numbers

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
    return box_surface(_positive(node, "size", (2.0, 2.0, 2.0), file))


def _sphere(node: Node, file: Path) -> Surface:
    return sphere_surface(_length(node, "radius", 1.0, file))


def _cylinder(node: Node, file: Path) -> Surface:
    return cylinder_surface(_length(node, "radius", 1.0, file), _length(node, "height", 2.0, file))


def _cone(node: Node, file: Path) -> Surface:
    return cone_surface(_length(node, "bottomRadius", 1.0, file), _length(node, "height", 2.0, file))


def _length(node: Node, name: str, default: float, file: Path) -> float:
    return float(_positive(node, name, (default,), file)[0])


def _positive(node: Node, name: str, default: tuple[float, ...], file: Path) -> Array:
    value = number_field(node, name, default, file)
    if (value <= 0).any():
        raise _wrong(node, f"field {name} must be positive", file)
    return value


_BUILDERS: dict[str, Callable[[Node, Path], Surface]] = {
    "IndexedFaceSet": _indexed_face_set,
    "Box": _box,
    "Sphere": _sphere,
    "Cylinder": _cylinder,
    "Cone": _cone,
}
