"""Whether the values and start values of variables lie within their bounds."""

from __future__ import annotations

import math
from typing import Final

from modelica2fmu.expand.scalar_model import ScalarVariable

LARGEST_INTEGER: Final = 2**31 - 1
"""Of FMI 2.0's Integer."""


def empty_bounds(variable: ScalarVariable) -> str:
    """What is wrong with bounds between which nothing lies; "" if something does."""
    least, largest = variable.minimum, variable.maximum
    if least is None or largest is None or least <= largest:
        return ""
    return f"{variable.name} has a min of {least:.15g}, more than its max of {largest:.15g}"


def beyond_integers(variable: ScalarVariable, value: float) -> str:
    """What is wrong with a value of an Integer that FMI has no number for; "" if nothing is."""
    if variable.type == "Integer" and abs(value) > LARGEST_INTEGER:
        return f"{value:.15g}, beyond the largest Integer, {LARGEST_INTEGER}"
    return ""


def outside_bounds(variable: ScalarVariable, value: float | None) -> str:
    """How a value lies outside the bounds of a variable, or of its type's; "" if not, or if it is not known yet."""
    if value is None or isinstance(value, bool):
        return ""
    if not math.isfinite(value):
        return "no number: what it is computed from has no finite result"
    too_large = beyond_integers(variable, value)
    if too_large:
        return too_large
    least, largest = variable.minimum, variable.maximum
    unit = variable.declaration.unit if variable.declaration is not None else ""
    shown = f"{value:.15g} {unit}".rstrip()
    if least is not None and value < least:
        return f"{shown}, less than its min of {least:.15g}"
    if largest is not None and value > largest:
        return f"{shown}, more than its max of {largest:.15g}"
    return ""
