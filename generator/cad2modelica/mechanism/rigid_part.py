"""A part of a robot description, from the bodies that are fixed to each other in it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from contact_foundation.errors import Place

from cad2modelica.geometry.mesh import Mesh
from cad2modelica.geometry.spatial import Pose
from cad2modelica.mechanism.mass_properties import NO_MASS, together
from cad2modelica.mechanism.mass_repair import impossible_members, usable
from cad2modelica.mechanism.model import CollisionChoice, MassProperties, Part


@dataclass(frozen=True, eq=False)
class Member:
    """What one body brings into its part: surfaces and mass, in the part's axes."""

    name: str
    shown: Sequence[Mesh]
    colliding: Sequence[Mesh]
    mass: MassProperties = NO_MASS


def part_between(name: str, pose: Pose, place: Place) -> Part:
    """A part without mass and geometry, between two joints in a row."""
    return Part(
        name=name,
        material=None,
        pose=pose,
        mass_properties=NO_MASS,
        meshes=(),
        collision=CollisionChoice.NONE,
        grounded=False,
        place=place,
    )


def rigid_part(
    name: str, pose: Pose, members: Iterable[Member], place: Place, *, grounded: bool, material: str | None = None
) -> tuple[Part, list[str]]:
    """The part, and notes on it.

    Args:
        name: of the part.
        pose: in the world.
        members: bodies that are fixed to each other; of a part that stands in the world the masses do not count.
        place: where it is described.
        grounded: whether it stands in the world.
        material: name of its material.
    """
    members = list(members)
    shown = tuple(mesh for member in members for mesh in member.shown)
    colliding = tuple(mesh for member in members for mesh in member.colliding)
    properties = NO_MASS if grounded else together(member.mass for member in members)
    notes: list[str] = []
    if properties.mass > 0:
        properties, remarks = usable(properties, shown or colliding)
        notes += [f"body {name!r}: {remark}" for remark in remarks]
        notes += [f"body {remark}" for remark in impossible_members((item.name, item.mass) for item in members)]
    return Part(
        name=name,
        material=material,
        pose=pose,
        mass_properties=properties,
        meshes=shown or colliding,
        collision=CollisionChoice.AUTO if colliding else CollisionChoice.NONE,
        grounded=grounded,
        place=place,
        collision_meshes=colliding or None,
    ), notes
