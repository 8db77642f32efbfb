"""What makes loops overconstrained: which joints take part, and which of them could have more freedom."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from contact_foundation.errors import InputError

from cad2modelica.geometry.spatial import Array
from cad2modelica.kinematics.joint_twists import (
    Column,
    independent_columns,
    loop_equations,
    loop_matrix,
    loop_projection,
    twists_of,
)
from cad2modelica.kinematics.loop_closures import NotMovable
from cad2modelica.kinematics.planar_loops import Loop
from cad2modelica.mechanism.model import Joint, JointType

LISTED = 12  # joints and remedies named in a message

# Joints that allow what the first one allows, and more.
_WIDER = {
    JointType.FIXED: (JointType.SPHERICAL,),
    JointType.REVOLUTE: (JointType.CYLINDRICAL, JointType.UNIVERSAL, JointType.SPHERICAL),
    JointType.PRISMATIC: (JointType.CYLINDRICAL, JointType.PLANAR),
    JointType.SCREW: (JointType.CYLINDRICAL,),
    JointType.CYLINDRICAL: (),
    JointType.UNIVERSAL: (JointType.SPHERICAL,),
    JointType.PLANAR: (),
    JointType.SPHERICAL: (),
}


def overconstrained(
    loops: Sequence[Loop], columns: Sequence[Column], missing: int, length: float, finding: NotMovable
) -> InputError:
    """The error about coupled loops whose conditions are not independent at the start.

    Args:
        loops: loops that share joints.
        columns: the coordinates of their joints.
        missing: number of conditions less the rank of their matrix.
        length: typical length of the mechanism, m.
        finding: why it does not move, or not from where it stands.
    """
    matrix = loop_matrix(loops, columns, length)
    involved = _involved(loops, matrix)
    remedies = [] if finding.singular else _remedies(loops, columns, matrix, involved, missing, length)
    joints = _joints(involved)
    names = ", ".join(repr(joint.name) for joint in joints[:LISTED])
    times = f"{missing} time{'s' if missing > 1 else ''}"
    place = involved[0].joint
    total = sum(loop_equations(loop) for loop in loops)
    lines = [
        f"the loop that the joint {place.name!r} closes is overconstrained {times}: "
        f"of {total} closing conditions only {total - missing} are independent at the start, "
        "so the forces in it are not determined by rigid bodies.",
        f"  {finding}",
        f"  Joints that take part: {names}{', ...' if len(joints) > LISTED else ''}.",
    ]
    if remedies:
        lines.append("  Each of these alone makes it right:")
        lines += [f"  - {remedy}" for remedy in remedies[:LISTED]]
    return InputError(
        "\n".join(lines),
        place=place.place,
        remedy="Move the parts a little along their motion and export that position."
        if finding.singular
        else "Correct the axes, give a joint more freedom (spherical instead of revolute, cylindrical instead of "
        "prismatic), or suppress one that repeats what others hold already.",
    )


def _involved(loops: Sequence[Loop], matrix: Array) -> list[Loop]:
    """Loops whose conditions take part in a combination that says nothing: rows of the left null space."""
    left, values, _ = np.linalg.svd(matrix)
    rank = len(independent_columns(matrix))
    null = left[:, rank:] if len(values) else np.eye(matrix.shape[0])
    found, row = [], 0
    for loop in loops:
        rows = slice(row, row + loop_equations(loop))
        if np.abs(null[rows]).max() > 1e-6:
            found.append(loop)
        row = rows.stop
    return found or list(loops)


def _joints(loops: Sequence[Loop]) -> list[Joint]:
    names: dict[str, Joint] = {}
    for loop in loops:
        names.update((joint.name, joint) for joint, _ in loop.steps)
    return list(names.values())


def _remedies(
    loops: Sequence[Loop],
    columns: Sequence[Column],
    matrix: Array,
    involved: Sequence[Loop],
    missing: int,
    length: float,
) -> list[str]:
    """Single joints that make all conditions independent if they get more freedom, or are left out."""
    found = []
    for joint in _joints(involved):
        for kind in _WIDER[joint.type]:
            axis = joint.axis if joint.axis is not None else np.array([0.0, 0.0, 1.0])
            more = _columns_of(joint, twists_of(kind, joint.origin, axis, joint.second_axis), loops, length)
            if len(independent_columns(np.column_stack([matrix, more]))) == matrix.shape[0]:
                found.append(f"{joint.name!r} as {kind.value} joint")
                break
    return found + _superfluous(loops, columns, involved, missing, length)


def _columns_of(joint: Joint, twists: Sequence[Array], loops: Sequence[Loop], length: float) -> Array:
    columns = []
    for twist in twists:
        parts = []
        for loop in loops:
            sign = sum(s for other, s in loop.steps if other is joint)
            parts.append(sign * (loop_projection(loop, length) @ twist))
        columns.append(np.concatenate(parts))
    return np.column_stack(columns)


def _superfluous(
    loops: Sequence[Loop], columns: Sequence[Column], involved: Sequence[Loop], missing: int, length: float
) -> list[str]:
    """Closing joints that can be left out: the other loops have all their conditions, and as many freedoms stay."""
    full = len(columns) - (sum(loop_equations(loop) for loop in loops) - missing)
    found = []
    for loop in involved:
        rest = [other for other in loops if other is not loop]
        if any(loop.joint is joint for other in rest for joint, _ in other.steps):
            continue
        kept = [column for column in columns if column[0] is not loop.joint]
        matrix = loop_matrix(rest, kept, length)
        rank = len(independent_columns(matrix)) if rest else 0
        if rank == matrix.shape[0] and len(kept) - rank == full:
            found.append(f"{loop.joint.name!r} left out: the others hold what it holds")
    return found
