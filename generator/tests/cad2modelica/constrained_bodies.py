"""Mechanisms as free bodies with constraint forces: an independent reference for what generated models do.

Newton's and Euler's equations of every part in maximal coordinates; a joint is a set of scalar conditions between two
bodies. Of dependent conditions the smallest forces are taken, so that loops may have as many as they like; no spanning
tree, cut joint, choice of conditions, reduction of index or state selection is shared with what is tested.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from cad2modelica.mechanism.model import Assembly, Joint, JointType
from joint_conditions import Condition, JointConditions, Side
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

RANK = 1e-7  # singular values smaller than this part of the largest are those of dependent conditions
SQUARED_RANK = 1e-11  # likewise of the conditions' products with each other


@dataclass(frozen=True)
class Motion:
    """Where bodies are, by part: centres of mass (times, 3) and rotations into the world (times, 3, 3)."""

    position: Mapping[str, np.ndarray]
    rotation: Mapping[str, np.ndarray]
    gap: float  # largest condition that the integration left open, m or rad


class ConstrainedBodies:
    """The parts of an assembly, held by its joints; no limits, friction or contacts.

    Args:
        assembly: the mechanism; only what its reader understood is used.
    """

    def __init__(self, assembly: Assembly) -> None:
        self._parts = [part for part in assembly.parts if not part.grounded]
        self._index = {part.name: number for number, part in enumerate(self._parts)}
        self._assembly = assembly
        self._masses = np.array([part.mass_properties.mass for part in self._parts])
        self._inertias = [part.mass_properties.inertia for part in self._parts]
        self._turns = [part.pose.rotation for part in self._parts]
        self._centers = [part.pose.point(part.mass_properties.center_of_mass) for part in self._parts]
        self._begin = np.concatenate([*self._centers, *(Rotation.from_matrix(turn).as_quat() for turn in self._turns)])
        self._held = JointConditions([item for joint in assembly.joints for item in self._of(joint)], len(self._parts))
        self._constants = self._held.values(*self._poses(self._begin))

    def simulate(
        self, speeds: Mapping[str, float], times: Sequence[float], free: Sequence[str] = (), tolerance: float = 1e-10
    ) -> Motion:
        """Motion from the start.

        Args:
            speeds: of revolute, screw (angle) and prismatic joints; with the conditions they must determine all.
                None at all: at rest.
            times: from 0 on.
            free: parts that start with the speed of their own that the assembly gives them.
            tolerance: of the integration.
        """
        return self.integrate(self._speeds(speeds, free), times, tolerance)

    def integrate(self, speed: np.ndarray, times: Sequence[float], tolerance: float = 1e-10) -> Motion:
        """Motion from the start, with the velocities of all centres of mass and angular velocities, (6 bodies,)."""
        rows, _ = self._equations(self._begin, np.zeros(6 * len(self._parts)))
        assert np.abs(rows @ speed).max(initial=0.0) < 1e-7
        count = len(self._begin)
        solution = solve_ivp(
            lambda _t, state: np.concatenate(
                [self._kinematics(state[:count], state[count:]), self._accelerations(state[:count], state[count:])]
            ),
            (times[0], times[-1]),
            np.append(self._begin, speed),
            method="DOP853",
            t_eval=times,
            rtol=tolerance,
            atol=tolerance / 10,
        )
        assert solution.success, solution.message
        poses = solution.y[:count].T
        gap = max(float(np.abs(self._gaps(pose)).max(initial=0.0)) for pose in poses)
        bodies = len(self._parts)
        position = {part.name: poses[:, 3 * k : 3 * k + 3] for k, part in enumerate(self._parts)}
        quaternions = poses[:, 3 * bodies :].reshape(len(times), bodies, 4)
        rotation = {part.name: Rotation.from_quat(quaternions[:, k]).as_matrix() for k, part in enumerate(self._parts)}
        return Motion(position, rotation, gap)

    def _speeds(self, speeds: Mapping[str, float], free: Sequence[str]) -> np.ndarray:
        rows, _ = self._equations(self._begin, np.zeros(6 * len(self._parts)))
        wanted = [self._rate(joint) for joint in self._assembly.joints if joint.name in speeds]
        given = [speeds[joint.name] for joint in self._assembly.joints if joint.name in speeds]
        for name in free:
            k, part = self._index[name], self._assembly.part(name)
            wanted += list(np.eye(6 * len(self._parts))[6 * k : 6 * k + 6])
            arm = part.pose.direction(part.mass_properties.center_of_mass)
            given += [*(part.velocity + np.cross(part.angular_velocity, arm)), *part.angular_velocity]
        matrix = np.vstack([rows, *wanted])
        begin, _, rank, _ = np.linalg.lstsq(matrix, np.append(np.zeros(len(rows)), given), rcond=RANK)
        assert not wanted or rank == matrix.shape[1], f"{matrix.shape[1] - rank} speeds are not given"
        assert np.abs(matrix @ begin - np.append(np.zeros(len(rows)), given)).max() < 1e-9
        return np.asarray(begin)

    # ----- what a joint holds -----

    def _side(self, name: str, point: np.ndarray, axes: np.ndarray) -> Side:
        if name not in self._index:
            return Side(None, point, axes)
        body = self._index[name]
        inverse = self._turns[body].T
        return Side(body, inverse @ (point - self._centers[body]), axes @ inverse.T)

    def _sides(self, joint: Joint) -> tuple[Side, Side]:
        n = joint.axis if joint.axis is not None else np.array([0.0, 0.0, 1.0])
        first = np.linalg.svd(n[None, :])[2][1]
        axes = np.array([first, np.cross(n, first), n])
        other = axes
        if joint.type is JointType.UNIVERSAL:
            assert joint.second_axis is not None
            other = np.array([first, np.cross(n, first), joint.second_axis])
        return self._side(joint.parent, joint.origin, axes), self._side(joint.child, joint.origin, other)

    def _of(self, joint: Joint) -> list[Condition]:
        first, second = self._sides(joint)
        x, y, n = 0, 1, 2

        def along(*axes: int) -> list[Condition]:
            return [Condition("along", first, second, a) for a in axes]

        def angle(*pairs: tuple[int, int]) -> list[Condition]:
            return [Condition("angle", first, second, a, b) for a, b in pairs]

        parallel = angle((x, n), (y, n))
        return {
            JointType.REVOLUTE: [*along(x, y, n), *parallel],
            JointType.PRISMATIC: [*along(x, y), *parallel, *angle((x, y))],
            JointType.CYLINDRICAL: [*along(x, y), *parallel],
            JointType.SCREW: [
                *along(x, y),
                *parallel,
                Condition("screw", first, second, n, n, joint.pitch / (2 * np.pi)),
            ],
            JointType.UNIVERSAL: [*along(x, y, n), *angle((n, n))],
            JointType.PLANAR: [*along(n), *parallel],
            JointType.SPHERICAL: along(x, y, n),
            JointType.FIXED: [*along(x, y, n), *parallel, *angle((x, y))],
            JointType.FREE: [],
        }[joint.type]

    # ----- bodies at a pose -----

    def _gaps(self, pose: np.ndarray) -> np.ndarray:
        return self._held.gaps(self._held.values(*self._poses(pose)), self._constants)

    def _poses(self, pose: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Rotations (bodies + 1, 3, 3) and centres; the last one is the world."""
        bodies = len(self._parts)
        turns = Rotation.from_quat(pose[3 * bodies :].reshape(bodies, 4)).as_matrix()
        centers = pose[: 3 * bodies].reshape(bodies, 3)
        return np.concatenate([turns, np.eye(3)[None]]), np.vstack([centers, np.zeros(3)])

    def _equations(self, pose: np.ndarray, speed: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Rows for the accelerations (conditions, 6 bodies), and what they must give."""
        return self._held.equations(*self._poses(pose), np.vstack([speed.reshape(-1, 6), np.zeros(6)]))

    def _rate(self, joint: Joint) -> np.ndarray:
        """A joint's rate by the bodies' velocities at the start, as a row."""
        row = np.zeros(6 * len(self._parts))
        assert joint.axis is not None
        for sign, side in zip((-1.0, 1.0), self._sides(joint), strict=True):
            if side.body is not None:
                if joint.type is JointType.PRISMATIC:
                    arm = self._turns[side.body] @ side.point
                    row[6 * side.body : 6 * side.body + 3] = sign * joint.axis
                    row[6 * side.body + 3 : 6 * side.body + 6] = sign * np.cross(arm, joint.axis)
                else:
                    row[6 * side.body + 3 : 6 * side.body + 6] = sign * joint.axis
        return row

    # ----- motion -----

    def _accelerations(self, pose: np.ndarray, speed: np.ndarray) -> np.ndarray:
        bodies = len(self._parts)
        turns = self._poses(pose)[0][:-1]
        inertias = turns @ np.array(self._inertias) @ turns.transpose(0, 2, 1)
        lighter = np.linalg.inv(inertias)
        spin = speed.reshape(-1, 6)[:, 3:]
        free = np.zeros((bodies, 6))
        free[:, :3] = self._assembly.gravity
        free[:, 3:] = -np.einsum("nij,nj->ni", lighter, np.cross(spin, np.einsum("nij,nj->ni", inertias, spin)))
        if not len(self._held):
            return free.ravel()
        rows, right = self._equations(pose, speed)
        blocks = rows.reshape(len(rows), bodies, 6)
        lightened = np.empty_like(blocks)
        lightened[:, :, :3] = blocks[:, :, :3] / self._masses[:, None]
        lightened[:, :, 3:] = np.einsum("cnj,nij->cni", blocks[:, :, 3:], lighter)
        matrix = lightened.reshape(len(rows), -1)
        forces, *_ = np.linalg.lstsq(rows @ matrix.T, right - rows @ free.ravel(), rcond=SQUARED_RANK)
        return np.asarray(free.ravel() + forces @ matrix)

    def _kinematics(self, pose: np.ndarray, speed: np.ndarray) -> np.ndarray:
        bodies = len(self._parts)
        spin = speed.reshape(-1, 6)[:, 3:]
        quaternion = pose[3 * bodies :].reshape(bodies, 4)
        vector, scalar = quaternion[:, :3], quaternion[:, 3:]
        change = np.hstack([scalar * spin + np.cross(spin, vector), -(spin * vector).sum(axis=1)[:, None]]) / 2
        return np.concatenate([speed.reshape(-1, 6)[:, :3].ravel(), change.ravel()])
