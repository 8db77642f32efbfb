"""URDF to the model: links, joints, masses and geometry, at joint position zero.

The Unified Robot Description Format as documented at wiki.ros.org/urdf/XML: SI units, a joint's origin is the pose of
the child link in the parent link, its axis is given in the child link's frame.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from cmb_base.errors import CmbError, Place
from cmb_base.progress import Progress, silent
from lxml import etree

from cad2modelica.mesh import Mesh
from cad2modelica.model import (
    GROUND,
    Assembly,
    CollisionChoice,
    ContactSettings,
    DecompositionLimits,
    Joint,
    JointFriction,
    JointType,
    MassProperties,
    Part,
)
from cad2modelica.problems import Problems
from cad2modelica.spatial import IDENTITY, Array, Pose
from cad2modelica.urdf_elements import UrdfElements
from cad2modelica.urdf_geometry import UrdfGeometry
from cad2modelica.urdf_mass import has_mass, read_mass_properties, usable

GRAVITY = (0.0, 0.0, -9.81)
STOP_TIME = 1.0
TOLERANCE = 1e-6
DECOMPOSED_TRIANGLES = 1000
"""Parts of finer geometry collide as hulls of their bodies: several simulators take a collision mesh's convex hull, so
descriptions are written for it, and a robot of thirty finely tessellated links would be decomposed for minutes."""

_TYPES = {
    "revolute": JointType.REVOLUTE,
    "continuous": JointType.REVOLUTE,
    "prismatic": JointType.PRISMATIC,
    "planar": JointType.PLANAR,
    "floating": JointType.FREE,
    "spherical": JointType.SPHERICAL,
    "fixed": JointType.FIXED,
}
_IGNORED = {"limit", "mimic", "safety_controller", "calibration"}


@dataclass(frozen=True, eq=False)
class _Link:
    name: str
    element: etree._Element

    @property
    def has_mass(self) -> bool:
        return has_mass(self.element)


@dataclass(frozen=True, eq=False)
class _UrdfJoint:
    name: str
    type: str
    parent: str
    child: str
    origin: Pose
    axis: Array
    element: etree._Element


@dataclass(frozen=True, eq=False)
class _Host:
    """The part (or the ground) that a link belongs to, and the link's pose in it and in the world."""

    part: str
    inner: Pose
    world: Pose


@dataclass
class _Found:
    visual: list[Mesh] = field(default_factory=list)
    collision: list[Mesh] = field(default_factory=list)
    unread: list[CmbError] = field(default_factory=list)


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
        self._elements = UrdfElements(path, self._problems)
        self._geometry = UrdfGeometry(root, self._elements)
        self._notes: list[str] = []

    def read(self) -> Assembly:
        links = self._links()
        joints = self._joints(links)
        self._problems.raise_if_any()
        order = self._order(links, joints)
        hosts = self._hosts(order, links)
        parts = self._parts(links, hosts)
        model_joints = [self._model_joint(joint, hosts) for joint in order]
        self._problems.raise_if_any()
        if not parts:
            self._problems.add("no link has mass", self._place(self._root), "Add masses and inertias.")
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
            joints=tuple(joint for joint in model_joints if joint is not None),
            contacts=ContactSettings(decomposition=DecompositionLimits(triangles=DECOMPOSED_TRIANGLES)),
            notes=tuple(self._notes),
        )

    # ----- structure -----

    def _links(self) -> dict[str, _Link]:
        links: dict[str, _Link] = {}
        for element in self._root.iterchildren("link"):
            name = element.get("name", "")
            if not name or name in links:
                self._problems.add(
                    f"a link needs a name of its own; {name!r} is not", self._place(element), "Rename the link."
                )
            links[name] = _Link(name, element)
        return links

    def _joints(self, links: dict[str, _Link]) -> list[_UrdfJoint]:
        joints: list[_UrdfJoint] = []
        ignored: set[str] = set()
        for element in self._root.iterchildren("joint"):
            place = self._place(element)
            name, kind = element.get("name", ""), element.get("type", "")
            if not name or any(joint.name == name for joint in joints):
                self._problems.add(f"a joint needs a name of its own; {name!r} is not", place, "Rename the joint.")
            if kind not in _TYPES:
                self._problems.add(f"joints of type {kind!r} are not known", place, f"Known: {', '.join(_TYPES)}.")
                continue
            ends = [self._end(element, end, links) for end in ("parent", "child")]
            ignored |= {str(child.tag) for child in element} & _IGNORED
            origin = self._elements.origin(element)
            joints.append(_UrdfJoint(name, kind, ends[0], ends[1], origin, self._axis(element, kind), element))
        if ignored:
            self._notes.append(f"not used: {', '.join(sorted(ignored))} of joints")
        return joints

    def _axis(self, element: etree._Element, kind: str) -> Array:
        axis_element = element.find("axis")
        axis = self._elements.numbers(axis_element, "xyz", (1.0, 0.0, 0.0))
        length = float(np.linalg.norm(axis))
        if length >= 1e-9:
            return axis / length
        if _TYPES[kind].needs_axis:
            self._problems.add("the axis is the zero vector", self._place(axis_element), "Give a direction.")
        return np.array([1.0, 0.0, 0.0])

    def _end(self, element: etree._Element, end: str, links: dict[str, _Link]) -> str:
        child = element.find(end)
        name = child.get("link", "") if child is not None else ""
        if name not in links:
            self._problems.add(
                f"the joint's {end} {name!r} is no link", self._place(element), "Correct the name, or add the link."
            )
        return name

    def _order(self, links: dict[str, _Link], joints: list[_UrdfJoint]) -> list[_UrdfJoint]:
        """Joints from the roots outwards."""
        by_child: dict[str, _UrdfJoint] = {}
        for joint in joints:
            if joint.child in by_child:
                self._problems.add(
                    f"the link {joint.child!r} has two parents", self._place(joint.element), "A robot is a tree."
                )
            by_child[joint.child] = joint
        reached = {name for name in links if name not in by_child}
        ordered: list[_UrdfJoint] = []
        while True:
            following = [joint for joint in joints if joint.child not in reached and joint.parent in reached]
            if not following:
                break
            for joint in following:
                ordered.append(joint)
                reached.add(joint.child)
        for joint in joints:
            if joint.child not in reached:
                self._problems.add(
                    f"the link {joint.child!r} hangs in a circle", self._place(joint.element), "A robot is a tree."
                )
        self._problems.raise_if_any()
        return ordered

    def _hosts(self, order: list[_UrdfJoint], links: dict[str, _Link]) -> dict[str, _Host]:
        children = {joint.child for joint in order}
        hosts: dict[str, _Host] = {}
        for name, link in links.items():
            if name not in children:
                grounded = not link.has_mass
                hosts[name] = _Host(GROUND if grounded else name, IDENTITY, IDENTITY)
                if not grounded:
                    self._notes.append(
                        f"link {name!r} is the root and moves freely; fix it to a massless link to ground it"
                    )
        carries_mass = self._links_that_carry_mass(order, links)
        for joint in order:
            parent = hosts[joint.parent]
            world = parent.world @ joint.origin
            if links[joint.child].has_mass or (joint.type != "fixed" and joint.child in carries_mass):
                hosts[joint.child] = _Host(joint.child, IDENTITY, world)
                continue
            if joint.type != "fixed":
                self._notes.append(f"joint {joint.name!r} moves nothing that has mass: it was taken as fixed")
            hosts[joint.child] = _Host(parent.part, parent.inner @ joint.origin, world)
        return hosts

    def _links_that_carry_mass(self, order: list[_UrdfJoint], links: dict[str, _Link]) -> set[str]:
        """Links with mass, and links with such links behind them."""
        carrying = {name for name, link in links.items() if link.has_mass}
        for joint in reversed(order):
            if joint.child in carrying:
                carrying.add(joint.parent)
        return carrying

    # ----- parts -----

    def _parts(self, links: dict[str, _Link], hosts: dict[str, _Host]) -> list[Part]:
        found: dict[str, _Found] = {}
        for index, (name, link) in enumerate(links.items()):
            self._progress("read geometry", index / len(links), name)
            collected = found.setdefault(hosts[name].part, _Found())
            for kind, target in (("visual", collected.visual), ("collision", collected.collision)):
                for element in link.element.iterchildren(kind):
                    try:
                        target.append(self._geometry.mesh(element, name, hosts[name].inner))
                    except CmbError as error:
                        collected.unread.append(error)
        for part, collected in found.items():
            self._report_unread(part, collected)
        parts = [
            self._part(link, hosts[name].world, found[name]) for name, link in links.items() if hosts[name].part == name
        ]
        if GROUND in found and (found[GROUND].visual or found[GROUND].collision):
            self._notes.append("geometry of massless links that stand on the ground was left out")
        return parts

    def _report_unread(self, part: str, found: _Found) -> None:
        """Geometry that cannot be read is an error, unless other geometry of the same part stands in for it."""
        for error in found.unread:
            if found.visual or found.collision:
                self._notes.append(f"{part}: geometry left out: {' '.join(str(error).split())}")
            else:
                self._problems.record(error)

    def _part(self, link: _Link, pose: Pose, found: _Found) -> Part:
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
            grounded=False,
            velocity=np.zeros(3),
            angular_velocity=np.zeros(3),
            place=place,
            collision_meshes=tuple(found.collision) if found.collision else None,
        )

    # ----- joints -----

    def _model_joint(self, joint: _UrdfJoint, hosts: dict[str, _Host]) -> Joint | None:
        parent, child = hosts[joint.parent], hosts[joint.child]
        if parent.part == child.part:
            return None
        kind = _TYPES[joint.type]
        if kind is JointType.FREE and parent.part != GROUND:
            self._problems.add(
                "a floating joint needs a massless root link as its parent",
                self._place(joint.element),
                "Correct the parent.",
            )
        return Joint(
            name=joint.name,
            type=kind,
            parent=parent.part,
            child=child.part,
            origin=child.world.position,
            axis=child.world.direction(joint.axis) if kind.needs_axis else None,
            second_axis=None,
            position=0.0,
            speed=0.0,
            velocity=np.zeros(3),
            angular_velocity=np.zeros(3),
            place=self._place(joint.element),
            friction=self._friction(joint, kind),
        )

    def _friction(self, joint: _UrdfJoint, kind: JointType) -> JointFriction | None:
        element = joint.element.find("dynamics")
        viscous = float(self._elements.numbers(element, "damping", (0.0,))[0])
        dry = float(self._elements.numbers(element, "friction", (0.0,))[0])
        if min(viscous, dry) < 0:
            self._problems.add("damping and friction must not be negative", self._place(joint.element), "Correct them.")
        return JointFriction(viscous, dry) if kind.is_scalar and max(viscous, dry) > 0 else None

    def _place(self, element: etree._Element | None) -> Place:
        return self._elements.place(element)
