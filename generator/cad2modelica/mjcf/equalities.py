"""Equality constraints: points and bodies that are held together close loops, joints that are tied to others follow."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from cad2modelica.geometry.spatial import Array, Pose, rotation_of_quaternion
from cad2modelica.mechanism.model import GROUND, Coupling, Joint, JointType
from cad2modelica.mjcf.bodies import WORLD, Body, BodyTree
from cad2modelica.mjcf.document import MjcfDocument
from cad2modelica.mjcf.elements import Item, MjcfElements
from cad2modelica.source.lost import Lost

SAME_POSE = 1e-6  # m and rad: a weld that agrees with the start

NO_POSE = (0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@dataclass
class Equalities:
    """Joints that close loops, couplings, and joints that are held where they are."""

    closing: list[Joint] = field(default_factory=list)
    couplings: list[Coupling] = field(default_factory=list)
    held: set[str] = field(default_factory=set)


def read_equalities(
    document: MjcfDocument, elements: MjcfElements, tree: BodyTree, hosts: dict[str, str], joints: dict[str, Joint]
) -> Equalities:
    """Reads the sections ``equality``; a note on each that cannot be kept."""
    reader = _EqualityReader(elements, tree, hosts, joints)
    for item in document.section_items("equality") if "equality" not in document.disabled else ():
        if item.text("active", "true") != "false":
            reader.read(item)
    return reader.found


class _EqualityReader:
    def __init__(self, elements: MjcfElements, tree: BodyTree, hosts: dict[str, str], joints: dict[str, Joint]) -> None:
        self._elements = elements
        self._tree = tree
        self._hosts = hosts
        self._joints = joints
        self.found = Equalities()

    def read(self, item: Item) -> None:
        if item.tag in ("connect", "weld"):
            self._hold(item)
        elif item.tag == "joint":
            self._couple(item)
        else:
            self._lose(item, f"an equality of kind {item.tag!r} is left out")

    # ----- loops -----

    def _hold(self, item: Item) -> None:
        ends = self._ends(item)
        if ends is None:
            return
        (first, at), (second, other) = ends
        parent, child = self._hosts[first.name], self._hosts[second.name]
        if parent == child:
            return
        if child == GROUND:
            parent, child = child, parent
            at, other = other, at
        kind = JointType.SPHERICAL if item.tag == "connect" else JointType.FIXED
        if kind is JointType.FIXED and not self._agrees(item, at, other):
            self._lose(item, "a weld of bodies that stand otherwise to each other at the start is left out")
            return
        apart = float(np.linalg.norm(at.position - other.position)) > SAME_POSE
        self.found.closing.append(
            Joint(
                name=self._name(item, first, second),
                type=kind,
                parent=parent,
                child=child,
                origin=at.position,
                axis=None,
                place=self._elements.place(item.element),
                child_origin=other.position if apart else None,
            )
        )

    def _ends(self, item: Item) -> tuple[tuple[Body, Pose], tuple[Body, Pose]] | None:
        """The two bodies and the poses in the world that are to meet."""
        if item.has("site1"):
            sites = [self._tree.sites.get(item.text(key)) for key in ("site1", "site2")]
            if sites[0] is None or sites[1] is None:
                self._missing(item, "a site")
                return None
            (first, a), (second, b) = sites[0], sites[1]
            return (first, first.world @ a), (second, second.world @ b)
        names = [item.text("body1"), item.text("body2") or WORLD]
        bodies = [self._tree.bodies.get(name) for name in names]
        if bodies[0] is None or bodies[1] is None:
            self._missing(item, "a body")
            return None
        one, two = bodies[0], bodies[1]
        if item.tag == "weld":
            given = self._elements.numbers(item, "relpose", NO_POSE)
            if not given[3:].any():  # says that the start counts
                return (one, two.world), (two, two.world)
            return (one, one.world @ Pose(given[:3], rotation_of_quaternion(given[3:]))), (two, two.world)
        anchor: Array = one.world.point(self._elements.numbers(item, "anchor", (0.0, 0.0, 0.0)))
        meeting = Pose(anchor, np.eye(3))
        return (one, meeting), (two, meeting)

    def _agrees(self, item: Item, at: Pose, other: Pose) -> bool:
        if item.has("site1"):
            return True  # what is apart is reported, or closed by moving parts
        shift = float(np.linalg.norm(at.position - other.position))
        return shift < SAME_POSE and float(np.abs(at.rotation - other.rotation).max()) < SAME_POSE

    def _name(self, item: Item, first: Body, second: Body) -> str:
        taken = {*self._joints, *(joint.name for joint in self.found.closing)}
        base = item.name or f"{first.name} {second.name} {item.tag}"
        number = 1
        while (name := base if number == 1 else f"{base} {number}") in taken:
            number += 1
        return name

    # ----- joints that follow -----

    def _couple(self, item: Item) -> None:
        follower, leader = self._joints.get(item.text("joint1")), self._joints.get(item.text("joint2"))
        if follower is None or (leader is None and item.has("joint2")):
            self._missing(item, "a joint")
            return
        offset, ratio, *higher = self._elements.numbers(item, "polycoef", (0.0, 1.0, 0.0, 0.0, 0.0))
        if not follower.type.is_scalar or (leader is not None and not leader.type.is_scalar):
            self._lose(item, f"joint {follower.name!r} cannot be tied: only hinges and slides can")
        elif offset != 0.0 or any(higher):
            self._lose(item, f"joint {follower.name!r} is tied by a polynomial that is no ratio: it moves by itself")
        elif leader is None or ratio == 0.0:
            self.found.held.add(follower.name)
        elif self._leads_back(follower.name, leader.name):
            self._lose(item, f"joint {follower.name!r} is tied for a second time, or to one that follows it")
        else:
            start = float(follower.position - ratio * leader.position)
            self.found.couplings.append(Coupling(follower.name, leader.name, float(ratio), start))

    def _leads_back(self, follower: str, leader: str) -> bool:
        leaders = {item.follower: item.leader for item in self.found.couplings}
        if follower in leaders:
            return True
        while leader in leaders:
            leader = leaders[leader]
        return leader == follower

    def _missing(self, item: Item, what: str) -> None:
        if self._tree.lost:  # it may be in what was left out
            self._lose(item, f"the {item.tag} names {what} that is not there: it may belong to what was left out")
            return
        place = self._elements.place(item.element)
        self._elements.problems.add(f"the {item.tag} names {what} that does not exist", place, "Correct the name.")

    def _lose(self, item: Item, text: str) -> None:
        self._elements.notes.append(Lost(f"{self._elements.place(item.element)}: {text}"))


def held(joints: dict[str, Joint], names: set[str]) -> dict[str, Joint]:
    """The joints with those of the names fixed."""

    def fixed(joint: Joint) -> Joint:
        return replace(
            joint, type=JointType.FIXED, axis=None, position=0.0, limits=None, friction=None, spring=None,
            rotor_inertia=0.0, rating=None,
        )  # fmt: skip

    return {name: fixed(joint) if name in names else joint for name, joint in joints.items()}
