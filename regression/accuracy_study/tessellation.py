"""Shapes of a descriptor as others: round and box shapes as hulls or meshes, meshes as convex pieces."""

from __future__ import annotations

import math
from typing import Final

import numpy as np
from contact_foundation.errors import SimulationError
from fmu_regression.results.result import FloatArray
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

_PLACE: Final = ("position", "rotation")
_MOST_PIECES: Final = 64


def tessellated(descriptor: str, kind: str, segments: int) -> str:
    """A descriptor (docs/architecture.md) whose analytic shapes are inscribed polyhedra.

    Args:
        descriptor: of a body.
        kind: "hull" or "mesh".
        segments: edges around a round shape.

    Returns:
        the descriptor; half-spaces, hulls, meshes and height fields in it stay as they are.
    """
    return ";".join(_shape(shape, kind, segments) for shape in descriptor.split(";"))


def decomposed(descriptor: str, error: float) -> str:
    """A descriptor whose closed meshes are unions of convex pieces; all other shapes stay as they are.

    Args:
        descriptor: of a body.
        error: what the pieces may keep of the mesh's hollows, m.

    Raises:
        SimulationError: a mesh is not closed or cannot be decomposed.
    """
    return ";".join(piece for shape in descriptor.split(";") for piece in _pieces(shape, error))


def _pieces(shape: str, error: float) -> list[str]:
    from cad2modelica.collision.convex_decomposition import decompose  # not at the start: the generator loads slowly

    words = shape.split()
    if words[1:2] != ["mesh"]:
        return [shape]
    values = dict(word.split("=", 1) for word in words[2:])
    if "triangles" not in values:
        return [shape]
    vertices, number = np.unique(_numbers(values["vertices"]).reshape(-1, 3), axis=0, return_inverse=True)
    corners = np.array(values["triangles"].split(","), dtype=np.int64) - 1
    triangles = number.reshape(-1)[corners].reshape(-1, 3).astype(np.int64)
    edges = {(a, b) for triangle in triangles for a, b in zip(triangle, np.roll(triangle, -1), strict=True)}
    if any((b, a) not in edges for a, b in edges):
        raise SimulationError("a mesh that is not closed cannot be decomposed")
    found = decompose(vertices, triangles, error, _MOST_PIECES)
    if not found.pieces:
        raise SimulationError(f"a mesh cannot be decomposed: {found.failure}")
    place = [f"{key}={values[key]}" for key in _PLACE if key in values]
    return [" ".join([f"cmb/1 hull vertices={_list(piece)}", *place]) for piece in found.pieces]


def _shape(shape: str, kind: str, segments: int) -> str:
    words = shape.split()
    if len(words) < 2:
        return shape
    values = dict(word.split("=", 1) for word in words[2:] if "=" in word)
    points = _points(words[1], values, segments)
    if points is None:
        return shape
    vertices, triangles = _polyhedron(points)
    text = f"cmb/1 {kind} vertices={_list(vertices)}"
    if kind == "mesh":
        text += " triangles=" + ",".join(str(i + 1) for i in triangles.ravel())
    return " ".join([text, *(f"{key}={values[key]}" for key in _PLACE if key in values)])


def _points(kind: str, values: dict[str, str], n: int) -> FloatArray | None:
    """Points of the surface, shape (k, 3), m; None for kinds that are not tessellated."""
    if kind == "box":
        half = _numbers(values["size"]) / 2
        signs = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
        return np.array(signs, dtype=np.float64) * half
    if kind == "sphere":
        return float(values["radius"]) * _ball(n)
    if kind == "ellipsoid":
        scaled: FloatArray = _ball(n) * _numbers(values["size"]) / 2
        return scaled
    if kind not in ("cylinder", "cone", "capsule"):
        return None
    radius, half_length = float(values["radius"]), float(values["length"]) / 2
    rim = radius * _ring(n)
    if kind == "cone":
        return np.vstack([_at(rim, -half_length), [[0.0, 0.0, half_length]]])
    if kind == "cylinder":
        return np.vstack([_at(rim, -half_length), _at(rim, half_length)])
    ball = radius * _ball(n)
    shift = np.array([0.0, 0.0, half_length])
    return np.vstack([ball[ball[:, 2] >= -1e-12 * radius] + shift, ball[ball[:, 2] <= 1e-12 * radius] - shift])


def _ring(n: int) -> FloatArray:
    angle = 2 * math.pi * np.arange(n) / n
    return np.column_stack([np.cos(angle), np.sin(angle), np.zeros(n)])


def _at(ring: FloatArray, height: float) -> FloatArray:
    shifted: FloatArray = ring + np.array([0.0, 0.0, height])
    return shifted


def _ball(n: int) -> FloatArray:
    """Points of the unit sphere: poles, and an odd number of rings of n points, so that one is the equator."""
    rings = max(1, n // 2 - 1) | 1
    heights = [math.pi * k / (rings + 1) for k in range(1, rings + 1)]
    parts = [_at(math.sin(t) * _ring(n), 0.0 if k == rings // 2 else math.cos(t)) for k, t in enumerate(heights)]
    return np.vstack([[[0.0, 0.0, 1.0]], *parts, [[0.0, 0.0, -1.0]]])


def _polyhedron(points: FloatArray) -> tuple[FloatArray, NDArray[np.intp]]:
    """The hull's vertices, shape (k, 3), and triangles, shape (t, 3), counter-clockwise seen from outside."""
    hull = ConvexHull(points)
    kept = np.array(sorted(hull.vertices))
    number = {int(old): new for new, old in enumerate(kept)}
    triangles = []
    for simplex, equation in zip(hull.simplices, hull.equations, strict=True):
        a, b, c = (points[i] for i in simplex)
        i, j, k = (number[int(v)] for v in simplex)
        triangles.append((i, j, k) if np.dot(np.cross(b - a, c - a), equation[:3]) > 0 else (i, k, j))
    return points[kept], np.array(sorted(triangles), dtype=np.intp)


def _list(values: FloatArray) -> str:
    return ",".join(repr(float(x)) for x in values.ravel())


def _numbers(text: str) -> FloatArray:
    return np.array([float(word) for word in text.split(",")])
