"""Motion of bodies with joints and forces: Newton's and Euler's equations of every body, with constraint forces.

Maximal coordinates: neither a tree of joints nor a choice of states nor a reduction of the index is shared with what is
compared.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import partial

import numpy as np
from joint_conditions import Condition, JointConditions, Side
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

Vector = np.ndarray
Matrix = np.ndarray
RATE = 1e-5  # s, over which speeds at the start are taken


@dataclass(frozen=True)
class Mass:
    """Of a body, about the origin of its frame and in its axes: m, m times centre of mass, inertia."""

    m: float
    moment: Vector
    inertia: Matrix

    def plus(self, other: Mass) -> Mass:
        return Mass(self.m + other.m, self.moment + other.moment, self.inertia + other.inertia)


def mass_at(m: float, center: Vector, inertia: Matrix) -> Mass:
    """A mass with its inertia about its centre."""
    return Mass(m, m * center, inertia + m * (center @ center * np.eye(3) - np.outer(center, center)))


@dataclass(frozen=True)
class Place:
    """A frame fixed in a body (None: in the world): origin and axes (columns) in the body's frame."""

    body: int | None
    origin: Vector
    axes: Matrix

    def moved(self, r: Vector, turn: Matrix) -> Place:
        return Place(self.body, self.origin + self.axes @ r, self.axes @ turn)


@dataclass(frozen=True)
class Seen:
    """A frame in motion, in the world: origin, axes, velocity of the origin, angular velocity."""

    r: Vector
    axes: Matrix
    v: Vector
    w: Vector


def condition(kind: str, first: Place, second: Place, a: Vector, b: Vector | None = None) -> Condition:
    """A scalar of two frames that stays; ``a`` is fixed in the first frame, ``b``, of angles, in the second."""
    sides = [
        Side(place.body, place.origin, np.tile(place.axes @ axis, (3, 1)))
        for place, axis in ((first, a), (second, a if b is None else b))
    ]
    return Condition(kind, sides[0], sides[1], 0)


@dataclass(frozen=True)
class Load:
    """Force at a point of a body and torque, in the world."""

    body: int | None
    point: Vector
    force: Vector
    torque: Vector


Look = Callable[[Place], Seen]
Force = Callable[[float, Look, Vector], Sequence[Load]]  # of time, frames and the angles of joints
Pose = tuple[Vector, Matrix]


@dataclass
class Mechanism:
    """Bodies, what holds and what drives them; ``turning``: frames and axes whose angle is followed from its start."""

    gravity: Callable[[Vector], Vector]
    masses: list[Mass] = field(default_factory=list)
    conditions: list[Condition] = field(default_factory=list)
    forces: list[Force] = field(default_factory=list)
    turning: list[tuple[Place, Place, Vector, float]] = field(default_factory=list)

    def motion(self, poses: Callable[[float], Sequence[Pose]], times: Sequence[float]) -> list[Look]:
        """Where frames are at the times, from poses near time 0 on; no condition may follow from the others."""
        start = np.concatenate([np.append(r, Rotation.from_matrix(turn).as_quat()) for r, turn in poses(0.0)])
        before, after = poses(-RATE), poses(RATE)
        speeds = []
        for (r0, turn0), (r1, turn1) in zip(before, after, strict=True):
            speeds += [(r1 - r0) / (2 * RATE), Rotation.from_matrix(turn1 @ turn0.T).as_rotvec() / (2 * RATE)]
        angles = [angle for *_, angle in self.turning]
        count = len(self.masses)
        solution = solve_ivp(
            partial(self._rates, JointConditions(self.conditions, count)),
            (0.0, times[-1]),
            np.concatenate([start, *speeds, angles]),
            method="DOP853",
            t_eval=times,
            rtol=1e-10,
            atol=1e-11,
        )
        assert solution.success, solution.message
        return [self.look(state[: 7 * count], state[7 * count : 13 * count]) for state in solution.y.T]

    def look(self, pose: Vector, speed: Vector) -> Look:
        """Frames at poses and speeds of all bodies, (7 bodies,) and (6 bodies,)."""
        turns = [Rotation.from_quat(pose[7 * k + 3 : 7 * k + 7]).as_matrix() for k in range(len(self.masses))]

        def seen(place: Place) -> Seen:
            if place.body is None:
                return Seen(place.origin, place.axes, np.zeros(3), np.zeros(3))
            k, turn = place.body, turns[place.body]
            arm = turn @ place.origin
            v, w = speed[6 * k : 6 * k + 3], speed[6 * k + 3 : 6 * k + 6]
            return Seen(pose[7 * k : 7 * k + 3] + arm, turn @ place.axes, v + np.cross(w, arm), w)

        return seen

    def _rates(self, held: JointConditions, time: float, state: Vector) -> Vector:
        count = len(self.masses)
        pose, speed, angles = np.split(state, [7 * count, 13 * count])
        look = self.look(pose, speed)
        rates = self._pose_rates(pose, speed)
        places = pose.reshape(-1, 7)
        turns = np.concatenate([Rotation.from_quat(places[:, 3:]).as_matrix(), np.eye(3)[None]])
        origins = np.vstack([places[:, :3], np.zeros(3)])
        rows, bias = held.equations(turns, origins, np.vstack([speed.reshape(-1, 6), np.zeros(6)]))
        matrix, right = self._newton_euler(time, look, angles)
        size = len(rows)
        full = np.block([[matrix, rows.T], [rows, np.zeros((size, size))]])
        accelerations = np.linalg.solve(full, np.concatenate([right, bias]))[: 6 * count]
        turned = [look(first).axes @ axis @ (look(second).w - look(first).w) for first, second, axis, _ in self.turning]
        return np.concatenate([rates, accelerations, turned])

    def _pose_rates(self, pose: Vector, speed: Vector) -> Vector:
        rates = np.zeros_like(pose)
        for k in range(len(self.masses)):
            x, y, z, s = pose[7 * k + 3 : 7 * k + 7]
            w = speed[6 * k + 3 : 6 * k + 6]
            rates[7 * k : 7 * k + 3] = speed[6 * k : 6 * k + 3]
            vector = np.array([x, y, z])
            rates[7 * k + 3 : 7 * k + 6] = 0.5 * (s * w + np.cross(w, vector))
            rates[7 * k + 6] = -0.5 * w @ vector
        return rates

    def _newton_euler(self, time: float, look: Look, angles: Vector) -> tuple[Matrix, Vector]:
        count = len(self.masses)
        matrix, right = np.zeros((6 * count, 6 * count)), np.zeros(6 * count)
        origins = [look(Place(k, np.zeros(3), np.eye(3))) for k in range(count)]
        for k, (mass, seen) in enumerate(zip(self.masses, origins, strict=True)):
            moment, inertia = seen.axes @ mass.moment, seen.axes @ mass.inertia @ seen.axes.T
            cross = np.array([[0, -moment[2], moment[1]], [moment[2], 0, -moment[0]], [-moment[1], moment[0], 0]])
            block = slice(6 * k, 6 * k + 6)
            matrix[block, block] = np.block([[mass.m * np.eye(3), -cross], [cross, inertia]])
            pull = self.gravity(seen.r + moment / mass.m)
            right[6 * k : 6 * k + 3] = mass.m * pull - np.cross(seen.w, np.cross(seen.w, moment))
            right[6 * k + 3 : 6 * k + 6] = np.cross(moment, pull) - np.cross(seen.w, inertia @ seen.w)
        for force in self.forces:
            for load in force(time, look, angles):
                if load.body is None:
                    continue
                k = 6 * load.body
                right[k : k + 3] += load.force
                right[k + 3 : k + 6] += load.torque + np.cross(load.point - origins[load.body].r, load.force)
        return matrix, right
