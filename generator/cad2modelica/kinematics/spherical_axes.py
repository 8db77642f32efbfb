"""Axes for spherical joints inside loops: there three turns in a row take the place of an orientation.

A loop usually leaves a spherical joint in the tree one of its three freedoms, as the spin of a coupler between two
spherical joints. One coordinate can only start as given if the joint has coordinates: three revolute axes, the first
fixed in the parent, along the axis of the joint before it in the loop, which may turn for ever; the third along the
child, towards the joint behind; the second across both. They lock where the child points along the first axis.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from cad2modelica.geometry.spatial import Array, perpendicular
from cad2modelica.kinematics.kinematic_graph import kinematic_tree
from cad2modelica.kinematics.loops import closed_loops
from cad2modelica.kinematics.planar_loops import Loop, Step
from cad2modelica.mechanism.model import Assembly, Joint, JointType

SMALLEST_ANGLE = 0.2  # rad, between the first and the third axis at the start


def with_spherical_axes(assembly: Assembly) -> Assembly:
    """The assembly with axes for the spherical joints that lie in loops without closing them."""
    if not any(joint.type is JointType.SPHERICAL for joint in assembly.joints):
        return assembly
    tree = kinematic_tree(assembly)
    cut = {joint.name for joint in tree.cut_joints}
    chosen: dict[str, tuple[Array, Array]] = {}
    for loop in closed_loops(tree):
        for number, (joint, sign) in enumerate(loop.steps):
            if joint.type is JointType.SPHERICAL and joint.name not in cut and joint.name not in chosen:
                chosen[joint.name] = _axes(joint, _neighbours(loop, number, sign))
    joints = tuple(
        replace(joint, axis=chosen[joint.name][0], second_axis=chosen[joint.name][1]) if joint.name in chosen else joint
        for joint in assembly.joints
    )
    return replace(assembly, joints=joints)


def _neighbours(loop: Loop, number: int, sign: float) -> tuple[list[Step], list[Step]]:
    """Joints of the loop on the parent's side and on the child's side, the nearest first."""
    rest = [*loop.steps[number + 1 :], *loop.steps[:number]]
    return (rest[::-1], rest) if sign > 0 else (rest, rest[::-1])


def _axes(joint: Joint, sides: tuple[Sequence[Step], Sequence[Step]]) -> tuple[Array, Array]:
    """First and third axis, unit vectors."""
    before, behind = sides
    aims = [other.origin - joint.origin for other, _ in behind]
    third = next((aim / np.linalg.norm(aim) for aim in aims if np.linalg.norm(aim) > 1e-9), np.array([0.0, 0.0, 1.0]))
    nearest = next((other for other, _ in before if other.type is not JointType.FIXED), None)
    first = nearest.axis if nearest is not None else None
    if first is None or np.linalg.norm(np.cross(first, third)) < SMALLEST_ANGLE:
        first = perpendicular(third)
    return first, third
