"""Positions and rotations in space."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def _vector(value: ArrayLike) -> Array:
    array = np.array(value, dtype=np.float64)
    array.setflags(write=False)
    return array


@dataclass(frozen=True, eq=False)
class Pose:
    """Where an inner coordinate system stands in an outer one: ``outer = position + rotation @ inner``.

    Attributes:
        position: origin of the inner system, shape (3,), m.
        rotation: its axes as columns, shape (3, 3), a proper rotation.
    """

    position: Array
    rotation: Array

    def __post_init__(self) -> None:
        object.__setattr__(self, "position", _vector(self.position))
        object.__setattr__(self, "rotation", _vector(self.rotation))

    def __matmul__(self, inner: Pose) -> Pose:
        """The pose of what stands at ``inner`` in this system."""
        return Pose(self.position + self.rotation @ inner.position, self.rotation @ inner.rotation)

    def inverse(self) -> Pose:
        """The pose of the outer system in the inner one."""
        return Pose(-self.rotation.T @ self.position, self.rotation.T)

    def point(self, points: ArrayLike) -> Array:
        """Points of the inner system, shape (..., 3), in the outer one."""
        return np.asarray(points, dtype=np.float64) @ self.rotation.T + self.position

    def direction(self, vectors: ArrayLike) -> Array:
        """Vectors of the inner system, shape (..., 3), in the outer one."""
        return np.asarray(vectors, dtype=np.float64) @ self.rotation.T


IDENTITY = Pose(np.zeros(3), np.eye(3))


def rotation_about(axis: ArrayLike, angle: float) -> Array:
    """Rotation by ``angle`` (rad) about ``axis`` (any length but zero); exact for axes and right angles."""
    unit = np.asarray(axis, dtype=np.float64)
    unit = unit / np.abs(unit).max()  # squares of very long or short axes leave the range of numbers
    unit = unit / math.sqrt(unit @ unit)
    cosine, sine = math.cos(angle), math.sin(angle)
    quarter_turns = angle / (math.pi / 2)
    if abs(quarter_turns - round(quarter_turns)) < 1e-14:
        cosine, sine = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[round(quarter_turns) % 4]
    x, y, z = unit.tolist()
    rest = 1.0 - cosine
    zero = 0.0 * cosine
    return np.array(
        [
            [x * x * rest + cosine + 0.0 * sine, x * y * rest + zero - z * sine, x * z * rest + zero + y * sine],
            [y * x * rest + zero + z * sine, y * y * rest + cosine + 0.0 * sine, y * z * rest + zero - x * sine],
            [z * x * rest + zero - y * sine, z * y * rest + zero + x * sine, z * z * rest + cosine + 0.0 * sine],
        ]
    )


def rotation_of_quaternion(quaternion: ArrayLike) -> Array:
    """Rotation of the quaternion (w, x, y, z), which is normalised first."""
    w, x, y, z = np.asarray(quaternion, dtype=np.float64) / np.linalg.norm(quaternion)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def rotation_of_roll_pitch_yaw(angles: ArrayLike) -> Array:
    """Rotations about the fixed axes x, y, z by the three angles (rad), in this order."""
    roll, pitch, yaw = np.asarray(angles, dtype=np.float64)
    return rotation_about([0, 0, 1], yaw) @ rotation_about([0, 1, 0], pitch) @ rotation_about([1, 0, 0], roll)


def nearest_rotation(matrix: ArrayLike) -> tuple[Array, float]:
    """The orthogonal matrix nearest to ``matrix`` and the largest difference of an element.

    The polar factor by singular values; its determinant has the sign of that of ``matrix``. A matrix
    that is orthogonal to rounding is returned as it is.
    """
    given = np.asarray(matrix, dtype=np.float64)
    if np.abs(given @ given.T - np.eye(3)).max() < 4 * np.finfo(float).eps:
        return given, 0.0
    left, _, right = np.linalg.svd(given)
    nearest = left @ right
    return nearest, float(np.abs(nearest - given).max())


def cardan_angles(rotation: Array) -> tuple[float, float, float]:
    """Angles (rad) of ``rotation = Rx(a) Ry(b) Rz(c)``: turns about the moved axes x, y, z in this order.

    These are the angles of Modelica.Mechanics.MultiBody's sequence {1,2,3}. At b = +-90 degrees a is 0.
    """
    sine = float(np.clip(rotation[0, 2], -1.0, 1.0))
    b = math.asin(sine)
    if abs(sine) > 1.0 - 1e-14:
        return 0.0, b, math.atan2(rotation[1, 0], rotation[1, 1])
    return math.atan2(-rotation[1, 2], rotation[2, 2]), b, math.atan2(-rotation[0, 1], rotation[0, 0])


def perpendicular(axis: Array) -> Array:
    """A unit vector at a right angle to ``axis``, chosen by the coordinate axis farthest from it."""
    candidate = np.zeros(3)
    candidate[int(np.argmin(np.abs(axis)))] = 1.0
    normal = np.cross(axis, candidate)
    return np.asarray(normal / np.linalg.norm(normal))


def cross(first: Array, second: Array) -> Array:
    """Vector product of two vectors; ``numpy.cross``, made for many, takes ten times as long for one."""
    a, b, c = first.tolist()
    x, y, z = second.tolist()
    return np.array([b * z - c * y, c * x - a * z, a * y - b * x])


def dot(first: Array, second: Array) -> Array:
    """Scalar products along the last axis."""
    return np.asarray(np.einsum("...i,...i->...", first, second))
