"""Closing conditions for loops that move although they have too many: by special geometry some follow from others.

Linkages of Bennett, Sarrus and Bricard, a third crank of a parallelogram, a nut in a guide: the rank of their loops'
equations is smaller than the number of conditions, in every position they can reach. Where the rank stays the same
along the motion, as many conditions as it says, independent at the start, describe the same motion near it (constant
rank theorem). Of the conditions in the axes of the part that the closing joint meets those are chosen that stay
farthest from dependence in all positions looked at.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from cad2modelica.geometry.spatial import Array
from cad2modelica.kinematics.joint_twists import Column, independent_columns, loop_equations, loop_projection
from cad2modelica.kinematics.loop_motion import LoopMotion, Position, scaled
from cad2modelica.kinematics.planar_loops import PARALLEL_TOLERANCE, Loop
from cad2modelica.mechanism.model import GROUND, Assembly, Joint, JointType

LEAST_TOLERANCE = 1e-6  # rad, or part of the mechanism's length, that a closed loop may show when simulated
STILL = 1e-6  # rad or m: a coordinate that changes less does not move
MARGIN = 10.0  # of the same over what the positions looked at leave open
SURE_DIGITS = 6
AXES = ("x", "y", "z")


@dataclass(frozen=True)
class Closure:
    """What a closing joint holds at the part it meets, in that part's axes; in its parent's if it is spherical.

    Attributes:
        shifts, turns: along and about x, y and z.
        distance, angle: what the conditions left out may show in a simulation, m and rad; a ball may turn at will.
        note: what was found, for the user.
    """

    shifts: tuple[bool, bool, bool]
    turns: tuple[bool, bool, bool]
    distance: float
    angle: float
    note: str

    @property
    def is_empty(self) -> bool:
        """Whether nothing is held: the other joints hold all of it."""
        return not any(self.shifts) and not any(self.turns)


class NotMovable(Exception):  # a finding, not an error: the caller words the error
    """Overconstrained loops that do not move, or not from where they stand; the text says why.

    Args:
        text: what was found.
        singular: whether the start alone is to blame, and not the joints.
    """

    def __init__(self, text: str, *, singular: bool = False) -> None:
        super().__init__(text)
        self.singular = singular


def movable_closures(
    assembly: Assembly, loops: Sequence[Loop], columns: Sequence[Column], length: float
) -> dict[str, Closure]:
    """Conditions for those of coupled loops that are overconstrained, by the names of their closing joints.

    Args:
        assembly: the mechanism.
        loops: they share joints, and have more conditions than are independent.
        columns: coordinates of all their joints.
        length: typical length of the mechanism, m.

    Raises:
        NotMovable: the loops are rigid, can move infinitely little only, or start in a singular position.
    """
    motion = LoopMotion(loops, columns, length)
    start = motion.start()
    rank = motion.rank(start)
    positions = [start, *_reached(motion, rank, len(columns))] if columns else [start]
    lacking = _lacking(loops, start, length)
    before = [np.zeros((0, len(columns)))] * len(positions)
    for number, loop in enumerate(loops):
        if loop not in lacking:
            rows = [loop_projection(loop, length) @ position.matrix[number] for position in positions]
            before = [np.vstack(pair) for pair in zip(before, rows, strict=True)]
    found = {}
    gap = max(position.gap for position in positions)
    for number, loop in enumerate(loops):
        if loop in lacking:
            blocks = [_conditions(position, number, loop.joint, assembly, length) for position in positions]
            chosen = _choice(before, blocks)
            before = [np.vstack([rows, block[list(chosen)]]) for rows, block in zip(before, blocks, strict=True)]
            found[loop.joint.name] = _closure(loop, chosen, gap, length, len(positions))
    blocked = _blocked(columns, positions)
    if blocked:
        last = list(found)[-1]
        found[last] = replace(found[last], note=f"{found[last].note}. In these loops cannot move: {blocked}")
    return found


def resisting_closures(assembly: Assembly, loops: Sequence[Loop], length: float) -> dict[str, Closure]:
    """Conditions for planar loops whose closing joint has stops or friction, by the names of these joints.

    A planar loop constraint has no coordinate that they could act on. The joint keeps its own, and the part that it
    meets is held in the plane of the loop: two shifts and a turn in that part's axes, whatever the position.

    Args:
        assembly: the mechanism.
        loops: of any kind.
        length: typical length of the mechanism, m.
    """
    found = {}
    for loop in loops:
        joint = loop.joint
        if loop.normal is not None and joint.has_resistance:
            across = np.abs(assembly.part(joint.child).pose.rotation.T @ loop.normal)
            axis = int(np.argmax(np.round(across, SURE_DIGITS)))  # rounding must not decide between equals
            angle = MARGIN * PARALLEL_TOLERANCE
            note = (
                f"joint {joint.name!r} closes a planar loop and keeps its coordinate, for its stops or friction: "
                f"in the axes of {joint.child!r} the turn about {AXES[axis]} and the shifts along the others are held"
            )
            x, y, z = (k == axis for k in range(3))
            found[joint.name] = Closure((not x, not y, not z), (x, y, z), float(f"{angle * length:.2g}"), angle, note)
    return found


def _blocked(columns: Sequence[Column], positions: Sequence[Position]) -> str:
    """Names of joints that stayed where they are in all positions; empty if nothing can move at all."""
    if len(positions) == 1:
        return ""
    moving = np.abs([position.coordinates for position in positions]).max(axis=0) > STILL
    names = {joint.name for (joint, _), moves in zip(columns, moving, strict=True) if moves}
    return ", ".join(repr(name) for name in dict.fromkeys(joint.name for joint, _ in columns) if name not in names)


def _reached(motion: LoopMotion, rank: int, count: int) -> list[Position]:
    """Closed positions along the motion, all of the start's rank."""
    if rank == count:
        raise NotMovable("At the start nothing in it can move: is an axis not quite where it should be?")
    ways = motion.ways()
    found = [position for way in ways for position in way]
    ranks = [motion.rank(position) for position in (found if all(ways) else [*found, *motion.beside()])]
    if max(ranks, default=rank) > rank:
        raise NotMovable(
            "The start is a singular position, as a dead centre is: beside it "
            f"{max(ranks)} conditions are independent. Start in another position.",
            singular=True,
        )
    if min(ranks, default=rank) < rank:
        raise NotMovable("Its motion leads through a singular position, where more joints can move than at the start.")
    if not all(ways):
        raise NotMovable("It can only move infinitely little: a finite motion would open it.")
    return found


def _lacking(loops: Sequence[Loop], start: Position, length: float) -> list[Loop]:
    """Loops whose conditions are not all independent of those of the loops before."""
    rows = np.zeros((0, start.matrix[0].shape[1]))
    found = []
    for loop, matrix in zip(loops, start.matrix, strict=True):
        more = np.vstack([rows, loop_projection(loop, length) @ matrix])
        if len(independent_columns(more)) == len(rows) + loop_equations(loop):
            rows = more
        else:
            found.append(loop)
    return found


def _conditions(position: Position, number: int, joint: Joint, assembly: Assembly, length: float) -> Array:
    """What the closing joint's frames can move against each other, by coordinate: shifts and then turns.

    In the axes of its child, shape (6, columns); of a spherical joint, which lets its child turn, the shifts of its
    centre in the axes of its parent, shape (3, columns).
    """
    turns, shifts = position.matrix[number][:3], position.matrix[number][3:]
    if joint.type is JointType.SPHERICAL:
        axes = np.eye(3) if joint.parent == GROUND else assembly.part(joint.parent).pose.rotation
        point = joint.origin
    else:
        child = position.turned[number] @ assembly.part(joint.child).pose
        axes, point = child.rotation, child.position
    moved = scaled(np.vstack([axes.T @ turns, axes.T @ (shifts + np.cross(turns.T, point).T)]), length)
    return moved[3:] if joint.type is JointType.SPHERICAL else np.vstack([moved[3:], moved[:3]])


def _choice(before: Sequence[Array], blocks: Sequence[Array]) -> tuple[int, ...]:
    """Rows of the blocks that are independent of those before, and of each other, most clearly in all positions."""
    wanted = len(independent_columns(np.vstack([before[0], blocks[0]]))) - len(independent_columns(before[0]))

    grams = []
    for known, block in zip(before, blocks, strict=True):
        base = np.linalg.qr(known.T)[0] if len(known) else np.zeros((block.shape[1], 0))
        rest = block - (block @ base) @ base.T  # what is not said already
        grams.append(rest @ rest.T)
    products = np.array(grams)

    def clearness(rows: tuple[int, ...]) -> float:
        least = np.linalg.eigvalsh(products[:, rows][:, :, rows])[:, 0].min()
        return float(f"{max(least, 0.0):.4g}")  # rounding must not decide between equals

    return max(combinations(range(len(blocks[0])), wanted), key=clearness) if wanted else ()


def _closure(loop: Loop, chosen: tuple[int, ...], gap: float, length: float, positions: int) -> Closure:
    x, y, z, turn_x, turn_y, turn_z = (k in chosen for k in range(6))
    angle = max(LEAST_TOLERANCE, MARGIN * gap)
    name = loop.joint.name
    axes = loop.joint.parent if loop.joint.type is JointType.SPHERICAL else loop.joint.child
    if not chosen:
        note = f"joint {name!r} was left out: it repeats what other joints hold"
        return Closure((x, y, z), (turn_x, turn_y, turn_z), 0.0, 0.0, note)
    words = [f"shift along {AXES[k]}" for k in chosen if k < 3] + [f"turn about {AXES[k - 3]}" for k in chosen if k > 2]
    note = (
        f"the loop that joint {name!r} closes is overconstrained but moves: of its {loop_equations(loop)} conditions "
        f"{len(words)} were kept ({', '.join(words)}, in the axes of {axes!r}); the others follow from the "
        f"geometry: in {positions} positions along the motion to {1000 * gap * length:.2g} mm and "
        f"{np.degrees(gap):.2g} degrees. Forces in this loop are one of many solutions: rigid bodies do not determine "
        "them"
    )
    distance = float(f"{angle * length:.2g}")
    angle = math.inf if loop.joint.type is JointType.SPHERICAL else float(f"{angle:.2g}")
    return Closure((x, y, z), (turn_x, turn_y, turn_z), distance, angle, note)
