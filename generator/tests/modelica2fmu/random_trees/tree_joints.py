"""Random joints of ``Modelica.Mechanics.MultiBody``: how they are declared, what they hold and how they start."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation
from tree_motion import Pose, Vector

Step = Callable[[float], Pose]  # a joint's frame_b in its frame_a, by time near the start
X, Y, Z = np.eye(3)


@dataclass(frozen=True)
class Joint:
    """Declaration, what it holds, how it starts, and the axes of its flanges."""

    kind: str
    text: str
    step: Step
    conditions: Sequence[tuple[str, Vector, Vector | None]]
    axis: Vector | None = None
    start: float = 0.0


def number(value: float) -> str:
    return repr(round(float(value), 4))


def vector(value: Sequence[float] | Vector) -> str:
    return "{" + ", ".join(number(each) for each in value) + "}"


def turn(axis: Vector, angle: float) -> np.ndarray:
    return Rotation.from_rotvec(np.asarray(axis) / np.linalg.norm(axis) * angle).as_matrix()


def sequence(angles: Vector, axes: Sequence[int] = (1, 2, 3)) -> np.ndarray:
    """Axes of a frame that was turned about its own axes, one after the other."""
    result = np.eye(3)
    for axis, angle in zip(axes, angles, strict=True):
        result = result @ turn(np.eye(3)[axis - 1], angle)
    return result


def across(axis: Vector) -> tuple[Vector, Vector]:
    first = np.cross(axis, X if abs(axis[0]) < 0.6 * np.linalg.norm(axis) else Y)
    first = first / np.linalg.norm(first)
    return first, np.cross(axis / np.linalg.norm(axis), first)


class Chooser(random.Random):
    """Random numbers of a mechanism, as they are written."""

    def within(self, low: float, high: float) -> float:
        return round(self.uniform(low, high), 3)

    def direction(self) -> Vector:
        if self.random() < 0.6:
            return self.choice([X, Y, Z]) * self.choice([1.0, 1.0, -1.0])
        return np.round([self.uniform(-1, 1) or 0.5 for _ in range(3)], 2) + np.array([0.01, 0, 0])

    def arm(self, size: float = 0.4) -> Vector:
        return np.round([self.uniform(-size, size) for _ in range(3)], 2)

    def sequence(self) -> list[int]:
        return self.choice([[1, 2, 3], [1, 2, 3], [3, 1, 3], [3, 2, 1], [2, 1, 3]])


def _revolute(choose: Chooser) -> Joint:
    n, phi, w = choose.direction(), choose.within(-1, 1), choose.within(-2, 2)
    first, second = across(n)
    conditions = [("along", each, None) for each in np.eye(3)] + [("angle", first, n), ("angle", second, n)]
    text = f"n={vector(n)}, phi(fixed=true, start={phi}), w(fixed=true, start={w})"
    return Joint("Revolute", text, lambda t: (np.zeros(3), turn(n, phi + w * t)), conditions, n, phi)


def _prismatic(choose: Chooser) -> Joint:
    n, s, v = choose.direction(), choose.within(-0.3, 0.3), choose.within(-1, 1)
    first, second = across(n)
    unit = n / np.linalg.norm(n)
    conditions = [("along", first, None), ("along", second, None), ("angle", first, n), ("angle", second, n)]
    conditions.append(("angle", first, second))
    text = f"n={vector(n)}, s(fixed=true, start={s}), v(fixed=true, start={v})"
    return Joint("Prismatic", text, lambda t: (unit * (s + v * t), np.eye(3)), conditions, n, s)


def _cylindrical(choose: Chooser) -> Joint:
    n, s, v, phi, w = choose.direction(), *(choose.within(-0.5, 0.5) for _ in range(4))
    first, second = across(n)
    unit = n / np.linalg.norm(n)
    conditions = [("along", first, None), ("along", second, None), ("angle", first, n), ("angle", second, n)]
    text = f"n={vector(n)}, s(fixed=true, start={s}), v(fixed=true, start={v}), phi(fixed=true, start={phi}), "
    text += f"w(fixed=true, start={w})"
    return Joint("Cylindrical", text, lambda t: (unit * (s + v * t), turn(n, phi + w * t)), conditions)


def _planar(choose: Chooser) -> Joint:
    n, n_x = choose.direction(), choose.direction()
    if np.linalg.norm(np.cross(n, n_x)) < 0.3:
        n_x = across(n)[0].round(3)
    unit = n / np.linalg.norm(n)
    y = np.cross(unit, n_x) / np.linalg.norm(np.cross(unit, n_x))
    x = np.cross(y, unit)
    starts = [choose.within(-0.4, 0.4) for _ in range(6)]
    first, second = across(n)
    text = f"n={vector(n)}, n_x={vector(n_x)}"
    for name, start in zip(("s_x", "v_x", "s_y", "v_y", "phi", "w"), starts, strict=True):
        text += f", {name}(fixed=true, start={start})"

    def step(t: float) -> Pose:
        return x * (starts[0] + starts[1] * t) + y * (starts[2] + starts[3] * t), turn(n, starts[4] + starts[5] * t)

    return Joint("Planar", text, step, [("along", n, None), ("angle", first, n), ("angle", second, n)])


def _universal(choose: Chooser) -> Joint:
    a, b = choose.direction(), choose.direction()
    if np.linalg.norm(np.cross(a, b)) < 0.5:
        b = across(a)[0].round(3)
    starts = [choose.within(-0.6, 0.6) for _ in range(4)]
    text = f"n_a={vector(a)}, n_b={vector(b)}"
    for name, start in zip(("phi_a", "w_a", "phi_b", "w_b"), starts, strict=True):
        text += f", {name}(fixed=true, start={start})"
    conditions = [("along", each, None) for each in np.eye(3)] + [("angle", a, b)]

    def step(t: float) -> Pose:
        return np.zeros(3), turn(a, starts[0] + starts[1] * t) @ turn(b, starts[2] + starts[3] * t)

    return Joint("Universal", text, step, conditions)


def turned(choose: Chooser, suffix: str) -> tuple[str, Callable[[float], np.ndarray]]:
    """Start of an orientation, with the angular velocity in the first frame's axes."""
    angles, w, axes = choose.arm(0.8), choose.arm(1.5), choose.sequence()
    text = f"angles_fixed=true, angles_start={vector(angles)}, sequence_start={{{', '.join(map(str, axes))}}}, "
    text += f"w_{suffix}_fixed=true, w_{suffix}_start={vector(w)}"
    if choose.random() < 0.4:
        text += ", useQuaternions=false"
    size = np.linalg.norm(w) or 1.0
    return text, lambda t: turn(w if np.any(w) else X, size * t if np.any(w) else 0.0) @ sequence(angles, axes)


def _spherical(choose: Chooser) -> Joint:
    text, orientation = turned(choose, "rel_a")
    if choose.random() < 0.7:
        text += ", enforceStates=true"
    return Joint(
        "Spherical", text, lambda t: (np.zeros(3), orientation(t)), [("along", each, None) for each in np.eye(3)]
    )


def _free(choose: Chooser) -> Joint:
    text, orientation = turned(choose, "rel_a")
    r, v = choose.arm(), choose.arm()
    text = f"r_rel_a(fixed=true, start={vector(r)}), v_rel_a(fixed=true, start={vector(v)}), {text}"
    return Joint("FreeMotion", text, lambda t: (r + v * t, orientation(t)), [])


def random_joint(choose: Chooser) -> Joint:
    """One of any kind; revolute ones most."""
    kinds = [_revolute, _revolute, _revolute, _prismatic, _cylindrical, _planar]
    return choose.choice([*kinds, _universal, _spherical, _free])(choose)
