"""Meshes of boxes, spheres and bodies of revolution."""

from __future__ import annotations

import numpy as np

from cad2modelica.geometry.mesh import Indices
from cad2modelica.geometry.spatial import Array, rotation_about

Surface = tuple[Array, Indices]

SEGMENTS = 32  # around the axis
RINGS = 16  # of spheres, from pole to pole


def box_surface(size: Array) -> Surface:
    """A box of full lengths ``size``, shape (3,), centred."""
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * size / 2
    quads = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    return corners, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))], dtype=np.int64)


def sphere_surface(radius: float) -> Surface:
    """A sphere about the origin, its poles on the y axis."""
    angles = np.linspace(0.0, np.pi, RINGS + 1)
    return revolved_surface(radius * np.sin(angles), radius * np.cos(angles))


def cylinder_surface(radius: float, height: float) -> Surface:
    """A cylinder along y, centred."""
    return revolved_surface(np.array([0.0, radius, radius, 0.0]), np.array([1.0, 1.0, -1.0, -1.0]) * height / 2)


def capsule_surface(radius: float, height: float) -> Surface:
    """A capsule along y, centred; ``height`` is that of its cylinder."""
    angles = np.linspace(0.0, np.pi / 2, RINGS // 2 + 1)
    radii = np.concatenate([radius * np.sin(angles), radius * np.cos(angles)])
    heights = np.concatenate([height / 2 + radius * np.cos(angles), -height / 2 - radius * np.sin(angles)])
    return revolved_surface(radii, heights)


def cone_surface(radius: float, height: float) -> Surface:
    """A cone along y, its tip up, centred at half its height."""
    return revolved_surface(np.array([0.0, radius, 0.0]), np.array([1.0, -1.0, -1.0]) * height / 2)


def along_z(surface: Surface) -> Surface:
    """A surface of revolution about y, turned to z, as robot descriptions have it."""
    vertices, triangles = surface
    return vertices @ rotation_about([1, 0, 0], np.pi / 2).T, triangles


def ellipsoid_surface(semi_axes: Array) -> Surface:
    """An ellipsoid about the origin."""
    vertices, triangles = sphere_surface(1.0)
    return vertices * semi_axes, triangles


def revolved_surface(radii: Array, heights: Array) -> Surface:
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
