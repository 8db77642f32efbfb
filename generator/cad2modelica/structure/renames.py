"""Which parts and joints of an earlier mechanism seem to have another name now.

A guess from what a new name leaves as it was: masses, places, and what is joined to what; and from the names
themselves. It serves messages only.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from difflib import SequenceMatcher
from pathlib import Path
from typing import Any

import numpy as np

from cad2modelica.geometry.spatial import Array
from cad2modelica.mechanism.model import Assembly
from cad2modelica.structure.entries import JointEntry, Structure, ends

MOST_PAIRS = 100_000  # compared; where more names have changed at once nothing is guessed
ALIKE = 0.6  # of difflib's ratio of two names
ROUNDING = 1e-6  # relative; exports of the same part differ by less


@dataclass(frozen=True)
class Renamed:
    """The name something seems to have now, and what speaks for it."""

    name: str
    reason: str


@dataclass(frozen=True)
class Renames:
    """Parts (planes among them) and joints that seem renamed, by their earlier names in the source."""

    parts: Mapping[str, Renamed] = field(default_factory=dict)
    joints: Mapping[str, Renamed] = field(default_factory=dict)

    def part_now(self, name: str) -> str:
        """A part's name now, as far as is known."""
        return self.parts[name].name if name in self.parts else name

    def ends_now(self, joint: JointEntry) -> tuple[str, str, str]:
        """Type, parent and child of an earlier joint, by the parts' names now."""
        kind, parent, child = ends(joint)
        return kind, self.part_now(parent), self.part_now(child)


@dataclass(frozen=True, eq=False)
class PartMarks:
    """What tells a part whatever it is called, in SI units.

    Attributes:
        mass: of the part.
        center: of mass, shape (3,), in the part's axes.
        inertia: about it, shape (3, 3), in the part's axes.
        position: of the part's origin in the world, shape (3,).
        turn: from the world's axes to the part's, shape (3, 3).
    """

    mass: float
    center: Array
    inertia: Array
    position: Array
    turn: Array

    def has_mass_of(self, other: PartMarks) -> bool:
        """Whether mass properties are the same."""
        if not self.mass > 0 or abs(self.mass - other.mass) > ROUNDING * self.mass:
            return False
        gyration = math.sqrt(max(float(np.trace(self.inertia)), 0.0) / self.mass)
        size = max(gyration, float(np.abs(self.center).max()))
        return _close(self.center, other.center, size) and _close(self.inertia, other.inertia)

    def stands_as(self, other: PartMarks) -> bool:
        """Whether both stand at the same place, turned the same way."""
        return _close(self.position, other.position) and _close(self.turn, other.turn)


def marks_of(assembly: Assembly) -> dict[str, PartMarks]:
    """The marks of an assembly's parts, by their names."""
    found = {}
    for part in assembly.parts:
        own, pose = part.mass_properties, part.pose
        found[part.name] = PartMarks(own.mass, own.center_of_mass, own.inertia, pose.position, pose.rotation.T)
    return found


def marks_in(scene: Path) -> dict[str, PartMarks]:
    """The marks that an earlier generation's scene file shows; none where it cannot be read."""
    try:
        bodies = json.loads(scene.read_text(encoding="utf-8"))["bodies"]
        return {str(body["label"]): _marks(body) for body in bodies if "mass" in body}
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return {}


def _marks(body: Mapping[str, Any]) -> PartMarks:
    shapes = {"centerOfMass": (3,), "inertia": (3, 3), "position": (3,), "rotation": (3, 3)}
    arrays = [np.array(body[key], dtype=float).reshape(shape) for key, shape in shapes.items()]
    return PartMarks(float(body["mass"]), *arrays)


def _close(first: Array, second: Array, size: float = 0.0) -> bool:
    """Whether arrays are the same to rounding of the largest element, or of a size."""
    largest = max(size, float(np.abs(first).max()))
    return bool(np.abs(first - second).max() <= ROUNDING * largest)


def renames(before: Structure, after: Structure, old: Mapping[str, PartMarks], new: Mapping[str, PartMarks]) -> Renames:
    """Guesses which parts and joints that are gone are others that are new.

    What speaks most clearly for a pair counts first; of pairs for which the same speaks, the most similar names.

    Args:
        before: the earlier structure.
        after: the structure now.
        old: marks of the earlier parts, as far as they are known.
        new: marks of the parts now.
    """
    earlier = {joint.source: joint for joint in before.joints}
    now = {joint.source: joint for joint in after.joints}
    common = [(earlier[name], now[name]) for name in earlier if name in now]

    def same_mass(first: str, second: str) -> bool:
        return first in old and second in new and old[first].has_mass_of(new[second])

    def same_mass_and_place(first: str, second: str) -> bool:
        return same_mass(first, second) and old[first].stands_as(new[second])

    def held_alike(first: str, second: str) -> bool:
        """Whether a joint of the same name holds the one as it held the other, at the same partner."""
        pairs = [((a.parent, a.child), (b.parent, b.child)) for a, b in common]
        return any(
            a[end] == first and b[end] == second and a[1 - end] == b[1 - end] for a, b in pairs for end in (0, 1)
        )

    parts = _paired(
        [body.source for body in before.bodies],
        [body.source for body in after.bodies],
        {
            "same mass, inertia and place": same_mass_and_place,
            "same mass and inertia": same_mass,
            "held by the same joint": held_alike,
            "similar name": _similar,
        },
    )
    found = Renames(parts)

    def same_ends(first: str, second: str) -> bool:
        return found.ends_now(earlier[first]) == ends(now[second])

    def same_child(first: str, second: str) -> bool:
        return found.ends_now(earlier[first])[::2] == ends(now[second])[::2]

    def same_type_similar_name(first: str, second: str) -> bool:
        return earlier[first].type == now[second].type and _similar(first, second)

    joints = _paired(
        list(earlier),
        list(now),
        {
            "same type, parent and child": same_ends,
            "same type and child": same_child,
            "same type, similar name": same_type_similar_name,
        },
    )
    return Renames(parts, joints)


def closest(name: str, names: Iterable[str]) -> str | None:
    """The name most similar to one that does not exist; None if none is similar."""
    found = max(names, key=lambda other: _similarity(name, other), default=None)
    return found if found is not None and _similar(name, found) else None


def _paired(
    before: Sequence[str], after: Sequence[str], evidence: Mapping[str, Callable[[str, str], bool]]
) -> dict[str, Renamed]:
    """Pairs what is gone with what is new; each kind of evidence, the clearest first, takes what those before left."""
    gone = [name for name in before if name not in after]
    added = [name for name in after if name not in before]
    found: dict[str, Renamed] = {}
    if len(gone) * len(added) > MOST_PAIRS:
        return found
    for reason, speaks_for in evidence.items():
        pairs = [(first, second) for first in gone for second in added if speaks_for(first, second)]
        for first, second in sorted(pairs, key=lambda pair: -_similarity(*pair)):
            if first in gone and second in added:
                found[first] = Renamed(second, reason)
                gone.remove(first)
                added.remove(second)
    return {name: found[name] for name in before if name in found}


def _similar(first: str, second: str) -> bool:
    return _similarity(first, second) >= ALIKE


def _similarity(first: str, second: str) -> float:
    """From 0 to 1, without regard to case."""
    return SequenceMatcher(None, first.casefold(), second.casefold(), autojunk=False).ratio()
