"""The tree of a robot description's links and joints, and which links become bodies of their own."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from lxml import etree

from cad2modelica.geometry.spatial import IDENTITY, Array, Pose, rotation_about
from cad2modelica.mechanism.model import GROUND, Coupling, JointType
from cad2modelica.source.lost import Lost
from cad2modelica.urdf.elements import UrdfElements
from cad2modelica.urdf.mass import gets_mass_by_density, has_inertia_alone, has_mass
from cad2modelica.urdf.mimic import read_couplings, start_position

TYPES = {
    "revolute": JointType.REVOLUTE,
    "continuous": JointType.REVOLUTE,
    "prismatic": JointType.PRISMATIC,
    "planar": JointType.PLANAR,
    "floating": JointType.FREE,
    "spherical": JointType.SPHERICAL,
    "fixed": JointType.FIXED,
}
_IGNORED = {"safety_controller", "calibration"}
WORLD = "world"
"""The name by which descriptions mean the fixed surroundings, with or without a link of that name."""


@dataclass(frozen=True, eq=False)
class Link:
    """A link; its name is the one in the description, but for ``ground``, which means the world here.

    Attributes:
        by_density: whether its mass comes from its geometry and a density.
    """

    name: str
    element: etree._Element
    by_density: bool = False

    @property
    def has_mass(self) -> bool:
        """Whether it is a body that forces can accelerate, by its own mass or one from its geometry."""
        return has_mass(self.element) or self.by_density


@dataclass(frozen=True, eq=False)
class UrdfJoint:
    """A joint: the child's pose in the parent at joint position zero, and the unit axis in the child's coordinates."""

    name: str
    type: str
    parent: str
    child: str
    origin: Pose
    axis: Array
    element: etree._Element


@dataclass(frozen=True, eq=False)
class Host:
    """The part (or the ground) that a link belongs to, and the link's pose in it and in the world."""

    part: str
    inner: Pose
    world: Pose


@dataclass(frozen=True, eq=False)
class UrdfTree:
    """Links, joints from the roots outwards, the host of every link, and joints that follow others by their names."""

    links: dict[str, Link]
    joints: tuple[UrdfJoint, ...]
    hosts: dict[str, Host]
    couplings: dict[str, Coupling]


def read_tree(root: etree._Element, elements: UrdfElements, density: bool) -> UrdfTree:
    """Reads links and joints.

    A root link without mass, or of the name ``world``, is the ground; links that are fixed to others belong to one part
    with them.

    Args:
        root: the element ``robot``.
        elements: reads attributes.
        density: whether links without mass get one from their geometry; a root does not, it stands in the world.

    Raises:
        InputError: the structure is wrong; a ``ProblemList`` if several problems were found.
    """
    reader = _TreeReader(root, elements, density)
    links = reader.links()
    joints = reader.joints(links)
    elements.problems.raise_if_any()
    order = reader.order(links, joints)
    couplings = {item.follower: item for item in read_couplings([joint.element for joint in joints], elements)}
    return UrdfTree(links, tuple(order), reader.hosts(order, links, couplings), couplings)


class _TreeReader:
    def __init__(self, root: etree._Element, elements: UrdfElements, density: bool) -> None:
        self._root = root
        self._density = density
        self._elements = elements
        self._problems = elements.problems
        self._notes = elements.notes

    def links(self) -> dict[str, Link]:
        """All links by name."""
        links: dict[str, Link] = {}
        children = {
            child.get("link", "") for joint in self._root.iterchildren("joint") for child in joint.iter("child")
        }
        for element in self._root.iterchildren("link"):
            name = _link_name(element.get("name", ""))
            if not name or name in links:
                place = self._elements.place(element)
                taken = self._elements.place(links[name].element).line if name in links else None
                said = f"the link at line {taken} has the name {name!r} too" if taken else "the link has no name"
                self._problems.add(said, place, "Give each link a name of its own.")
            hangs = element.get("name", "") in children
            links[name] = Link(name, element, self._density and hangs and gets_mass_by_density(element))
            if has_inertia_alone(element):
                self._notes.append(Lost(f"link {name!r} has inertia without mass, which is left out"))
        self._add_world(links)
        return links

    def _add_world(self, links: dict[str, Link]) -> None:
        """The fixed surroundings, where joints have them as parent and no link is declared for them."""
        parents = {
            parent.get("link", "") for joint in self._root.iterchildren("joint") for parent in joint.iter("parent")
        }
        if WORLD in parents and WORLD not in links:
            links[WORLD] = Link(WORLD, etree.Element("link", name=WORLD))

    def joints(self, links: dict[str, Link]) -> list[UrdfJoint]:
        """All joints in the order of the file."""
        joints: list[UrdfJoint] = []
        names: set[str] = set()
        ignored: set[str] = set()
        for element in self._root.iterchildren("joint"):
            place = self._elements.place(element)
            name, kind = element.get("name", ""), element.get("type", "")
            if not name or name in names:
                self._problems.add(f"a joint needs a name of its own; {name!r} is not", place, "Rename the joint.")
            names.add(name)
            if kind not in TYPES:
                self._problems.add(f"joints of type {kind!r} are not known", place, f"Known: {', '.join(TYPES)}.")
                continue
            ends = [self._end(element, end, links) for end in ("parent", "child")]
            ignored |= {str(child.tag) for child in element} & _IGNORED
            origin = self._elements.origin(element)
            joints.append(UrdfJoint(name, kind, ends[0], ends[1], origin, self._axis(element, kind), element))
        if ignored:
            self._notes.append(f"not used: {', '.join(sorted(ignored))} of joints")
        return joints

    def _axis(self, element: etree._Element, kind: str) -> Array:
        axis_element = element.find("axis")
        axis = self._elements.numbers(axis_element, "xyz", (1.0, 0.0, 0.0))
        length = float(np.linalg.norm(axis))
        if length >= 1e-9:
            return axis / length
        if TYPES[kind].needs_axis:
            self._problems.add("the axis is the zero vector", self._elements.place(axis_element), "Give a direction.")
        return np.array([1.0, 0.0, 0.0])

    def _end(self, element: etree._Element, end: str, links: dict[str, Link]) -> str:
        child = element.find(end)
        name = _link_name(child.get("link", "") if child is not None else "")
        if name not in links:
            self._problems.add(
                f"the joint's {end} {name!r} is no link",
                self._elements.place(element),
                "Correct the name, or add the link.",
            )
        return name

    def order(self, links: dict[str, Link], joints: list[UrdfJoint]) -> list[UrdfJoint]:
        """Joints from the roots outwards."""
        by_child: dict[str, UrdfJoint] = {}
        for joint in joints:
            if joint.child in by_child:
                self._problems.add(
                    f"the link {joint.child!r} has two parents",
                    self._elements.place(joint.element),
                    "A robot is a tree.",
                )
            by_child[joint.child] = joint
        roots = [name for name in links if name not in by_child]
        if len(roots) > 1:
            self._problems.add(
                f"the link {roots[1]!r} hangs on nothing, as {roots[0]!r} does; a robot has one root",
                self._elements.place(links[roots[1]].element),
                "Join it by a joint (fixed or floating), or take it out.",
            )
        following: dict[str, list[int]] = {}
        for index, joint in enumerate(joints):
            following.setdefault(joint.parent, []).append(index)
        reached = set(roots)
        ordered: list[UrdfJoint] = []
        level = sorted(index for name in roots for index in following.get(name, ()))
        while level:
            fresh = [joints[index] for index in level if joints[index].child not in reached]
            ordered += fresh
            reached |= {joint.child for joint in fresh}
            level = sorted(index for joint in fresh for index in following.get(joint.child, ()))
        for joint in joints:
            if joint.child not in reached:
                self._problems.add(
                    f"the link {joint.child!r} hangs in a circle",
                    self._elements.place(joint.element),
                    "A robot is a tree.",
                )
        self._problems.raise_if_any()
        return ordered

    def hosts(
        self, order: list[UrdfJoint], links: dict[str, Link], couplings: Mapping[str, Coupling]
    ) -> dict[str, Host]:
        """Where every link belongs: at joint position zero, or where a joint that follows others is then."""
        children = {joint.child for joint in order}
        hosts: dict[str, Host] = {}
        for name, link in links.items():
            if name not in children:
                grounded = name == WORLD or not link.has_mass
                hosts[name] = Host(GROUND if grounded else name, IDENTITY, IDENTITY)
                if name == WORLD and link.has_mass:
                    self._notes.append(f"link {name!r} means the fixed surroundings: its mass does not count")
                if not grounded:
                    self._notes.append(f"link {name!r} is the root and moves freely; --ground {name} holds it")
        carries_mass = self._links_that_carry_mass(order, links)
        for joint in order:
            parent = hosts[joint.parent]
            origin = joint.origin @ _moved(joint, start_position(joint.name, couplings))
            world = parent.world @ origin
            if joint.type != "fixed" and joint.child in carries_mass:
                hosts[joint.child] = Host(joint.child, IDENTITY, world)
                continue
            if joint.type != "fixed":
                advice = "; --density makes masses" if gets_mass_by_density(links[joint.child].element) else ""
                note = f"joint {joint.name!r} moves nothing that has mass: it was taken as fixed{advice}"
                self._notes.append(Lost(note))
            hosts[joint.child] = Host(parent.part, parent.inner @ origin, world)
        return hosts

    def _links_that_carry_mass(self, order: list[UrdfJoint], links: dict[str, Link]) -> set[str]:
        """Links with mass, and links with such links behind them."""
        carrying = {name for name, link in links.items() if link.has_mass}
        for joint in reversed(order):
            if joint.child in carrying:
                carrying.add(joint.parent)
        return carrying


def _moved(joint: UrdfJoint, position: float) -> Pose:
    """The child's pose at a joint's position against that at zero."""
    if TYPES[joint.type] is JointType.PRISMATIC:
        return Pose(joint.axis * position, np.eye(3))
    return Pose(np.zeros(3), rotation_about(joint.axis, position)) if position else IDENTITY


def _link_name(name: str) -> str:
    return f"{name} link" if name == GROUND else name
