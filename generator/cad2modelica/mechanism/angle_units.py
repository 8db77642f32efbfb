"""Doubts about the unit of angles: whole turns in radians, right angles in degrees that are radians."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from lxml import etree

from cad2modelica.source.units import ANGLE

USUAL_STEP = 15.0  # degrees: angles that people choose are multiples of it
AS_WRITTEN = 1e-3  # degrees: radians are written with five digits or more
PLAIN_DIGITS = 2  # a number of no more decimals is meant as it stands


def angle_notes(root: etree._Element, unit: str) -> tuple[str, ...]:
    """A remark on the first angle of a pose that looks as if it had another unit, and how many do; none if none does.

    Args:
        root: the assembly's element.
        unit: of angles, "deg" or "rad".
    """
    doubtful = [(line, value) for line, value in _angles(root) if _doubtful(value, unit)]
    if not doubtful:
        return ()
    line, value = doubtful[0]
    others = f" (and {len(doubtful) - 1} more)" if len(doubtful) > 1 else ""
    if unit == "rad":
        meaning = f"{value:g} rad is {abs(value) / (2 * np.pi):.3g} turns; are angles in degrees?"
    else:
        meaning = f"{value:g} deg would be {np.degrees(value):.4g} deg if it were rad; are angles in radians?"
    return (f"line {line}: the angle {meaning} 'units' says {unit!r}{others}",)


def _angles(root: etree._Element) -> Iterator[tuple[int, float]]:
    for element in root.iter("{*}axisAngle", "{*}rollPitchYaw"):
        words = [element.get("angle", "")] if element.get("angle") is not None else (element.text or "").split()
        line = element.sourceline
        for word in words:
            yield line if isinstance(line, int) else 0, float(word)


def _doubtful(value: float, unit: str) -> bool:
    if ANGLE[unit] == 1.0:
        return abs(value) > 2 * np.pi + 1e-6
    if abs(value) > 2 * np.pi + 1e-6 or round(value, PLAIN_DIGITS) == value:
        return False
    degrees = float(np.degrees(value))
    return abs(degrees - USUAL_STEP * round(degrees / USUAL_STEP)) < AS_WRITTEN
