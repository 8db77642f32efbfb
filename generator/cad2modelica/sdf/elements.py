"""Texts, numbers and poses of SDFormat's elements."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from contact_foundation.errors import Place
from lxml import etree

from cad2modelica.geometry.spatial import Array, Pose, rotation_of_quaternion, rotation_of_roll_pitch_yaw
from cad2modelica.source.number_limits import LARGEST, are_usable, plain_number
from cad2modelica.source.problems import Problems
from cad2modelica.source.xml_document import place_of

UNLIMITED = 1e15
"""Numbers beyond this one say that there is no limit; the format's default is 1e16."""


@dataclass(frozen=True)
class SdfElements:
    """Reads elements of one file; wrong values are recorded as problems and replaced by their defaults.

    Attributes:
        file: the description, or one that it includes.
        version: major and minor version of the format.
        problems: receives what is wrong.
        notes: receives what was left out.
    """

    file: Path
    version: tuple[int, int]
    problems: Problems
    notes: list[str]

    def place(self, element: etree._Element | None, component: str | None = None) -> Place:
        """Where an element stands."""
        return place_of(element, self.file, component)

    def text(self, element: etree._Element, path: str, default: str = "") -> str:
        """The text of an element below another."""
        found = element.find(path)
        return (found.text or "").strip() if found is not None else default

    def flag(self, element: etree._Element, path: str, default: bool = False) -> bool:
        """A Boolean below an element."""
        word = self.text(element, path, "true" if default else "false").lower()
        if word not in ("true", "1", "false", "0"):
            self.problems.add(f"{path} is {word!r}", self.place(element.find(path)), "Write true or false.")
        return word in ("true", "1")

    def number(self, element: etree._Element, path: str, default: float) -> float:
        """A number below an element."""
        return float(self.numbers(element, path, (default,))[0])

    def numbers(self, element: etree._Element, path: str, default: tuple[float, ...]) -> Array:
        """As many finite numbers, of at most ``LARGEST``, as the default has."""
        found = element.find(path)
        if found is None or not (found.text or "").strip():
            return np.array(default)
        return self._parsed(found, found.text or "", default)

    def limit(self, element: etree._Element, path: str) -> float | None:
        """A limit; None if there is none: no element, infinite, or beyond ``UNLIMITED``."""
        text = self.text(element, path)
        if not text:
            return None
        try:
            value = plain_number(text)
        except ValueError:
            value = float("nan")
        if np.isnan(value):
            self.problems.add(f"{path}={text!r} is no number", self.place(element.find(path)), "Correct the value.")
            return None
        return None if abs(value) >= UNLIMITED else value

    def pose(self, element: etree._Element) -> Pose:
        """The pose that an element's ``pose`` gives, in whatever frame that names; identity if there is none."""
        found = element.find("pose")
        if found is None or not (found.text or "").strip():
            return Pose(np.zeros(3), np.eye(3))
        text = found.text or ""
        if found.get("rotation_format") == "quat_xyzw":
            x, y, z, *quaternion = self._parsed(found, text, (0.0,) * 6 + (1.0,))
            i, j, k, w = quaternion
            if not np.linalg.norm(quaternion) > 0:
                self.problems.add("the quaternion is zero", self.place(found), "Correct the pose.")
                w = 1.0
            return Pose(np.array([x, y, z]), rotation_of_quaternion([w, i, j, k]))
        values = self._parsed(found, text, (0.0,) * 6)
        turn = np.radians(values[3:]) if found.get("degrees", "false") in ("true", "1") else values[3:]
        return Pose(values[:3], rotation_of_roll_pitch_yaw(turn))

    def relative_to(self, element: etree._Element) -> str:
        """The frame that an element's pose stands in; empty if it names none, or its version knows none."""
        found = element.find("pose")
        return found.get("relative_to", "") if found is not None and self.version >= (1, 7) else ""

    def _parsed(self, element: etree._Element, text: str, default: tuple[float, ...]) -> Array:
        try:
            values = np.array([plain_number(word) for word in text.split()])
        except ValueError:
            values = np.zeros(0)
        if len(values) != len(default) or not are_usable(values):
            count = f"{len(default)} finite number{'s' if len(default) > 1 else ''}"
            self.problems.add(
                f"{element.tag}={' '.join(text.split())[:80]!r} must be {count}, of at most {LARGEST:g}",
                self.place(element),
                "Correct the value.",
            )
            return np.array(default)
        return values
