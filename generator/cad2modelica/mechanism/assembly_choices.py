"""What the user may choose differently from the source: parts held in the world, and limits as stops or not."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from contact_foundation.errors import InputError, Place

from cad2modelica.mechanism.model import Assembly, Joint
from cad2modelica.source.lost import Lost

LISTED = 30  # parts named in a message


def with_grounded(assembly: Assembly, names: Sequence[str]) -> Assembly:
    """The assembly with more parts fixed in the world where they stand.

    Raises:
        InputError: there is no part of such a name.
    """
    known = [part.name for part in assembly.parts]
    for name in names:
        if name not in known:
            listed = ", ".join(known[:LISTED]) + (", ..." if len(known) > LISTED else "")
            raise InputError(
                f"there is no part {name!r} to ground", place=Place(file=assembly.file), remedy=f"Parts are: {listed}."
            )
    parts = tuple(replace(part, grounded=True) if part.name in names else part for part in assembly.parts)
    notes = tuple(
        note for note in assembly.notes if not any(note.endswith(f"--ground {name} holds it") for name in names)
    )
    return replace(assembly, parts=parts, notes=notes)


def with_stops(assembly: Assembly, wanted: bool | None) -> Assembly:
    """The assembly with stops at its joints' limits, or without any.

    A joint that starts outside its range gets no stop, which would hit it at the start; a note says so.

    Args:
        assembly: the mechanism.
        wanted: whether limits are stops; None: as the source's format has it.
    """
    limited = [joint for joint in assembly.joints if joint.limits is not None]
    if not limited or (wanted is None and assembly.limits_stop):
        return assembly
    if not wanted:
        count = f"{len(limited)} joints move" if len(limited) > 1 else "1 joint moves"
        note = Lost(f"{count} without stops at the limits; --stops adds them, --no-stops does without")
        return _without_limits(assembly, {joint.name for joint in limited}, (note,) if wanted is None else ())
    outside = [joint for joint in limited if _starts_outside(joint)]
    notes = tuple(
        Lost(
            f"joint {joint.name!r} has no stops, for it starts at {joint.position:g}, outside its range "
            f"{joint.limits.lower} to {joint.limits.upper}"
        )
        for joint in outside
        if joint.limits is not None
    )
    return _without_limits(assembly, {joint.name for joint in outside}, notes)


def _starts_outside(joint: Joint) -> bool:
    limits = joint.limits
    if limits is None:
        return False
    return (limits.lower is not None and joint.position < limits.lower) or (
        limits.upper is not None and joint.position > limits.upper
    )


def _without_limits(assembly: Assembly, names: set[str], notes: tuple[str, ...]) -> Assembly:
    joints = tuple(replace(joint, limits=None) if joint.name in names else joint for joint in assembly.joints)
    return replace(assembly, joints=joints, notes=(*assembly.notes, *notes))
