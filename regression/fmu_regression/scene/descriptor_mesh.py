"""Triangles of a geometry descriptor (docs/architecture.md), to show it."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from typing import Final

import numpy as np
from numpy.typing import NDArray

from fmu_regression.results.result import FloatArray
from fmu_regression.scene.scene_file import Mesh

_SHAPE: Final = re.compile(r"\s*cmb/1\s+(\w+)(.*)", re.DOTALL)
_ITEM: Final = re.compile(r'(\w+)=("[^"]*"|\S+)')
_BETWEEN: Final = re.compile(r';(?=(?:[^"]*"[^"]*")*[^"]*$)')
_SIDES: Final = 32
_PLANE: Final = 1.0  # half the side of the square that stands for a half-space, m
_COLORS: Final = ((0.45, 0.6, 0.8), (0.85, 0.6, 0.35), (0.5, 0.75, 0.5), (0.8, 0.5, 0.6))
_GROUND: Final = (0.75, 0.75, 0.72)

_Triangles = NDArray[np.uint32]
_Surface = tuple[FloatArray, _Triangles]
_Numbers = Mapping[str, FloatArray]


def descriptor_meshes(descriptor: str, number: int) -> tuple[Mesh, ...]:
    """The surfaces of a descriptor's shapes in the body's axes; shapes in files and of unknown kinds are left out.

    Args:
        descriptor: of one body; half-spaces become squares of 2 m.
        number: of the body, which decides about its colour.
    """
    meshes = []
    for text in _BETWEEN.split(descriptor):
        match = _SHAPE.fullmatch(text)
        make = _SURFACES.get(match[1]) if match is not None else None
        if match is None or make is None:
            continue
        try:
            items = _ITEM.findall(match[2])
            values = {key: np.array([float(item) for item in value.split(",")]) for key, value in items}
            vertices, triangles = make(values)
        except (ValueError, KeyError, IndexError):
            continue
        turn = values.get("rotation", np.eye(3)).reshape(3, 3)
        placed = vertices @ turn + values.get("position", np.zeros(3))  # v_body = T' v_shape
        color = _GROUND if match[1] == "halfspace" else _COLORS[number % len(_COLORS)]
        meshes.append(Mesh(match[1], placed, triangles, color))
    return tuple(meshes)


def _grid(profile: list[tuple[float, float]]) -> _Surface:
    """A surface of revolution about z of points (radius, z), from below to above; ends at radius 0 are closed."""
    angles = 2 * np.pi * np.arange(_SIDES) / _SIDES
    vertices = [
        (radius * math.cos(angle), radius * math.sin(angle), height) for radius, height in profile for angle in angles
    ]
    triangles = []
    for ring in range(len(profile) - 1):
        for side in range(_SIDES):
            a, b = ring * _SIDES + side, ring * _SIDES + (side + 1) % _SIDES
            triangles += [(a, b, b + _SIDES), (a, b + _SIDES, a + _SIDES)]
    return np.array(vertices, dtype=float), np.array(triangles, dtype=np.uint32)


def _arc(radius: float, first: float, last: float, height: float) -> list[tuple[float, float]]:
    angles = np.linspace(first, last, _SIDES // 4 + 1)
    return [(max(radius * math.cos(angle), 0.0), height + radius * math.sin(angle)) for angle in angles]


def _sphere(values: _Numbers) -> _Surface:
    radius = float(values["radius"][0])
    return _grid(_arc(radius, -np.pi / 2, 0, 0.0) + _arc(radius, 0, np.pi / 2, 0.0)[1:])


def _capsule(values: _Numbers) -> _Surface:
    radius, half = float(values["radius"][0]), float(values["length"][0]) / 2
    return _grid(_arc(radius, -np.pi / 2, 0, -half) + _arc(radius, 0, np.pi / 2, half))


def _cylinder(values: _Numbers) -> _Surface:
    radius, half = float(values["radius"][0]), float(values["length"][0]) / 2
    return _grid([(0.0, -half), (radius, -half), (radius, half), (0.0, half)])


def _cone(values: _Numbers) -> _Surface:
    radius, half = float(values["radius"][0]), float(values["length"][0]) / 2
    return _grid([(0.0, -half), (radius, -half), (0.0, half)])


def _ellipsoid(values: _Numbers) -> _Surface:
    vertices, triangles = _sphere({"radius": np.array([0.5])})
    return vertices * values["size"], triangles


def _box(values: _Numbers) -> _Surface:
    corners = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=float)
    faces = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    triangles = [triangle for a, b, c, d in faces for triangle in ((a, b, c), (a, c, d))]
    return corners * values["size"] / 2, np.array(triangles, dtype=np.uint32)


def _halfspace(_: _Numbers) -> _Surface:
    corners = np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], dtype=float) * _PLANE
    return corners, np.array([(0, 1, 2), (0, 2, 3)], dtype=np.uint32)


def _mesh(values: _Numbers) -> _Surface:
    return values["vertices"].reshape(-1, 3), values["triangles"].reshape(-1, 3).astype(np.uint32) - 1


def _hull(values: _Numbers) -> _Surface:
    from scipy.spatial import ConvexHull, QhullError

    points = values["vertices"].reshape(-1, 3)
    try:
        hull = ConvexHull(points)
    except QhullError as error:
        raise ValueError(str(error)) from error
    triangles = np.array(hull.simplices)
    a, b, c = (points[triangles[:, column]] for column in range(3))
    inside = np.einsum("ij,ij->i", np.cross(b - a, c - a), hull.equations[:, :3]) < 0
    triangles[inside] = triangles[inside][:, ::-1]
    return points, triangles.astype(np.uint32)


_SURFACES: Final[Mapping[str, Callable[[_Numbers], _Surface]]] = {
    "sphere": _sphere,
    "capsule": _capsule,
    "cylinder": _cylinder,
    "cone": _cone,
    "ellipsoid": _ellipsoid,
    "box": _box,
    "halfspace": _halfspace,
    "mesh": _mesh,
    "hull": _hull,
}
