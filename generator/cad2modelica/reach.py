"""How far bodies can get, by intervals of distance along the tree of joints: pairs that can never meet.

Every colliding body is enclosed in a ball about its shapes. A revolute, universal or spherical joint holds one point
of both parts together, so every point of either part keeps its distance from it. Along a chain of such joints, the way
between the two ends has a length in an interval by the triangle inequality; of sliding parts nothing is said.
Joint limits are not used, and joints that close loops only take freedom away: so the intervals are never too small.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from cad2modelica.kinematic_graph import KinematicTree
from cad2modelica.model import GROUND, Joint, JointType, Part, Plane
from cad2modelica.spatial import Array

SAFETY = 1e-3  # of the lengths involved: far more than rounding or the integrator's error move a body

_HOLDS_A_POINT = frozenset({JointType.REVOLUTE, JointType.UNIVERSAL, JointType.SPHERICAL})


@dataclass(frozen=True, eq=False)
class Ball:
    """A ball that holds a body's shapes: centre in the world at the start, shape (3,), m; radius, m."""

    center: Array
    radius: float


class Reach:
    """What can be said about distances between bodies for all time."""

    def __init__(self, parts: tuple[Part, ...], planes: tuple[Plane, ...], tree: KinematicTree) -> None:
        self._parts = {part.name: part for part in parts}
        self._planes = {plane.name: plane for plane in planes}
        self._tree = tree
        self._steps = {branch.part.name: (branch.predecessor, branch.joint) for branch in tree.branches}

    def never_meet(self, first: str, second: str, balls: Mapping[str, Ball]) -> bool:
        """Whether two bodies stay apart, whatever the joints do.

        Args:
            first, second: names of parts or planes.
            balls: one for every part.
        """
        if first in self._planes or second in self._planes:
            plane, other = (first, second) if first in self._planes else (second, first)
            return other in self._parts and self._stays_above(self._planes[plane], other, balls[other])
        start, end = balls[first], balls[second]
        chain = self._turning_joints(first, second)
        if chain is None:
            return False
        low, high = _interval(chain, start.center, end.center)
        radii = start.radius + end.radius
        return low > radii + SAFETY * (radii + high)

    def _stays_above(self, plane: Plane, name: str, ball: Ball) -> bool:
        chain = self._turning_joints(name, GROUND)
        if chain is None:
            return False
        # The last joint before the ground turns about a point that stays.
        pivot = chain[-1].origin if chain else ball.center
        _, high = _interval(chain, ball.center, pivot)
        height = float(plane.normal @ (pivot - plane.position))
        return height > high + ball.radius + SAFETY * (high + ball.radius + abs(height))

    def _turning_joints(self, first: str, second: str) -> list[Joint] | None:
        """Joints on the way from one part to another, without fixed ones; None if not all hold a point."""
        up, down = self._to_root(first), self._to_root(second)
        if up[-1][0] != down[-1][0]:
            return None
        while len(up) > 1 and len(down) > 1 and up[-2][0] == down[-2][0]:
            up.pop()
            down.pop()
        way = [joint for _, joint in up[:-1]] + [joint for _, joint in reversed(down[:-1])]
        moving = [joint for joint in way if joint is not None and joint.type is not JointType.FIXED]
        return moving if all(joint.type in _HOLDS_A_POINT for joint in moving) else None

    def _to_root(self, name: str) -> list[tuple[str, Joint | None]]:
        """A part and what is above it, each with the joint to the next one; the last is the ground or a free part."""
        way: list[tuple[str, Joint | None]] = []
        node: str | None = name
        while node is not None and node != GROUND:
            above, joint = self._steps[node]
            way.append((node, joint))
            if above is None:
                return way
            node = above
        return [*way, (GROUND, None)]


def _interval(chain: list[Joint], start: Array, end: Array) -> tuple[float, float]:
    """Smallest and largest distance of a point before the chain's first joint and one behind its last."""
    points = [start, *(joint.origin for joint in chain), end]
    lengths = [float(np.linalg.norm(after - before)) for before, after in pairwise(points)]
    total = sum(lengths)
    return max(0.0, 2 * max(lengths) - total), total
