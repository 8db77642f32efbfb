"""Mass properties of solids of a given density, and of several bodies as one."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from cad2modelica.geometry.convex_hull import hull_surface
from cad2modelica.geometry.mesh import Mesh, bodies, is_closed, volume_integrals, weld
from cad2modelica.geometry.spatial import Array, Pose
from cad2modelica.mechanism.model import MassProperties

NO_MASS = MassProperties(0.0, np.zeros(3), np.zeros((3, 3)))


def placed(properties: MassProperties, pose: Pose) -> MassProperties:
    """The same body in the axes that its own have the pose in."""
    turn = pose.rotation
    inertia = turn @ properties.inertia @ turn.T
    return MassProperties(properties.mass, pose.point(properties.center_of_mass), (inertia + inertia.T) / 2)


def together(items: Iterable[MassProperties]) -> MassProperties:
    """Several bodies in the same axes as one rigid body, by the parallel axis theorem."""
    massive = [item for item in items if item.mass != 0.0]
    if len(massive) <= 1:
        return massive[0] if massive else NO_MASS
    mass = sum(item.mass for item in massive)
    center = sum((item.mass * item.center_of_mass for item in massive), np.zeros(3)) / mass
    inertia = sum((item.inertia + _steiner(item, center) for item in massive), np.zeros((3, 3)))
    return MassProperties(mass, center, inertia)


def _steiner(item: MassProperties, center: Array) -> Array:
    arm = item.center_of_mass - center
    return item.mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))


def solid_mass(meshes: Sequence[Mesh], density: float) -> tuple[MassProperties, bool]:
    """Mass properties of meshes as solids.

    Args:
        meshes: in the axes of the result.
        density: kg/m3.

    Returns:
        The mass properties; and whether all bodies are closed: of one that is not, the convex hull counts.
    """
    found, closed = [], True
    for mesh in meshes:
        for vertices, triangles in bodies(*weld(mesh.vertices, mesh.triangles)):
            integrals = volume_integrals(vertices, triangles) if is_closed(triangles) else None
            if integrals is None or integrals.volume <= 0:
                closed = False
                hull = hull_surface(vertices)
                integrals = volume_integrals(*hull) if hull is not None else None
            if integrals is not None:
                found.append(MassProperties(density * integrals.volume, integrals.center, density * integrals.inertia))
    return together(found), closed
