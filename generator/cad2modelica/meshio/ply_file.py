"""Polygon files (.ply), as text or binary: Greg Turk, The PLY Polygon File Format, 1994."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from contact_foundation.errors import InputError, Place

from cad2modelica.geometry.mesh import Indices
from cad2modelica.geometry.polygon import Triangle, split
from cad2modelica.geometry.spatial import Array

_TYPES = {
    "char": "i1",
    "uchar": "u1",
    "short": "i2",
    "ushort": "u2",
    "int": "i4",
    "uint": "u4",
    "float": "f4",
    "double": "f8",
    "int8": "i1",
    "uint8": "u1",
    "int16": "i2",
    "uint16": "u2",
    "int32": "i4",
    "uint32": "u4",
    "float32": "f4",
    "float64": "f8",
}
_ORDERS = {"binary_little_endian": "<", "binary_big_endian": ">", "ascii": ""}
_CORNERS = ("vertex_indices", "vertex_index")


@dataclass(frozen=True)
class _Property:
    """A property; ``count`` is the type of a list's length, and None for a single value."""

    name: str
    type: str
    count: str | None


@dataclass
class _Element:
    name: str
    count: int
    properties: list[_Property] = field(default_factory=list)


class _Broken(ValueError):
    """The file breaks the format; the text says how."""


def read_ply(data: bytes, file: Path) -> tuple[Array, Indices]:
    """Vertices, shape (n, 3), and triangles, shape (m, 3); polygons may be concave.

    Raises:
        InputError: the data breaks the format or ends too early.
    """
    try:
        order, elements, body = _header(data)
        values = _TextBody(body) if order == "" else _BinaryBody(body, order)
        return _surface(elements, values)
    except _Broken as error:
        raise InputError(str(error), place=Place(file=file), remedy="Export the mesh again.") from None


def _header(data: bytes) -> tuple[str, list[_Element], bytes]:
    """Byte order (empty for text), elements in the file's order, and what follows the header."""
    head, mark, rest = data.partition(b"end_header")
    lines = head.decode("ascii", errors="replace").splitlines()
    if not mark or not lines or lines[0].strip() != "ply":
        raise _Broken("is no PLY file: its header does not begin with 'ply' and end with 'end_header'")
    order, elements = None, list[_Element]()
    for line in lines[1:]:
        words = line.split()
        try:
            match words:
                case ["format", name, _]:
                    order = _ORDERS[name]
                case ["element", name, count]:
                    elements.append(_Element(name, int(count)))
                case ["property", "list", count, kind, name]:
                    elements[-1].properties.append(_Property(name, _TYPES[kind], _TYPES[count]))
                case ["property", kind, name]:
                    elements[-1].properties.append(_Property(name, _TYPES[kind], None))
        except (KeyError, ValueError, IndexError):
            raise _Broken(f"the header's line {line.strip()!r} is not understood") from None
    if order is None:
        raise _Broken("the header names no format")
    return order, elements, rest[2:] if rest.startswith(b"\r\n") else rest[1:]


class _BinaryBody:
    def __init__(self, data: bytes, order: str) -> None:
        self._data = data
        self._order = order
        self._at = 0

    def take(self, kind: str, count: int) -> Array:
        """The next values."""
        size = np.dtype(kind).itemsize * count
        if count < 0 or self._at + size > len(self._data):
            raise _Broken("the file ends too early")
        values = np.frombuffer(self._data, self._order + kind, count, self._at)
        self._at += size
        return values.astype(np.float64)


class _TextBody:
    def __init__(self, data: bytes) -> None:
        try:
            self._values = np.array(data.split(), dtype=np.float64)
        except ValueError:
            raise _Broken("holds text where a number belongs") from None
        self._at = 0

    def take(self, kind: str, count: int) -> Array:  # noqa: ARG002
        """The next values."""
        if count < 0 or self._at + count > len(self._values):
            raise _Broken("the file ends too early")
        values = self._values[self._at : self._at + count]
        self._at += count
        return values


def _surface(elements: list[_Element], body: _BinaryBody | _TextBody) -> tuple[Array, Indices]:
    vertices = np.zeros((0, 3))
    faces: list[list[int]] = []
    for element in elements:
        names = [item.name for item in element.properties]
        if element.name == "vertex" and not set("xyz") <= set(names):
            raise _Broken("its vertices have no coordinates x, y and z")
        points = []
        for _ in range(element.count):
            row = {}
            for item in element.properties:
                length = 1 if item.count is None else int(body.take(item.count, 1)[0])
                row[item.name] = body.take(item.type, length)
            if element.name == "vertex":
                points.append([float(row[axis][0]) for axis in "xyz"])
            elif element.name == "face":
                corners = next((row[name] for name in _CORNERS if name in row), None)
                if corners is None:
                    raise _Broken("its faces name no vertices")
                faces.append([int(corner) for corner in corners])
        if element.name == "vertex":
            vertices = np.array(points, dtype=np.float64).reshape(-1, 3)
    triangles: list[Triangle] = []
    for face in faces:
        if any(not 0 <= corner < len(vertices) for corner in face):
            raise _Broken("a face needs vertices that exist")
        if len(face) == 3:
            triangles.append((face[0], face[1], face[2]))
        elif len(face) > 3:
            triangles += split(vertices, face)
    return vertices, np.array(triangles, dtype=np.int64).reshape(-1, 3)
