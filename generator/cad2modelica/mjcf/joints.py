"""Joints of bodies, and parts without mass between several joints of one body."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from cad2modelica.geometry.spatial import Array
from cad2modelica.mechanism.model import (
    GROUND,
    Joint,
    JointFriction,
    JointLimits,
    JointRating,
    JointSpring,
    JointType,
    Part,
)
from cad2modelica.mechanism.rigid_part import part_between
from cad2modelica.mjcf.bodies import Body, BodyTree, PlacedItem
from cad2modelica.mjcf.elements import Item, MjcfElements
from cad2modelica.source.lost import Lost

TYPES = {
    "hinge": JointType.REVOLUTE,
    "slide": JointType.PRISMATIC,
    "ball": JointType.SPHERICAL,
    "free": JointType.FREE,
}


@dataclass
class MjcfJoints:
    """Joints by name, parts between them, and the behaviour of springs that depends on the moved inertia.

    Attributes:
        time_springs: time constant (s) and damping ratio of joints that give these instead of a stiffness.
    """

    joints: dict[str, Joint] = field(default_factory=dict)
    between: list[Part] = field(default_factory=list)
    time_springs: dict[str, tuple[float, float]] = field(default_factory=dict)


def read_joints(tree: BodyTree, hosts: dict[str, str], elements: MjcfElements) -> MjcfJoints:
    """The joints of all bodies.

    Args:
        tree: the bodies.
        hosts: the part that each body belongs to.
        elements: reads attributes.
    """
    found = MjcfJoints()
    reader = _JointReader(elements, found)
    for body in tree.bodies.values():
        if body.joints and body.parent is not None:
            reader.read(body, hosts[body.parent.name])
    return found


class _JointReader:
    def __init__(self, elements: MjcfElements, found: MjcfJoints) -> None:
        self._elements = elements
        self._found = found

    def read(self, body: Body, parent: str) -> None:
        before = parent
        for number, entry in enumerate(body.joints):
            last = number == len(body.joints) - 1
            after = body.name if last else f"{body.name} between {number + 1}"
            joint = self._joint(body, entry, before, after)
            if joint.type is JointType.FREE and (not last or number):
                place = self._elements.place(entry.item.element)
                self._elements.problems.add("a free joint must be the only one", place, "Remove the others.")
            if joint.name in self._found.joints:
                place = self._elements.place(entry.item.element)
                self._elements.problems.add(f"there are two joints {joint.name!r}", place, "Rename one of them.")
            self._found.joints[joint.name] = joint
            if not last:
                self._found.between.append(part_between(after, body.world, joint.place))
            before = after

    def _joint(self, body: Body, entry: PlacedItem, parent: str, child: str) -> Joint:
        item = entry.item
        name = self._name(item, body)
        word = "free" if item.tag == "freejoint" else item.text("type", "hinge")
        kind = TYPES.get(word)
        if kind is None:
            place = self._elements.place(item.element)
            self._elements.problems.add(f"joints of type {word!r} are not known", place, f"Known: {', '.join(TYPES)}.")
            kind = JointType.REVOLUTE
        frame = body.world @ entry.inner
        unit = self._elements.compiler.angle if kind in (JointType.REVOLUTE, JointType.SPHERICAL) else 1.0
        scalar = kind.is_scalar
        joint = Joint(
            name=name,
            type=kind,
            parent=GROUND if kind is JointType.FREE else parent,
            child=child,
            origin=frame.position
            if kind is JointType.FREE
            else frame.point(self._elements.numbers(item, "pos", (0.0,) * 3)),
            axis=self._axis(item, frame.rotation) if kind.needs_axis else None,
            position=unit * self._elements.number(item, "ref") if scalar else 0.0,
            place=self._elements.place(item.element, name),
        )
        return self._with_resistance(joint, item, unit)

    def _axis(self, item: Item, rotation: Array) -> Array:
        axis = self._elements.numbers(item, "axis", (0.0, 0.0, 1.0))
        length = float(np.linalg.norm(axis))
        if not length > 1e-9:
            place = self._elements.place(item.element)
            self._elements.problems.add("the axis is the zero vector", place, "Give a direction.")
            axis, length = np.array([0.0, 0.0, 1.0]), 1.0
        return np.asarray(rotation @ (axis / length))

    def _with_resistance(self, joint: Joint, item: Item, unit: float) -> Joint:
        """The joint with its range, friction, spring and rotor."""
        stiffness, viscous, dry, rotor = (
            float(self._elements.numbers(item, key, (0.0, 0.0, 0.0))[0])
            for key in ("stiffness", "damping", "frictionloss", "armature")
        )
        for key, value in (("stiffness", stiffness), ("damping", viscous), ("frictionloss", dry), ("armature", rotor)):
            if value < 0:
                self._elements.problems.add(f"{key} must not be negative", joint.place, "Correct the value.")
            if self._elements.numbers(item, key, (0.0, 0.0, 0.0))[1:].any():
                self._elements.notes.append(Lost(f"joint {joint.name!r}: of {key} the first number counts"))
        limits = self._elements.limits(item, "limited", "range")
        if joint.type is JointType.FREE:
            return joint
        if not joint.type.is_scalar:
            given = {
                "stiffness": stiffness,
                "damping": viscous,
                "frictionloss": dry,
                "armature": rotor,
                "range": limits is not None,
            }
            left_out = [key for key, value in given.items() if value]
            if left_out:
                note = f"joint {joint.name!r}: {', '.join(left_out)} left out, which a ball joint cannot have here"
                self._elements.notes.append(Lost(note))
            return joint
        if item.has("springdamper"):
            constant, ratio = self._elements.numbers(item, "springdamper", (0.0, 0.0))
            if constant > 0 and ratio > 0:
                self._found.time_springs[joint.name] = (float(constant), float(ratio))
        rest = unit * self._elements.number(item, "springref")
        effort = self._effort(item)
        return replace(
            joint,
            limits=JointLimits(unit * limits[0], unit * limits[1]) if limits is not None else None,
            friction=JointFriction(viscous, dry) if max(viscous, dry) > 0 else None,
            spring=JointSpring(stiffness, rest) if stiffness > 0 or joint.name in self._found.time_springs else None,
            rotor_inertia=max(rotor, 0.0),
            rating=JointRating(effort, None) if effort is not None else None,
        )

    def _effort(self, item: Item) -> float | None:
        """Largest torque or force of all actuators together at a joint."""
        limits = self._elements.limits(item, "actuatorfrclimited", "actuatorfrcrange")
        return max(map(abs, limits)) if limits is not None else None

    def _name(self, item: Item, body: Body) -> str:
        if item.name:
            return item.name
        base = f"{body.name} joint"
        number = 1
        while (name := base if number == 1 else f"{base} {number}") in self._found.joints:
            number += 1
        return name
