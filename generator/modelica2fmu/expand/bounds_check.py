"""Whether the values of parameters lie within their bounds."""

from __future__ import annotations

from contact_foundation.errors import InputError, Place

from modelica2fmu.expand.scalar_model import ScalarVariable


def require_within(variable: ScalarVariable, place: Place) -> None:
    """Refuses a number below a parameter's ``min`` or above its ``max``; what is computed later is not checked here.

    Args:
        variable: with its value and bounds.
        place: where the value is written.

    Raises:
        InputError: the number lies outside.
    """
    value, least, largest = variable.value, variable.minimum, variable.maximum
    if isinstance(value, bool) or not isinstance(value, float | int):
        return
    unit = variable.declaration.unit if variable.declaration is not None else ""
    shown = f"{value:.15g} {unit}".rstrip()
    if least is not None and value < least:
        outside = f"is {shown}, less than its min of {least:.15g}"
    elif largest is not None and value > largest:
        outside = f"is {shown}, more than its max of {largest:.15g}"
    else:
        return
    raise InputError(
        f"{variable.name} {outside}",
        place=Place(file=place.file, line=place.line),
        remedy="Give a value within the bounds.",
    )
