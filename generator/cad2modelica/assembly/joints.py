"""Joints of the assembly's XML: partners, axes, start, limits, friction."""

from __future__ import annotations

from collections.abc import Mapping

from contact_foundation.errors import Place
from lxml import etree

from cad2modelica.assembly.elements import NAMESPACE, ElementReader, numbers, optional
from cad2modelica.assembly.unfolding import JointDescription, PartDescription
from cad2modelica.geometry.spatial import IDENTITY, Array, Pose
from cad2modelica.mechanism.model import GROUND, Joint, JointFriction, JointLimits, JointType
from cad2modelica.source.units import to_si

RIGHT_ANGLE_TOLERANCE = 1e-6


def read_joint(read: ElementReader, item: JointDescription, parts: Mapping[str, PartDescription]) -> Joint | None:
    """One joint; None, with its problems recorded, if it cannot be made."""
    return _JointReader(read, item, parts).read()


class _JointReader:
    def __init__(self, read: ElementReader, item: JointDescription, parts: Mapping[str, PartDescription]) -> None:
        self._read = read
        self._item = item
        self._parts = parts
        self._element = item.element
        self._kind = JointType(item.element.get("type", ""))
        self._place = read.place(item.element, item.name)

    def read(self) -> Joint | None:
        element, kind = self._element, self._kind
        ends = self._partners()
        if ends is None:
            return None
        parent, child = ends
        frames = self._frames(parent, child)
        origin = self._parts[child].pose.position
        origin_element = element.find(f"{{{NAMESPACE}}}origin")
        if origin_element is not None:
            origin = self._point(origin_element, frames)
        elif kind not in (JointType.FIXED, JointType.FREE):
            self._problem(f"a {kind.value} joint needs an origin", "Add the element origin.")
        axis = self._axis("axis", frames, kind.needs_axis)
        child_origin = self._element.find(f"{{{NAMESPACE}}}childOrigin")
        child_axis = self._element.find(f"{{{NAMESPACE}}}childAxis")
        second = self._axis("axis2", frames, kind is JointType.UNIVERSAL)
        if axis is not None and second is not None and abs(float(axis @ second)) > RIGHT_ANGLE_TOLERANCE:
            self._problem("axis and axis2 are not at a right angle", "Correct the axes.")
        start = self._start()
        unit = self._coordinate_unit()
        joint = Joint(
            name=self._item.name,
            type=kind,
            parent=parent,
            child=child,
            origin=origin,
            axis=axis,
            second_axis=second,
            position=to_si(float(start.get("position", "0")), unit),
            speed=to_si(float(start.get("speed", "0")), unit),
            velocity=to_si(self._started("velocity", start, frames), self._read.units.length),
            angular_velocity=self._started("angularVelocity", start, frames) * self._read.units.angle,
            place=self._place,
            pitch=self._pitch(),
            limits=self._limits(),
            friction=self._friction(),
            child_origin=self._point(child_origin, frames) if child_origin is not None else None,
            child_axis=self._axis("childAxis", frames, kind.needs_axis) if child_axis is not None else None,
        )
        self._check_start(joint)
        return joint

    def _partners(self) -> tuple[str, str] | None:
        element, prefix = self._element, self._item.prefix
        parent = element.get("parent", "")
        parent = GROUND if parent == GROUND else prefix + parent
        child = prefix + element.get("child", "")
        if element.get("child") == GROUND:
            self._problem(f"{GROUND!r} cannot be a child", "Exchange parent and child.")
            return None
        unknown = [name for name in (parent, child) if name != GROUND and name not in self._parts]
        for name in unknown:
            self._read.unknown(f"the joint {self._item.name!r}", name, self._parts, element)
        if unknown:
            return None
        if parent == child:
            self._problem(f"joins {parent!r} with itself", "Name two different parts.")
            return None
        return parent, child

    def _frames(self, parent: str, child: str) -> dict[str, Pose]:
        """Coordinate systems by the names the format gives them.

        Where an instance has put the joint's parent elsewhere, what the definition says in its own coordinates has
        moved with the parent. What lists the instance itself knows the place, and means its own coordinates.
        """
        outer = self._item.outer
        if parent != GROUND:
            known, placed = self._parts[parent].seen_from(self._item.prefix), self._parts[parent].pose
            if known is not placed and self._parts[parent].placements:
                outer = placed @ (known.inverse() @ outer)
        return {
            "assembly": outer,
            "parent": IDENTITY if parent == GROUND else self._parts[parent].pose,
            "child": self._parts[child].pose,
        }

    def _point(self, element: etree._Element, frames: dict[str, Pose]) -> Array:
        given = to_si(numbers(element.text), self._read.units.length)
        return frames[element.get("frame", "assembly")].point(given)

    def _axis(self, tag: str, frames: dict[str, Pose], needed: bool) -> Array | None:
        child = self._element.find(f"{{{NAMESPACE}}}{tag}")
        kind = self._kind.value
        if child is None:
            if needed:
                self._problem(f"a {kind} joint needs an {tag}", f"Add the element {tag}.")
            return None
        if not needed:
            place = self._read.place(child)
            self._read.problems.add(f"a {kind} joint has no {tag}", place, f"Remove the element {tag}.")
            return None
        unit = self._read.unit(numbers(child.text), child, f"the {tag}")
        return frames[child.get("frame", "assembly")].direction(unit)

    def _start(self) -> dict[str, str]:
        start = self._element.find(f"{{{NAMESPACE}}}start")
        given = {str(key): str(value) for key, value in start.items()} if start is not None else {}
        given |= self._item.start or {}
        allowed = ("position", "speed") if self._kind.is_scalar else ("velocity", "angularVelocity")
        for key in given:
            if key not in allowed or self._kind is JointType.FIXED:
                self._read.problems.add(
                    f"the start of a {self._kind.value} joint has no {key}",
                    self._read.place(start if start is not None else self._element, self._item.name),
                    "Remove it." if self._kind is JointType.FIXED else f"Possible: {', '.join(allowed)}.",
                )
        return given

    def _started(self, key: str, start: dict[str, str], frames: dict[str, Pose]) -> Array:
        """A start velocity in world axes; the instance's own is not moved by where it places the parent."""
        frame = self._item.outer if key in (self._item.start or {}) else frames["assembly"]
        return frame.direction(numbers(start.get(key, "0 0 0")))

    def _coordinate_unit(self) -> float:
        turns = self._kind in (JointType.REVOLUTE, JointType.SCREW)
        return self._read.units.angle if turns else self._read.units.length

    def _pitch(self) -> float:
        pitch = optional(self._element, "pitch")
        if self._kind is not JointType.SCREW:
            if pitch is not None:
                self._problem(f"a {self._kind.value} joint has no pitch", "Remove the attribute pitch.")
            return 0.0
        if not pitch:
            self._problem("a screw joint needs a pitch other than zero", "Add the attribute pitch: way in one turn.")
            return 1.0
        return to_si(pitch, self._read.units.length)

    def _limits(self) -> JointLimits | None:
        element = self._element.find(f"{{{NAMESPACE}}}limits")
        if element is None or not self._needs_coordinate("limits"):
            return None
        unit = self._coordinate_unit()
        lower, upper = optional(element, "lower"), optional(element, "upper")
        if lower is not None and upper is not None and not lower < upper:
            self._problem(f"the limits are {lower:g} and {upper:g}: the lower must be smaller", "Correct the limits.")
            return None
        return JointLimits(
            lower=to_si(lower, unit) if lower is not None else None,
            upper=to_si(upper, unit) if upper is not None else None,
            stiffness=optional(element, "stiffness"),
            damping=optional(element, "damping"),
        )

    def _friction(self) -> JointFriction | None:
        element = self._element.find(f"{{{NAMESPACE}}}friction")
        if element is None or not self._needs_coordinate("friction"):
            return None
        return JointFriction(optional(element, "viscous") or 0.0, optional(element, "dry") or 0.0)

    def _needs_coordinate(self, what: str) -> bool:
        if self._kind.is_scalar:
            return True
        self._problem(
            f"a {self._kind.value} joint has no {what}", "Revolute, screw and prismatic joints can have them."
        )
        return False

    def _check_start(self, joint: Joint) -> None:
        limits = joint.limits
        if limits is None:
            return
        low = limits.lower is not None and joint.position < limits.lower
        if low or (limits.upper is not None and joint.position > limits.upper):
            unit = self._coordinate_unit()
            self._problem(
                f"starts at {joint.position / unit:g}, outside its limits", "Correct the start or the limits."
            )

    def _problem(self, message: str, remedy: str) -> None:
        place: Place = self._place
        self._read.problems.add(message, place, remedy)
