"""Joints as Modelica declarations: class, axes, start values, states."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from cad2modelica.geometry.spatial import Array, Pose, perpendicular, rotation_about
from cad2modelica.kinematics.loop_closures import Closure
from cad2modelica.kinematics.loops import LoopAnalysis
from cad2modelica.mechanism.model import Joint, JointType
from cad2modelica.modelica.text import SIGNIFICANT_LENGTH, number, tidy_direction, tidy_length, vector

MULTIBODY = "Modelica.Mechanics.MultiBody"
CLOSURE = "ContactMultiBody.Joints.LoopClosure"

# Coordinates and rates of the joints in the order of joint_twists.
COORDINATES = {
    JointType.REVOLUTE: (("phi", "w"),),
    JointType.PRISMATIC: (("s", "v"),),
    JointType.SCREW: (("phi", "w"),),
    JointType.CYLINDRICAL: (("s", "v"), ("phi", "w")),
    JointType.UNIVERSAL: (("phi_a", "w_a"), ("phi_b", "w_b")),
    JointType.PLANAR: (("s_x", "v_x"), ("s_y", "v_y"), ("phi", "w")),
}


def joint_declaration(joint: Joint, side: Pose, loops: LoopAnalysis) -> tuple[str, tuple[str, ...]]:
    """Class and modifiers of a joint whose parent side stands at ``side``."""
    library = "ContactMultiBody" if joint.type is JointType.SCREW else MULTIBODY
    class_name = f"{library}.Joints.{joint.type.name.capitalize()}"
    independent, rates = loops.independent[joint.name], loops.rates[joint.name]
    if joint.type is JointType.SPHERICAL:
        start = side.rotation.T @ np.array(rates)
        fixed = "true" if all(independent) else "false"
        # States of its own start as given; those of the body behind it had to be solved for.
        own_states = ("enforceStates=true",) if all(independent) else ()
        return class_name, (
            f"angles_fixed={fixed}",
            f"w_rel_a_fixed={fixed}",
            f"w_rel_a_start={vector(tidy_length(start))}",
            *own_states,
        )
    axes = _axis_modifiers(joint, side)
    if joint.name in loops.planar_constraints:
        return f"{MULTIBODY}.Joints.RevolutePlanarLoopConstraint", axes
    return class_name, (*axes, *coordinate_modifiers(COORDINATES[joint.type], independent, rates, joint.position))


def coordinate_modifiers(
    names: Sequence[tuple[str, str]], independent: Sequence[bool], rates: Sequence[float], position: float = 0.0
) -> list[str]:
    """Start values of a joint's coordinates and rates, and whether they are states."""
    mixed = any(independent) and not all(independent)
    modifiers = []
    for (coordinate, rate), fixed_start, value in zip(names, independent, rates, strict=True):
        suffix = ",fixed=true" if fixed_start else ""
        if mixed:  # the joint's own parameter speaks for all of its coordinates
            suffix += f",stateSelect=StateSelect.{'always' if fixed_start else 'avoid'}"
        modifiers.append(f"{coordinate}(start={number(position)}{suffix})")
        modifiers.append(f"{rate}(start={number(round(value, SIGNIFICANT_LENGTH))}{suffix})")
    if not mixed:
        modifiers.append(f"stateSelect=StateSelect.{'always' if any(independent) else 'avoid'}")
    return modifiers


def closure_modifiers(closure: Closure) -> tuple[str, ...]:
    """What a loop closure does not hold, and what the conditions left out may show."""
    held = (*closure.shifts, *closure.turns)
    names = ("x_locked", "y_locked", "z_locked", "turn_x_locked", "turn_y_locked", "turn_z_locked")
    free = [f"{name}=false" for name, locked in zip(names, held, strict=True) if not locked]
    angle = "Modelica.Constants.inf" if math.isinf(closure.angle) else number(closure.angle)
    return (*free, f"distance_max={number(closure.distance)}", f"angle_max={angle}")


def _axis_modifiers(joint: Joint, side: Pose) -> tuple[str, ...]:
    axis = tidy_direction(side.rotation.T @ axis_of(joint))
    if joint.type is JointType.UNIVERSAL and joint.second_axis is not None:
        return f"n_a={vector(axis)}", f"n_b={vector(tidy_direction(side.rotation.T @ joint.second_axis))}"
    if joint.type is JointType.PLANAR:
        first = side.rotation.T @ perpendicular(axis_of(joint))
        return f"n={vector(axis)}", f"n_x={vector(tidy_direction(first))}"
    if joint.type is JointType.SCREW:
        return f"n={vector(axis)}", f"pitch={number(joint.pitch)}"
    return (f"n={vector(axis)}",)


def axis_of(joint: Joint) -> Array:
    """The axis of a joint whose type has one."""
    if joint.axis is None:
        raise AssertionError(f"the reader guarantees an axis for {joint.name}")
    return joint.axis


def start_rotation(joint: Joint, side: Pose) -> Array:
    """Rotation of the joint's far side against its parent side ``side`` at the start coordinate."""
    if joint.type in (JointType.REVOLUTE, JointType.SCREW):
        return rotation_about(side.rotation.T @ axis_of(joint), joint.position)
    return np.eye(3)
