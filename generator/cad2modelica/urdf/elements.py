"""Numbers, poses and places in a robot description."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from contact_foundation.errors import Place
from lxml import etree

from cad2modelica.geometry.spatial import Array, Pose, rotation_of_roll_pitch_yaw
from cad2modelica.source.lost import Lost
from cad2modelica.source.number_limits import LARGEST, are_usable, plain_number
from cad2modelica.source.problems import Problems
from cad2modelica.source.xml_document import place_of

XACRO = "ros.org/wiki/xacro"
EXPAND = "Expand the macros first: xacro robot.urdf.xacro > robot.urdf"
_OPTIONAL_ENVIRONMENT = re.compile(r"\$\(optenv\s+\w+\s+([^()]*)\)")


@dataclass(frozen=True)
class UrdfElements:
    """Reads attributes; wrong ones are recorded as problems and replaced by their defaults.

    Attributes:
        file: the robot description.
        problems: receives what is wrong.
        notes: receives what was read otherwise than it stands there.
    """

    file: Path
    problems: Problems
    notes: list[str]

    def origin(self, element: etree._Element) -> Pose:
        """The pose that an element's ``origin`` gives; identity if there is none."""
        origin = element.find("origin")
        position = self.numbers(origin, "xyz", (0.0, 0.0, 0.0))
        angles = self.numbers(origin, "rpy", (0.0, 0.0, 0.0))
        return Pose(position, rotation_of_roll_pitch_yaw(angles))

    def numbers(self, element: etree._Element | None, name: str, default: tuple[float, ...]) -> Array:
        """As many finite numbers, of at most ``LARGEST``, as the default has.

        Read with a note: commas between numbers, more numbers than needed, and ``$(optenv NAME value)``, whose value
        counts; the environment is never looked at.
        """
        text = element.get(name) if element is not None else None
        if text is None:
            return np.array(default)
        words = _OPTIONAL_ENVIRONMENT.sub(r"\1", text).replace(",", " ").split()
        try:
            values = np.array([plain_number(word) for word in words[: len(default)]])
        except ValueError:
            values = np.zeros(0)
        if words != text.split():
            self.notes.append(f"{self.place(element)}: {name}={text!r} was read as {' '.join(words)!r}")
        if len(words) > len(default):
            note = f"{self.place(element)}: of {name}={text!r} the first {len(default)} numbers count"
            self.notes.append(Lost(note))
        if len(values) != len(default) or not are_usable(values):
            self.problems.add(
                f"{name}={text!r} must be {len(default)} finite number{'s' if len(default) > 1 else ''}, "
                f"of at most {LARGEST:g}",
                self.place(element),
                f"{EXPAND}." if "$" in text else "Correct the value.",
            )
            return np.array(default)
        return values

    def number_or_zero(self, element: etree._Element, name: str) -> float:
        """A number that can be done without: zero with a note if it is none."""
        text = element.get(name, "0")
        try:
            value = plain_number(text)
        except ValueError:
            value = np.nan
        if are_usable(value):
            return value
        if "inf" not in text:  # no limit
            doubt = "is no number" if np.isnan(value) else f"is beyond {LARGEST:g}"
            self.notes.append(Lost(f"{self.place(element)}: {name}={text!r} {doubt} and was left out"))
        return 0.0

    def refuse_macros(self, root: etree._Element) -> None:
        """Records a problem if macros of xacro stand in the file: without them parts of the robot would be missing."""
        for element in root.iter():
            if XACRO in str(element.tag):
                macro = etree.QName(element).localname
                self.problems.add(f"holds macros of xacro ({macro!r})", self.place(element), f"{EXPAND}.")
                return

    def place(self, element: etree._Element | None, component: str | None = None) -> Place:
        """Where an element stands."""
        return place_of(element, self.file, component)
