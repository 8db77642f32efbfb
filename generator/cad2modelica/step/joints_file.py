"""``NAME.joints.toml``: which parts of a STEP assembly are one body, and which joints hold the bodies.

```toml
ground = ["Base"]                      # parts that stand in the world
density = 2700.0                       # kg/m3, of parts without a density or mass of their own; optional
leave_out = ["Label"]                  # parts that are not in the model; optional

[[body]]                               # parts that are fixed to each other
parts = ["Arm", "Motor", "Screw"]

[[joint]]
name = "shoulder"
type = "revolute"                      # or prismatic, cylindrical, planar, spherical, universal, screw, fixed
parent = "Base"
child = "Arm"
origin = [0.0, 0.0, 120.0]             # mm, in the file's coordinates
axis = [0.0, 1.0, 0.0]
limits = [-90.0, 90.0]                 # degrees or mm; optional
use = true                             # optional; false: the joint is not in the model
confidence = 0.85                      # of the proposal, and what it was seen by; for the modeller
seen = ["Arm and Base: shaft in hole, ..."]

[[part]]
name = "Arm"
density = 7850.0                       # or mass = 1.2 (kg)
```
"""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from contact_foundation.errors import InputError, Place
from contact_foundation.output import whole_file
from contact_foundation.toml_text import read_toml

from cad2modelica.geometry.spatial import Array, perpendicular
from cad2modelica.mechanism.model import GROUND, JointLimits, JointType
from cad2modelica.source.number_limits import are_usable
from cad2modelica.source.problems import Problems
from cad2modelica.step.proposal import Proposal

ENDING = ".joints.toml"
MILLIMETRE = 1e-3
RIGHT_ANGLE_TOLERANCE = 1e-3
_TOP_KEYS = ("ground", "density", "leave_out", "body", "joint", "part")
_JOINT_KEYS = (
    "name",
    "type",
    "parent",
    "child",
    "origin",
    "axis",
    "second_axis",
    "pitch",
    "limits",
    "use",
    "confidence",
    "seen",
)
_FINGERPRINT = "# fingerprint: "
_HEADER = """# Joints of {source}; lengths in mm, angles in degrees, in the file's coordinates.
# Proposed from faces by `cmb joints`: correct types, origins and axes, take joints out by use = false, move parts from
# one body to another. Once it is edited, `cmb joints` writes it anew only if --overwrite says so.
"""


@dataclass(frozen=True, eq=False)
class FileJoint:
    """A joint of the file, lengths in m, angles in rad."""

    name: str
    type: JointType
    parent: str
    child: str
    origin: Array
    axis: Array | None
    second_axis: Array | None
    pitch: float
    limits: JointLimits | None


@dataclass(frozen=True, eq=False)
class JointsFile:
    """What a joints file says.

    Attributes:
        ground: parts that stand in the world.
        bodies: parts that are fixed to each other.
        densities, masses: of single parts, kg/m3 and kg.
    """

    ground: tuple[str, ...] = ()
    density: float | None = None
    leave_out: tuple[str, ...] = ()
    bodies: tuple[tuple[str, ...], ...] = ()
    joints: tuple[FileJoint, ...] = ()
    densities: Mapping[str, float] = field(default_factory=dict)
    masses: Mapping[str, float] = field(default_factory=dict)


def joints_file_of(step_file: Path) -> Path:
    """Where the joints of a STEP file are looked for."""
    return step_file.with_name(step_file.stem + ENDING)


# ----- writing -----


def write_proposal(file: Path, source: str, proposal: Proposal) -> None:
    """Writes a joints file; its fingerprint tells later whether it was edited."""
    lines = [f"ground = {_text([proposal.ground])}", "# density = 2700.0  # kg/m3; or --density"]
    for body in proposal.bodies:
        lines += ["", "[[body]]", *(f"# {text}" for text in body.seen), f"parts = {_text(list(body.parts))}"]
    names: dict[str, int] = {}
    for joint in proposal.joints:
        name = f"{joint.child} to {joint.parent}"
        names[name] = names.get(name, 0) + 1
        name = name if names[name] == 1 else f"{name} {names[name]}"
        lines += [
            "",
            "[[joint]]",
            f"name = {_text(name)}",
            f"type = {_text(joint.type.value)}",
            f"parent = {_text(joint.parent)}",
            f"child = {_text(joint.child)}",
            f"origin = {_numbers(joint.origin / MILLIMETRE)}",
            *([f"axis = {_numbers(joint.axis)}"] if joint.type.needs_axis else []),
            *([] if joint.use else ["use = false"]),
            f"confidence = {joint.confidence:.2f}",
            f"seen = {_text(list(joint.seen))}",
        ]
    if proposal.loose:
        lines += ["", "# No face holds these to what stands; without a joint they move freely:"]
        lines += [f"#   {name}" for name in proposal.loose]
    body_text = _HEADER.format(source=source) + "\n".join(lines) + "\n"
    with whole_file(file) as target:
        target.write_text(f"{body_text}{_FINGERPRINT}{_digest(body_text)}\n", encoding="utf-8")


def was_edited(file: Path) -> bool:
    """Whether a joints file is other than ``write_proposal`` wrote it."""
    try:
        body, _, fingerprint = file.read_text(encoding="utf-8").rpartition(_FINGERPRINT)
    except (OSError, UnicodeDecodeError):
        return True
    return fingerprint.strip() != _digest(body)


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


def _text(value: object) -> str:
    return json.dumps(value, ensure_ascii=False)  # strings and lists of them are TOML as they are JSON


def _numbers(values: Array) -> str:
    return "[" + ", ".join(repr(round(float(value), 9) + 0.0) for value in values) + "]"


# ----- reading -----


def read_joints_file(file: Path, parts: Sequence[str]) -> JointsFile:
    """Reads a joints file and checks it against the names of the parts.

    Raises:
        InputError: the file is wrong; a ``ProblemList`` if several problems were found.
    """
    return _JointsReader(file, parts).read()


class _JointsReader:
    def __init__(self, file: Path, parts: Sequence[str]) -> None:
        self._file = file
        self._parts = set(parts)
        self._problems = Problems(str(file))

    def read(self) -> JointsFile:
        content = read_toml(self._file)
        self._unknown_keys(content, _TOP_KEYS, None)
        leave_out = self._names(content.get("leave_out", []), "leave_out")
        self._parts -= set(leave_out)
        density = content.get("density")
        densities, masses = self._part_entries(content)
        result = JointsFile(
            ground=self._names(content.get("ground", []), "ground"),
            density=self._positive(density, "density", None) if density is not None else None,
            leave_out=leave_out,
            bodies=tuple(
                self._names(entry.get("parts", []), "the parts of a body") for entry in self._tables(content, "body")
            ),
            joints=self._joints(content),
            densities=densities,
            masses=masses,
        )
        self._problems.raise_if_any()
        return result

    def _joints(self, content: Mapping[str, Any]) -> tuple[FileJoint, ...]:
        found, names = [], set()
        for number, entry in enumerate(self._tables(content, "joint"), start=1):
            name = entry.get("name") if isinstance(entry.get("name"), str) else f"joint {number}"
            assert isinstance(name, str)
            self._unknown_keys(entry, _JOINT_KEYS, name)
            if name in names:
                self._add(name, "the name is given twice", "Rename the joint.")
            names.add(name)
            if entry.get("use", True) is not True:
                if entry["use"] is not False:
                    self._add(name, "use must be true or false", "Correct it.")
                continue
            joint = self._joint(name, entry)
            found += [joint] if joint is not None else []
        return tuple(found)

    def _joint(self, name: str, entry: Mapping[str, Any]) -> FileJoint | None:
        kinds = {kind.value: kind for kind in JointType if kind is not JointType.FREE}
        kind = kinds.get(entry["type"]) if isinstance(entry.get("type"), str) else None
        if kind is None:
            self._add(name, f"type is {entry.get('type')!r}", f"Known: {', '.join(kinds)}.")
            return None
        ends = []
        for key in ("parent", "child"):
            value = entry.get(key)
            if not isinstance(value, str) or (value not in self._parts and value != GROUND):
                self._add(name, f"{key} is {value!r}, which is no part", self._known(value))
                return None
            ends.append(value)
        if ends[0] == ends[1]:
            self._add(name, "parent and child are the same part", "Name two parts.")
            return None
        origin = self._vector(name, entry, "origin") if kind is not JointType.FIXED else np.zeros(3)
        axis = self._unit(name, entry, "axis") if kind.needs_axis else None
        second = self._unit(name, entry, "second_axis") if kind is JointType.UNIVERSAL else None
        if axis is not None and second is not None and abs(float(axis @ second)) > RIGHT_ANGLE_TOLERANCE:
            self._add(name, "axis and second_axis are not at a right angle", "Correct them.")
        pitch = entry.get("pitch", 0.0)
        if kind is JointType.SCREW:
            pitch = self._positive(abs(pitch) if isinstance(pitch, float | int) else pitch, "pitch", name)
            pitch = math.copysign(pitch, entry["pitch"]) if isinstance(entry.get("pitch"), float | int) else pitch
        limits = self._limits(name, entry, kind)
        return FileJoint(
            name, kind, ends[0], ends[1], origin * MILLIMETRE, axis, second, float(pitch) * MILLIMETRE, limits
        )

    def _limits(self, name: str, entry: Mapping[str, Any], kind: JointType) -> JointLimits | None:
        if "limits" not in entry:
            return None
        values = entry["limits"]
        around = _are_numbers(values, 2) and values[0] <= 0 <= values[1] and values[0] < values[1]
        if not kind.is_scalar or not around:
            remedy = "Correct them: the joint starts at zero."
            self._add(name, "limits are two numbers around zero, of a revolute, prismatic or screw joint", remedy)
            return None
        factor = MILLIMETRE if kind is JointType.PRISMATIC else math.pi / 180
        return JointLimits(values[0] * factor, values[1] * factor)

    def _part_entries(self, content: Mapping[str, Any]) -> tuple[dict[str, float], dict[str, float]]:
        densities: dict[str, float] = {}
        masses: dict[str, float] = {}
        for entry in self._tables(content, "part"):
            name = entry.get("name")
            if not isinstance(name, str) or name not in self._parts:
                self._add("part", f"{name!r} is no part", self._known(name))
                continue
            self._unknown_keys(entry, ("name", "density", "mass"), name)
            for key, target in (("density", densities), ("mass", masses)):
                if key in entry:
                    target[name] = self._positive(entry[key], key, name)
        return densities, masses

    def _names(self, values: Any, what: str) -> tuple[str, ...]:
        if not isinstance(values, list) or not all(isinstance(value, str) for value in values):
            self._add(None, f"{what} must be a list of names", "Correct it.")
            return ()
        for value in values:
            if value not in self._parts:
                self._add(None, f"{what}: {value!r} is no part", self._known(value))
        return tuple(value for value in values if value in self._parts)

    def _tables(self, content: Mapping[str, Any], key: str) -> list[dict[str, Any]]:
        values = content.get(key, [])
        if not isinstance(values, list) or not all(isinstance(value, dict) for value in values):
            self._add(None, f"{key} must be tables [[{key}]]", "Correct them.")
            return []
        return values

    def _vector(self, name: str, entry: Mapping[str, Any], key: str) -> Array:
        if not _are_numbers(entry.get(key), 3):
            self._add(name, f"{key} must be three finite numbers", "Correct it.")
            return np.zeros(3)
        return np.array(entry[key], dtype=np.float64)

    def _unit(self, name: str, entry: Mapping[str, Any], key: str) -> Array:
        vector = self._vector(name, entry, key)
        length = float(np.linalg.norm(vector))
        if not length > 0:
            if _are_numbers(entry.get(key), 3):
                self._add(name, f"{key} is the zero vector", "Give a direction.")
            return perpendicular(np.array([1.0, 0.0, 0.0]))
        return np.asarray(vector / length)

    def _positive(self, value: Any, key: str, name: str | None) -> float:
        if not _are_numbers([value], 1) or not value > 0:
            self._add(name, f"{key} must be a positive number", "Correct it.")
            return 1.0
        return float(value)

    def _unknown_keys(self, entry: Mapping[str, Any], known: Iterable[str], name: str | None) -> None:
        for key in entry:
            if key not in known:
                self._add(name, f"{key!r} is not known", f"Known: {', '.join(known)}.")

    def _known(self, value: object) -> str:
        from difflib import get_close_matches

        likely = get_close_matches(str(value), self._parts, 1)
        hint = f"Write {likely[0]!r}, if that is meant. " if likely else ""
        return f"{hint}Parts: {', '.join(repr(name) for name in sorted(self._parts)[:20])}."

    def _add(self, name: str | None, message: str, remedy: str) -> None:
        self._problems.add(message, Place(file=self._file, component=name), remedy)


def _are_numbers(values: Any, count: int) -> bool:
    if not isinstance(values, list) or len(values) != count:
        return False
    return all(isinstance(value, float | int) and not isinstance(value, bool) for value in values) and are_usable(
        values
    )


def require_unedited(file: Path) -> None:
    """Raises InputError if a joints file is there that the modeller changed."""
    if file.exists() and was_edited(file):
        raise InputError(
            "was edited: it is not written anew",
            place=Place(file=file),
            remedy="--overwrite replaces it; --output FILE writes the proposal to another file.",
        )
