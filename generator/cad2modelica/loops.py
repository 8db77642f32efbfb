"""Closed loops: which are planar, which joint coordinates stay independent, and whether the loops can be computed.

The joints outside the spanning tree close loops. Around each loop the joints' relative velocities add up to zero; as
twists (angular velocity, velocity at the world's origin) these are six linear equations in the joints' rates.
Their rank at the start tells how many rates depend on the others (Samin and Fisette, Symbolic Modeling of Multibody
Systems, 2003, on spanning trees and cut joints; planar loops as in the Modelica Standard Library).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from cmb_base.errors import InputError

from cad2modelica.kinematic_graph import KinematicTree
from cad2modelica.model import GROUND, Assembly, Joint, JointType
from cad2modelica.spatial import Array, perpendicular

PARALLEL_TOLERANCE = 1e-6
RANK_TOLERANCE = 1e-7
PLANAR_EQUATIONS = 3
SPATIAL_EQUATIONS = 6


@dataclass(frozen=True)
class LoopAnalysis:
    """What the loops ask of the joints.

    Attributes:
        planar_constraints: names of the cut joints that become planar loop constraints.
        independent: for every joint, which of its coordinates (in the order of ``joint_twists``) start as given;
            the others follow from the loops.
        rates: for every joint, the rates at the start that satisfy the loops.
        notes: remarks.
    """

    planar_constraints: frozenset[str]
    independent: dict[str, tuple[bool, ...]]
    rates: dict[str, tuple[float, ...]]
    notes: tuple[str, ...]


def joint_twists(joint: Joint) -> list[Array]:
    """Unit twists of a joint's coordinates: angular velocity, then velocity at the world's origin, shape (6,).

    Order: revolute, screw (angle), prismatic (distance), cylindrical (distance, angle), universal (first, second
    angle), planar (first, second distance, angle), spherical (about x, y, z).
    """

    def turn(axis: Array) -> Array:
        return np.concatenate([axis, np.cross(joint.origin, axis)])

    def shift(axis: Array) -> Array:
        return np.concatenate([np.zeros(3), axis])

    if joint.type is JointType.SPHERICAL:
        return [turn(axis) for axis in np.eye(3)]
    if joint.axis is None:
        return []
    axis = joint.axis
    if joint.type is JointType.REVOLUTE:
        return [turn(axis)]
    if joint.type is JointType.PRISMATIC:
        return [shift(axis)]
    if joint.type is JointType.SCREW:
        return [turn(axis) + shift(axis * joint.pitch / (2 * np.pi))]
    if joint.type is JointType.CYLINDRICAL:
        return [shift(axis), turn(axis)]
    if joint.type is JointType.UNIVERSAL and joint.second_axis is not None:
        return [turn(axis), turn(joint.second_axis)]
    first = perpendicular(axis)
    return [shift(first), shift(np.cross(axis, first)), turn(axis)]


def start_rates(joint: Joint) -> tuple[float, ...]:
    """The rates a joint is given, in the order of ``joint_twists``."""
    if joint.type.is_scalar:
        return (joint.speed,)
    rates = []
    for twist in joint_twists(joint):
        turning = twist[:3].any()
        given = joint.angular_velocity @ twist[:3] if turning else joint.velocity @ twist[3:]
        rates.append(float(given))
    return tuple(rates)


def analyse_loops(assembly: Assembly, tree: KinematicTree) -> LoopAnalysis:
    """Analyses the loops at the start.

    Raises:
        InputError: a loop is overconstrained, so that its forces are not determined.
    """
    joints = [joint for joint in assembly.joints if joint.type is not JointType.FREE]
    loops = {joint.name: fundamental_loop(joint, tree) for joint in tree.cut_joints}
    planar = frozenset(
        joint.name for joint in tree.cut_joints if joint.type is JointType.REVOLUTE and _is_planar(loops[joint.name])
    )
    # Candidates for dependence: coordinates of cut joints first, then of joints listed late.
    cut = {joint.name for joint in tree.cut_joints}
    rank_order = [joint for joint in joints if joint.name in cut] + [j for j in reversed(joints) if j.name not in cut]
    columns: list[tuple[Joint, int]] = [(joint, k) for joint in rank_order for k in range(len(joint_twists(joint)))]
    matrix = _loop_matrix(loops, columns, _length(assembly))
    dependent = _basis(matrix)
    expected = sum(PLANAR_EQUATIONS if name in planar else SPATIAL_EQUATIONS for name in loops)
    if len(dependent) < expected:
        raise _overconstrained(tree.cut_joints, planar, expected - len(dependent))
    return LoopAnalysis(planar, *_independence(joints, columns, dependent, matrix, cut))


def fundamental_loop(joint: Joint, tree: KinematicTree) -> list[tuple[Joint, float]]:
    """The joints of the loop that a cut joint closes, each with +1 if passed from parent to child, else -1."""
    up = _path_to_root(joint.parent, tree)
    down = _path_to_root(joint.child, tree)
    while up and down and up[-1][0] is down[-1][0]:
        up.pop()
        down.pop()
    return [(joint, 1.0), *((j, sign) for j, sign in down), *((j, -sign) for j, sign in reversed(up))]


def _path_to_root(name: str, tree: KinematicTree) -> list[tuple[Joint, float]]:
    """Joints from a part to its root; the sign is that of walking towards the root."""
    path = []
    current: str | None = name
    while current is not None and current != GROUND:
        branch = tree.branch(current)
        if branch.joint is not None:
            path.append((branch.joint, -1.0 if branch.joint.child == current else 1.0))
        current = branch.predecessor
    return path


def _is_planar(loop: list[tuple[Joint, float]]) -> bool:
    """Whether all joints of the loop move in planes at a right angle to one direction."""
    normal = loop[0][0].axis
    if normal is None:
        return False
    for joint, _ in loop:
        if joint.type is JointType.FIXED:
            continue
        if joint.axis is None or joint.type not in (JointType.REVOLUTE, JointType.PRISMATIC):
            return False
        along = abs(float(joint.axis @ normal))
        wanted = 1.0 if joint.type is JointType.REVOLUTE else 0.0
        if abs(along - wanted) > PARALLEL_TOLERANCE:
            return False
    return True


def _length(assembly: Assembly) -> float:
    """A length to compare rotations with displacements."""
    points = np.array([joint.origin for joint in assembly.joints])
    return max(float(np.linalg.norm(np.ptp(points, axis=0))), 1e-6) if len(points) else 1.0


def _loop_matrix(loops: dict[str, list[tuple[Joint, float]]], columns: list[tuple[Joint, int]], length: float) -> Array:
    scale = np.array([1.0, 1.0, 1.0, 1 / length, 1 / length, 1 / length])
    position = {(joint.name, k): column for column, (joint, k) in enumerate(columns)}
    matrix = np.zeros((SPATIAL_EQUATIONS * len(loops), len(columns)))
    for row, loop in enumerate(loops.values()):
        center = np.mean([joint.origin for joint, _ in loop], axis=0)
        for joint, sign in loop:
            for k, twist in enumerate(joint_twists(joint)):
                # Velocity at the loop's middle instead of the world's origin keeps far mechanisms well conditioned.
                moved = np.concatenate([twist[:3], twist[3:] + np.cross(twist[:3], center)])
                entry = slice(SPATIAL_EQUATIONS * row, SPATIAL_EQUATIONS * (row + 1))
                matrix[entry, position[joint.name, k]] += sign * moved * scale
    return matrix


def _basis(matrix: Array) -> list[int]:
    """Columns, first come first served, that are linearly independent of the ones taken before."""
    taken: list[int] = []
    directions: list[Array] = []
    for column in range(matrix.shape[1]):
        rest = matrix[:, column].copy()
        size = float(np.linalg.norm(rest))
        for _ in range(2):
            for direction in directions:
                rest -= (direction @ rest) * direction
        remaining = float(np.linalg.norm(rest))
        if size > 0.0 and remaining > RANK_TOLERANCE * size:
            directions.append(rest / remaining)
            taken.append(column)
    return taken


def _independence(
    joints: list[Joint], columns: list[tuple[Joint, int]], dependent: list[int], matrix: Array, cut: set[str]
) -> tuple[dict[str, tuple[bool, ...]], dict[str, tuple[float, ...]], tuple[str, ...]]:
    given = {joint.name: list(start_rates(joint)) for joint in joints}
    rates = np.array([given[joint.name][k] for joint, k in columns])
    free = [column for column in range(len(columns)) if column not in set(dependent)]
    if dependent:
        solution, *_ = np.linalg.lstsq(matrix[:, dependent], -matrix[:, free] @ rates[free], rcond=None)
        followed = dict(zip(dependent, solution, strict=True))
    else:
        followed = {}
    independent = {joint.name: [True] * len(joint_twists(joint)) for joint in joints}
    notes = []
    for column, value in followed.items():
        joint, k = columns[column]
        independent[joint.name][k] = False
        if given[joint.name][k] != 0.0 and abs(value - given[joint.name][k]) > 1e-6 * max(1.0, abs(value)):
            notes.append(
                f"joint {joint.name!r}: its start speed follows from a loop ({value:.4g}); the one given was ignored"
            )
        given[joint.name][k] = float(value)
    notes += [f"joint {joint.name!r} closes a kinematic loop" for joint in joints if joint.name in cut]
    return (
        {name: tuple(flags) for name, flags in independent.items()},
        {name: tuple(values) for name, values in given.items()},
        tuple(notes),
    )


def _overconstrained(cut_joints: tuple[Joint, ...], planar: frozenset[str], surplus: int) -> InputError:
    joint = next((joint for joint in cut_joints if joint.name not in planar), cut_joints[0])
    return InputError(
        f"the loop that the joint {joint.name!r} closes is overconstrained {surplus} time{'s' if surplus > 1 else ''}: "
        "the forces in it are not determined by rigid bodies",
        place=joint.place,
        remedy="Give one of its joints more freedom (spherical instead of revolute, cylindrical instead of prismatic), "
        "or start in a configuration that is not singular.",
    )
