"""Parts of a STEP assembly with names of their own."""

from __future__ import annotations

import re
from dataclasses import dataclass

from cad2modelica.brep.step_model import Occurrence, StepModel
from cad2modelica.step.part_faces import PartFaces, faces_of_shape, placed_faces

_GENERIC = re.compile(r"\s*|NAUO\d*|\d+|=>\[.*\]|COMPOUND|SOLID|Open CASCADE.*|(next )?assembly usage.*", re.IGNORECASE)
"""Names of instances that writers make up; the product's counts instead."""


@dataclass(frozen=True, eq=False)
class NamedPart:
    """An occurrence and its name, which no other part has."""

    name: str
    occurrence: Occurrence


def named_parts(model: StepModel) -> tuple[NamedPart, ...]:
    """The parts in the order of the file: names of instances (else of products) with slashes, numbered if equal."""
    counts: dict[str, int] = {}
    taken: set[str] = set()
    parts = []
    for occurrence in model.occurrences:
        path = "/".join(_level(instance, product) for instance, product in occurrence.path)
        counts[path] = counts.get(path, 0) + 1
        name = path if counts[path] == 1 else f"{path} {counts[path]}"
        while name in taken:
            counts[path] += 1
            name = f"{path} {counts[path]}"
        taken.add(name)
        parts.append(NamedPart(name, occurrence))
    return tuple(parts)


def part_faces(parts: tuple[NamedPart, ...]) -> list[PartFaces]:
    """The faces of all parts in the file's coordinates; each shape is looked at once."""
    known: dict[int, PartFaces] = {}
    found = []
    for part in parts:
        shape = part.occurrence.shape
        if id(shape) not in known:
            known[id(shape)] = faces_of_shape(shape.name, shape)
        found.append(placed_faces(known[id(shape)], part.name, part.occurrence.pose))
    return found


def _level(instance: str, product: str) -> str:
    name = product if _GENERIC.fullmatch(instance) else instance
    return " ".join(name.replace("/", "-").split()) or "part"
