"""Values of single elements of the assembly's XML: numbers, vectors, poses, places for messages."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import numpy as np
from contact_foundation.errors import Place
from lxml import etree

from cad2modelica.geometry.spatial import (
    IDENTITY,
    Array,
    Pose,
    nearest_rotation,
    rotation_about,
    rotation_of_quaternion,
    rotation_of_roll_pitch_yaw,
)
from cad2modelica.source.problems import Problems
from cad2modelica.source.units import UnitSystem, to_si
from cad2modelica.source.xml_document import line_of, nearest_name

NAMESPACE = "urn:contactmultibody:assembly:1"
ROTATION_TOLERANCE = 1e-4  # elements of a matrix in an export may be rounded that much


class ElementReader:
    """Reads values of elements in one file's units, and records what is wrong with them.

    Args:
        file: the assembly's file, for messages.
        units: factors to SI.
        problems: takes what is wrong.
    """

    def __init__(self, file: Path, units: UnitSystem, problems: Problems) -> None:
        self.file = file
        self.units = units
        self.problems = problems

    def pose(self, element: etree._Element | None) -> Pose:
        """A pose in the outer system, lengths in m; the identity if there is no element."""
        if element is None:
            return IDENTITY
        position = np.zeros(3)
        rotation = np.eye(3)
        for child in element:
            kind = etree.QName(child).localname
            if kind == "position":
                position = to_si(numbers(child.text), self.units.length)
            elif kind == "rotation":
                rotation = self._rotation_matrix(child)
            elif kind == "axisAngle":
                axis = self.unit(numbers(child.get("axis", "")), child, "the axis")
                rotation = rotation_about(axis, float(child.get("angle", "")) * self.units.angle)
            elif kind == "quaternion":
                quaternion = numbers(child.text)
                self.unit(quaternion, child, "the quaternion")
                rotation = rotation_of_quaternion(quaternion if quaternion.any() else [1.0, 0.0, 0.0, 0.0])
            else:
                rotation = rotation_of_roll_pitch_yaw(numbers(child.text) * self.units.angle)
        return Pose(position, rotation)

    def _rotation_matrix(self, element: etree._Element) -> Array:
        given = numbers(element.text).reshape(3, 3)
        nearest, difference = nearest_rotation(given)
        if difference > ROTATION_TOLERANCE:
            self.problems.add(
                f"the matrix is not a rotation: its columns must be orthogonal unit vectors (off by {difference:.2g})",
                self.place(element),
                "Scaled or sheared coordinate systems are not poses; export the part at its true size.",
            )
            return np.eye(3)
        if np.linalg.det(nearest) < 0:
            self.problems.add(
                "the matrix mirrors (its determinant is -1)",
                self.place(element),
                "A mirrored part is another part: export it with geometry, centre of mass and inertia of its own.",
            )
            return np.eye(3)
        return nearest

    def place(self, element: etree._Element | None, component: str | None = None) -> Place:
        """Where an element stands."""
        if element is None:
            return Place(file=self.file, component=component)
        return Place(file=self.file, line=line_of(element), component=component or nearest_name(element))

    def unit(self, vector: Array, element: etree._Element, what: str) -> Array:
        """The unit vector along ``vector``; records a problem if that is zero."""
        length = np.linalg.norm(vector)
        if length < 1e-9:
            self.problems.add(f"{what} is the zero vector", self.place(element), "Give a direction.")
            fallback: Array = np.eye(len(vector))[-1]
            return fallback
        unit: Array = vector / length
        return unit

    def duplicate(self, kind: str, name: str, element: etree._Element) -> None:
        """Records that a name is not unique; parts, instances and planes share theirs."""
        shared = f"{kind} or part" if kind in ("instance", "plane") else kind
        self.problems.add(
            f"there is another {shared} of the name {name!r}",
            self.place(element, name),
            "Names must be unique; rename one in the CAD system.",
        )

    def unknown(self, what: str, name: str, known: Iterable[str], element: etree._Element) -> None:
        """Records that something names what does not exist."""
        self.problems.add(
            f"{what} names {name!r}, which does not exist",
            self.place(element),
            f"There are: {', '.join(sorted(known)[:30]) or 'none'}.",
        )


def child(element: etree._Element, tag: str) -> etree._Element:
    """The child element that the schema guarantees."""
    found = element.find(f"{{{NAMESPACE}}}{tag}")
    if found is None:
        raise AssertionError(f"the schema guarantees {tag}")
    return found


def text(element: etree._Element) -> str:
    """The element's text."""
    return element.text or ""


def numbers(words: str | None) -> Array:
    """Blank-separated numbers."""
    return np.array((words or "").split(), dtype=np.float64)


def optional(element: etree._Element, name: str) -> float | None:
    """A number in an attribute, None if it is not there."""
    value = element.get(name)
    return None if value is None else float(value)
