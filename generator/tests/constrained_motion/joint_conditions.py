"""Scalar conditions that joints put on pairs of bodies, with their first two derivatives in closed form.

E. Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems (1989). Every body has a point of reference, whose
position and velocity are given with the body's turn and angular velocity; the world is the body behind the last one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Side:
    """A point and directions fixed in a body (None: in the world), in its axes from its point of reference."""

    body: int | None
    point: np.ndarray
    axes: np.ndarray


@dataclass(frozen=True)
class Condition:
    """One equation between two sides: ``along`` a . d = const, ``angle`` a . b = const, ``screw`` a . d = lead angle.

    ``a`` is an axis of the first side, ``b`` one of the second, ``d`` leads from the first point to the second.
    """

    kind: str
    first: Side
    second: Side
    a: int
    b: int = 0
    lead: float = 0.0


class JointConditions:
    """All conditions of a mechanism at once.

    Args:
        conditions: between the bodies.
        bodies: how many there are.
    """

    def __init__(self, conditions: Sequence[Condition], bodies: int) -> None:
        self._bodies = bodies
        sides = [[item.first for item in conditions], [item.second for item in conditions]]
        self._body = [np.array([bodies if s.body is None else s.body for s in side], dtype=int) for side in sides]
        self._point = [np.array([s.point for s in side]).reshape(-1, 3) for side in sides]
        self._axes = [np.array([s.axes for s in side]).reshape(-1, 3, 3) for side in sides]
        self._a = np.array([item.a for item in conditions], dtype=int)
        self._b = np.array([item.b for item in conditions], dtype=int)
        self._lead = np.array([item.lead for item in conditions])
        self._is_angle = np.array([item.kind == "angle" for item in conditions], dtype=bool)

    def __len__(self) -> int:
        return len(self._lead)

    def values(self, turns: np.ndarray, origins: np.ndarray) -> np.ndarray:
        """What stays, by rotations into the world (bodies + 1, 3, 3) and points of reference (bodies + 1, 3)."""
        p, q = (self._points(side, turns, origins) for side in (0, 1))
        a, b = self._axis(0, self._a, turns), self._axis(1, self._b, turns)
        x, y = (self._axis(0, k, turns) for k in (0, 1))
        other = self._axis(1, 0, turns)
        angles = np.where(self._lead != 0, np.arctan2(_dot(y, other), _dot(x, other)), 0.0)
        return np.where(self._is_angle, _dot(a, b), _dot(a, q - p) - self._lead * angles)

    def gaps(self, values: np.ndarray, constants: np.ndarray) -> np.ndarray:
        """How far values are from what they were; angles of screws are known but for whole turns."""
        gaps = values - constants
        turns = np.where(self._lead != 0, 2 * np.pi * self._lead, 1.0)
        return np.where(self._lead != 0, gaps - turns * np.round(gaps / turns), gaps)

    def equations(self, turns: np.ndarray, origins: np.ndarray, rates: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Rows for the accelerations (conditions, 6 bodies), and what they must give; rates: (bodies + 1, 6)."""
        p, q = (self._points(side, turns, origins) for side in (0, 1))
        a, b = self._axis(0, self._a, turns), self._axis(1, self._b, turns)
        arm_p, arm_q = p - origins[self._body[0]], q - origins[self._body[1]]
        wp, wq = rates[self._body[0], 3:], rates[self._body[1], 3:]
        vp = rates[self._body[0], :3] + np.cross(wp, arm_p)
        vq = rates[self._body[1], :3] + np.cross(wq, arm_q)
        moved, d, lead = np.cross(wp, a), q - p, self._lead[:, None]
        across = np.cross(a, b)
        is_angle = self._is_angle[:, None]
        shift = np.where(is_angle, 0.0, a)
        first = np.where(is_angle, across, np.cross(a, d) - np.cross(arm_p, a) + lead * a)
        second = np.where(is_angle, -across, np.cross(arm_q, a) - lead * a)
        turned = _dot(wp - wq, np.cross(moved, b) + np.cross(a, np.cross(wq, b)))
        bent = np.cross(wq, np.cross(wq, arm_q)) - np.cross(wp, np.cross(wp, arm_p))
        slid = _dot(np.cross(wp, moved), d) + 2 * _dot(moved, vq - vp) + _dot(a, bent)
        slid -= self._lead * _dot(moved, wq - wp)
        count = len(self._lead)
        rows = np.zeros((count, self._bodies + 1, 6))
        every = np.arange(count)
        rows[every, self._body[0], :3] -= shift
        rows[every, self._body[0], 3:] += first
        rows[every, self._body[1], :3] += shift
        rows[every, self._body[1], 3:] += second
        return rows[:, :-1].reshape(count, 6 * self._bodies), -np.where(self._is_angle, turned, slid)

    def _points(self, side: int, turns: np.ndarray, origins: np.ndarray) -> np.ndarray:
        body = self._body[side]
        return origins[body] + np.einsum("nij,nj->ni", turns[body], self._point[side])

    def _axis(self, side: int, number: np.ndarray | int, turns: np.ndarray) -> np.ndarray:
        own = self._axes[side][np.arange(len(self._lead)), number]
        return np.asarray(np.einsum("nij,nj->ni", turns[self._body[side]], own))


def _dot(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    return np.asarray((first * second).sum(axis=-1))
