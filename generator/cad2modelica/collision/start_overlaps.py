"""Bodies that overlap at the start, by the contact engine's own distances."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import networkx as nx
import numpy as np
from contact_data import contact_engine
from contact_foundation.errors import BuildError

from cad2modelica.collision.collision_shapes import CollisionGeometry
from cad2modelica.collision.contact_engine import ContactEngine
from cad2modelica.geometry.spatial import Pose, perpendicular
from cad2modelica.mechanism.model import GROUND, Assembly, JointType, Plane

TOLERANCE = 1e-6  # of the smaller body's size: what lies on another body touches, and does not overlap
RESTING = 0.02  # share up to which an overlap may be that of bodies at rest


@dataclass(frozen=True)
class Overlap:
    """Two bodies, by their names in the source, and how deep (m) one is in the other.

    Attributes:
        share: the depth over the size of the smaller body.
        is_filled: whether one of them collides as a shape that fills what is hollow in it, so that the bodies
            themselves may be apart.
    """

    first: str
    second: str
    depth: float
    share: float
    is_filled: bool = False

    @property
    def deep(self) -> bool:
        """Whether it is more than bodies that lie on each other have, so that contact throws them apart."""
        return self.share > RESTING


@dataclass(frozen=True)
class StartCheck:
    """Overlaps, deepest first; ``reason`` says why nothing was checked, and is None if it was."""

    overlaps: tuple[Overlap, ...]
    checked: int
    reason: str | None = None


def start_overlaps(
    assembly: Assembly,
    geometries: Mapping[str, CollisionGeometry],
    pairs: Sequence[tuple[str, str]],
    library: Path | None = None,
) -> StartCheck:
    """Checks the pairs that may touch in the start configuration.

    Args:
        assembly: the mechanism.
        geometries: collision shapes by part.
        pairs: names of parts and planes.
        library: the contact engine; as a rule the one in the Modelica library.
    """
    library = library or contact_engine()
    near = _near(assembly, geometries, pairs)
    if not near:
        return StartCheck((), len(pairs))
    if not library.is_file():
        return StartCheck((), 0, "the contact engine is not installed")
    names = list(dict.fromkeys(name for pair in near for name in pair))
    planes = {plane.name: plane for plane in assembly.planes}
    descriptors = ["cmb/1 halfspace" if name in planes else geometries[name].descriptor for name in names]
    poses = [_plane_pose(planes[name]) if name in planes else assembly.part(name).pose for name in names]
    try:
        distances = ContactEngine(library).signed_distances(
            descriptors, poses, [(names.index(a), names.index(b)) for a, b in near]
        )
    except BuildError as error:
        return StartCheck((), 0, error.message)
    found = []
    for (first, second), distance in zip(near, distances, strict=True):
        parts = [name for name in (first, second) if name not in planes]
        size = min(geometries[name].ball(assembly.part(name).pose).radius for name in parts)
        if distance < -TOLERANCE * size:
            is_filled = any(geometries[name].is_filled for name in parts)
            found.append(Overlap(first, second, -float(distance), -float(distance) / (2 * size), is_filled))
    found.sort(key=lambda overlap: (-overlap.depth, overlap.first, overlap.second))
    return StartCheck(tuple(found), len(pairs))


def without_start_overlaps(
    assembly: Assembly, pairs: Sequence[tuple[str, str]], start: StartCheck
) -> tuple[list[tuple[str, str]], StartCheck, tuple[str, ...]]:
    """Drops pairs of one mechanism that overlap at the start deeply, or as shapes that fill what is hollow.

    Descriptions of robots and CAD assemblies have fingers, covers and gear wheels that overlap where they were drawn,
    and a contact would throw them apart. Hulls of forks, housings and bent links reach into what they hold: their
    contact would brake joints that turn freely, for ever. Pairs included explicitly stay. Bodies that no joints connect
    keep their contact: a body in the ground would fall for ever without it.

    Returns:
        The pairs that are left, the overlaps among them, and a note on each pair that is not.
    """
    joined: nx.Graph[str] = nx.Graph()
    joined.add_nodes_from(part.name for part in assembly.parts)
    joined.add_edges_from(
        (joint.parent, joint.child)
        for joint in assembly.joints
        if joint.type is not JointType.FREE and joint.parent != GROUND
    )
    mechanism = {name: number for number, names in enumerate(nx.connected_components(joined)) for name in names}
    included = {frozenset(pair) for pair in assembly.contacts.included}

    def is_dropped(overlap: Overlap) -> bool:
        first, second = (mechanism.get(name) for name in (overlap.first, overlap.second))
        of_one = first is not None and first == second
        is_none = overlap.deep or overlap.is_filled
        return is_none and of_one and frozenset((overlap.first, overlap.second)) not in included

    dropped = {frozenset((item.first, item.second)): item for item in start.overlaps if is_dropped(item)}
    notes = tuple(
        f"{item.first!r} and {item.second!r} overlap at the start by {1000 * item.depth:.4g} mm"
        f"{'' if item.deep else ', one of them as a shape that fills what is hollow in it,'} and were left out of the "
        f"contacts; --include {item.first},{item.second} has them collide"
        for item in dropped.values()
    )
    left = tuple(item for item in start.overlaps if frozenset((item.first, item.second)) not in dropped)
    return [pair for pair in pairs if frozenset(pair) not in dropped], replace(start, overlaps=left), notes


def _near(
    assembly: Assembly, geometries: Mapping[str, CollisionGeometry], pairs: Sequence[tuple[str, str]]
) -> list[tuple[str, str]]:
    """Pairs whose balls meet at the start."""
    planes = {plane.name: plane for plane in assembly.planes}
    balls = {part.name: geometries[part.name].ball(part.pose) for part in assembly.parts}

    def meet(first: str, second: str) -> bool:
        if first in planes or second in planes:
            plane, other = (first, second) if first in planes else (second, first)
            height = planes[plane].normal @ (balls[other].center - planes[plane].position)
            return bool(height <= balls[other].radius)
        a, b = balls[first], balls[second]
        return bool(np.linalg.norm(a.center - b.center) <= a.radius + b.radius)

    return [pair for pair in pairs if meet(*pair)]


def _plane_pose(plane: Plane) -> Pose:
    first = perpendicular(plane.normal)
    return Pose(plane.position, np.column_stack([first, np.cross(plane.normal, first), plane.normal]))
