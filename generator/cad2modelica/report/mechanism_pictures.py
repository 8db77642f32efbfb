"""Pictures of a mechanism at the start: as it was drawn, and as it collides."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from scipy.spatial import ConvexHull

from cad2modelica.collision.collision_shape import CollisionShape
from cad2modelica.collision.collision_shapes import CollisionGeometry
from cad2modelica.geometry.spatial import Array, dot
from cad2modelica.mechanism.model import Assembly
from cad2modelica.report.picture import Solid, draw

RECOGNISED = (0.25, 0.62, 0.60)  # box, sphere, cylinder, cone, capsule
HULL = (0.52, 0.60, 0.72)
PIECES = ((0.86, 0.62, 0.30), (0.80, 0.47, 0.36), (0.87, 0.76, 0.42), (0.66, 0.50, 0.58), (0.72, 0.70, 0.50))
APART = (0.93, 0.93, 0.94)  # parts that do not collide
ROUND = 8  # half the number of sides of a round shape in the picture


def mechanism_pictures(assembly: Assembly, geometries: Mapping[str, CollisionGeometry]) -> tuple[bytes, bytes] | None:
    """PNG of the parts and of their collision shapes, from the same place; None if one of them has nothing to show.

    Args:
        assembly: the mechanism.
        geometries: collision shapes by part.
    """
    parts = [
        Solid(part.pose.point(mesh.vertices)[mesh.triangles], mesh.color)
        for part in assembly.parts
        for mesh in part.meshes
        if len(mesh.triangles)
    ]
    shapes: list[Solid] = []
    for part in assembly.parts:
        own = geometries[part.name].shapes
        if not own:
            meshes = (part.pose.point(mesh.vertices)[mesh.triangles] for mesh in part.meshes if len(mesh.triangles))
            shapes += [Solid(corners, APART) for corners in meshes]
        pieces = sum(shape.kind == "hull" for shape in own)
        for number, shape in enumerate(own):
            several = PIECES[number % len(PIECES)] if pieces > 1 else HULL
            color = several if shape.kind == "hull" else RECOGNISED
            shapes.append(Solid(part.pose.point(_surface(shape).reshape(-1, 3)).reshape(-1, 3, 3), color))
    if not parts or not shapes:
        return None
    down = assembly.gravity
    up = -down if np.linalg.norm(down) > 0 else np.array([0.0, 0.0, 1.0])
    everything = [*parts, *shapes]
    return draw(parts, up, everything), draw(shapes, up, everything)


def _surface(shape: CollisionShape) -> Array:
    """Triangles of a shape in the body's frame, shape (n, 3, 3)."""
    points, margin = shape.outline
    if margin > 0:
        points = (points[:, None] + margin * _globe(shape)).reshape(-1, 3)
    hull = ConvexHull(points)
    corners = hull.points[hull.simplices]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    inward = dot(normal, hull.equations[:, :3]) < 0
    return np.where(inward[:, None, None], corners[:, ::-1], corners)


def _globe(shape: CollisionShape) -> Array:
    """Directions of a sphere's meridians and parallels about the shape's third axis."""
    polar = np.pi * np.arange(ROUND + 1) / ROUND
    around = np.pi * np.arange(2 * ROUND) / ROUND
    ring = np.column_stack([np.cos(around), np.sin(around), np.ones(2 * ROUND)])
    rows = [ring * [np.sin(angle), np.sin(angle), np.cos(angle)] for angle in polar]
    return np.asarray(np.concatenate(rows) @ shape.pose.rotation.T)
