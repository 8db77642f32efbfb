"""Which bodies may touch: all pairs but those that are joined, fixed to each other, or excluded."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from cad2modelica.kinematics.kinematic_graph import KinematicTree
from cad2modelica.kinematics.reach import Ball, Reach
from cad2modelica.mechanism.model import GROUND, Assembly, Joint, JointType

LISTED = 10  # pairs named in a note


def contact_pairs(assembly: Assembly, tree: KinematicTree, colliding: Sequence[str]) -> list[tuple[str, str]]:
    """Pairs of names of parts and planes, in the order of ``colliding``.

    Args:
        assembly: the mechanism.
        tree: its graph.
        colliding: names of the parts and planes that have a shape.

    Returns:
        With the default "all": every pair except neighbours in a joint (counting rigidly joined parts as one),
        parts of one rigid group, pairs of fixed bodies and excluded pairs; pairs included explicitly stay. With the
        default "none": the included pairs.
    """
    planes = {plane.name for plane in assembly.planes}
    group = {**tree.rigid_groups, **dict.fromkeys(planes, GROUND)}
    joined = {frozenset(_joined_units(joint, tree)) for joint in assembly.joints if joint.type is not JointType.FREE}
    excluded = {frozenset(pair) for pair in assembly.contacts.excluded}
    included = {frozenset(pair) for pair in assembly.contacts.included}

    def may_touch(first: str, second: str) -> bool:
        if group[first] == group[second]:
            return False
        names = frozenset((first, second))
        if names in included:
            return True
        if not assembly.contacts.all_pairs or names in excluded:
            return False
        return frozenset((_unit(first, tree), _unit(second, tree))) not in joined

    return [
        (first, second)
        for index, first in enumerate(colliding)
        for second in colliding[index + 1 :]
        if may_touch(first, second)
    ]


def within_reach(
    assembly: Assembly, tree: KinematicTree, pairs: Sequence[tuple[str, str]], balls: Mapping[str, Ball]
) -> tuple[list[tuple[str, str]], tuple[str, ...]]:
    """Drops pairs that can never meet, whatever the joints do; those included explicitly stay.

    Args:
        assembly: the mechanism.
        tree: its graph.
        pairs: of names of parts and planes.
        balls: for every part of a pair, one that holds its shapes.

    Returns:
        The pairs that are left, and a note on those that are not.
    """
    reach = Reach(assembly.parts, assembly.planes, tree)
    included = {frozenset(pair) for pair in assembly.contacts.included}
    apart = reach.apart(balls)
    left: list[tuple[str, str]] = []
    dropped: list[tuple[str, str]] = []
    for pair in pairs:
        kept = not apart(*pair) or frozenset(pair) in included
        (left if kept else dropped).append(pair)
    if not dropped:
        return left, ()
    listed = ", ".join(f"{first!r} and {second!r}" for first, second in dropped[:LISTED])
    more = f", and {len(dropped) - LISTED} more" if len(dropped) > LISTED else ""
    return left, (f"left out of the contacts, because the joints keep them apart: {listed}{more}",)


def _unit(name: str, tree: KinematicTree) -> str:
    """What a joint joins: a rigid group, but a fixed part by itself.

    A joint to one fixed part keeps its neighbour away from that part, not from everything else that is fixed.
    """
    group = tree.rigid_groups.get(name, GROUND)
    return name if group == GROUND else group


def _joined_units(joint: Joint, tree: KinematicTree) -> tuple[str, str]:
    return _unit(joint.parent, tree), _unit(joint.child, tree)
