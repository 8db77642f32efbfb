"""Elements of MJCF with the attributes that their default classes give them: numbers, orientations, places."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from contact_foundation.errors import Place
from lxml import etree

from cad2modelica.geometry.spatial import Array, Pose, rotation_about, rotation_of_quaternion
from cad2modelica.source.number_limits import LARGEST, are_usable, plain_number
from cad2modelica.source.problems import Problems
from cad2modelica.source.xml_document import line_of

FILE_MARK = "cmb-file"
"""Attribute that names the file that an included element came from."""
_SMALLEST = 1e-10  # of directions


@dataclass(frozen=True)
class Compiler:
    """What the elements ``compiler`` of a model say about how the rest is meant."""

    radians: bool = False
    euler_sequence: str = "xyz"
    autolimits: bool = True
    mesh_folder: str = ""
    strip_path: bool = False
    from_geometry: str = "auto"
    groups: tuple[int, int] = (0, 5)
    least_mass: float = 0.0
    least_inertia: float = 0.0
    total_mass: float = -1.0
    balance: bool = False

    @property
    def angle(self) -> float:
        """Factor from the unit of angles to rad."""
        return 1.0 if self.radians else float(np.pi / 180.0)


@dataclass(frozen=True, eq=False)
class Item:
    """An element and its attributes, its own before those of its default class."""

    element: etree._Element
    attributes: Mapping[str, str]

    @property
    def tag(self) -> str:
        """The element's name."""
        return str(self.element.tag)

    @property
    def name(self) -> str:
        """Its attribute ``name``; empty if it has none."""
        return self.attributes.get("name", "")

    def text(self, key: str, default: str = "") -> str:
        """An attribute as it stands."""
        return self.attributes.get(key, default).strip()

    def has(self, key: str) -> bool:
        """Whether the attribute is given."""
        return key in self.attributes


@dataclass
class MjcfElements:
    """Reads attributes; wrong ones are recorded as problems and replaced by their defaults.

    Attributes:
        file: the model.
        problems: receives what is wrong.
        notes: receives what was read otherwise than it stands there, or was left out.
        compiler: units and conventions, once they are known.
    """

    file: Path
    problems: Problems
    notes: list[str]
    compiler: Compiler = field(default_factory=Compiler)

    def place(self, element: etree._Element, component: str | None = None) -> Place:
        """Where an element stands, also in an included file."""
        marked = element
        while marked is not None and marked.get(FILE_MARK) is None:
            parent = marked.getparent()
            if parent is None:
                break
            marked = parent
        name = component or element.get("name")
        return Place(file=Path(marked.get(FILE_MARK, str(self.file))), line=line_of(element), component=name)

    def numbers(self, item: Item, key: str, default: tuple[float, ...]) -> Array:
        """Finite numbers, of at most ``LARGEST``; as many as given count, the others are the default's."""
        words = item.text(key).split()
        try:
            values = [plain_number(word) for word in words]
        except ValueError:
            values = [np.nan]
        if len(values) > len(default) or not are_usable(values):
            count = f"{len(default)} finite number{'s' if len(default) > 1 else ''}"
            self.problems.add(
                f"{key}={item.text(key)!r} must be at most {count}, of at most {LARGEST:g}",
                self.place(item.element),
                "Correct the value.",
            )
            return np.array(default)
        return np.array([*values, *default[len(values) :]])

    def number(self, item: Item, key: str, default: float = 0.0) -> float:
        """One number."""
        return float(self.numbers(item, key, (default,))[0])

    def integer(self, item: Item, key: str, default: int) -> int:
        """A whole number."""
        value = self.number(item, key, float(default))
        if value != round(value):
            self.problems.add(f"{key} must be a whole number", self.place(item.element), "Correct the value.")
        return round(value)

    def limits(self, item: Item, flag: str, key: str) -> tuple[float, float] | None:
        """The range that an attribute gives, if it counts: by its flag, or where it is given and the compiler says so.

        Args:
            item: the element.
            flag: its attribute ``true``, ``false`` or ``auto``.
            key: its attribute with the lower and the upper limit.
        """
        word = item.text(flag, "auto")
        lower, upper = (float(value) for value in self.numbers(item, key, (0.0, 0.0)))
        is_given = lower != 0.0 or upper != 0.0  # "0 0" takes back what a default class gives
        if word == "false" or (word == "auto" and not is_given):
            return None
        if word == "auto" and not self.compiler.autolimits:
            self.problems.add(
                f"has {key}, but not {flag}, and autolimits is false",
                self.place(item.element),
                f'Say {flag}="true" or {flag}="false" beside it, or leave autolimits out of the compiler.',
            )
            return None
        if not lower < upper:
            self.problems.add(
                f"the {key} is {lower:g} to {upper:g}: the lower must be smaller",
                self.place(item.element),
                f"Correct the {key}.",
            )
            return None
        return lower, upper

    def pose(self, item: Item) -> Pose:
        """Position and orientation of an element in its parent."""
        return Pose(self.numbers(item, "pos", (0.0, 0.0, 0.0)), self.rotation(item))

    def rotation(self, item: Item) -> Array:
        """The orientation that one of five attributes gives; identity if there is none."""
        angle = self.compiler.angle
        if item.has("axisangle"):
            x, y, z, turn = self.numbers(item, "axisangle", (1.0, 0.0, 0.0, 0.0))
            return rotation_about(self._direction(item, "axisangle", np.array([x, y, z])), turn * angle)
        if item.has("xyaxes"):
            values = self.numbers(item, "xyaxes", (1.0, 0.0, 0.0, 0.0, 1.0, 0.0))
            first = self._direction(item, "xyaxes", values[:3])
            second = self._direction(item, "xyaxes", values[3:] - first * (values[3:] @ first))
            return np.column_stack([first, second, np.cross(first, second)])
        if item.has("zaxis"):
            return turn_of_z(self._direction(item, "zaxis", self.numbers(item, "zaxis", (0.0, 0.0, 1.0))))
        if item.has("euler"):
            return self.euler(self.numbers(item, "euler", (0.0, 0.0, 0.0)))
        quaternion = self.numbers(item, "quat", (1.0, 0.0, 0.0, 0.0))
        if not np.linalg.norm(quaternion) > _SMALLEST:
            self.problems.add("quat is zero", self.place(item.element), "Give a quaternion other than zero.")
            return np.eye(3)
        return rotation_of_quaternion(quaternion)

    def euler(self, angles: Array) -> Array:
        """Rotation by three angles in the compiler's unit and sequence: small letters are axes that move along."""
        rotation = np.eye(3)
        for letter, value in zip(self.compiler.euler_sequence, angles, strict=True):
            turn = rotation_about(np.eye(3)["xyz".index(letter.lower())], value * self.compiler.angle)
            rotation = rotation @ turn if letter.islower() else turn @ rotation
        return rotation

    def _direction(self, item: Item, key: str, vector: Array) -> Array:
        length = float(np.linalg.norm(vector))
        if not length > _SMALLEST:
            self.problems.add(f"{key} gives no direction", self.place(item.element), "Correct the vector.")
            return np.array([1.0, 0.0, 0.0])
        return vector / length


def turn_of_z(direction: Array) -> Array:
    """The smallest rotation that turns the z axis to a unit vector."""
    axis = np.cross([0.0, 0.0, 1.0], direction)
    sine = float(np.linalg.norm(axis))
    if sine < _SMALLEST:
        return np.eye(3) if direction[2] > 0 else rotation_about([1.0, 0.0, 0.0], np.pi)
    return rotation_about(axis, float(np.arctan2(sine, direction[2])))
