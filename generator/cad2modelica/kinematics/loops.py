"""Closed loops: which are planar, which joint coordinates stay independent, and whether the loops can be computed."""

from __future__ import annotations

import math
from collections.abc import Container, Sequence
from dataclasses import dataclass

import networkx as nx
import numpy as np

from cad2modelica.geometry.spatial import Array
from cad2modelica.kinematics.coordinate_choice import choose_coordinates
from cad2modelica.kinematics.joint_couplings import follow
from cad2modelica.kinematics.joint_twists import (
    Column,
    independent_columns,
    joint_twists,
    loop_equations,
    loop_matrix,
    start_rates,
)
from cad2modelica.kinematics.kinematic_graph import KinematicTree
from cad2modelica.kinematics.loop_closures import Closure, NotMovable, movable_closures, resisting_closures
from cad2modelica.kinematics.loop_diagnosis import overconstrained
from cad2modelica.kinematics.planar_loops import Loop, Step
from cad2modelica.mechanism.model import GROUND, Assembly, Joint, JointType
from cad2modelica.source.lost import Lost

_JOINTS_NAMED = 4  # of a loop, in notes


@dataclass(frozen=True)
class LoopAnalysis:
    """What the loops ask of the joints.

    Attributes:
        loops: all independent loops, in the order of the joints that close them.
        planar_constraints: names of the cut joints that become planar loop constraints.
        closures: conditions that close loops where no planar constraint or ordinary joint does: overconstrained ones
            which move, and planar ones whose cut joint has stops or friction; by the names of their cut joints.
        independent: for every joint, which of its coordinates (in the order of ``joint_twists``) start as given;
            the others follow from the loops.
        rates: for every joint, the rates at the start that satisfy the loops.
        notes: remarks.
    """

    loops: tuple[Loop, ...]
    planar_constraints: frozenset[str]
    closures: dict[str, Closure]
    independent: dict[str, tuple[bool, ...]]
    rates: dict[str, tuple[float, ...]]
    notes: tuple[str, ...]

    @property
    def freedoms(self) -> int:
        """Degrees of freedom of all joints at the start; bodies that no joint holds are not counted."""
        return sum(sum(flags) for flags in self.independent.values())


def analyse_loops(assembly: Assembly, tree: KinematicTree) -> LoopAnalysis:
    """Analyses the loops at the start.

    Raises:
        InputError: loops are overconstrained, so that their forces are not determined.
    """
    joints = [joint for joint in assembly.joints if joint.type is not JointType.FREE]
    loops = closed_loops(tree)
    length = mechanism_length(assembly)
    given = {joint.name: list(start_rates(joint)) for joint in joints}
    independent = {joint.name: [True] * len(joint_twists(joint)) for joint in joints}
    notes: list[str] = []
    closures: dict[str, Closure] = {}
    for group in _coupled(loops):
        found = _closures(assembly, group, tree, joints, length)
        notes += [closure.note for closure in found.values()]
        columns = _columns(group, tree, joints, found)
        notes += _solve(group, columns, length, given, independent)
        notes += _choose(group, columns, length, independent, _without_variables(group, found))
        closures |= found
    notes += follow(assembly.couplings, independent, given)
    notes += [_loop_note(loop) for loop in loops if loop.joint.name not in closures]
    return LoopAnalysis(
        loops,
        frozenset(loop.joint.name for loop in tree.planar_loops if loop.joint.name not in closures),
        closures,
        {name: tuple(flags) for name, flags in independent.items()},
        {name: tuple(values) for name, values in given.items()},
        tuple(notes),
    )


def closed_loops(tree: KinematicTree) -> tuple[Loop, ...]:
    """All independent loops, in the order of the joints that close them."""
    planar = {loop.joint.name: loop for loop in tree.planar_loops}
    return tuple(planar.get(joint.name) or _fundamental_loop(joint, tree) for joint in tree.cut_joints)


def mechanism_length(assembly: Assembly) -> float:
    """A length to compare rotations with displacements, m."""
    # Axes through one point, as in a spherical linkage, say nothing about the size: the parts do.
    points = [joint.origin for joint in assembly.joints]
    centers = [part.pose.point(part.mass_properties.center_of_mass) for part in assembly.parts]
    return max(_extent(points), _extent([*points, *centers]) / 2) or _largest_gyration(assembly) or 1.0


def joint_extent(assembly: Assembly) -> float:
    """How far apart the joints are, m; 0 if there are none."""
    return _extent([joint.origin for joint in assembly.joints])


def _extent(points: Sequence[Array]) -> float:
    return float(np.linalg.norm(np.ptp(np.array(points), axis=0))) if points else 0.0


def _largest_gyration(assembly: Assembly) -> float:
    properties = [part.mass_properties for part in assembly.parts if part.mass_properties.mass > 0]
    return math.sqrt(max((float(np.trace(item.inertia)) / item.mass for item in properties), default=0.0))


def _coupled(loops: Sequence[Loop]) -> list[list[Loop]]:
    """Loops in groups that share no joint that moves: each group is solved for itself."""
    graph: nx.Graph[object] = nx.Graph()
    for number, loop in enumerate(loops):
        graph.add_node(number)
        graph.add_edges_from((number, joint.name) for joint, _ in loop.steps if joint.type is not JointType.FIXED)
    groups = [sorted(item for item in group if isinstance(item, int)) for group in nx.connected_components(graph)]
    return [[loops[number] for number in group] for group in sorted(groups)]


def _closures(
    assembly: Assembly, loops: Sequence[Loop], tree: KinematicTree, joints: Sequence[Joint], length: float
) -> dict[str, Closure]:
    """Conditions that close coupled loops where their closing joints alone do not.

    Those of loops that move although they are overconstrained, and of planar ones whose closing joint has stops or
    friction.
    """
    columns = _columns(loops, tree, joints, ())
    matrix = loop_matrix(loops, columns, length)
    missing = sum(loop_equations(loop) for loop in loops) - len(independent_columns(matrix))
    found = resisting_closures(assembly, loops, length)
    if missing == 0:
        return found
    try:
        return found | movable_closures(assembly, loops, columns, length)
    except NotMovable as finding:
        raise overconstrained(loops, columns, missing, length, finding) from None


def _solve(
    loops: Sequence[Loop],
    columns: Sequence[Column],
    length: float,
    given: dict[str, list[float]],
    independent: dict[str, list[bool]],
) -> list[Lost]:
    """Finds the dependent coordinates of coupled loops and their rates; changes ``given`` and ``independent``."""
    matrix = loop_matrix(loops, columns, length)
    dependent = independent_columns(matrix)
    rates = np.array([given[joint.name][k] for joint, k in columns])
    free = sorted(set(range(len(columns))) - set(dependent))
    solution, *_ = np.linalg.lstsq(matrix[:, dependent], -matrix[:, free] @ rates[free], rcond=None)
    notes = []
    for column, value in zip(dependent, solution, strict=True):
        joint, k = columns[column]
        independent[joint.name][k] = False
        if given[joint.name][k] != 0.0 and abs(value - given[joint.name][k]) > 1e-6 * max(1.0, abs(value)):
            speed = f"its start speed follows from a loop ({value:.4g}); the one given was ignored"
            notes.append(Lost(f"joint {joint.name!r}: {speed}"))
        given[joint.name][k] = float(value)
    return notes


def _choose(
    loops: Sequence[Loop],
    columns: Sequence[Column],
    length: float,
    independent: dict[str, list[bool]],
    without: Container[str],
) -> list[str]:
    """Takes other coordinates as independent where those come to dead centres; changes ``independent``."""
    preferred = [number for number, (joint, k) in enumerate(columns) if independent[joint.name][k]]
    possible = [number for number, (joint, _) in enumerate(columns) if joint.name not in without]
    choice = choose_coordinates(loops, columns, length, preferred, possible)
    for number, (joint, k) in enumerate(columns):
        independent[joint.name][k] = number in choice.independent
    names = dict.fromkeys(columns[number][0].name for number in choice.independent)
    notes = []
    if set(choice.independent) != set(preferred):
        instead = ", ".join(repr(columns[number][0].name) for number in preferred)
        notes.append(
            f"states of a loop are those of {', '.join(map(repr, names))}: those of {instead}, chosen first, come to a "
            "dead centre sooner"
        )
    if choice.is_sampled:
        through = list(dict.fromkeys(joint.name for joint, _ in columns))
        others = " and others" if len(through) > _JOINTS_NAMED else ""
        notes.append(
            f"the loop through {', '.join(map(repr, through[:_JOINTS_NAMED]))}{others} moves in "
            f"{len(choice.independent)} ways, more than can be searched for dead centres: a simulation that comes to a "
            "position in which its states do not determine the rest ends there"
        )
    for value in choice.dead_centers:
        joint, k = columns[choice.independent[0]]
        turning = joint_twists(joint)[k][:3].any()
        unit, size = ("degrees", np.degrees(value)) if turning else ("mm", 1000 * value)
        notes.append(
            f"joint {joint.name!r} is the state of its loop and comes to a dead centre at about {size:.3g} {unit} from "
            "its start, which the model cannot pass"
        )
    return notes


def _without_variables(loops: Sequence[Loop], closures: Container[str]) -> set[str]:
    """Joints whose coordinates are no variables of the model: constraints, and spherical joints that close loops."""
    return {
        loop.joint.name
        for loop in loops
        if loop.joint.type is JointType.SPHERICAL or (loop.normal is not None and loop.joint.name not in closures)
    }


def _columns(
    loops: Sequence[Loop], tree: KinematicTree, joints: Sequence[Joint], closures: Container[str]
) -> list[Column]:
    """Coordinates of the loops' joints, candidates for dependence first.

    First those that no model variable stands for (planar loop constraints, spherical joints that close a loop), then
    others of cut joints, then of joints listed late; coordinates that start with a speed come last.
    """
    inside = {joint.name for loop in loops for joint, _ in loop.steps}
    cut = {joint.name for joint in tree.cut_joints}
    without = _without_variables(loops, closures)
    order = [joint for joint in joints if joint.name in cut] + [j for j in reversed(joints) if j.name not in cut]
    columns = []
    for joint in order:
        if joint.name in inside:
            columns += [(joint, k, rate) for k, rate in enumerate(start_rates(joint))]
    columns.sort(key=lambda column: 0 if column[0].name in without else 1 if column[2] == 0.0 else 2)
    return [(joint, k) for joint, k, _ in columns]


def _fundamental_loop(joint: Joint, tree: KinematicTree) -> Loop:
    """The loop that a cut joint closes with the spanning tree."""
    up = _path_to_root(joint.parent, tree)
    down = _path_to_root(joint.child, tree)
    while up and down and up[-1][0] is down[-1][0]:
        up.pop()
        down.pop()
    return Loop(joint, ((joint, 1.0), *down, *((j, -sign) for j, sign in reversed(up))), None)


def _path_to_root(name: str, tree: KinematicTree) -> list[Step]:
    """Joints from a part to its root; the sign is that of walking towards the root."""
    path: list[Step] = []
    current: str | None = name
    while current is not None and current != GROUND:
        branch = tree.branch(current)
        if branch.joint is not None:
            path.append((branch.joint, -1.0 if branch.joint.child == current else 1.0))
        current = branch.predecessor
    return path


def _loop_note(loop: Loop) -> str:
    names = ", ".join(repr(joint.name) for joint, _ in loop.steps)
    kind = "planar, by a planar loop constraint" if loop.normal is not None else "in space"
    return f"joint {loop.joint.name!r} closes a kinematic loop ({kind}): {names}"
