"""End stops and friction of joints, as components of the library at the joint's axis."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from cad2modelica.actuators.catalogue import DOMAINS, PACKAGE
from cad2modelica.geometry.spatial import Array
from cad2modelica.mechanism.model import Joint, JointType, Part
from cad2modelica.modelica.text import number

STOP_FREQUENCY = 20.0  # Hz, of the moved parts against a stop whose stiffness is not given
DEFAULT_DAMPING = 0.75  # s/rad, s/m: by Hunt and Crossley e = 1 - 2/3*0.75*v, so about half at unit speed


@dataclass(frozen=True)
class Resistance:
    """A component at a joint's axis.

    Attributes:
        suffix: completes the joint's name to the component's.
    """

    class_name: str
    suffix: str
    modifiers: tuple[str, ...]


def resistances(joint: Joint, moved: Iterable[Part]) -> tuple[Resistance, ...]:
    """What stops and brakes a joint.

    Args:
        joint: the joint.
        moved: parts that it moves at the start, for the stiffness of stops.
    """
    if not joint.type.is_scalar:
        return ()
    domain = f"{PACKAGE}.{DOMAINS[joint.type]}"
    turning = joint.type is not JointType.PRISMATIC
    coordinate, speed_effort = ("phi", "tau") if turning else ("s", "f")
    found = []
    limits = joint.limits
    if limits is not None and (limits.lower is not None or limits.upper is not None):
        stiffness = limits.stiffness if limits.stiffness is not None else _stop_stiffness(joint, moved)
        damping = limits.damping if limits.damping is not None else DEFAULT_DAMPING
        modifiers = [f"{coordinate}_min={number(limits.lower)}"] if limits.lower is not None else []
        modifiers += [f"{coordinate}_max={number(limits.upper)}"] if limits.upper is not None else []
        modifiers += [f"c={number(stiffness)}", f"damping={number(damping)}"]
        found.append(Resistance(f"{domain}.EndStop", "stop", ("useSupport=true", *modifiers)))
    friction = joint.friction
    if friction is not None and (friction.viscous > 0 or friction.dry > 0):
        modifiers = [f"d={number(friction.viscous)}"] if friction.viscous > 0 else []
        modifiers += [f"{speed_effort}_dry={number(friction.dry)}"] if friction.dry > 0 else []
        found.append(Resistance(f"{domain}.Friction", "friction", ("useSupport=true", *modifiers)))
    return tuple(found)


def _stop_stiffness(joint: Joint, moved: Iterable[Part]) -> float:
    """Stiffness that makes the moved parts swing with ``STOP_FREQUENCY``, to three digits."""
    inertia = sum(_inertia(joint, part) for part in moved)
    stiffness = inertia * (2 * math.pi * STOP_FREQUENCY) ** 2
    return float(f"{stiffness:.3g}")


def _inertia(joint: Joint, part: Part) -> float:
    """Inertia of a part in the joint's coordinate: kg, or kg.m2 about the axis."""
    properties = part.mass_properties
    if joint.type is JointType.PRISMATIC or joint.axis is None:
        return properties.mass
    axis: Array = joint.axis
    arm = np.cross(part.pose.point(properties.center_of_mass) - joint.origin, axis)
    turned = part.pose.rotation.T @ axis
    about = float(turned @ properties.inertia @ turned) + properties.mass * float(arm @ arm)
    along = joint.pitch / (2 * math.pi)
    return about + properties.mass * along**2
