"""How loops move: positions by products of exponentials, and the way of a mechanism through closed positions.

Around a loop the displacements of its joints multiply to the identity (R. Brockett's product of exponentials; K. Lynch
and F. Park, Modern Robotics, 2017, chapters 4 and 5). From a closed position the mechanism is moved by small steps
along the null space of its loops' equations; each step is corrected by Gauss and Newton until all conditions hold.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from cad2modelica.geometry.spatial import Array, Pose, cross, rotation_about
from cad2modelica.kinematics.joint_twists import RANK_TOLERANCE, Column, independent_columns, joint_twists
from cad2modelica.kinematics.planar_loops import Loop

STEP = 0.05  # rad, or part of the mechanism's length: largest change of a coordinate in a step
STEPS = 64  # on each way from the start, a turn in all; fewer if there are many ways
FEWEST_STEPS = 8
CORRECTIONS = 30
TRIALS = 200  # of positions beside a singular one
CLOSED = 1e-10  # rad, or part of the mechanism's length: what a correction reaches where all conditions hold exactly
ROUNDED = 1e-4  # likewise: what a position may leave open, for exports round
CROSSING = 1e-8  # likewise: at a step's distance from a singular position
MOVED = 0.25  # part of a step that a correction must leave of it
DIRECTIONS = 4  # beside those of the null space's base, where there are several


@dataclass(frozen=True, eq=False)
class Position:
    """A closed position of coupled loops.

    Attributes:
        coordinates: displacements from the start, in the order of the columns; rad, m.
        matrix: for each loop, the twist of its end against its beginning by coordinate, world axes, about the world's
            origin, shape (6, columns).
        turned: for each loop, the displacement of the closing joint's child against its parent.
        gap: what is left open, rad or part of the length.
    """

    coordinates: Array
    matrix: tuple[Array, ...]
    turned: tuple[Pose, ...]
    gap: float


def scaled(matrix: Array, length: float) -> Array:
    """Twists whose displacements are divided by the length."""
    return np.vstack([matrix[:3], matrix[3:] / length])


class LoopMotion:
    """Positions of coupled loops.

    Args:
        loops: they share joints.
        columns: coordinates of all their joints.
        length: typical length of the mechanism, m.
    """

    def __init__(self, loops: Sequence[Loop], columns: Sequence[Column], length: float) -> None:
        number = {(joint.name, k): column for column, (joint, k) in enumerate(columns)}
        self._length = length
        self._count = len(columns)
        # The middle of the mechanism instead of the world's origin keeps far mechanisms well conditioned.
        self._middle = np.mean([joint.origin for loop in loops for joint, _ in loop.steps], axis=0)
        self._chains = [
            [
                (number[joint.name, k], sign * twist, place == 0)
                for place, (joint, sign) in enumerate(loop.steps)
                for k, twist in list(enumerate(joint_twists(joint)))[:: 1 if sign > 0 else -1]
            ]
            for loop in loops
        ]
        turning = [joint_twists(joint)[k][:3].any() for joint, k in columns]
        self._unit = np.where(np.array(turning, dtype=bool), 1.0, length)

    def start(self) -> Position:
        """The position at the start."""
        return self.position(np.zeros(self._count))

    def position(self, coordinates: Array) -> Position:
        """The position at given coordinates, closed or not."""
        matrices, turned, gaps = [], [], []
        for chain in self._chains:
            here = Pose(np.zeros(3), np.eye(3))
            closing = here
            matrix = np.zeros((6, self._count))
            for column, twist, closes in chain:
                matrix[:, column] += _moved(twist, here)
                here = here @ displacement(twist * coordinates[column])
                closing = here if closes else closing
            matrices.append(matrix)
            turned.append(closing)
            gaps.append(self._gap(here))
        gap = max((float(np.abs(item).max()) for item in gaps), default=0.0)
        return Position(coordinates, tuple(matrices), tuple(turned), gap)

    def ways(self) -> list[list[Position]]:
        """Closed positions from the start on, one list for each direction that was tried; empty where it is blocked."""
        begin = self.start()
        directions = self._directions(begin)
        steps = max(FEWEST_STEPS, 2 * STEPS // max(len(directions), 2))
        return [self._way(begin, direction, steps) for direction in directions]

    def beside(self) -> list[Position]:
        """Closed positions at the distance of a step from the start, for starts where ways are blocked.

        Several motions may cross in a singular position, and their directions are not those of the null space's base.
        """
        begin = self.start()

        def residual(scaled_coordinates: Array) -> Array:
            away = (scaled_coordinates @ scaled_coordinates) / STEP**2 - 1.0
            return np.append(STEP * away, self._gaps(scaled_coordinates * self._unit))

        def slope(scaled_coordinates: Array) -> Array:
            here = self.position(scaled_coordinates * self._unit)
            return np.vstack([2 * scaled_coordinates / STEP, self._equations(here)])

        found = []
        for direction in self._directions(begin):
            guess = direction * STEP / np.linalg.norm(direction)
            solution = least_squares(residual, guess, slope, xtol=1e-15, ftol=1e-15, gtol=1e-15, max_nfev=TRIALS)
            if np.abs(solution.fun).max() < CROSSING:
                found.append(self.position(solution.x * self._unit))
        return found

    def rank(self, position: Position) -> int:
        """How many of all loops' conditions are independent at a position."""
        return len(independent_columns(self._equations(position)))

    def _directions(self, begin: Position) -> list[Array]:
        free = self.null_space(begin)
        generator = np.random.default_rng(0)
        mixed = (
            [free @ generator.standard_normal(free.shape[1]) for _ in range(DIRECTIONS)] if free.shape[1] > 1 else []
        )
        return [sign * direction for direction in [*free.T, *mixed] for sign in (1.0, -1.0)]

    def _way(self, begin: Position, direction: Array, steps: int) -> list[Position]:
        way: list[Position] = []
        here = begin
        for _ in range(steps):
            step = direction * (STEP / np.abs(direction).max()) * self._unit
            following = self._closed(here.coordinates + step)
            moved = np.abs((following.coordinates - here.coordinates) / self._unit).max()
            if following.gap > ROUNDED or moved < MOVED * STEP or moved > 4 * STEP:
                break
            way.append(following)
            free = self.null_space(following)
            # On along the null space, as straight as it allows.
            direction = free @ (free.T @ ((following.coordinates - here.coordinates) / self._unit))
            here = following
            if not np.abs(direction).max() > 0:
                break
        return way

    def _closed(self, coordinates: Array) -> Position:
        here = self.position(coordinates)
        for _ in range(CORRECTIONS):
            if here.gap < CLOSED:
                break
            change, *_ = np.linalg.lstsq(self._equations(here), -self._gaps(here.coordinates), rcond=RANK_TOLERANCE)
            following = self.position(here.coordinates + change * self._unit)
            if following.gap >= here.gap:
                break
            here = following
        return here

    def _gaps(self, coordinates: Array) -> Array:
        return np.concatenate([self._gap(self._end(chain, coordinates)) for chain in self._chains])

    def _end(self, chain: list[tuple[int, Array, bool]], coordinates: Array) -> Pose:
        here = Pose(np.zeros(3), np.eye(3))
        for column, twist, _ in chain:
            here = here @ displacement(twist * coordinates[column])
        return here

    def _gap(self, end: Pose) -> Array:
        """Small turn and shift, by length, that is left when a loop has been walked round."""
        turn = end.rotation - end.rotation.T
        shift = (end.point(self._middle) - self._middle) / self._length
        return np.array([turn[2, 1] / 2, turn[0, 2] / 2, turn[1, 0] / 2, *shift])

    def _equations(self, position: Position) -> Array:
        """Turns and shifts of all loops' ends by scaled coordinate."""
        rows = [scaled(_about(matrix, self._middle), self._length) for matrix in position.matrix]
        return np.vstack(rows) * self._unit

    def null_space(self, position: Position) -> Array:
        """Scaled coordinates that keep all loops closed, as orthonormal columns."""
        equations = self._equations(position)
        rank = len(independent_columns(equations))
        # The triangular factor has the same null space, and far fewer rows where loops are many.
        return np.asarray(np.linalg.svd(np.linalg.qr(equations, mode="r"))[2][rank:].T)


def displacement(twist: Array) -> Pose:
    """The finite motion that a twist makes in unit time: the exponential on SE(3)."""
    turn, shift = twist[:3], twist[3:]
    angle = float(np.linalg.norm(turn))
    if angle < 1e-12:
        return Pose(shift, np.eye(3))
    axis = turn / angle
    rotation = rotation_about(axis, angle)
    pitch = float(axis @ shift) / angle
    point = cross(axis, shift) / angle
    return Pose(point - rotation @ point + pitch * angle * axis, rotation)


def _moved(twist: Array, pose: Pose) -> Array:
    """A twist in the outer coordinates of a pose."""
    turn = pose.rotation @ twist[:3]
    return np.concatenate([turn, pose.rotation @ twist[3:] + cross(pose.position, turn)])


def _about(matrix: Array, point: Array) -> Array:
    """Twists as columns, with the velocity at a point instead of the origin."""
    return np.vstack([matrix[:3], matrix[3:] + np.cross(matrix[:3].T, point).T])
