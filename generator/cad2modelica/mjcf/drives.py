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
        if self._is_limited(item, "forcelimited", "forcerange"):
            found.append(abs(gear) * self._largest(item, "forcerange"))
        if gain is not None and self._clamps and self._is_limited(item, "ctrllimited", "ctrlrange"):
            found.append(abs(gear * gain) * self._largest(item, "ctrlrange"))
        if joint.rating is not None and joint.rating.effort is not None:
            found.append(joint.rating.effort)
        return min(found) if found else None

    def _largest(self, item: Item, key: str) -> float:
        return float(np.abs(self._elements.numbers(item, key, (0.0, 0.0))).max())

    def _is_limited(self, item: Item, flag: str, values: str) -> bool:
        word = item.text(flag, "auto")
        return word == "true" or (word == "auto" and self._elements.compiler.autolimits and item.has(values))
