"""End stops, friction, springs and rotors of joints, as components of the library at the joint's axis."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

from cad2modelica.actuators.catalogue import DOMAINS, PACKAGE
from cad2modelica.mechanism.model import Joint, JointType, Part
from cad2modelica.mechanism.moved_inertia import inertia_about
from cad2modelica.modelica.text import number

STOP_FREQUENCY = 20.0  # Hz, of the moved parts against a stop whose stiffness is not given
DEFAULT_DAMPING = 0.75  # s/rad, s/m: by Hunt and Crossley e = 1 - 2/3*0.75*v, so about half at unit speed


@dataclass(frozen=True)
class Resistance:
    """A component at a joint's axis.

    Attributes:
        suffix: completes the joint's name to the component's.
        flange: its connector at the joint's axis.
        has_support: whether it has a housing, which is the joint's.
    """

    class_name: str
    suffix: str
    modifiers: tuple[str, ...]
    flange: str = "flange"
    has_support: bool = True


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
    spring = joint.spring
    if spring is not None:
        modifiers = [f"c={number(spring.stiffness)}", f"{coordinate}_rest={number(spring.rest)}"]
        found.append(Resistance(f"{domain}.SpringDamper", "spring", ("useSupport=true", *modifiers)))
    if joint.rotor_inertia > 0:
        kind, inertia = ("Rotational.Components.Inertia", "J") if turning else ("Translational.Components.Mass", "m")
        modifiers = [f"{inertia}={number(joint.rotor_inertia)}"]
        rotor = Resistance(
            f"Modelica.Mechanics.{kind}", "rotor", tuple(modifiers), flange="flange_a", has_support=False
        )
        found.append(rotor)
    return tuple(found)


def _stop_stiffness(joint: Joint, moved: Iterable[Part]) -> float:
    """Stiffness that makes the moved parts swing with ``STOP_FREQUENCY``, to three digits."""
    inertia = sum(inertia_about(joint, part) for part in moved)
    stiffness = inertia * (2 * math.pi * STOP_FREQUENCY) ** 2
    return float(f"{stiffness:.3g}")
