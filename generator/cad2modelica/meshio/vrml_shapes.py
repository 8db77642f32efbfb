"""VRML97 geometry nodes to triangles in the node's own coordinates."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from contact_foundation.errors import InputError, Place

from cad2modelica.geometry.mesh import Indices
from cad2modelica.geometry.polygon import split
from cad2modelica.geometry.primitive_meshes import Surface, box_surface, cone_surface, cylinder_surface, sphere_surface
from cad2modelica.geometry.spatial import Array
from cad2modelica.meshio.vrml_extrusion import extrusion_surface
from cad2modelica.meshio.vrml_syntax import Node, Numbers
from cad2modelica.source.number_limits import LARGEST, are_usable

MAXIMUM_EXTRUSION = 1_000_000  # points: a short file could ask for any number
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
    if not isinstance(value, Numbers) or len(value.values) != len(default) or not are_usable(value.values):
        count = f"{len(default)} finite number{'s' if len(default) > 1 else ''}"
        raise _wrong(node, f"field {name} needs {count}, of at most {LARGEST:g}", file)
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
    if len(numbers) % 3 or not are_usable(numbers):
        message = f"the list of points needs three finite numbers a point, of at most {LARGEST:g}"
        raise _wrong(coordinate, message, file)
    points = numbers.reshape(-1, 3)
    index = list_field(node, "coordIndex", file)
    if (index != np.rint(index)).any():
        raise _wrong(node, "coordIndex must hold whole numbers", file)
    outside = index[(index < -1) | (index >= len(points))]
    if len(outside):
        raise _wrong(node, f"coordIndex names point {outside[0]:g}, but there are {len(points)} points", file)
    triangles = _split_faces(points, index.astype(np.int64))
    return points, _turned(node, triangles)


def _split_faces(points: Array, indices: Indices) -> Indices:
    if len(indices) and indices[-1] != -1:
        indices = np.append(indices, -1)
    if len(indices) % 4 == 0 and (indices[3::4] == -1).all() and (indices.reshape(-1, 4)[:, :3] >= 0).all():
        return indices.reshape(-1, 4)[:, :3]
    triangles: list[tuple[int, int, int]] = []
    begin = 0
    for end in np.flatnonzero(indices == -1).tolist():
        triangles += split(points, [int(corner) for corner in indices[begin:end]])
        begin = end + 1
    return np.array(triangles, dtype=np.int64).reshape(-1, 3)


def _elevation_grid(node: Node, file: Path) -> Surface:
    """Heights over the x-z plane, x running fastest (ISO/IEC 14772-1, 6.17); two triangles a quadrilateral."""
    columns, rows = (_whole(node, name, file) for name in ("xDimension", "zDimension"))
    heights = list_field(node, "height", file)
    if len(heights) != columns * rows or not are_usable(heights):
        message = f"field height needs {columns} x {rows} finite numbers, of at most {LARGEST:g}"
        raise _wrong(node, f"{message}, and has {len(heights)}", file)
    if columns < 2 or rows < 2:
        return np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64)
    row, column = np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij")
    width, depth = _length(node, "xSpacing", 1.0, file), _length(node, "zSpacing", 1.0, file)
    points = np.column_stack([width * column.ravel(), heights, depth * row.ravel()])
    a = (row[:-1, :-1] * columns + column[:-1, :-1]).ravel()
    b, c, d = a + columns, a + columns + 1, a + 1
    triangles = np.stack([np.column_stack([a, b, c]), np.column_stack([a, c, d])], axis=1).reshape(-1, 3)
    return points, _turned(node, triangles.astype(np.int64))


def _extrusion(node: Node, file: Path) -> Surface:
    section = _points(node, "crossSection", 2, (1, 1, 1, -1, -1, -1, -1, 1, 1, 1), file)
    spine = _points(node, "spine", 3, (0, 0, 0, 0, 1, 0), file)
    if len(section) < 2 or len(spine) < 2:
        return np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64)
    if len(section) * len(spine) > MAXIMUM_EXTRUSION:
        raise _wrong(node, f"has more than {MAXIMUM_EXTRUSION} points", file)
    scale = _along_spine(node, "scale", 2, (1, 1), len(spine), file)
    orientation = _along_spine(node, "orientation", 4, (0, 0, 1, 0), len(spine), file)
    caps = (boolean_field(node, "beginCap", True), boolean_field(node, "endCap", True))
    points, triangles = extrusion_surface(section, spine, scale, orientation, caps)
    return points, _turned(node, triangles)


def _along_spine(node: Node, name: str, width: int, default: tuple[float, ...], count: int, file: Path) -> Array:
    """One row for each point of the spine; a single row counts for all, and rows too many do not count."""
    rows = _points(node, name, width, default, file)
    if len(rows) == 1:
        return np.tile(rows, (count, 1))
    if len(rows) < count:
        raise _wrong(node, f"field {name} needs 1 or {count} values, but has {len(rows)}", file)
    return rows[:count]


def _points(node: Node, name: str, width: int, default: tuple[float, ...], file: Path) -> Array:
    values = list_field(node, name, file) if name in node.fields else np.array(default, dtype=np.float64)
    if len(values) % width or not are_usable(values):
        raise _wrong(node, f"field {name} needs {width} finite numbers a value, of at most {LARGEST:g}", file)
    return values.reshape(-1, width)


def _whole(node: Node, name: str, file: Path) -> int:
    value = float(number_field(node, name, (0.0,), file)[0])
    if value < 0 or value != np.rint(value):
        raise _wrong(node, f"field {name} must be a whole number, zero or more", file)
    return int(value)


def _turned(node: Node, triangles: Indices) -> Indices:
    return triangles if boolean_field(node, "ccw", True) else triangles[:, ::-1]


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
    "ElevationGrid": _elevation_grid,
    "Extrusion": _extrusion,
}
