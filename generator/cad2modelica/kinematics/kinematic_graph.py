"""The mechanism as a graph: bodies are nodes, joints edges; a spanning tree and the joints that close loops."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import networkx as nx

from cad2modelica.kinematics.planar_loops import Loop, planar_loops
from cad2modelica.mechanism.model import GROUND, Assembly, Joint, JointType, Part


@dataclass(frozen=True, eq=False)
class Branch:
    """A part and how the spanning tree reaches it.

    Attributes:
        joint: from ``predecessor`` to the part (or, if the CAD system has it so, the other way round); None for the
            first part of a tree that stands on nothing, and for parts that are grounded.
        predecessor: a part's name, ``GROUND``, or None.
        children: names of the parts reached from this one, in the order of the tree.
    """

    part: Part
    joint: Joint | None
    predecessor: str | None
    children: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class KinematicTree:
    """A spanning forest of the mechanism.

    Attributes:
        branches: every part once, each after its predecessor.
        cut_joints: joints that are not in the forest: each closes a loop.
        planar_loops: the planar ones of these loops.
        fixed: names of the parts that cannot move.
        rigid_groups: for every part, the name of the first part it is rigidly joined to; ``GROUND`` if it is fixed.
    """

    branches: tuple[Branch, ...]
    cut_joints: tuple[Joint, ...]
    planar_loops: tuple[Loop, ...]
    fixed: frozenset[str]
    rigid_groups: dict[str, str]

    @cached_property
    def _by_name(self) -> dict[str, Branch]:
        return {branch.part.name: branch for branch in self.branches}

    def branch(self, name: str) -> Branch:
        """The branch of a part.

        Raises:
            KeyError: there is no such part.
        """
        return self._by_name[name]


def kinematic_tree(assembly: Assembly) -> KinematicTree:
    """Spans the mechanism from the ground.

    Of the joints of a loop one is left out of the tree: in planar loops the revolute joint that closes them; in others
    a spherical joint if there is one, else a revolute one, and of those the one listed last, so that the order in the
    source decides. Grounded parts stand on the ground without a joint. Parts no chain of joints connects to the ground
    form trees of their own; their roots are the parts that start with a speed of their own or hang on a free joint, and
    of several, or of none, those listed first.
    """
    planar = planar_loops(assembly)
    cut = _cut_joints(assembly, {loop.joint.name for loop in planar})
    graph = _graph(assembly, cut)
    parts = {part.name: part for part in assembly.parts}
    order: list[str] = []
    reached_by: dict[str, tuple[Joint | None, str | None]] = {}

    def span(start: list[str]) -> None:
        queue = deque(start)
        while queue:
            node = queue.popleft()
            for joint in _joints_at(graph, node):
                other = joint.child if joint.parent == node else joint.parent
                if other == GROUND or other in reached_by:
                    continue
                reached_by[other] = (joint, node)
                order.append(other)
                queue.append(other)

    grounded = [part.name for part in assembly.parts if part.grounded]
    for name in grounded:
        reached_by[name] = (None, GROUND)
        order.append(name)
    span([GROUND, *grounded])
    for part in _roots_first(assembly):
        if part.name not in reached_by:
            reached_by[part.name] = (None, None)
            order.append(part.name)
            span([part.name])

    children: dict[str, list[str]] = {name: [] for name in order}
    for name in order:
        predecessor = reached_by[name][1]
        if predecessor in children:
            children[predecessor].append(name)
    groups = _rigid_groups(assembly)
    return KinematicTree(
        branches=tuple(Branch(parts[name], *reached_by[name], tuple(children[name])) for name in order),
        cut_joints=cut,
        planar_loops=planar,
        fixed=frozenset(name for name, group in groups.items() if group == GROUND),
        rigid_groups=groups,
    )


def _roots_first(assembly: Assembly) -> list[Part]:
    """Parts in their order, but those first whose speed at the start is given: it is that of their tree's root."""
    free = {joint.child for joint in assembly.joints if joint.type is JointType.FREE}

    def is_given(part: Part) -> bool:
        return part.name in free or bool(part.velocity.any() or part.angular_velocity.any())

    return sorted(assembly.parts, key=lambda part: not is_given(part))


def _cut_joints(assembly: Assembly, planar: set[str]) -> tuple[Joint, ...]:
    """Joints outside a spanning forest that takes joints in the order of the source (Kruskal).

    Fixed ones come first, then all others, revolute and at last spherical ones; those that close planar loops never.
    """
    groups: nx.utils.UnionFind[str] = nx.utils.UnionFind([GROUND, *(part.name for part in assembly.parts)])
    for part in assembly.parts:
        if part.grounded:
            groups.union(GROUND, part.name)
    real = [joint for joint in assembly.joints if joint.type is not JointType.FREE]
    ranks = {JointType.FIXED: 0, JointType.REVOLUTE: 2, JointType.SPHERICAL: 3}
    cut = set(planar)
    for joint in sorted(real, key=lambda joint: ranks.get(joint.type, 1)):
        if joint.name in planar:
            continue
        if groups[joint.parent] == groups[joint.child]:
            cut.add(joint.name)
        else:
            groups.union(joint.parent, joint.child)
    return tuple(joint for joint in real if joint.name in cut)


def _graph(assembly: Assembly, cut: tuple[Joint, ...]) -> nx.MultiGraph[str]:
    outside = {joint.name for joint in cut}
    graph: nx.MultiGraph[str] = nx.MultiGraph()
    graph.add_node(GROUND)
    graph.add_nodes_from(part.name for part in assembly.parts)
    for index, joint in enumerate(assembly.joints):
        if joint.type is not JointType.FREE and joint.name not in outside:
            graph.add_edge(joint.parent, joint.child, key=index, joint=joint)
    return graph


def _joints_at(graph: nx.MultiGraph[str], node: str) -> list[Joint]:
    # Edge keys are the joints' numbers in the source; networkx does not promise an order of its own.
    by_number: dict[Any, Joint] = {}
    for neighbours in graph.adj[node].values():
        by_number.update({number: data["joint"] for number, data in neighbours.items()})
    return [by_number[number] for number in sorted(by_number)]


def _rigid_groups(assembly: Assembly) -> dict[str, str]:
    rigid: nx.Graph[str] = nx.Graph()
    rigid.add_node(GROUND)
    rigid.add_nodes_from(part.name for part in assembly.parts)
    rigid.add_edges_from((GROUND, part.name) for part in assembly.parts if part.grounded)
    rigid.add_edges_from((joint.parent, joint.child) for joint in assembly.joints if joint.type is JointType.FIXED)
    rank = {GROUND: -1} | {part.name: index for index, part in enumerate(assembly.parts)}
    groups: dict[str, str] = {}
    for component in nx.connected_components(rigid):
        first = min(component, key=lambda name: rank[name])
        groups.update(dict.fromkeys(component, first))
    del groups[GROUND]
    return groups
