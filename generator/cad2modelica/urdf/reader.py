"""URDF to the model: links, joints, masses and geometry, at joint position zero.

The Unified Robot Description Format as documented at wiki.ros.org/urdf/XML: SI units, a joint's origin is the pose of
the child link in the parent link, its axis is given in the child link's frame.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from contact_foundation.errors import CmbError, Place
from contact_foundation.progress import Progress, silent
from lxml import etree

from cad2modelica.geometry.mesh import Mesh
from cad2modelica.geometry.spatial import IDENTITY, Pose
from cad2modelica.mechanism.model import (
    GROUND,
    Assembly,
    CollisionChoice,
    ContactSettings,
    Coupling,
    DecompositionLimits,
    Joint,
    JointFriction,
    JointLimits,
    JointRating,
    JointType,
    MassProperties,
    Part,
)
from cad2modelica.source.lost import Lost
from cad2modelica.source.problems import Problems
from cad2modelica.urdf.elements import UrdfElements
from cad2modelica.urdf.geometry import UrdfGeometry
from cad2modelica.urdf.mass import read_mass_properties, usable
from cad2modelica.urdf.mimic import start_position
from cad2modelica.urdf.tree import TYPES, Link, UrdfJoint, UrdfTree, read_tree

GRAVITY = (0.0, 0.0, -9.81)
STOP_TIME = 1.0
TOLERANCE = 1e-6
DECOMPOSED_TRIANGLES = 1000
"""Parts of finer geometry collide as hulls of their bodies: several simulators take a collision mesh's convex hull, so
descriptions are written for it, and a robot of thirty finely tessellated links would be decomposed for minutes."""


@dataclass
class _Found:
    visual: list[Mesh] = field(default_factory=list)
    collision: list[Mesh] = field(default_factory=list)


def read_urdf(root: etree._Element, path: Path, progress: Progress = silent) -> Assembly:
    """Reads a robot description.

    A root link without mass is the ground; other links without mass belong to the link they are fixed to. Descriptions
    in circulation are often approximate; what can be used is used, with a note on everything doubtful.

    Args:
        root: the element ``robot``.
        path: the file.
        progress: is told which link is being read.

    Raises:
        InputError: the input is wrong; a ``ProblemList`` if several problems were found.
    """
    return _UrdfReader(root, path, progress).read()


class _UrdfReader:
    def __init__(self, root: etree._Element, path: Path, progress: Progress) -> None:
        self._root = root
        self._file = path
        self._progress = progress
        self._problems = Problems(str(path))
        self._notes: list[str] = []
        self._elements = UrdfElements(path, self._problems, self._notes)
        self._geometry = UrdfGeometry(root, self._elements)

    def read(self) -> Assembly:
        self._elements.refuse_macros(self._root)
        tree = read_tree(self._root, self._elements)
        parts, ground = self._parts(tree)
        found = [self._model_joint(joint, tree, ground) for joint in tree.joints]
        joints = [joint for joint in found if joint is not None]
        couplings = self._couplings(tree, {joint.name for joint in joints})
        self._problems.raise_if_any()
        if not parts:
            self._problems.add(
                "no link has mass or geometry", self._place(self._root), "Add links; only rigid bodies are read."
            )
            self._problems.raise_if_any()
        return Assembly(
            name=self._root.get("name", "") or self._file.stem,
            description="",
            source="URDF",
            file=self._file,
            gravity=np.array(GRAVITY),
            stop_time=STOP_TIME,
            tolerance=TOLERANCE,
            materials=(),
            planes=(),
            parts=tuple(parts),
            joints=tuple(joints),
            contacts=ContactSettings(decomposition=DecompositionLimits(triangles=DECOMPOSED_TRIANGLES)),
            notes=tuple(self._notes),
            limits_stop=False,
            couplings=couplings,
        )

    # ----- parts -----

    def _parts(self, tree: UrdfTree) -> tuple[list[Part], str]:
        """All parts, and the name of what joints to the ground are fixed to: a part if the ground has geometry."""
        found: dict[str, _Found] = {}
        for index, (name, link) in enumerate(tree.links.items()):
            self._progress("read geometry", index / len(tree.links), name)
            host = tree.hosts[name]
            collected = found.setdefault(host.part, _Found())
            for kind, target in (("visual", collected.visual), ("collision", collected.collision)):
                for element in link.element.iterchildren(kind):
                    try:
                        target.append(self._geometry.mesh(element, name, host.inner))
                    except CmbError as error:
                        reason = ". ".join(line.strip().rstrip(".") for line in str(error).splitlines())
                        self._notes.append(Lost(f"link {name!r}: {kind} geometry left out: {reason}"))
        parts = []
        ground = GROUND
        for name, link in tree.links.items():
            host = tree.hosts[name]
            own = found.get(host.part, _Found())
            if host.part == GROUND and ground == GROUND and (own.visual or own.collision):
                ground = name
                parts.append(self._part(link, IDENTITY, own, grounded=True))
            elif host.part == name:
                parts.append(self._part(link, host.world, own, grounded=False))
        return parts, ground

    def _part(self, link: Link, pose: Pose, found: _Found, *, grounded: bool) -> Part:
        place = self._place(link.element)
        meshes = tuple(found.visual or found.collision)
        properties = MassProperties(0.0, np.zeros(3), np.zeros((3, 3)))
        inertial = link.element.find("inertial")
        if link.has_mass and inertial is not None:
            properties = read_mass_properties(inertial, self._elements)
            try:
                properties, remarks = usable(properties, meshes)
                self._notes += [f"link {link.name!r}: {remark}" for remark in remarks]
            except ValueError as error:
                self._problems.add(str(error), place, "Correct the inertial.")
        elif grounded:
            self._notes.append(f"link {link.name!r} has no mass and is fixed in the world; its geometry collides")
        else:
            self._notes.append(f"link {link.name!r} has no mass: it only carries what is behind it")
        if not meshes:
            self._notes.append(f"link {link.name!r} has no geometry: it moves, but does not collide and is not shown")
        return Part(
            name=link.name,
            material=None,
            pose=pose,
            mass_properties=properties,
            meshes=meshes,
            collision=CollisionChoice.AUTO,
            grounded=grounded,
            velocity=np.zeros(3),
            angular_velocity=np.zeros(3),
            place=place,
            collision_meshes=tuple(found.collision) if found.collision else None,
        )

    # ----- joints -----

    def _couplings(self, tree: UrdfTree, joints: set[str]) -> tuple[Coupling, ...]:
        """Couplings of joints that move; a joint that was taken as fixed neither leads nor follows."""
        kept = []
        for item in tree.couplings.values():
            if item.leader in joints and item.follower in joints:
                kept.append(item)
            elif item.follower in joints:
                reason = "which was taken as fixed: it moves by itself"
                self._notes.append(
                    Lost(f"joint {item.follower!r} is to follow joint {item.leader!r} (mimic), {reason}")
                )
        return tuple(kept)

    def _model_joint(self, joint: UrdfJoint, tree: UrdfTree, ground: str) -> Joint | None:
        parent, child = tree.hosts[joint.parent], tree.hosts[joint.child]
        if parent.part == child.part:
            return None
        kind = TYPES[joint.type]
        before = ground if parent.part == GROUND else parent.part
        limits, rating = self._limits(joint, kind)
        return Joint(
            name=joint.name,
            type=kind,
            # A floating joint holds nothing: its child moves freely, whatever its parent is.
            parent=GROUND if kind is JointType.FREE else before,
            child=child.part,
            origin=child.world.position,
            axis=child.world.direction(joint.axis) if kind.needs_axis else None,
            second_axis=None,
            position=start_position(joint.name, tree.couplings),
            speed=0.0,
            velocity=np.zeros(3),
            angular_velocity=np.zeros(3),
            place=self._place(joint.element),
            limits=limits,
            friction=self._friction(joint, kind),
            rating=rating,
        )

    def _limits(self, joint: UrdfJoint, kind: JointType) -> tuple[JointLimits | None, JointRating | None]:
        """Range and largest effort and speed; zero, which many descriptions write for unknown, says nothing."""
        element = joint.element.find("limit")
        if element is None or not kind.is_scalar:
            return None, None
        effort, speed, lower, upper = (
            self._elements.number_or_zero(element, key) for key in ("effort", "velocity", "lower", "upper")
        )
        rating = JointRating(effort if effort > 0 else None, speed if speed > 0 else None)
        limits = JointLimits(lower, upper) if joint.type != "continuous" and lower < upper else None
        return limits, rating

    def _friction(self, joint: UrdfJoint, kind: JointType) -> JointFriction | None:
        element = joint.element.find("dynamics")
        viscous = float(self._elements.numbers(element, "damping", (0.0,))[0])
        dry = float(self._elements.numbers(element, "friction", (0.0,))[0])
        if min(viscous, dry) < 0:
            self._problems.add("damping and friction must not be negative", self._place(joint.element), "Correct them.")
        if max(viscous, dry) <= 0 or kind is JointType.FIXED:
            return None
        if not kind.is_scalar:
            note = (
                f"joint {joint.name!r}: damping and friction are left out, which a {joint.type} joint cannot have here"
            )
            self._notes.append(Lost(note))
            return None
        return JointFriction(viscous, dry)

    def _place(self, element: etree._Element | None) -> Place:
        return self._elements.place(element)
