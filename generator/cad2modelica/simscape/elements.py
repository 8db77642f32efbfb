"""Numbers, poses, units and places in a Simscape Multibody import file."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from contact_foundation.errors import Place
from lxml import etree

from cad2modelica.geometry.spatial import Array, Pose, nearest_rotation
from cad2modelica.source.number_limits import LARGEST, are_usable, plain_number
from cad2modelica.source.problems import Problems
from cad2modelica.source.units import to_si
from cad2modelica.source.xml_document import place_of

LENGTHS = {
    "meter": 1.0,
    "m": 1.0,
    "centimeter": 0.01,
    "cm": 0.01,
    "millimeter": 0.001,
    "mm": 0.001,
    "micrometer": 1e-6,
    "um": 1e-6,
    "kilometer": 1000.0,
    "km": 1000.0,
    "inch": 0.0254,
    "in": 0.0254,
    "foot": 0.3048,
    "ft": 0.3048,
    "yard": 0.9144,
    "yd": 0.9144,
}
MASSES = {
    "kilogram": 1.0,
    "kg": 1.0,
    "gram": 0.001,
    "g": 0.001,
    "milligram": 1e-6,
    "mg": 1e-6,
    "tonne": 1000.0,
    "t": 1000.0,
    "pound": 0.45359237,
    "lbm": 0.45359237,
    "lb": 0.45359237,
    "ounce": 0.028349523125,
    "oz": 0.028349523125,
    "slug": 14.593902937206364,
}
ROTATION_TOLERANCE = 1e-3  # of an element: what is farther from a rotation is none


@dataclass(frozen=True)
class Units:
    """Factors to metre and kilogram of the data, and to metre of meshes without units (the model's unit)."""

    length: float
    mass: float
    mesh_length: float


@dataclass(frozen=True)
class Elements:
    """Reads children of elements; wrong ones are recorded as problems and replaced by zeros."""

    file: Path
    units: Units
    problems: Problems

    def numbers(self, element: etree._Element | None, name: str, count: int) -> Array:
        """The numbers in the child of that name."""
        child = element.find(f"{{*}}{name}") if element is not None else None
        try:
            values = np.array([plain_number(word) for word in (child.text or "").split()] if child is not None else [])
        except ValueError:
            values = np.zeros(0)
        if len(values) != count or not are_usable(values):
            self.problems.add(
                f"{name} must be {count} finite number{'s' if count > 1 else ''}, of at most {LARGEST:g}",
                self.place(child if child is not None else element),
                "Export the assembly again.",
            )
            return np.zeros(count)
        return values

    def pose(self, element: etree._Element | None) -> Pose:
        """The pose in a ``Transform``: rotation in rows, then the position."""
        given = self.numbers(element, "Rotation", 9).reshape(3, 3)
        position = to_si(self.numbers(element, "Translation", 3), self.units.length)
        rotation, error = nearest_rotation(given) if np.any(given) else (np.eye(3), 0.0)
        if error > ROTATION_TOLERANCE or np.linalg.det(rotation) < 0:
            self.problems.add(
                "Rotation is no rotation (its rows are not at right angles, or it mirrors)",
                self.place(element),
                "Export the assembly again.",
            )
            rotation = np.eye(3)
        return Pose(position, rotation)

    def direction(self, element: etree._Element) -> Array:
        """The unit vector in the child ``Axis``."""
        axis = self.numbers(element, "Axis", 3)
        length = float(np.linalg.norm(axis))
        if not length > 0:
            self.problems.add("Axis is the zero vector", self.place(element), "Export the assembly again.")
            return np.array([0.0, 0.0, 1.0])
        return np.asarray(axis / length)

    def place(self, element: etree._Element | None, component: str | None = None) -> Place:
        """Where an element stands."""
        return place_of(element, self.file, component)


def read_units(root: etree._Element, file: Path, problems: Problems) -> Units:
    """The units of an import file: ``DataUnits``, else ``ModelUnits``, which are those of the CAD model."""

    def factor(element: etree._Element | None, quantity: str, known: dict[str, float]) -> float:
        name = element.get(quantity, "") if element is not None else ""
        if name.lower() not in known:
            problems.add(
                f"the unit of {quantity} {name!r} is not known",
                place_of(element, file),
                f"Known: {', '.join(known)}.",
            )
            return 1.0
        return known[name.lower()]

    model = root.find("{*}ModelUnits")
    given = root.find("{*}DataUnits")
    data = given if given is not None else model
    mesh = model if model is not None else data
    return Units(factor(data, "length", LENGTHS), factor(data, "mass", MASSES), factor(mesh, "length", LENGTHS))
