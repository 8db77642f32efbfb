"""What others may rely on in a generated mechanics: its bodies and joints, by name."""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict, dataclass
from typing import Any, Literal

from cad2modelica.kinematics.loops import LoopAnalysis
from cad2modelica.mechanism.model import Assembly
from cad2modelica.modelica.view import MechanismView


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
    """Bodies and joints of a mechanics; numbers of any kind are no part of it.

    Attributes:
        contacts: whether there is a contact manager; "compiled" if it is one that shows no pairs.
    """

    bodies: tuple[BodyEntry, ...]
    joints: tuple[JointEntry, ...]
    contacts: bool | Literal["compiled"]

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
    contacts = view.contacts
    return Structure(
        tuple(bodies), tuple(joints), "compiled" if contacts is not None and contacts.compiled else contacts is not None
    )


def structure_from(data: dict[str, Any]) -> Structure:
    """A structure that ``dataclasses.asdict`` has turned into a dictionary.

    Raises:
        KeyError, TypeError: it is none.
    """
    return Structure(
        tuple(BodyEntry(**item) for item in data["bodies"]),
        tuple(JointEntry(**item) for item in data["joints"]),
        "compiled" if data["contacts"] == "compiled" else bool(data["contacts"]),
    )


def ends(joint: JointEntry) -> tuple[str, str, str]:
    """Type, parent and child."""
    return joint.type, joint.parent, joint.child
