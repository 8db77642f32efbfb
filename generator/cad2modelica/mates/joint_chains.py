"""Joints, one or several in a row, that move as mates allow.

The mates' twist space says which shifts and turns there are; chains of joints that have them are tried in the order of
their simplicity, and one counts only if the mates hold in positions far from the start too: two bodies that touch along
a curve have the twists of some joint, but not its motion.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import permutations, product

import numpy as np

from cad2modelica.geometry.spatial import Array, Pose, perpendicular, rotation_about
from cad2modelica.mates.allowed_motion import MatedPair, TwistSpace, allowed_twists
from cad2modelica.mechanism.model import JointType

HELD = 1e-6  # rad, sizes: how far mates may be from fulfilled on the way
POSITIONS = ((0.3, -0.2, 0.25, 0.15, -0.35), (-0.5, 0.4, -0.1, 0.3, 0.2))  # rad, or tenths of the size
SHIFT = 0.1  # of the size at a coordinate of one
ON_AXIS = 1e-6


@dataclass(frozen=True, eq=False)
class ChainJoint:
    """A joint of a chain at the start, in the world; the axis is the normal of a planar joint."""

    type: JointType
    point: Array
    axis: Array


Chain = tuple[ChainJoint, ...]


def joint_chain(pair: MatedPair) -> Chain | None:
    """The joints from the first to the second body that move as the mates allow; () if there is no freedom at all.

    Returns:
        None if no chain of joints does.
    """
    for seen in (
        pair,
        replace(pair, reference=np.mean([mate.first.at(pair.first).point for mate in pair.mates], axis=0)),
    ):
        space = allowed_twists(seen)
        for chain in _candidates(seen, space):
            if sum(joint.type.freedoms for joint in chain) == len(space.twists) and _holds(chain, seen):
                return chain
    return None


def _candidates(pair: MatedPair, space: TwistSpace) -> Iterator[Chain]:
    shifts, turns = space.shifts, space.turns
    slides = [ChainJoint(JointType.PRISMATIC, pair.reference, axis) for axis in shifts]
    if not len(turns):
        yield tuple(slides)
    elif len(turns) == 1:
        yield from _with_one_turn(pair, space, slides)
    elif len(turns) == 3:
        ball = _ball(pair, space)
        if ball is not None:
            yield from _orders([*slides, ball])
    else:
        yield from _with_two_turns(pair, space, slides)


def _with_one_turn(pair: MatedPair, space: TwistSpace, slides: Sequence[ChainJoint]) -> Iterator[Chain]:
    axis = space.turns[0]
    point = _point_of_axis(axis, pair, space)
    if point is None:
        return
    along = [slide for slide in slides if abs(slide.axis @ axis) > 1 - ON_AXIS]
    across = [slide for slide in slides if abs(slide.axis @ axis) < ON_AXIS]
    flat = len(across) == 2
    single = JointType.PLANAR if flat else JointType.CYLINDRICAL if along else JointType.REVOLUTE
    middle = ChainJoint(single, point, axis)
    if flat or along or not slides:
        rest = along if flat else [slide for slide in slides if slide not in along]
        yield from _orders([*rest, middle])
    yield from _orders([*slides, ChainJoint(JointType.REVOLUTE, point, axis)])


def _with_two_turns(pair: MatedPair, space: TwistSpace, slides: Sequence[ChainJoint]) -> Iterator[Chain]:
    """One turn about a direction of the first body, the other about one of the second."""
    first = _directions([mate.first.at(pair.first).axis for mate in pair.mates], space)
    second = _directions([mate.second.at(pair.second).axis for mate in pair.mates], space)
    for before, after in product([*first, *space.turns], [*second, *space.turns]):
        if np.linalg.norm(np.cross(before, after)) < ON_AXIS:
            continue
        turns = []
        for axis in (before, after):
            point = _point_of_axis(axis, pair, space)
            if point is None:
                break
            turns.append(ChainJoint(JointType.REVOLUTE, point, axis))
        if len(turns) < 2:
            continue
        yield (*slides, *turns)
        yield (turns[0], *slides, turns[1])
        yield (*turns, *slides)


def _orders(joints: Sequence[ChainJoint]) -> Iterator[Chain]:
    yield from permutations(joints)


def _directions(axes: Sequence[Array], space: TwistSpace) -> list[Array]:
    """Those of the directions about which there is a turn, each once."""
    projector = space.turns.T @ space.turns
    found: list[Array] = []
    for axis in axes:
        turns = np.linalg.norm(projector @ axis - axis) < ON_AXIS
        if turns and all(np.linalg.norm(np.cross(axis, other)) > ON_AXIS for other in found):
            found.append(axis)
    return found


def _shift_with(axis: Array, space: TwistSpace) -> Array | None:
    """The shift at the reference point that comes with a turn of one about an axis, without free shifts."""
    weights, *_ = np.linalg.lstsq(space.twists[:, :3].T, axis, rcond=None)
    twist = weights @ space.twists
    if np.linalg.norm(twist[:3] - axis) > ON_AXIS:
        return None
    shift = twist[3:]
    return np.asarray(shift - space.shifts.T @ (space.shifts @ shift))


def _point_of_axis(axis: Array, pair: MatedPair, space: TwistSpace) -> Array | None:
    """A point of the axis of a pure turn about a direction, up to free shifts; None if it is a screw's."""
    shift = _shift_with(axis, space)
    if shift is None:
        return None
    # shift + shifts.T w = -axis x p: least squares for the point p and the weights w.
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    matrix = np.hstack([-cross, -space.shifts.T])
    solution, *_ = np.linalg.lstsq(matrix, shift, rcond=1e-9)
    if np.linalg.norm(matrix @ solution - shift) > ON_AXIS:
        return None
    own = solution[:3] - (solution[:3] @ axis) * axis
    return np.asarray(pair.reference + own * pair.size)


def _ball(pair: MatedPair, space: TwistSpace) -> ChainJoint | None:
    """The point about which every turn is free, up to free shifts."""
    rows, right = [], []
    project = np.eye(3) - space.shifts.T @ space.shifts
    for axis in np.eye(3):
        shift = _shift_with(axis, space)
        if shift is None:
            return None
        x, y, z = axis
        rows.append(project @ -np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]))
        right.append(shift)
    matrix, target = np.vstack(rows), np.concatenate(right)
    point, *_ = np.linalg.lstsq(matrix, target, rcond=1e-9)
    if np.linalg.norm(matrix @ point - target) > ON_AXIS:
        return None
    return ChainJoint(JointType.SPHERICAL, pair.reference + point * pair.size, np.array([0.0, 0.0, 1.0]))


# ----- trying a chain -----


def _holds(chain: Chain, pair: MatedPair) -> bool:
    """Whether the mates are fulfilled where the chain leads."""
    return all(
        np.abs(pair.values(_reached(chain, pair, coordinates))).max(initial=0.0) < HELD for coordinates in POSITIONS
    )


def _reached(chain: Chain, pair: MatedPair, coordinates: Sequence[float]) -> Pose:
    """The second body's pose when the joints are moved: the last joint first, so that the others carry it."""
    values = [coordinates[k % len(coordinates)] for k in range(6)]
    pose = pair.second
    for joint in reversed(chain):
        for kind, axis in reversed(list(_motions(joint))):
            value = values.pop()
            if kind is JointType.PRISMATIC:
                pose = Pose(pose.position + SHIFT * value * pair.size * axis, pose.rotation)
            else:
                turn = rotation_about(axis, value)
                pose = Pose(joint.point + turn @ (pose.position - joint.point), turn @ pose.rotation)
    return pose


def _motions(joint: ChainJoint) -> Iterator[tuple[JointType, Array]]:
    """Single motions that a joint is made of, from the first body outwards."""
    across = perpendicular(joint.axis)
    if joint.type in (JointType.PRISMATIC, JointType.CYLINDRICAL):
        yield JointType.PRISMATIC, joint.axis
    if joint.type is JointType.PLANAR:
        yield JointType.PRISMATIC, across
        yield JointType.PRISMATIC, np.cross(joint.axis, across)
    if joint.type is JointType.SPHERICAL:
        for axis in np.eye(3):
            yield JointType.REVOLUTE, axis
    elif joint.type is not JointType.PRISMATIC:
        yield JointType.REVOLUTE, joint.axis
