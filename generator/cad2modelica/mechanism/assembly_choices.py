"""What the user may choose differently from the source: parts held in the world, stops at limits, pairs that touch."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from contact_foundation.errors import InputError, Place

from cad2modelica.mechanism.model import GROUND, Assembly, Joint
from cad2modelica.source.lost import Lost

LISTED = 30  # parts named in a message
STANDARD_GRAVITY = 9.81  # m/s2


def with_grounded(assembly: Assembly, names: Sequence[str]) -> Assembly:
    """The assembly with more parts fixed in the world where they stand.

    Args:
        assembly: the mechanism.
        names: of parts, or of links that belong to parts.

    Raises:
        InputError: there is no part of such a name.
    """
    known = [part.name for part in assembly.parts]
    held = {assembly.aliases.get(name, name) for name in names}
    for name in names:
        if assembly.aliases.get(name, name) not in (*known, GROUND):
            listed = ", ".join(known[:LISTED]) + (", ..." if len(known) > LISTED else "")
            raise InputError(
                f"there is no part {name!r} to ground", place=Place(file=assembly.file), remedy=f"Parts are: {listed}."
            )
    parts = tuple(replace(part, grounded=True) if part.name in held else part for part in assembly.parts)
    notes = tuple(
        note for note in assembly.notes if not any(note.endswith(f"--ground {name} holds it") for name in held)
    )
    standing = {GROUND, *(part.name for part in assembly.parts if part.grounded)}
    already = tuple(
        f"{name!r} stands in the world without --ground too"
        for name in names
        if assembly.aliases.get(name, name) in standing
    )
    return replace(assembly, parts=parts, notes=(*notes, *already))


AXES = ("x", "y", "z", "-x", "-y", "-z")


def with_up(assembly: Assembly, up: str | None) -> Assembly:
    """The assembly with gravity against an axis of its source: CAD systems do not say which one points up.

    Raises:
        InputError: there is no such axis.
    """
    if up is None:
        return assembly
    if up not in AXES:
        raise InputError(f"{up!r} is no axis that could point up", remedy=f"Give one of {', '.join(AXES)}.")
    axis = np.eye(3)["xyz".index(up[-1])] * (-1.0 if up.startswith("-") else 1.0)
    strength = float(np.linalg.norm(assembly.gravity)) or STANDARD_GRAVITY
    return replace(assembly, gravity=-strength * axis + 0.0)


def without_contacts(assembly: Assembly, contacts: bool) -> Assembly:
    """The assembly in which only pairs touch that are included one by one, unless contacts are wanted."""
    return assembly if contacts else replace(assembly, contacts=replace(assembly.contacts, all_pairs=False))


def with_pairs(assembly: Assembly, exclude: Sequence[tuple[str, str]], include: Sequence[tuple[str, str]]) -> Assembly:
    """The assembly with more pairs of parts and planes that do not, or do, touch each other.

    Raises:
        InputError: there is no part or plane of such a name.
    """
    known = [*(part.name for part in assembly.parts), *(plane.name for plane in assembly.planes)]

    def named(pair: tuple[str, str]) -> tuple[str, str]:
        for name in pair:
            if assembly.aliases.get(name, name) not in known:
                listed = ", ".join(known[:LISTED]) + (", ..." if len(known) > LISTED else "")
                raise InputError(
                    f"there is no part {name!r} in the pair {pair[0]},{pair[1]}",
                    place=Place(file=assembly.file),
                    remedy=f"Parts are: {listed}.",
                )
        return assembly.aliases.get(pair[0], pair[0]), assembly.aliases.get(pair[1], pair[1])

    contacts = assembly.contacts
    excluded = tuple(named(pair) for pair in exclude)
    included = tuple(named(pair) for pair in include)
    taken = {frozenset(pair) for pair in excluded}
    return replace(
        assembly,
        contacts=replace(
            contacts,
            excluded=(*contacts.excluded, *excluded),
            included=(*(pair for pair in contacts.included if frozenset(pair) not in taken), *included),
        ),
    )


def with_stops(assembly: Assembly, wanted: bool | None) -> Assembly:
    """The assembly with stops at its joints' limits, or without any.

    A joint that starts outside its range gets no stop, which would hit it at the start; a note says so, also where none
    has stops.

    Args:
        assembly: the mechanism.
        wanted: whether limits are stops; None: as the source's format has it.
    """
    limited = [joint for joint in assembly.joints if joint.limits is not None]
    if not limited:
        return assembly
    if not (assembly.limits_stop if wanted is None else wanted):
        count = f"{len(limited)} joints move" if len(limited) > 1 else "1 joint moves"
        note = Lost(f"{count} without stops at the limits; --stops adds them, --no-stops does without")
        notes = (*((note,) if wanted is None else ()), *_outside_notes(limited))
        return _without_limits(assembly, {joint.name for joint in limited}, notes)
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


def _outside_notes(joints: Sequence[Joint]) -> tuple[str, ...]:
    """That joints without stops start where the machine never is; position zero is so in many descriptions."""
    outside = [joint for joint in joints if _starts_outside(joint)]
    if not outside:
        return ()
    listed = ", ".join(
        f"{joint.name!r} at {joint.position:g} ({_bound(joint.limits.lower)} to {_bound(joint.limits.upper)})"
        for joint in outside[:LISTED]
        if joint.limits is not None
    )
    more = f", and {len(outside) - LISTED} more" if len(outside) > LISTED else ""
    count = len(outside)
    kind = "1 joint starts outside its range" if count == 1 else f"{count} joints start outside their ranges"
    return (f"{kind}, where parts may lie in each other: {listed}{more}",)


def _bound(value: float | None) -> str:
    return "none" if value is None else f"{value:.4g}"


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
