"""What others may rely on in a generated mechanics: its bodies and joints, by name; and how two of them differ."""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict, dataclass
from typing import Any

from cad2modelica.loops import LoopAnalysis
from cad2modelica.mechanism_view import MechanismView
from cad2modelica.model import Assembly


@dataclass(frozen=True)
class BodyEntry:
    """A part or plane: its Modelica name and its name in the source."""

    name: str
    source: str


@dataclass(frozen=True)
class JointEntry:
    """A joint: names as of a body; type, partners by their source names, and whether it is a planar loop constraint."""

    name: str
    source: str
    type: str
    parent: str
    child: str
    constraint: bool


@dataclass(frozen=True)
class Structure:
    """Bodies and joints of a mechanics; numbers of any kind are no part of it."""

    bodies: tuple[BodyEntry, ...]
    joints: tuple[JointEntry, ...]
    contacts: bool

    @property
    def signature(self) -> str:
        """SHA-256 of the structure as JSON with sorted keys and no blanks."""
        return hashlib.sha256(json.dumps(asdict(self), sort_keys=True, separators=(",", ":")).encode()).hexdigest()

    @property
    def names(self) -> frozenset[str]:
        """Modelica names of bodies and joints."""
        return frozenset(body.name for body in self.bodies) | frozenset(joint.name for joint in self.joints)


def structure_of(assembly: Assembly, loops: LoopAnalysis, view: MechanismView) -> Structure:
    """The structure of a mechanism."""
    bodies = [BodyEntry(view.part_names[part.name], part.name) for part in assembly.parts]
    bodies += [BodyEntry(view.plane_names[plane.name], plane.name) for plane in assembly.planes]
    joints = [
        JointEntry(
            view.joint_names[joint.name],
            joint.name,
            joint.type.value,
            joint.parent,
            joint.child,
            joint.name in loops.planar_constraints,
        )
        for joint in assembly.joints
        if joint.name in view.joint_names
    ]
    return Structure(tuple(bodies), tuple(joints), view.contacts is not None)


def structure_from(data: dict[str, Any]) -> Structure:
    """A structure that ``dataclasses.asdict`` has turned into a dictionary.

    Raises:
        KeyError, TypeError: it is none.
    """
    return Structure(
        tuple(BodyEntry(**item) for item in data["bodies"]),
        tuple(JointEntry(**item) for item in data["joints"]),
        bool(data["contacts"]),
    )


def differences(before: Structure, after: Structure) -> tuple[str, ...]:
    """What has changed, one line each: what is gone, new, seems renamed, or is joined in another way."""
    lines = _differences_of_names("part", before.bodies, after.bodies)
    old = {joint.source: joint for joint in before.joints}
    new = {joint.source: joint for joint in after.joints}
    gone = [joint for joint in before.joints if joint.source not in new]
    added = [joint for joint in after.joints if joint.source not in old]
    for joint in gone:
        twin = next((item for item in added if _ends(item) == _ends(joint)), None)
        hint = f"; renamed {twin.source!r}, it seems: same type, parent and child" if twin is not None else ""
        lines.append(f"joint {joint.source!r} is gone{hint}")
    lines += [
        f"joint {joint.source!r} is new ({joint.type} from {joint.parent!r} to {joint.child!r})" for joint in added
    ]
    for name, joint in new.items():
        earlier = old.get(name)
        if earlier is None or earlier == joint:
            continue
        if _ends(earlier) != _ends(joint):
            lines.append(
                f"joint {name!r} was {earlier.type} from {earlier.parent!r} to {earlier.child!r}, and is "
                f"{joint.type} from {joint.parent!r} to {joint.child!r}"
            )
        elif earlier.constraint != joint.constraint:
            lines.append(f"joint {name!r} closes a planar loop {'now' if joint.constraint else 'no longer'}")
        else:
            lines.append(f"joint {name!r} was called {earlier.name!r} in the model, and is called {joint.name!r}")
    if before.contacts != after.contacts:
        lines.append(f"there is {'now a' if after.contacts else 'no'} contact manager")
    if not lines and before != after:
        lines.append("the order of parts or joints has changed")
    return tuple(lines)


def _differences_of_names(kind: str, before: tuple[BodyEntry, ...], after: tuple[BodyEntry, ...]) -> list[str]:
    old = {item.source: item.name for item in before}
    new = {item.source: item.name for item in after}
    lines = [f"{kind} {source!r} is gone" for source in old if source not in new]
    lines += [f"{kind} {source!r} is new" for source in new if source not in old]
    lines += [
        f"{kind} {source!r} was called {old[source]!r} in the model, and is called {name!r}"
        for source, name in new.items()
        if source in old and old[source] != name
    ]
    return lines


def _ends(joint: JointEntry) -> tuple[str, str, str]:
    return joint.type, joint.parent, joint.child
