"""Numbers, poses and places in a robot description."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from cmb_base.errors import Place
from lxml import etree

from cad2modelica.problems import Problems
from cad2modelica.spatial import Array, Pose, rotation_of_roll_pitch_yaw
from cad2modelica.xml_document import line_of


@dataclass(frozen=True)
class UrdfElements:
    """Reads attributes; wrong ones are recorded as problems and replaced by their defaults.

    Attributes:
        file: the robot description.
        problems: receives what is wrong.
    """

    file: Path
    problems: Problems

    def origin(self, element: etree._Element) -> Pose:
        """The pose that an element's ``origin`` gives; identity if there is none."""
        origin = element.find("origin")
        position = self.numbers(origin, "xyz", (0.0, 0.0, 0.0))
        angles = self.numbers(origin, "rpy", (0.0, 0.0, 0.0))
        return Pose(position, rotation_of_roll_pitch_yaw(angles))

    def numbers(self, element: etree._Element | None, name: str, default: tuple[float, ...]) -> Array:
        """As many finite numbers as the default has."""
        text = element.get(name) if element is not None else None
        if text is None:
            return np.array(default)
        try:
            values = np.array(text.split(), dtype=np.float64)
        except ValueError:
            values = np.zeros(0)
        if len(values) != len(default) or not np.isfinite(values).all():
            self.problems.add(
                f"{name}={text!r} must be {len(default)} finite number{'s' if len(default) > 1 else ''}",
                self.place(element),
                "Correct the value; xacro files must be expanded first." if "$" in text else "Correct the value.",
            )
            return np.array(default)
        return values

    def place(self, element: etree._Element | None, component: str | None = None) -> Place:
        """Where an element stands."""
        if element is None:
            return Place(file=self.file, component=component)
        return Place(file=self.file, line=line_of(element), component=component or element.get("name"))
