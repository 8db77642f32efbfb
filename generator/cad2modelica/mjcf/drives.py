"""Actuators as components of ContactMultiBody.Actuators: torques, and controllers of position or speed."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from cad2modelica.mechanism.model import Assignment, Joint, JointType
from cad2modelica.mjcf.document import KIND, MjcfDocument
from cad2modelica.mjcf.elements import Item, MjcfElements
from cad2modelica.source.lost import Lost

_DRIVES = ("motor", "position", "velocity", "general")


def read_drives(
    document: MjcfDocument, elements: MjcfElements, joints: Mapping[str, Joint], inertias: Mapping[str, float]
) -> tuple[Assignment, ...]:
    """What drives hinges and slides; a note on each actuator that is left out.

    Args:
        document: the model.
        elements: reads attributes.
        joints: by name.
        inertias: that joints move at the start, kg.m2 or kg.
    """
    if "actuation" in document.disabled:
        return ()
    reader = _DriveReader(elements, joints, inertias, clamps="clampctrl" not in document.disabled)
    found = []
    for item in document.section_items("actuator"):
        try:
            drive = reader.read(item)
        except _NotKept as reason:
            elements.notes.append(Lost(f"{elements.place(item.element)}: {reason}"))
            continue
        found += [drive] if drive is not None else []
    if reader.unclamped:
        listed = ", ".join(reader.unclamped)
        elements.notes.append(
            Lost(f"wanted positions and speeds of drives are not clamped to their ctrlrange; keep them in it: {listed}")
        )
    return tuple(found)


class _NotKept(Exception):  # a finding, not an error: it becomes a note
    """Why an actuator is left out."""


class _DriveReader:
    def __init__(
        self, elements: MjcfElements, joints: Mapping[str, Joint], inertias: Mapping[str, float], *, clamps: bool
    ) -> None:
        self._clamps = clamps
        self._elements = elements
        self._joints = joints
        self._inertias = inertias
        self._names: set[str] = set()
        self.unclamped: list[str] = []  # controllers whose signal has a range

    def read(self, item: Item) -> Assignment | None:
        name = item.text("joint") or item.text("jointinparent")
        joint = self._joints.get(name)
        if item.tag not in _DRIVES:
            raise _NotKept(f"actuators of kind {item.tag!r} are left out")
        if not name:
            raise _NotKept("only actuators of joints are kept")
        if joint is None:
            place = self._elements.place(item.element)
            self._elements.problems.add(f"drives the joint {name!r}, which does not exist", place, "Correct the name.")
            return None
        if joint.type is JointType.FIXED:
            raise _NotKept(f"joint {name!r} does not move")
        if not joint.type.is_scalar:
            raise _NotKept(f"joint {name!r} is driven, which has several freedoms")
        if item.text("dyntype", "none") != "none" or self._elements.number(item, "timeconst") > 0:
            self._elements.notes.append(
                Lost(f"{self._elements.place(item.element)}: the actuator of {name!r} acts without its filter")
            )
        gear = float(self._elements.numbers(item, "gear", (1.0, 0.0, 0.0, 0.0, 0.0, 0.0))[0])
        law = self._law(item, joint, gear)
        return self._drive(item, joint, gear, law)

    def _drive(self, item: Item, joint: Joint, gear: float, law: tuple[float, float, float]) -> Assignment:
        gain, spring, damper = law
        turning = joint.is_turning
        limit = self._limit(item, joint, gear, gain if spring == damper == 0.0 else None)
        parameters: dict[str, float | bool] = {} if limit is None else {"tau_max" if turning else "f_max": limit}
        name = item.name or f"{joint.name} drive"
        while name in self._names:
            name += " 2"
        self._names.add(name)
        if spring == damper == 0.0:
            return Assignment(joint.name, "Torque" if turning else "Force", name, parameters)
        parameters |= {"c": spring * gear**2, "d": damper * gear**2}
        if spring == 0.0:
            parameters["useSpeedReference"] = True
        return Assignment(joint.name, "Servo", name, parameters)

    def _law(self, item: Item, joint: Joint, gear: float) -> tuple[float, float, float]:
        """Gain of the signal, stiffness and damping, in the actuator's coordinate."""
        if gear == 0.0:
            raise _NotKept(f"the actuator of {joint.name!r} has the gear 0")
        gains = self._elements.numbers(item, "gainprm", (1.0, *(0.0,) * 9))
        if item.tag == "motor":
            return 1.0, 0.0, 0.0
        if item.tag == "velocity":
            return 0.0, 0.0, self._elements.number(item, "kv", float(gains[0]))
        kind = item.text(KIND)
        if item.tag == "position" or (item.tag == "general" and kind == "position" and not item.has("biasprm")):
            spring = self._elements.number(item, "kp", float(gains[0]))
            bias = self._elements.numbers(item, "biasprm", (0.0,) * 10)
            damper = self._elements.number(item, "kv", -float(bias[2]))
            if item.has("dampratio"):
                inertia = self._inertias.get(joint.name, 0.0) / gear**2  # seen from the actuator's side
                damper = 2.0 * self._elements.number(item, "dampratio") * float(np.sqrt(max(spring, 0.0) * inertia))
            return self._checked(joint, (0.0, spring, damper))
        return self._general(item, joint, gains)

    def _general(self, item: Item, joint: Joint, gains: np.ndarray) -> tuple[float, float, float]:
        if item.text("gaintype", "fixed") != "fixed" or item.text("biastype", "none") not in ("none", "affine"):
            raise _NotKept(f"the actuator of {joint.name!r} follows another law than force, position or speed")
        bias = self._elements.numbers(item, "biasprm", (0.0,) * 10)
        gain = float(gains[0])
        if item.text("biastype", "none") == "none" or not bias[:3].any():
            return gain, 0.0, 0.0
        constant, spring, damper = float(bias[0]), -float(bias[1]), -float(bias[2])
        if constant == 0.0 and spring == gain and gain > 0:
            return self._checked(joint, (0.0, spring, damper))
        if constant == spring == 0.0 and damper == gain and gain > 0:
            return self._checked(joint, (0.0, 0.0, damper))
        raise _NotKept(f"the actuator of {joint.name!r} follows another law than force, position or speed")

    def _checked(self, joint: Joint, law: tuple[float, float, float]) -> tuple[float, float, float]:
        if min(law) < 0:
            raise _NotKept(f"the actuator of {joint.name!r} has a negative gain")
        return law

    def _limit(self, item: Item, joint: Joint, gear: float, gain: float | None) -> float | None:
        """Largest torque or force at the joint; None if there is none."""
        found = []
        force = self._elements.limits(item, "forcelimited", "forcerange")
        control = self._control(item, joint)
        if force is not None:
            found.append(abs(gear) * self._largest(item, "forcerange", force))
        if control is not None and gain is not None:
            found.append(abs(gear * gain) * self._largest(item, "ctrlrange", control))
        elif control is not None:
            self.unclamped.append(f"{item.name or joint.name} {control[0]:g} to {control[1]:g}")
        if joint.rating is not None and joint.rating.effort is not None:
            found.append(joint.rating.effort)
        return min(found) if found else None

    def _control(self, item: Item, joint: Joint) -> tuple[float, float] | None:
        """The range that the signal is clamped to: its own, or the joint's where it inherits this one."""
        limits = self._elements.limits(item, "ctrllimited", "ctrlrange")
        share = self._elements.number(item, "inheritrange")
        if share > 0.0 and joint.limits is not None and item.tag == "position":
            lower, upper = joint.limits.lower or 0.0, joint.limits.upper or 0.0
            middle, half = (lower + upper) / 2, share * (upper - lower) / 2
            limits = middle - half, middle + half
        return limits if self._clamps else None

    def _largest(self, item: Item, key: str, limits: tuple[float, float]) -> float:
        lower, upper = limits
        largest = max(abs(lower), abs(upper))
        if lower != -upper:
            self._elements.notes.append(
                Lost(
                    f"{self._elements.place(item.element)}: the {key} {lower:g} to {upper:g} is taken as "
                    f"{-largest:g} to {largest:g}"
                )
            )
        return largest
