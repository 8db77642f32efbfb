"""How far bodies can get, by intervals of distance along the tree of joints: pairs that can never meet.

Every colliding body is enclosed in a ball about its shapes. A revolute, universal or spherical joint holds one point
of both parts together, so every point of either part keeps its distance from it. Along a chain of such joints, the way
between the two ends has a length in an interval by the triangle inequality; of sliding parts nothing is said.
Joint limits are not used, and joints that close loops only take freedom away: so the intervals are never too small.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cad2modelica.geometry.spatial import Array
from cad2modelica.kinematics.kinematic_graph import Branch, KinematicTree
from cad2modelica.mechanism.model import GROUND, Joint, JointType, Part, Plane

SAFETY = 1e-3  # of the lengths involved: far more than rounding or the integrator's error move a body

_HOLDS_A_POINT = frozenset({JointType.REVOLUTE, JointType.UNIVERSAL, JointType.SPHERICAL})


@dataclass(frozen=True, eq=False)
class Ball:
    """A ball that holds a body's shapes: centre in the world at the start, shape (3,), m; radius, m."""

    center: Array
    radius: float


class Reach:
    """What can be said about distances between bodies for all time.

    Args:
        parts, planes: of the mechanism.
        tree: its graph.
    """

    def __init__(self, parts: tuple[Part, ...], planes: tuple[Plane, ...], tree: KinematicTree) -> None:
        self._index = {part.name: number for number, part in enumerate(parts)}
        self._planes = {plane.name: plane for plane in planes}
        self._tree = tree

    def apart(self, balls: Mapping[str, Ball]) -> Callable[[str, str], bool]:
        """A test of pairs of names of parts and planes: whether they stay apart, whatever the joints do.

        All pairs of parts are computed at once, each where their chains to the root meet.

        Args:
            balls: one for every part.
        """
        low, grounded = self._pairs_apart(balls)
        index, planes = self._index, self._planes
        rows = {int(part): row for row, part in enumerate(grounded.parts)}

        def test(first: str, second: str) -> bool:
            if first in planes or second in planes:
                plane, other = (first, second) if first in planes else (second, first)
                row = rows.get(index[other]) if other in index else None
                return row is not None and _stays_above(planes[plane], balls[other].radius, grounded, row)
            return bool(low[index[first], index[second]])

        return test

    def _pairs_apart(self, balls: Mapping[str, Ball]) -> tuple[NDArray[np.bool_], _Chains]:
        """For every pair of parts whether they stay apart, shape (parts, parts), and the chains to the ground."""
        count = len(self._index)
        apart = np.zeros((count, count), dtype=np.bool_)
        radius = np.array([balls[name].radius for name in self._index])
        open_chains: dict[str, _Chains] = {}
        # Leaves first: the chains below a part are complete when it is its turn.
        for branch in reversed(self._tree.branches):
            name = branch.part.name
            own = _Chains.of(self._index[name], balls[name])
            for child in branch.children:
                below = open_chains.pop(child)
                joint = self._tree.branch(child).joint
                below = below.through(joint)
                _compare(own, below, radius, apart)
                own = own.joined(below)
            open_chains[name] = own
        at_ground = [(branch, open_chains[branch.part.name]) for branch in self._tree.branches if _is_root(branch)]
        ground = _Chains(np.zeros(0, np.intp), np.zeros(0), np.zeros(0), np.zeros((0, 3)))
        for branch, chains in at_ground:
            if branch.predecessor is None:
                continue
            chains = chains.through(branch.joint)
            _compare(ground, chains, radius, apart)
            ground = ground.joined(chains)
        return apart, ground


@dataclass(frozen=True, eq=False)
class _Chains:
    """Chains of many parts up to the same part: arrays over the parts; ``last`` has shape (parts, 3)."""

    parts: NDArray[np.intp]
    total: Array
    longest: Array
    last: Array

    @staticmethod
    def of(part: int, ball: Ball) -> _Chains:
        """The part's own chain, which begins at the centre of its ball."""
        return _Chains(np.array([part]), np.zeros(1), np.zeros(1), ball.center[None, :])

    def through(self, joint: Joint | None) -> _Chains:
        """All chains continued by a joint; none is left if it holds no point."""
        if joint is None or joint.type is JointType.FIXED:
            return self
        if joint.type not in _HOLDS_A_POINT:
            return _Chains(self.parts[:0], self.total[:0], self.longest[:0], self.last[:0])
        length = np.linalg.norm(joint.origin - self.last, axis=1)
        last = np.broadcast_to(joint.origin, self.last.shape)
        return _Chains(self.parts, self.total + length, np.maximum(self.longest, length), last)

    def joined(self, other: _Chains) -> _Chains:
        """These chains and others."""
        return _Chains(
            np.concatenate([self.parts, other.parts]),
            np.concatenate([self.total, other.total]),
            np.concatenate([self.longest, other.longest]),
            np.concatenate([self.last, other.last]),
        )


def _compare(first: _Chains, second: _Chains, radius: Array, apart: NDArray[np.bool_]) -> None:
    """Fills ``apart`` for all pairs of one chain of the first and one of the second kind, which meet here."""
    between = np.linalg.norm(first.last[:, None, :] - second.last[None, :, :], axis=2)
    total = first.total[:, None] + second.total[None, :] + between
    longest = np.maximum(np.maximum(first.longest[:, None], second.longest[None, :]), between)
    lowest = np.maximum(0.0, 2 * longest - total)
    radii = radius[first.parts][:, None] + radius[second.parts][None, :]
    result = lowest > radii + SAFETY * (radii + total)
    apart[np.ix_(first.parts, second.parts)] = result
    apart[np.ix_(second.parts, first.parts)] = result.T


def _stays_above(plane: Plane, radius: float, grounded: _Chains, row: int) -> bool:
    """Whether a part stays above a plane: the last joint before the ground turns about a point that stays."""
    total = float(grounded.total[row])
    height = float(plane.normal @ (grounded.last[row] - plane.position))
    return height > total + radius + SAFETY * (total + radius + abs(height))


def _is_root(branch: Branch) -> bool:
    return branch.predecessor is None or branch.predecessor == GROUND
