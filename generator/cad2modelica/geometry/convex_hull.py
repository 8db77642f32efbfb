"""Convex hulls of points that may not span a solid."""

from __future__ import annotations

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from cad2modelica.geometry.mesh import Indices
from cad2modelica.geometry.spatial import Array

FLAT = 1e-9  # thickness over size below which points span no solid


def convex_hull(vertices: Array) -> ConvexHull | None:
    """The hull of points of shape (n, 3); None if they span no solid."""
    size = float(np.linalg.norm(vertices.max(axis=0) - vertices.min(axis=0))) if len(vertices) else 0.0
    if len(vertices) < 4 or size == 0.0:
        return None
    singular = np.linalg.svd(vertices - vertices.mean(axis=0), compute_uv=False)
    if singular[2] < FLAT * singular[0]:
        return None
    try:
        return ConvexHull(vertices)
    except QhullError:
        return None


def hull_surface(vertices: Array) -> tuple[Array, Indices] | None:
    """The hull's corners and triangles, which face outwards; None if the points span no solid."""
    hull = convex_hull(vertices)
    if hull is None:
        return None
    triangles: Indices = hull.simplices.astype(np.int64)
    corners = vertices[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    inward = np.einsum("ij,ij->i", normals, hull.equations[:, :3]) < 0
    triangles[inward] = triangles[inward][:, ::-1]
    used, renumbered = np.unique(triangles, return_inverse=True)
    return vertices[used], renumbered.reshape(triangles.shape)
