"""Planar loops: for each direction of revolute axes, the joints that move at a right angle to it, and what they close.

All joints whose motion stays in planes with one normal (revolute ones along it, prismatic ones across it, planar ones
with it, and fixed ones) make a graph of their own; its loops are planar whatever else the mechanism does. Each is
closed by one revolute joint: joints are taken in the order of the source, prismatic and planar ones first and revolute
ones with stops or friction before plain ones; a revolute joint between bodies that are connected already closes a loop.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass

import networkx as nx
import numpy as np

from cad2modelica.geometry.spatial import Array
from cad2modelica.mechanism.model import GROUND, Assembly, Joint, JointType

PARALLEL_TOLERANCE = 1e-6

Step = tuple[Joint, float]


@dataclass(frozen=True, eq=False)
class Loop:
    """A closed chain of joints.

    Attributes:
        joint: the one that closes it.
        steps: all of its joints, each with +1 if passed from parent to child, else -1; the closing one first.
        normal: of the planes all bodies of the loop move in; None if there are none.
    """

    joint: Joint
    steps: tuple[Step, ...]
    normal: Array | None


def planar_loops(assembly: Assembly) -> tuple[Loop, ...]:
    """Independent planar loops, each closed by a revolute joint, in the order of the source."""
    joints = [joint for joint in assembly.joints if joint.type is not JointType.FREE]
    found: list[Loop] = []
    for normal in _directions(joints):
        found += _loops_across(assembly, joints, normal)
    order = {joint.name: number for number, joint in enumerate(joints)}
    return tuple(sorted(found, key=lambda loop: order[loop.joint.name]))


def _directions(joints: Sequence[Joint]) -> list[Array]:
    """Directions that at least two revolute axes have, without regard to their sense."""
    directions: list[Array] = []
    counts: list[int] = []
    for joint in joints:
        if joint.type is not JointType.REVOLUTE or joint.axis is None:
            continue
        along = np.abs(np.array(directions) @ joint.axis) if directions else np.zeros(0)
        near = int(np.argmax(along)) if len(along) else -1
        if near >= 0 and _parallel(directions[near], joint.axis):
            counts[near] += 1
        else:
            directions.append(joint.axis)
            counts.append(1)
    return [direction for direction, count in zip(directions, counts, strict=True) if count > 1]


def _parallel(first: Array, second: Array) -> bool:
    return float(np.linalg.norm(np.cross(first, second))) < PARALLEL_TOLERANCE


def _moves_across(joint: Joint, normal: Array) -> bool:
    """Whether the joint keeps its bodies in planes with that normal."""
    if joint.type is JointType.FIXED:
        return True
    if joint.axis is None:
        return False
    if joint.type is JointType.PRISMATIC:
        return abs(float(joint.axis @ normal)) < PARALLEL_TOLERANCE
    return joint.type in (JointType.REVOLUTE, JointType.PLANAR) and _parallel(joint.axis, normal)


def _loops_across(assembly: Assembly, joints: Sequence[Joint], normal: Array) -> list[Loop]:
    edges = [joint for joint in joints if _moves_across(joint, normal)]
    groups: nx.utils.UnionFind[str] = nx.utils.UnionFind([GROUND, *(part.name for part in assembly.parts)])
    grounded = {part.name for part in assembly.parts if part.grounded}
    for name in grounded:
        groups.union(GROUND, name)
    neighbours: dict[str, list[Step]] = {}
    found = []
    for joint in sorted(edges, key=_rank):
        ends = [GROUND if name in grounded else name for name in (joint.parent, joint.child)]
        if groups[ends[0]] != groups[ends[1]]:
            groups.union(*ends)
            neighbours.setdefault(ends[0], []).append((joint, 1.0))
            neighbours.setdefault(ends[1], []).append((joint, -1.0))
        elif joint.type is JointType.REVOLUTE:
            found.append(joint)
    return [
        Loop(joint, ((joint, 1.0), *_path(joint.child, joint.parent, neighbours, grounded)), normal) for joint in found
    ]


def _rank(joint: Joint) -> int:
    """Fixed joints first, and last those that may close a loop: plain revolute ones."""
    if joint.type is not JointType.REVOLUTE:
        return 0 if joint.type is JointType.FIXED else 1
    return 2 if joint.has_resistance else 3


def _path(start: str, end: str, neighbours: dict[str, list[Step]], grounded: set[str]) -> list[Step]:
    """Joints of the forest from one body to another."""
    first, last = (GROUND if name in grounded else name for name in (start, end))
    came: dict[str, tuple[str, Step] | None] = {first: None}
    queue = deque([first])
    while queue and last not in came:
        node = queue.popleft()
        for joint, sign in neighbours.get(node, ()):
            other = joint.child if sign > 0 else joint.parent
            other = GROUND if other in grounded else other
            if other not in came:
                came[other] = (node, (joint, sign))
                queue.append(other)
    steps: list[Step] = []
    reached = came[last]
    while reached is not None:
        steps.append(reached[1])
        reached = came[reached[0]]
    return steps[::-1]
