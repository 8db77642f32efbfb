"""Instantaneous motions of joints as twists, and the equations that loops make of them.

A twist is an angular velocity and a velocity at the world's origin, shape (6,). Around a closed loop the joints'
relative twists add up to zero (Samin and Fisette, Symbolic Modeling of Multibody Systems, 2003).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cad2modelica.geometry.spatial import Array, perpendicular
from cad2modelica.kinematics.planar_loops import Loop
from cad2modelica.mechanism.model import Joint, JointType

RANK_TOLERANCE = 1e-5  # what exports round must not make dependent conditions look independent
PLANAR_EQUATIONS = 3
SPATIAL_EQUATIONS = 6

Column = tuple[Joint, int]


def joint_twists(joint: Joint) -> list[Array]:
    """Unit twists of a joint's coordinates.

    Order: revolute, screw (angle), prismatic (distance), cylindrical (distance, angle), universal (first, second
    angle), planar (first, second distance, angle), spherical (about x, y, z, or about its three axes if it has any).
    """
    return twists_of(joint.type, joint.origin, joint.axis, joint.second_axis, joint.pitch)


def twists_of(
    kind: JointType, origin: Array, axis: Array | None, second_axis: Array | None = None, pitch: float = 0.0
) -> list[Array]:
    """Unit twists of a joint of that kind, as ``joint_twists``."""

    def turn(direction: Array) -> Array:
        return np.concatenate([direction, np.cross(origin, direction)])

    def shift(direction: Array) -> Array:
        return np.concatenate([np.zeros(3), direction])

    if kind is JointType.SPHERICAL:
        return [turn(direction) for direction in spherical_axes(axis, second_axis)]
    if axis is None:
        return []
    if kind is JointType.REVOLUTE:
        return [turn(axis)]
    if kind is JointType.PRISMATIC:
        return [shift(axis)]
    if kind is JointType.SCREW:
        return [turn(axis) + shift(axis * pitch / (2 * np.pi))]
    if kind is JointType.CYLINDRICAL:
        return [shift(axis), turn(axis)]
    if kind is JointType.UNIVERSAL:
        return [turn(axis), turn(second_axis if second_axis is not None else perpendicular(axis))]
    first = perpendicular(axis)
    return [shift(first), shift(np.cross(axis, first)), turn(axis)]


def spherical_axes(axis: Array | None, third: Array | None) -> Array:
    """The three axes of a spherical joint as rows: x, y, z, or with axes of its own the second one across both."""
    if axis is None or third is None:
        return np.eye(3)
    across = np.cross(third, axis)
    return np.array([axis, across / np.linalg.norm(across), third])


def start_rates(joint: Joint) -> tuple[float, ...]:
    """The rates a joint is given, in the order of ``joint_twists``."""
    if joint.type.is_scalar:
        return (joint.speed,)
    if joint.type is JointType.SPHERICAL:
        axes = spherical_axes(joint.axis, joint.second_axis)
        return tuple(float(rate) for rate in np.linalg.solve(axes.T, joint.angular_velocity))
    rates = []
    for twist in joint_twists(joint):
        turning = twist[:3].any()
        given = joint.angular_velocity @ twist[:3] if turning else joint.velocity @ twist[3:]
        rates.append(float(given))
    return tuple(rates)


def loop_equations(loop: Loop) -> int:
    """How many conditions close a loop: three in a plane, six in space."""
    return PLANAR_EQUATIONS if loop.normal is not None else SPATIAL_EQUATIONS


def loop_matrix(loops: Sequence[Loop], columns: Sequence[Column], length: float) -> Array:
    """The loops' equations for the joints' rates, shape (equations, columns).

    Displacements are divided by ``length``, so that they compare with rotations.

    Args:
        loops: three rows for planar ones (turn about the normal, displacements across it), six for others.
        columns: joints and numbers of their coordinates.
        length: typical length of the mechanism, m.
    """
    position = {(joint.name, k): column for column, (joint, k) in enumerate(columns)}
    matrix = np.zeros((sum(loop_equations(loop) for loop in loops), len(columns)))
    row = 0
    for loop in loops:
        rows = slice(row, row + loop_equations(loop))
        projection = loop_projection(loop, length)
        for joint, sign in loop.steps:
            for k, twist in enumerate(joint_twists(joint)):
                column = position.get((joint.name, k))
                if column is not None:
                    matrix[rows, column] += sign * (projection @ twist)
        row = rows.stop
    return matrix


def loop_projection(loop: Loop, length: float) -> Array:
    """Takes twists to a loop's equations, shape (3 or 6, 6)."""
    # Velocity at the loop's middle instead of the world's origin keeps far mechanisms well conditioned.
    x, y, z = np.mean([joint.origin for joint, _ in loop.steps], axis=0)
    moved = np.eye(6)
    moved[3:, :3] = np.array([[0, z, -y], [-z, 0, x], [y, -x, 0]])
    scaled = np.diag([1.0, 1.0, 1.0, 1 / length, 1 / length, 1 / length]) @ moved
    if loop.normal is None:
        return np.asarray(scaled)
    first = perpendicular(loop.normal)
    choice = np.zeros((PLANAR_EQUATIONS, 6))
    choice[0, :3] = loop.normal
    choice[1, 3:] = first
    choice[2, 3:] = np.cross(loop.normal, first)
    return np.asarray(choice @ scaled)


def independent_columns(matrix: Array) -> list[int]:
    """Columns, first come first served, that are linearly independent of the ones taken before."""
    taken: list[int] = []
    directions = np.zeros((matrix.shape[0], 0))
    for column in range(matrix.shape[1]):
        rest = matrix[:, column].copy()
        size = float(np.linalg.norm(rest))
        for _ in range(2):
            rest -= directions @ (directions.T @ rest)
        remaining = float(np.linalg.norm(rest))
        if size > 0.0 and remaining > RANK_TOLERANCE * size:
            directions = np.column_stack([directions, rest / remaining])
            taken.append(column)
            if len(taken) == matrix.shape[0]:
                break
    return taken
