"""Start positions that do not fit: gaps of joints that both parts describe, and a least-squares step to close them.

A joint's parent says where its point and axis are, and so may its child. In the start configuration both must agree in
what the joint does not leave free. Where they do not, the parts can be moved: small motions of all parts, as small as
possible by least squares, that close all joints to first order (Gauss and Newton), repeated until they fit.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from contact_foundation.errors import InputError, Place
from numpy.typing import NDArray
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import lsmr
from scipy.spatial.transform import Rotation

from cad2modelica.geometry.spatial import IDENTITY, Array, Pose, perpendicular
from cad2modelica.kinematics.kinematic_graph import KinematicTree
from cad2modelica.kinematics.loops import mechanism_length
from cad2modelica.mechanism.model import GROUND, Assembly, Joint, JointType
from cad2modelica.source.problems import Problems

NOTED = 1e-9  # m or rad: parts that were moved by less are no note
POSITION_TOLERANCE = 1e-5  # of the mechanism's size: exports round
ANGLE_TOLERANCE = 1e-4  # rad
CLOSED = 1e-12  # of the mechanism's size, rad: where the iteration ends
MAXIMUM_STEPS = 60


@dataclass(frozen=True, eq=False)
class _Sides:
    """A joint in the coordinates of its parts, in their poses as exported.

    Attributes:
        relative: rotation of the child against the parent that fixed and prismatic joints keep.
    """

    joint: Joint
    parent_point: Array
    child_point: Array
    parent_axis: Array
    child_axis: Array
    second_axis: Array
    relative: Array


def require_closed(assembly: Assembly) -> None:
    """Checks that all joints fit in the start configuration.

    Raises:
        InputError: joints do not; each with its gap; a ``ProblemList`` if there are several.
    """
    length = mechanism_length(assembly)
    poses = {part.name: part.pose for part in assembly.parts}
    problems = Problems(str(assembly.file))
    for joint in assembly.joints:
        if joint.child_origin is None and joint.child_axis is None:
            continue
        angle, distance = _size(_gap(_sides(joint, poses), poses))
        if distance > POSITION_TOLERANCE * length or angle > ANGLE_TOLERANCE:
            problems.add(
                f"the joint {joint.name!r} does not close at the start: its parts are {1000 * distance:.4g} mm and "
                f"{np.degrees(angle):.4g} degrees apart",
                joint.place,
                "Correct the poses, or let --assemble move the parts together.",
            )
    problems.raise_if_any()


def assembled(assembly: Assembly, tree: KinematicTree) -> Assembly:
    """The assembly with its parts moved so that all joints close.

    Fixed parts stay, and so does the relative pose of parts that a fixed joint joins. Start positions of revolute,
    screw and prismatic joints change with the parts.

    Raises:
        InputError: there is no such position near the exported one.
    """
    before = {part.name: part.pose for part in assembly.parts}
    sides = [_sides(joint, before) for joint in assembly.joints if joint.type is not JointType.FREE]
    length = mechanism_length(assembly)
    moving = {name: k for k, name in enumerate(part.name for part in assembly.parts if part.name not in tree.fixed)}
    poses = dict(before)
    for _ in range(MAXIMUM_STEPS):
        gaps = [_size(_gap(side, poses)) for side in sides]
        worst = max((angle + distance / length for angle, distance in gaps), default=0.0)
        if worst < CLOSED:
            return _with_poses(assembly, sides, before, poses)
        poses = _step(sides, poses, moving, length)
    left = max(range(len(sides)), key=lambda k: gaps[k][0] + gaps[k][1] / length)
    angle, distance = gaps[left]
    raise InputError(
        f"the parts cannot be assembled: the joint {sides[left].joint.name!r} keeps a gap of "
        f"{1000 * distance:.4g} mm and {np.degrees(angle):.4g} degrees",
        place=sides[left].joint.place or Place(file=assembly.file),
        remedy="Check the lengths of the parts: no position near the exported one closes all joints.",
    )


def _pose(name: str, poses: Mapping[str, Pose]) -> Pose:
    return IDENTITY if name == GROUND else poses[name]


def _sides(joint: Joint, poses: Mapping[str, Pose]) -> _Sides:
    parent, child = _pose(joint.parent, poses), _pose(joint.child, poses)
    axis = joint.axis if joint.axis is not None else np.array([0.0, 0.0, 1.0])
    other = joint.child_axis if joint.child_axis is not None else axis
    second = joint.second_axis if joint.second_axis is not None else perpendicular(axis)
    point = joint.child_origin if joint.child_origin is not None else joint.origin
    # The smallest rotation that lays the child's axis on the parent's.
    turn, _ = Rotation.align_vectors([axis], [other])
    return _Sides(
        joint,
        parent.inverse().point(joint.origin),
        child.inverse().point(point),
        parent.rotation.T @ axis,
        child.rotation.T @ other,
        child.rotation.T @ second,
        parent.rotation.T @ turn.as_matrix() @ child.rotation,
    )


def _gap(side: _Sides, poses: Mapping[str, Pose]) -> tuple[Array, Array, Array]:
    """Constrained directions of the child's turns and shifts, shape (n, 6), what is missing along them, and where."""
    parent, child = _pose(side.joint.parent, poses), _pose(side.joint.child, poses)
    point, other = parent.point(side.parent_point), child.point(side.child_point)
    axis, own = parent.direction(side.parent_axis), child.direction(side.child_axis)
    shift, turn = point - other, np.cross(own, axis)
    first = perpendicular(axis)
    second = np.cross(axis, first)
    kind = side.joint.type
    turns: list[Array] = []
    shifts: list[Array] = []
    if kind in (JointType.FIXED, JointType.PRISMATIC):
        turn = Rotation.from_matrix(parent.rotation @ side.relative @ child.rotation.T).as_rotvec()
        turns = list(np.eye(3))
    elif kind in (JointType.REVOLUTE, JointType.CYLINDRICAL, JointType.SCREW, JointType.PLANAR):
        turns = [first, second]
    elif kind is JointType.UNIVERSAL:
        turns = [np.cross(child.direction(side.second_axis), axis)]
        turn = -float(axis @ child.direction(side.second_axis)) * turns[0]
    if kind in (JointType.PRISMATIC, JointType.CYLINDRICAL):
        shifts = [first, second]
    elif kind is JointType.PLANAR:
        shifts = [axis]
    else:
        shifts = list(np.eye(3))
    none = np.zeros(3)
    rows = [np.concatenate([row, none]) for row in turns]
    if kind is JointType.SCREW:
        lead = side.joint.pitch / (2 * np.pi)
        rows += [np.concatenate([none, first]), np.concatenate([none, second]), np.concatenate([-lead * axis, axis])]
    else:
        rows += [np.concatenate([none, row]) for row in shifts]
    matrix = np.array(rows)
    return matrix, matrix @ np.concatenate([turn, shift]), other


def _size(gap: tuple[Array, Array, Array]) -> tuple[float, float]:
    """Angle (rad) and distance (m) of a gap in the constrained directions."""
    matrix, missing, _ = gap
    turning = np.abs(matrix[:, :3]).sum(axis=1) > np.abs(matrix[:, 3:]).sum(axis=1)
    return float(np.linalg.norm(missing[turning])), float(np.linalg.norm(missing[~turning]))


def _step(sides: Sequence[_Sides], poses: dict[str, Pose], moving: Mapping[str, int], length: float) -> dict[str, Pose]:
    """Moves all parts by the smallest motions that close all joints to first order."""
    rows: list[NDArray[np.intp]] = []
    columns: list[NDArray[np.intp]] = []
    values: list[Array] = []
    right: list[Array] = []
    count = 0
    for side in sides:
        matrix, missing, point = _gap(side, poses)
        # Twist at the world's origin to turn and shift at the joint; turns are scaled to lengths.
        x, y, z = point
        at = np.eye(6)
        at[3:, :3] = np.array([[0, z, -y], [-z, 0, x], [y, -x, 0]])
        at[:, :3] /= length
        weights = np.where(np.abs(matrix[:, :3]).sum(axis=1) > 0, length, 1.0)
        block = (matrix * weights[:, None]) @ at
        for name, sign in ((side.joint.child, 1.0), (side.joint.parent, -1.0)):
            if name in moving:
                row, column = np.meshgrid(
                    np.arange(len(matrix)) + count, np.arange(6) + 6 * moving[name], indexing="ij"
                )
                rows.append(row.ravel())
                columns.append(column.ravel())
                values.append((sign * block).ravel())
        right.append(missing * weights)
        count += len(matrix)
    if not values:
        return poses
    system = coo_matrix(
        (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape=(count, 6 * len(moving))
    ).tocsr()
    target = np.concatenate(right)
    if system.shape[0] * system.shape[1] <= 4_000_000:
        solution, *_ = np.linalg.lstsq(system.toarray(), target, rcond=1e-10)
    else:
        solution = lsmr(system, target, atol=1e-14, btol=1e-14, maxiter=20_000)[0]
    moved = dict(poses)
    for name, number in moving.items():
        turn, shift = solution[6 * number : 6 * number + 3] / length, solution[6 * number + 3 : 6 * number + 6]
        rotation = Rotation.from_rotvec(turn).as_matrix()
        pose = poses[name]
        moved[name] = Pose(rotation @ pose.position + shift, rotation @ pose.rotation)
    return moved


def _with_poses(
    assembly: Assembly, sides: Sequence[_Sides], before: Mapping[str, Pose], after: Mapping[str, Pose]
) -> Assembly:
    by_name = {side.joint.name: side for side in sides}
    joints = tuple(
        _moved_joint(by_name[joint.name], before, after) if joint.name in by_name else joint
        for joint in assembly.joints
    )
    notes = []
    for name, pose in after.items():
        way = float(np.linalg.norm(pose.position - before[name].position))
        turn = float(Rotation.from_matrix(pose.rotation @ before[name].rotation.T).magnitude())
        if way > NOTED or turn > NOTED:
            moved = f"moved by {1000 * way:.4g} mm and turned by {np.degrees(turn):.4g} degrees"
            notes.append(f"part {name!r} was {moved} to close the joints")
    parts = tuple(replace(part, pose=after[part.name]) for part in assembly.parts)
    return replace(assembly, parts=parts, joints=joints, notes=(*assembly.notes, *notes))


def _moved_joint(side: _Sides, before: Mapping[str, Pose], after: Mapping[str, Pose]) -> Joint:
    joint = side.joint
    parent, child = _pose(joint.parent, after), _pose(joint.child, after)
    axis = parent.direction(side.parent_axis)
    old_parent, old_child = _pose(joint.parent, before), _pose(joint.child, before)
    position = joint.position
    if joint.type is JointType.PRISMATIC:
        new = parent.inverse().point(child.point(side.child_point)) @ side.parent_axis
        old = old_parent.inverse().point(old_child.point(side.child_point)) @ side.parent_axis
        position += float(new - old)
    elif joint.is_turning:
        change = parent.rotation.T @ child.rotation @ (old_parent.rotation.T @ old_child.rotation).T
        position += float(Rotation.from_matrix(change).as_rotvec() @ side.parent_axis)
    # Sliding joints keep their point on the child's side of the way.
    origin = parent.point(side.parent_point)
    if joint.type in (JointType.PRISMATIC, JointType.CYLINDRICAL, JointType.PLANAR):
        free = child.point(side.child_point) - origin
        origin = origin + (free if joint.type is not JointType.PLANAR else free - (free @ axis) * axis)
    return replace(
        joint,
        origin=origin,
        axis=axis if joint.axis is not None else None,
        second_axis=child.direction(side.second_axis) if joint.second_axis is not None else None,
        position=position,
        child_origin=None,
        child_axis=None,
    )
