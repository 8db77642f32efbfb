"""What a generation may change in an earlier package, and what it must ask about first.

``Resources/generation.json`` in the package records what the generator wrote: the mechanics' structure with its
signature, that of the assignment of actuators, and the check sum of the mechatronic model's file. So the next
generation knows what has changed since, and whether somebody edited the mechatronic model.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from enum import Enum
from pathlib import Path
from typing import Any

from contact_foundation.errors import InputError, Place

from cad2modelica.actuators.file import NamedJoints
from cad2modelica.mechanism.model import Assembly, Assignment
from cad2modelica.regenerate.own_files import OwnFiles, declared_names
from cad2modelica.structure.changes import differences
from cad2modelica.structure.entries import Structure, structure_from
from cad2modelica.structure.renames import Renames

RECORD = "Resources/generation.json"
MECHATRONICS_FILE = Path("Mechatronics.mo")
FORMAT = 1
LISTED = 50  # changes told before consent; the notes of what is then written hold all


class Edited(Enum):
    """What to do with an edited mechatronic model when the assignment of actuators has changed."""

    ASK = "ask"
    KEEP = "keep"
    REPLACE = "replace"


@dataclass(frozen=True)
class Record:
    """What an earlier generation wrote.

    Attributes:
        structure: of the mechanics.
        actuators: signature of the assignment.
        mechatronics: SHA-256 of the mechatronic model's file.
        files: resources, by their paths in the package.
    """

    structure: Structure
    actuators: str
    mechatronics: str
    files: tuple[str, ...] = ()


@dataclass(frozen=True)
class Plan:
    """What is going to be written.

    Attributes:
        write_mechatronics: whether the mechatronic model is written, anew or for the first time.
        keep_old: name that an edited model is kept under when it is replaced; None if none is.
        notes: what the user should know.
    """

    write_mechatronics: bool
    keep_old: str | None
    notes: tuple[str, ...]


def read_record(root: Path) -> Record | None:
    """The record of an earlier package; None if there is none, or none that can be read."""
    try:
        data = json.loads((root / RECORD).read_text(encoding="utf-8"))
        if data["format"] != FORMAT:
            return None
        files = tuple(str(file) for file in data.get("files", ()))
        return Record(structure_from(data["structure"]), str(data["actuators"]), str(data["mechatronics"]), files)
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return None


def record_text(record: Record) -> str:
    """The record as JSON."""
    data = {
        "format": FORMAT,
        "signature": record.structure.signature,
        "structure": asdict(record.structure),
        "actuators": record.actuators,
        "mechatronics": record.mechatronics,
        "files": list(record.files),
    }
    return json.dumps(data, ensure_ascii=False, indent=1) + "\n"


def actuator_signature(assignments: Sequence[Assignment], assembly: Assembly) -> str:
    """SHA-256 of all that the mechatronic model says itself: the assignment, joints' ratings, and the experiment."""
    data: list[Any] = [[asdict(item) for item in assignments], assembly.stop_time, assembly.tolerance]
    driven = {item.joint for item in assignments}
    ratings = [[joint.name, asdict(joint.rating)] for joint in assembly.joints if joint.rating and joint.name in driven]
    data += [ratings] if ratings else []
    return checksum(json.dumps(data, sort_keys=True).encode())


def checksum(data: bytes) -> str:
    """SHA-256 in hexadecimal digits."""
    return hashlib.sha256(data).hexdigest()


def require_same_structure(
    earlier: Record | None,
    structure: Structure,
    own: OwnFiles,
    renames: Renames,
    assigned: NamedJoints | None,
    accepted: bool,
) -> tuple[str, ...]:
    """Compares the structure with the earlier one.

    Args:
        earlier: of the earlier package.
        structure: now.
        own: the modeller's files, the mechatronic model among them.
        renames: parts and joints that seem renamed.
        assigned: joints that the actuator file names, if there is one.
        accepted: whether a changed structure may be written.

    Returns:
        Notes on what has changed; empty if nothing has.

    Raises:
        InputError: it has changed, and that is not accepted.
    """
    if earlier is None or earlier.structure == structure:
        return ()
    changes = differences(earlier.structure, structure, renames)
    edited = is_edited(own, earlier)
    gone = dict.fromkeys(earlier.structure.names - structure.names) | _names_now(earlier.structure, structure, renames)
    lost = own.references_to(gone, () if edited else (MECHATRONICS_FILE,))
    lost += _without_joint(assigned, structure, renames) if assigned is not None else []
    if accepted:
        return (*(f"structure: {change}" for change in changes), *(f"no longer fits: {item}" for item in lost))
    lines = ["the mechanism has another structure than the package that is there:"]
    lines += _listed(changes)
    lines += ["What no longer fits:", *_listed(lost)] if lost else ["Nothing refers to what is gone."]
    lines.append(
        "Nothing was written. With --accept-structure Mechanics, Geometry and scene.json are written anew, and"
    )
    lines.append(
        f"{MECHATRONICS_FILE} stays as you edited it."
        if edited
        else f"{MECHATRONICS_FILE}, which nobody has edited, is written anew from the assignment of actuators."
    )
    raise InputError(
        "\n".join(lines),
        place=Place(file=own.root),
        remedy="Adapt the files named above (or rename back in the CAD system), then repeat with --accept-structure."
        if lost
        else "Repeat with --accept-structure if that is meant.",
    )


def _listed(items: Sequence[str]) -> list[str]:
    """Lines of a message, as many as can be read."""
    more = [f"  - and {len(items) - LISTED} more"] if len(items) > LISTED else []
    return [*(f"  - {item}" for item in items[:LISTED]), *more]


def _names_now(before: Structure, after: Structure, renames: Renames) -> dict[str, str | None]:
    """What components that are gone seem to be called in the model now, by their earlier names in it."""
    found: dict[str, str | None] = {}
    for old, new, renamed in (
        (before.bodies, after.bodies, renames.parts),
        (before.joints, after.joints, renames.joints),
    ):
        now = {item.source: item.name for item in new}
        found |= {item.name: now[renamed[item.source].name] for item in old if item.source in renamed}
    kept = {*after.names}
    return {name: present for name, present in found.items() if name not in kept}


def _without_joint(assigned: NamedJoints, structure: Structure, renames: Renames) -> list[str]:
    """Entries of the actuator file whose joint is not there, and which joint it seems to be now."""
    joints = {joint.source for joint in structure.joints}
    lines = []
    for name in dict.fromkeys(assigned.names):
        if name not in joints:
            guess = renames.joints.get(name)
            hint = f"; it seems to be {guess.name!r} now" if guess is not None else ""
            lines.append(f"{assigned.file}: no joint {name!r}{hint}")
    return lines


def is_edited(own: OwnFiles, earlier: Record | None) -> bool:
    """Whether somebody changed the mechatronic model since it was generated; so it counts without a record too."""
    if MECHATRONICS_FILE not in own.files:
        return False
    return earlier is None or checksum((own.root / MECHATRONICS_FILE).read_bytes()) != earlier.mechatronics


def plan_mechatronics(
    own: OwnFiles, earlier: Record | None, structure: Structure, actuators: str, edited_choice: Edited
) -> Plan:
    """Decides about the mechatronic model.

    It is written if there is none, or if the assignment or the structure has changed and nobody edited it. An
    edited one stays when the structure has changed; when the assignment has, the user must choose.

    Raises:
        InputError: the assignment has changed, the model was edited, and no choice was made.
    """
    if MECHATRONICS_FILE not in own.files:
        return Plan(True, None, ())
    same_actuators = earlier is not None and earlier.actuators == actuators
    same_structure = earlier is not None and earlier.structure == structure
    if not is_edited(own, earlier):
        return Plan(not (same_actuators and same_structure), None, ())
    if same_actuators or (earlier is None and edited_choice is Edited.ASK):
        note = f"{MECHATRONICS_FILE} was edited and stays as it is"
        if edited_choice is Edited.REPLACE:
            note += ", for the assignment of actuators has not changed; move it away to have it written anew"
        is_news = earlier is None or not same_structure or edited_choice is Edited.REPLACE
        return Plan(False, None, (note,) if is_news else ())
    if edited_choice is Edited.KEEP:
        return Plan(False, None, (f"{MECHATRONICS_FILE} was edited and stays; the new assignment is not in it",))
    if edited_choice is Edited.REPLACE:
        name = _free_name(own)
        return Plan(True, name, (f"{MECHATRONICS_FILE} was written anew; the edited one is kept as {name}",))
    raise InputError(
        f"{MECHATRONICS_FILE} was edited by hand, and the assignment of actuators has changed since: "
        "nothing was written",
        place=Place(file=own.root / MECHATRONICS_FILE),
        remedy="Choose --mechatronics keep (it stays as it is) or --mechatronics replace (it is written anew, the "
        "edited file is kept beside it).",
    )


def lost_references(own: OwnFiles, plan: Plan, mechatronics: str) -> tuple[str, ...]:
    """Notes on what the modeller's files use of a mechatronic model that is written anew and no longer has it.

    Args:
        own: the modeller's files, the earlier mechatronic model among them.
        plan: what is going to be written.
        mechatronics: the new model's text.
    """
    if not plan.write_mechatronics or MECHATRONICS_FILE not in own.files:
        return ()
    before = (own.root / MECHATRONICS_FILE).read_text(encoding="utf-8", errors="replace")
    gone = sorted(declared_names(before) - declared_names(mechatronics))
    found = own.references_to(dict.fromkeys(gone), (MECHATRONICS_FILE,))
    return tuple(f"no longer fits: {item}, which {MECHATRONICS_FILE} had" for item in found)


def _free_name(own: OwnFiles) -> str:
    names = {str(file) for file in own.files}
    number = 1
    while f"{MECHATRONICS_FILE}.edited{number}" in names:
        number += 1
    return f"{MECHATRONICS_FILE}.edited{number}"
