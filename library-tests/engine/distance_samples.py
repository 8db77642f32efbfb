"""Bodies and poses for comparing the engine's distances with those of other libraries."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from cad2modelica.geometry.spatial import Array, Pose
from scipy.spatial import ConvexHull

Triangles = npt.NDArray[np.int32]
SignedDistance = Callable[[str, Pose, str, Pose], float]


@dataclass(frozen=True)
class Surface:
    """Triangles with their corners counter-clockwise seen from outside: ``vertices[n, 3]``, ``triangles[m, 3]``."""

    vertices: Array
    triangles: Triangles

    def descriptor(self) -> str:
        """As a mesh."""
        corners = ",".join(str(number) for number in (self.triangles + 1).ravel())
        return f"cmb/1 mesh vertices={numbers(self.vertices)} triangles={corners}"


def numbers(values: Array) -> str:
    return ",".join(repr(float(value)) for value in values.ravel())


def hull_surface(points: Array) -> Surface:
    """Of points that all lie on their convex hull."""
    hull = ConvexHull(points)
    turned = []
    for corners, equation in zip(hull.simplices, hull.equations, strict=True):
        a, b, c = points[corners]
        turned.append(corners if np.dot(np.cross(b - a, c - a), equation[:3]) > 0 else corners[::-1])
    return Surface(points, np.array(turned, dtype=np.int32))


def ball_points(count: int, semi_axes: tuple[float, float, float]) -> Array:
    """On an ellipsoid, along a spiral."""
    k = np.arange(count)
    z = 1 - (2 * k + 1) / count
    turn = 2.399963229728653 * k
    across = np.sqrt(1 - z * z)
    return np.stack([across * np.cos(turn), across * np.sin(turn), z], axis=1) * np.array(semi_axes)


def ring_surface(radius: float, tube: float, n: int, m: int) -> Surface:
    """A torus about z, of 2 n m triangles."""
    u, v = np.meshgrid(2 * np.pi * np.arange(n) / n, 2 * np.pi * np.arange(m) / m, indexing="ij")
    r = radius + tube * np.cos(v)
    vertices = np.stack([r * np.cos(u), r * np.sin(u), tube * np.sin(v)], axis=-1).reshape(-1, 3)
    triangles = []
    for i in range(n):
        for j in range(m):
            a, b = i * m + j, (i + 1) % n * m + j
            c, d = (i + 1) % n * m + (j + 1) % m, i * m + (j + 1) % m
            triangles += [(a, b, c), (a, c, d)]
    return Surface(vertices, np.array(triangles, dtype=np.int32))


HULL = hull_surface(ball_points(14, (0.5, 0.4, 0.3)))

# Descriptors by kind; the other libraries' shapes have the same sizes.
CONVEX = {
    "sphere": "cmb/1 sphere radius=0.3",
    "box": "cmb/1 box size=0.6,0.8,1",
    "capsule": "cmb/1 capsule radius=0.25 length=0.7",
    "cylinder": "cmb/1 cylinder radius=0.3 length=0.8",
    "cone": "cmb/1 cone radius=0.4 length=0.9",
    "ellipsoid": "cmb/1 ellipsoid size=1,0.7,0.5",
    "hull": f"cmb/1 hull vertices={numbers(HULL.vertices)}",
}

CONVEX_PAIRS = [(a, b) for i, a in enumerate(CONVEX) for b in list(CONVEX)[i:]]


def random_rotation(random: np.random.Generator) -> Array:
    q = random.normal(size=4)
    w, x, y, z = q / np.linalg.norm(q)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def pose_pairs(seed: int, count: int, nearest: float, farthest: float) -> Iterator[tuple[Pose, Pose]]:
    """Bodies whose origins are ``nearest`` to ``farthest`` (m) apart, turned any way."""
    random = np.random.default_rng(seed)
    for _ in range(count):
        direction = random.normal(size=3)
        at = random.uniform(-1, 1, size=3)
        off = direction / np.linalg.norm(direction) * random.uniform(nearest, farthest)
        yield Pose(at + off, random_rotation(random)), Pose(at, random_rotation(random))
