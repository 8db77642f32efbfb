"""Joints of SDFormat; joints of two axes become two with a part without mass between them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from lxml import etree

from cad2modelica.geometry.spatial import Array, Pose
from cad2modelica.mechanism.model import (
    Coupling,
    Joint,
    JointFriction,
    JointLimits,
    JointRating,
    JointSpring,
    JointType,
    Part,
)
from cad2modelica.mechanism.rigid_part import part_between
from cad2modelica.sdf.scopes import SEPARATOR, Scope, UnknownFrame
from cad2modelica.source.lost import Lost

TYPES = {
    "revolute": JointType.REVOLUTE,
    "continuous": JointType.REVOLUTE,
    "prismatic": JointType.PRISMATIC,
    "screw": JointType.SCREW,
    "ball": JointType.SPHERICAL,
    "universal": JointType.REVOLUTE,
    "revolute2": JointType.REVOLUTE,
    "fixed": JointType.FIXED,
}
TWO_AXES = ("universal", "revolute2")
_NO_PITCH = 1e-12


@dataclass
class SdfJoints:
    """Joints, parts between those of two axes, and joints that follow others."""

    joints: list[Joint] = field(default_factory=list)
    between: list[Part] = field(default_factory=list)
    couplings: list[Coupling] = field(default_factory=list)


def joint_name(scope: Scope, element: etree._Element) -> str:
    """A joint's name with the names of the models around it."""
    own = element.get("name", "")
    return f"{scope.name}{SEPARATOR}{own}" if scope.name else own


class JointReader:
    """Reads joints that move.

    Args:
        hosts: part (or ``GROUND``) of every link.
        notes: receives what was left out.
    """

    def __init__(self, hosts: Mapping[str, str], ground: str, notes: list[str]) -> None:
        self._hosts = hosts
        self._ground = ground
        self._notes = notes
        self._mimics: list[tuple[str, str, etree._Element, Scope]] = []
        self.found = SdfJoints()

    def read(self, scope: Scope, element: etree._Element) -> None:
        """One joint; what is wrong is recorded, what cannot be kept is noted."""
        elements = scope.elements
        place = elements.place(element)
        name = joint_name(scope, element)
        word = element.get("type", "")
        if word == "gearbox":
            self._notes.append(Lost(f"joint {name!r} is a gearbox, which is left out: its joints move by themselves"))
            return
        if word not in TYPES:
            elements.problems.add(f"joints of type {word!r} are not known", place, f"Known: {', '.join(TYPES)}.")
            return
        try:
            ends = [scope.link(elements.text(element, end)) for end in ("parent", "child")]
            pose = scope.world_pose() @ scope.frame(element.get("name", ""))
        except UnknownFrame as missing:
            elements.problems.add(f"the joint {name!r} names {missing}, which does not exist", place, "Correct it.")
            return
        parent, child = (self._hosts[link.name] if link is not None else self._ground for link in ends)
        if parent == child or word == "fixed":
            return
        turned = child == self._ground
        if turned:
            parent, child = child, parent
            self._notes.append(f"joint {name!r} has the world as its child: it is read from the other side")
        axes = [item for item in ("axis", "axis2") if element.find(item) is not None]
        if word in TWO_AXES:
            middle = f"{name} between"
            self.found.between.append(part_between(middle, pose, place))
            ends_of = {"axis": (parent, middle), "axis2": (middle, child)}
            if turned:  # the first axis stays fixed in the parent, which now comes last
                ends_of = {"axis": (middle, child), "axis2": (parent, middle)}
            self._add(scope, element, (name, *ends_of["axis"]), pose, "axis", JointType.REVOLUTE, turned)
            second = (f"{name} second axis", *ends_of["axis2"])
            self._add(scope, element, second, pose, "axis2", JointType.REVOLUTE, turned)
            return
        if len(axes) > 1:
            self._notes.append(Lost(f"joint {name!r}: its second axis is left out, which a {word} joint has not"))
        self._add(scope, element, (name, parent, child), pose, "axis", TYPES[word], turned)

    def _add(
        self,
        scope: Scope,
        element: etree._Element,
        ends: tuple[str, str, str],
        pose: Pose,
        key: str,
        kind: JointType,
        turned: bool,
    ) -> None:
        """Adds a joint; of one whose sides were exchanged the axis points the other way, so that coordinates stay."""
        name, parent, child = ends
        elements = scope.elements
        axis = element.find(key)
        place = elements.place(element)
        direction: Array | None = None
        if kind.needs_axis:
            direction = self._direction(scope, element, axis, pose) * (-1.0 if turned else 1.0)
        scalar = kind.is_scalar and axis is not None
        self.found.joints.append(
            Joint(
                name=name,
                type=kind,
                parent=parent,
                child=child,
                origin=pose.position,
                axis=direction,
                place=place,
                pitch=self._pitch(scope, element) if kind is JointType.SCREW else 0.0,
                limits=self._limits(scope, element, axis) if scalar and axis is not None else None,
                friction=self._friction(scope, axis) if scalar and axis is not None else None,
                spring=self._spring(scope, axis) if scalar and axis is not None else None,
                rating=self._rating(scope, axis) if scalar and axis is not None else None,
            )
        )
        if axis is not None and elements.number(axis, "initial_position", 0.0):
            self._notes.append(Lost(f"joint {name!r}: initial_position is left out: it starts at zero"))
        mimic = axis.find("mimic") if axis is not None else None
        if mimic is not None:
            self._mimics.append((name, scope.name, mimic, scope))
        if not kind.is_scalar and axis is not None and axis.find("dynamics") is not None:
            self._notes.append(Lost(f"joint {name!r}: dynamics left out, which a ball joint cannot have here"))

    def _direction(self, scope: Scope, element: etree._Element, axis: etree._Element | None, pose: Pose) -> Array:
        """The axis in the world: given in the joint's frame, in the model's, or in one that it names."""
        elements = scope.elements
        fallback = np.array([0.0, 0.0, 1.0])
        if axis is None:
            elements.problems.add("the joint has no axis", elements.place(element), "Add the element axis.")
            return fallback
        given = elements.numbers(axis, "xyz", (0.0, 0.0, 1.0))
        length = float(np.linalg.norm(given))
        if not length > 1e-9:
            elements.problems.add("the axis is the zero vector", elements.place(axis), "Give a direction.")
            return fallback
        xyz = axis.find("xyz")
        frame = xyz.get("expressed_in", "") if xyz is not None and elements.version >= (1, 7) else ""
        in_model = elements.version < (1, 5) or elements.flag(axis, "use_parent_model_frame")
        rotation = pose.rotation
        if frame or (elements.version < (1, 7) and in_model):
            try:
                rotation = (scope.world_pose() @ scope.frame(frame)).rotation
            except UnknownFrame as missing:
                elements.problems.add(f"the axis names {missing}, which does not exist", elements.place(axis))
        return np.asarray(rotation @ (given / length))

    def _limits(self, scope: Scope, element: etree._Element, axis: etree._Element) -> JointLimits | None:
        if element.get("type") == "continuous":
            return None
        lower, upper = (scope.elements.limit(axis, f"limit/{key}") for key in ("lower", "upper"))
        if lower is None and upper is None:
            return None
        if lower is not None and upper is not None and not lower < upper:
            name = joint_name(scope, element)
            self._notes.append(Lost(f"joint {name!r}: the range {lower:g} to {upper:g} is left out"))
            return None
        return JointLimits(lower, upper)

    def _friction(self, scope: Scope, axis: etree._Element) -> JointFriction | None:
        elements = scope.elements
        viscous, dry = (elements.number(axis, f"dynamics/{key}", 0.0) for key in ("damping", "friction"))
        if min(viscous, dry) < 0:
            elements.problems.add("damping and friction must not be negative", elements.place(axis), "Correct them.")
        return JointFriction(viscous, dry) if max(viscous, dry) > 0 else None

    def _spring(self, scope: Scope, axis: etree._Element) -> JointSpring | None:
        elements = scope.elements
        stiffness = elements.number(axis, "dynamics/spring_stiffness", 0.0)
        rest = elements.number(axis, "dynamics/spring_reference", 0.0)
        return JointSpring(stiffness, rest) if stiffness > 0 else None

    def _rating(self, scope: Scope, axis: etree._Element) -> JointRating:
        effort, speed = (scope.elements.limit(axis, f"limit/{key}") for key in ("effort", "velocity"))
        return JointRating(*(value if value is not None and value > 0 else None for value in (effort, speed)))

    def _pitch(self, scope: Scope, element: etree._Element) -> float:
        """Way in one turn, m; the older parameter is in rad/m, of a left-handed thread."""
        elements = scope.elements
        if element.find("screw_thread_pitch") is not None:
            pitch = elements.number(element, "screw_thread_pitch", 1.0)
        elif element.find("thread_pitch") is not None:
            given = elements.number(element, "thread_pitch", 1.0)
            pitch = -2.0 * math.pi / given if given != 0.0 else 0.0
        else:
            pitch = 1.0
        if abs(pitch) < _NO_PITCH:
            elements.problems.add("a screw joint needs a pitch other than zero", elements.place(element), "Correct it.")
            return 1.0
        return pitch

    def follow(self) -> None:
        """Couples the joints that follow others, once all are known."""
        joints = {joint.name: joint for joint in self.found.joints}
        leaders: dict[str, str] = {}
        for follower, prefix, mimic, scope in self._mimics:
            elements = scope.elements
            own = mimic.get("joint", "")
            leader = f"{prefix}{SEPARATOR}{own}" if prefix else own
            if mimic.get("axis", "axis") == "axis2":
                leader += " second axis"
            ratio = elements.number(mimic, "multiplier", 1.0)
            start = elements.number(mimic, "offset", 0.0) - ratio * elements.number(mimic, "reference", 0.0)
            known = leader in joints and follower in joints and joints[leader].type.is_scalar
            current = leader
            while current in leaders:
                current = leaders[current]
            if not known or ratio == 0.0 or current == follower or start != 0.0:
                reason = "which cannot be kept" if start == 0.0 else "with an offset, which is not there at the start"
                note = f"joint {follower!r} is to follow {leader!r} (mimic), {reason}: it moves by itself"
                self._notes.append(Lost(note))
                continue
            leaders[follower] = leader
            self.found.couplings.append(Coupling(follower, leader, ratio, 0.0))
