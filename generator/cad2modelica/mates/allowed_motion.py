"""Which motions mates leave to one body against another: a space of twists at the start.

A twist here is a turn (rad) and a shift (in units of the mechanism's size) at a reference point, shape (6,).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cad2modelica.geometry.spatial import Array, Pose, rotation_about
from cad2modelica.mates.mate_equation import MateEquation

STEP = 1e-5  # rad, sizes; of the central difference
RANK_TOLERANCE = 1e-5  # what exports round must not look like a condition


@dataclass(frozen=True, eq=False)
class MatedPair:
    """Two bodies and the mates between them.

    Attributes:
        mates: equations with features in the bodies' axes; first and second body as here.
        first, second: poses of the bodies at the start.
        reference: point near the mates, world, shape (3,), m.
        size: of the mechanism, m.
    """

    mates: tuple[MateEquation, ...]
    first: Pose
    second: Pose
    reference: Array
    size: float

    def values(self, second: Pose) -> Array:
        """What the mates make of a pose of the second body: zeros if it fulfils them."""
        return np.concatenate([mate.values(self.first, second, self.size) for mate in self.mates])


@dataclass(frozen=True, eq=False)
class TwistSpace:
    """Orthonormal bases of a space of twists.

    Attributes:
        twists: all, shape (n, 6).
        shifts: directions of those without a turn, shape (t, 3).
        turns: directions about which there is a turn, shape (n - t, 3).
    """

    twists: Array
    shifts: Array
    turns: Array


def mated_pair(mates: Sequence[MateEquation], first: Pose, second: Pose, size: float) -> MatedPair:
    """The pair, with a reference point in the middle of the mates."""
    points = [mate.second.at(second).point for mate in mates]
    return MatedPair(tuple(mates), first, second, np.mean(points, axis=0), size)


def allowed_twists(pair: MatedPair) -> TwistSpace:
    """The motions of the second body that keep all mates, to first order."""
    columns = []
    for k in range(6):
        twist = np.zeros(6)
        twist[k] = STEP
        ahead, behind = (pair.values(moved(pair.second, sign * twist, pair)) for sign in (1.0, -1.0))
        columns.append((ahead - behind) / (2 * STEP))
    jacobian = np.array(columns).T
    return _space(_null_space(jacobian))


def moved(pose: Pose, twist: Array, pair: MatedPair) -> Pose:
    """The pose after a turn about the reference point and a shift."""
    angle = float(np.linalg.norm(twist[:3]))
    rotation = rotation_about(twist[:3], angle) if angle > 0 else np.eye(3)
    position = pair.reference + rotation @ (pose.position - pair.reference) + twist[3:] * pair.size
    return Pose(position, rotation @ pose.rotation)


def _null_space(matrix: Array) -> Array:
    _, values, right = np.linalg.svd(matrix)
    rank = int((values > RANK_TOLERANCE).sum())
    return right[rank:]


def _space(twists: Array) -> TwistSpace:
    if not len(twists):
        return TwistSpace(twists, np.zeros((0, 3)), np.zeros((0, 3)))
    left, values, right = np.linalg.svd(twists[:, :3])
    rank = int((values > RANK_TOLERANCE).sum())
    shifts = left.T[rank:] @ twists  # combinations without a turn
    return TwistSpace(twists, _rounded(shifts[:, 3:]), _rounded(right[:rank]))


def _rounded(directions: Array) -> Array:
    """The same span by coordinate axes where they lie in it, so that joints have the axes one expects."""
    if not len(directions):
        return directions.reshape(0, 3)
    projector = directions.T @ directions
    chosen = [axis for axis in np.eye(3) if np.linalg.norm(projector @ axis - axis) < RANK_TOLERANCE]
    if len(chosen) < len(directions):
        left = projector - sum((np.outer(axis, axis) for axis in chosen), np.zeros((3, 3)))
        _, _, right = np.linalg.svd(left)
        chosen += list(right[: len(directions) - len(chosen)])
    return np.array([_main_positive(axis) for axis in chosen])


def _main_positive(axis: Array) -> Array:
    """The direction whose largest component is positive."""
    main = axis[int(np.argmax(np.abs(axis) > np.abs(axis).max() - 1e-9))]
    return np.asarray((axis if main > 0 else -axis) / np.linalg.norm(axis))
