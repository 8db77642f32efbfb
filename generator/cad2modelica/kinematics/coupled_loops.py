"""Couplings of joints that stand in loops: there the loop says where a joint is, and a coupling would say it again."""

from __future__ import annotations

from dataclasses import replace

from cad2modelica.kinematics.kinematic_graph import kinematic_tree
from cad2modelica.kinematics.loops import closed_loops
from cad2modelica.mechanism.model import Assembly
from cad2modelica.source.lost import Lost


def without_looped_couplings(assembly: Assembly) -> Assembly:
    """The assembly without couplings of followers in loops; a note on each."""
    if not assembly.couplings:
        return assembly
    inside = {joint.name for loop in closed_loops(kinematic_tree(assembly)) for joint, _ in loop.steps}
    dropped = [item for item in assembly.couplings if item.follower in inside]
    if not dropped:
        return assembly
    notes = tuple(
        Lost(
            f"joint {item.follower!r} is to follow joint {item.leader!r}, but stands in a loop, which moves by itself; "
            "drive both joints alike"
        )
        for item in dropped
    )
    left = tuple(item for item in assembly.couplings if item not in dropped)
    return replace(assembly, couplings=left, notes=(*assembly.notes, *notes))
