"""Volume, centre and inertia of meshes by the rules of MuJoCo, which differ where a mesh is not convex or not closed.

Tetrahedra from the surface's centre give the centre of mass, tetrahedra from there volume and inertia (MuJoCo's
XML reference, asset/mesh/inertia). By the rule "legacy" all of them count as positive, by "exact" with their sign; a
"shell" has its mass on the surface, whose area takes the volume's place.
"""

from __future__ import annotations

import numpy as np

from cad2modelica.geometry.mesh import Indices, VolumeIntegrals
from cad2modelica.geometry.spatial import Array


def mesh_integrals(vertices: Array, triangles: Indices, rule: str) -> VolumeIntegrals:
    """Integrals over a mesh.

    Args:
        vertices: shape (n, 3), m.
        triangles: shape (m, 3).
        rule: "legacy", "shell", or any other word for exact ones.
    """
    corners = vertices[triangles]
    doubled = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(doubled, axis=1) / 2
    centers = corners.mean(axis=1)
    base = areas @ centers / max(float(areas.sum()), np.finfo(float).tiny)

    def weights(origin: Array) -> Array:
        volumes = np.einsum("ij,ij->i", centers - origin, doubled) / 6
        return np.asarray(areas if rule == "shell" else np.abs(volumes) if rule == "legacy" else volumes)

    first = weights(base)
    total = float(first.sum())
    if not total > 0.0:
        return VolumeIntegrals(0.0, base, np.zeros((3, 3)))
    center = first @ (0.75 * centers + 0.25 * base) / total
    second = weights(center)
    arms = corners - center
    sums = arms.sum(axis=1)
    products = np.einsum("t,tci,tcj->ij", second, arms, arms) + np.einsum("t,ti,tj->ij", second, sums, sums)
    products /= 12.0 if rule == "shell" else 20.0
    return VolumeIntegrals(float(second.sum()), center, np.trace(products) * np.eye(3) - products)
