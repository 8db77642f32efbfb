"""Remarks of a generation that no single stage makes."""

from __future__ import annotations

from cad2modelica.kinematic_graph import KinematicTree
from cad2modelica.loops import joint_extent
from cad2modelica.mass_check import check_against_mechanism
from cad2modelica.model import Assembly
from cad2modelica.start_overlaps import StartCheck

NOTED_OVERLAPS = 10


def unit_notes(assembly: Assembly) -> tuple[str, ...]:
    """Doubts about the units of parts without geometry; only joints tell how large such a mechanism is."""
    if len(assembly.joints) < 2:
        return ()
    length = max(joint_extent(assembly), 1e-6)
    notes = []
    for part in assembly.parts:
        finding = check_against_mechanism(part.mass_properties, length) if not part.meshes else None
        if finding is not None:
            notes.append(f"part {part.name!r}: {finding.message}; {finding.remedy}")
    return tuple(notes)


def speed_notes(assembly: Assembly, tree: KinematicTree) -> tuple[str, ...]:
    """Start speeds of parts that joints hold: those of their joints count."""
    held = [
        part.name
        for part in assembly.parts
        if (part.velocity.any() or part.angular_velocity.any()) and tree.branch(part.name).predecessor is not None
    ]
    return tuple(f"part {name!r}: its start speed was ignored, for joints hold it; give it to a joint" for name in held)


def overlap_notes(start: StartCheck) -> tuple[str, ...]:
    """Overlaps in the start configuration, the deepest first, or why they were not looked for."""
    if start.reason is not None:
        return (f"overlaps at the start were not checked: {start.reason}",)
    return tuple(
        f"{item.first!r} and {item.second!r} overlap at the start by {1000 * item.depth:.4g} mm"
        + (f", {100 * item.share:.0f} % of the smaller one: contact throws them apart" if item.deep else "")
        for item in start.overlaps[:NOTED_OVERLAPS]
    )
