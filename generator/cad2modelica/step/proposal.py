"""Joints proposed from the faces of parts: what fits and lies on each other guides each other.

Contacts of two bodies are taken as mates, and what mates leave free is a joint (``mates/``). Bodies without freedom
against each other become one, and so do turned parts (pins, screws) with what they sit in, until nothing changes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import networkx as nx
import numpy as np

from cad2modelica.geometry.spatial import IDENTITY, Array
from cad2modelica.mates.allowed_motion import MatedPair, allowed_twists, mated_pair
from cad2modelica.mates.joint_chains import joint_chain
from cad2modelica.mates.mate_equation import AXIS, PLANE, POINT, Feature, MateEquation, mate_equation
from cad2modelica.mechanism.model import JointType
from cad2modelica.step.contacts import ALIGNED, BALL, FACE, FIT, LOOSE, FaceContact, face_contacts
from cad2modelica.step.part_faces import PartFaces

SURE = 0.5  # confidence from which on a joint is used unless the modeller says otherwise
LONG_FIT = 1.5  # diameters: a shaft that long slides, a shorter one without a shoulder turns
TURNED_SIZE = 0.6  # of the other part's size: larger turned parts (wheels, drums) are no pins
MAXIMUM_MENTIONED = 3


@dataclass(frozen=True, eq=False)
class ProposedBody:
    """Parts that are fixed to each other, and why."""

    parts: tuple[str, ...]
    seen: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class ProposedJoint:
    """A joint between two parts, in the file's coordinates.

    Attributes:
        confidence: from 0 to 1, how much speaks for the joint.
        seen: the faces it stands for.
        use: whether it holds unless the modeller says otherwise.
    """

    type: JointType
    parent: str
    child: str
    origin: Array
    axis: Array
    confidence: float
    seen: tuple[str, ...]
    use: bool


@dataclass(frozen=True, eq=False)
class Proposal:
    """Which part stands, which parts are one body, and joints between bodies.

    Attributes:
        loose: a part of each group of bodies that no joint in use connects to the ground.
    """

    ground: str
    bodies: tuple[ProposedBody, ...]
    joints: tuple[ProposedJoint, ...]
    loose: tuple[str, ...] = ()


def propose_joints(parts: Sequence[PartFaces]) -> Proposal:
    """Joints of an assembly from the faces of its parts, which have names of their own.

    The largest part is taken to stand. Parts that touch by one plane only are taken as fixed to each other, for that is
    what screws that were left out of the drawing do.
    """
    return _Proposer(parts).propose()


class _Proposer:
    def __init__(self, parts: Sequence[PartFaces]) -> None:
        self._parts = {part.name: part for part in parts}
        self._rank = {part.name: number for number, part in enumerate(parts)}
        self._contacts = [contact for one, other in combinations(parts, 2) for contact in face_contacts(one, other)]
        low = np.min([part.low for part in parts], axis=0)
        high = np.max([part.high for part in parts], axis=0)
        self._size = float(np.linalg.norm(high - low)) or 1.0
        self._union: nx.utils.UnionFind[str] = nx.utils.UnionFind(list(self._parts))
        self._seen: dict[str, list[str]] = {}

    def propose(self) -> Proposal:
        ground = max(self._parts.values(), key=lambda part: (part.volume, part.size)).name
        self._join_turned_parts()
        self._join_locked()
        joints = self._joints(ground)
        bodies: dict[str, list[str]] = {}
        for name in self._parts:
            bodies.setdefault(self._union[name], []).append(name)
        merged = tuple(
            ProposedBody(
                tuple(names), tuple(dict.fromkeys(text for name in names for text in self._seen.get(name, ())))
            )
            for names in bodies.values()
            if len(names) > 1
        )
        return Proposal(ground, merged, joints, self._loose(ground, joints))

    def _body(self, names: Sequence[str]) -> ProposedBody:
        seen = dict.fromkeys(text for name in names for text in self._seen.get(name, ()))
        return ProposedBody(tuple(names), tuple(seen))

    def _loose(self, ground: str, joints: Sequence[ProposedJoint]) -> tuple[str, ...]:
        """The largest part of each group that no joint in use connects to the ground."""
        links: nx.utils.UnionFind[str] = nx.utils.UnionFind(list(self._parts))
        for name in self._parts:
            links.union(name, self._union[name])
        for joint in joints:
            if joint.use:
                links.union(joint.parent, joint.child)
        largest: dict[str, PartFaces] = {}
        for name, part in self._parts.items():
            root = links[name]
            if root != links[ground] and (root not in largest or part.volume > largest[root].volume):
                largest[root] = part
        return tuple(part.name for part in largest.values())

    # ----- bodies -----

    def _join_turned_parts(self) -> None:
        """Fixes each pin or screw to the part in which it sits longest: turning about itself makes no difference."""
        for name in sorted(self._parts, key=lambda name: self._parts[name].size):
            axis = self._parts[name].symmetry_axis
            if axis is None:
                continue
            fits = [
                contact
                for contact in self._contacts
                if contact.kind == FIT and name in (contact.first, contact.second) and self._is_about(contact, axis)
            ]
            larger = [
                contact
                for contact in fits
                if self._parts[name].size < TURNED_SIZE * self._parts[_other(contact, name)].size
            ]
            if not larger:
                continue
            best = max(larger, key=lambda contact: (contact.measure, -self._rank[_other(contact, name)]))
            self._join(name, _other(best, name), f"{name} is turned about its own axis, {best.text}")

    def _is_about(self, contact: FaceContact, axis: tuple[Array, Array]) -> bool:
        point, direction = axis
        off = np.linalg.norm(np.cross(contact.point - point, direction))
        return bool(np.linalg.norm(np.cross(contact.axis, direction)) < 1e-2 and off < 1e-3 * self._size)

    def _join_locked(self) -> None:
        """Makes one body of bodies whose contacts leave no freedom, until no more are found."""
        changed = True
        while changed:
            changed = False
            for (first, second), contacts in self._by_bodies().items():
                if self._union[first] == self._union[second]:
                    continue
                if not len(allowed_twists(self._pair(contacts)).twists):
                    self._join(first, second, f"{_described(contacts)} leave no freedom")
                    changed = True

    def _join(self, first: str, second: str, text: str) -> None:
        self._union.union(first, second)
        self._seen.setdefault(first, []).append(text)

    def _by_bodies(self) -> dict[tuple[str, str], list[FaceContact]]:
        """Contacts by bodies, the first in the file first."""
        first: dict[str, str] = {}
        for name in self._parts:
            first.setdefault(self._union[name], name)
        found: dict[tuple[str, str], list[FaceContact]] = {}
        for contact in self._contacts:
            one, other = (first[self._union[name]] for name in (contact.first, contact.second))
            if one != other:
                key = (one, other) if self._rank[one] < self._rank[other] else (other, one)
                found.setdefault(key, []).append(contact)
        return found

    def _pair(self, contacts: Sequence[FaceContact]) -> MatedPair:
        mates = [mate for contact in contacts if (mate := _mate(contact)) is not None]
        return mated_pair(mates, IDENTITY, IDENTITY, self._size)

    # ----- joints -----

    def _joints(self, ground: str) -> tuple[ProposedJoint, ...]:
        found: list[tuple[ProposedJoint, list[FaceContact]]] = []
        for (first, _), contacts in self._by_bodies().items():
            joint = self._joint(first, contacts)
            if joint is not None:
                found.append((joint, contacts))
        sure = [(joint, contacts) for joint, contacts in found if joint.use]
        links: nx.utils.UnionFind[str] = nx.utils.UnionFind(list(self._parts))
        for joint, _ in sure:
            links.union(self._union[joint.parent], self._union[joint.child])
        kept = [joint for joint, _ in sure]
        # What only doubtful contacts hold is fixed by them: the largest first.
        for joint, contacts in sorted(
            (item for item in found if not item[0].use), key=lambda item: -max(entry.measure for entry in item[1])
        ):
            one, other = self._union[joint.parent], self._union[joint.child]
            if links[one] == links[other]:
                kept.append(joint)
                continue
            links.union(one, other)
            self._join(
                joint.parent, joint.child, f"{_described(contacts)}: fixed, though {joint.type.value} is possible"
            )
        inside = [joint for joint in kept if self._union[joint.parent] != self._union[joint.child]]
        return tuple(self._outwards(inside, ground))

    def _joint(self, first: str, contacts: Sequence[FaceContact]) -> ProposedJoint | None:
        pair = self._pair(contacts)
        chain = joint_chain(pair) if pair.mates else None
        if chain is None or len(chain) != 1:
            return None
        joint = chain[0]
        kind, confidence = joint.type, _confidence(joint.type, contacts)
        fit = max((item.measure for item in contacts if item.kind == FIT), default=0.0)
        if kind is JointType.CYLINDRICAL and fit < LONG_FIT:
            kind = JointType.REVOLUTE
        origin = joint.point
        round_ones = [item for item in contacts if item.kind != FACE]
        if round_ones and kind is not JointType.SPHERICAL:
            arm = np.mean([item.point for item in round_ones], axis=0) - origin
            origin = origin + (arm @ joint.axis) * joint.axis
        parent, child = self._nearest(first, contacts)
        return ProposedJoint(kind, parent, child, origin, joint.axis, confidence, _texts(contacts), confidence >= SURE)

    def _nearest(self, first: str, contacts: Sequence[FaceContact]) -> tuple[str, str]:
        """The parts of two bodies that the strongest contact is between, the first body's first."""
        best = max(contacts, key=lambda item: (item.kind in (FIT, BALL), item.measure))
        ends = (best.first, best.second)
        return ends if self._union[ends[0]] == self._union[first] else (ends[1], ends[0])

    def _outwards(self, joints: Sequence[ProposedJoint], ground: str) -> list[ProposedJoint]:
        """Joints from the ground outwards."""
        graph: nx.Graph[str] = nx.Graph()
        graph.add_node(self._union[ground])
        graph.add_edges_from((self._union[joint.parent], self._union[joint.child]) for joint in joints)
        order: dict[str, int] = {}
        for start in [self._union[ground], *graph]:
            if start not in order:
                for node in [start, *(child for _, child in nx.bfs_edges(graph, start))]:
                    order.setdefault(node, len(order))
        turned = []
        for joint in joints:
            ends = (joint.parent, joint.child)
            parent, child = sorted(ends, key=lambda name: order[self._union[name]])
            turned.append(
                ProposedJoint(
                    joint.type, parent, child, joint.origin, joint.axis, joint.confidence, joint.seen, joint.use
                )
            )
        return sorted(turned, key=lambda joint: (order[self._union[joint.parent]], order[self._union[joint.child]]))


def _other(contact: FaceContact, name: str) -> str:
    return contact.second if contact.first == name else contact.first


def _mate(contact: FaceContact) -> MateEquation | None:
    """The contact as a mate of the same piece of geometry on both sides, so that it is fulfilled at the start."""
    shape = {FACE: PLANE, BALL: POINT}.get(contact.kind, AXIS)
    feature = Feature(shape, contact.point, contact.axis)
    return mate_equation(contact.text, "Coincident", feature, feature, (IDENTITY, IDENTITY))


_START: Mapping[JointType, float] = {
    JointType.REVOLUTE: 0.6,
    JointType.CYLINDRICAL: 0.55,
    JointType.SPHERICAL: 0.85,
    JointType.PRISMATIC: 0.5,
    JointType.PLANAR: 0.3,
}


def _confidence(kind: JointType, contacts: Sequence[FaceContact]) -> float:
    """How much speaks for a joint: a shaft in a hole more than holes alone, a long fit more than a short one."""
    value = _START.get(kind, 0.2)
    fits = [item for item in contacts if item.kind == FIT]
    faces = [item for item in contacts if item.kind == FACE]
    if kind in (JointType.REVOLUTE, JointType.CYLINDRICAL):
        if not fits:
            value -= 0.2 if all(item.kind != LOOSE for item in contacts) else 0.15  # the pin is not drawn
        elif max(item.measure for item in fits) >= 0.5:
            value += 0.1
        if faces:
            value += 0.15
        if len(fits) > 1:
            value += 0.1
    if kind is JointType.PRISMATIC and len({tuple(np.round(np.abs(item.axis), 3)) for item in faces}) > 1:
        value += 0.1 if len(faces) > 2 else 0.0
    return round(min(value, 0.95), 2)


def _texts(contacts: Sequence[FaceContact]) -> tuple[str, ...]:
    """What was seen, the strongest first; equal ones once with their number."""
    counts: dict[str, int] = {}
    for contact in sorted(contacts, key=lambda item: (item.kind == FACE, -item.measure)):
        text = f"{contact.first} and {contact.second}: {contact.text}"
        counts[text] = counts.get(text, 0) + 1
    listed = [f"{text} ({count} times)" if count > 1 else text for text, count in counts.items()]
    more = len(listed) - MAXIMUM_MENTIONED
    return (*listed[:MAXIMUM_MENTIONED], *((f"and {more} more",) if more > 0 else ()))


def _described(contacts: Sequence[FaceContact]) -> str:
    first = contacts[0]
    kinds = {FIT: "fits", LOOSE: "loose fits", ALIGNED: "holes behind each other", BALL: "balls", FACE: "plane faces"}
    counted = {kind: sum(item.kind == kind for item in contacts) for kind in kinds}
    listed = ", ".join(f"{count} {kinds[kind]}" for kind, count in counted.items() if count)
    return f"{first.first} and {first.second}: {listed}"
