"""What a joint's coordinate resists while all other joints are free, as the compiler's automatic springs count it."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from cad2modelica.geometry.spatial import Array
from cad2modelica.mechanism.model import Joint, JointType, Part


def effective_inertias(joints: Mapping[str, Joint], parts: Mapping[str, Part]) -> dict[str, float]:
    """Inertia of hinges (kg.m2) and slides (kg) at the start: 1 over the diagonal of the inverse mass matrix.

    Args:
        joints: of a tree, by name.
        parts: by name.
    """
    columns = [(joint.name, twist) for joint in joints.values() for twist in _twists(joint, parts)]
    matrix = np.diag([joints[name].rotor_inertia for name, _ in columns])
    before = {joint.child: joint for joint in joints.values()}
    numbers: dict[str, list[int]] = {}
    for number, (name, _) in enumerate(columns):
        numbers.setdefault(name, []).append(number)
    for part in parts.values():
        moving, name = list[int](), part.name
        while name in before:
            moving += numbers.get(before[name].name, [])
            name = before[name].parent
        if moving and not part.grounded:
            matrix[np.ix_(moving, moving)] += _part_inertia(part, np.array([columns[k][1] for k in moving]))
    inverse = np.linalg.pinv(matrix, hermitian=True)
    found = {}
    for joint in joints.values():
        if joint.type.is_scalar:
            (number,) = numbers[joint.name]
            found[joint.name] = float(1.0 / inverse[number, number]) if inverse[number, number] > 0.0 else 0.0
    return found


def _twists(joint: Joint, parts: Mapping[str, Part]) -> list[Array]:
    """Angular velocity and velocity at the world's origin of each of a joint's rates, shape (6,)."""
    if joint.type is JointType.PRISMATIC and joint.axis is not None:
        return [np.concatenate([np.zeros(3), joint.axis])]
    if joint.axis is not None:
        return [np.concatenate([joint.axis, np.cross(joint.origin, joint.axis)])]
    free = joint.type is JointType.FREE
    origin = parts[joint.child].pose.position if free else joint.origin
    turns = [np.concatenate([axis, np.cross(origin, axis)]) for axis in np.eye(3)]
    return [*turns, *(np.concatenate([np.zeros(3), axis]) for axis in np.eye(3) if free)]


def _part_inertia(part: Part, twists: Array) -> Array:
    """A part's share in the mass matrix of the coordinates that have these twists, shape (n, 6)."""
    properties = part.mass_properties
    inertia = part.pose.rotation @ properties.inertia @ part.pose.rotation.T
    turning = twists[:, :3]
    moving = twists[:, 3:] + np.cross(turning, part.pose.point(properties.center_of_mass))
    return np.asarray(properties.mass * moving @ moving.T + turning @ inertia @ turning.T)
