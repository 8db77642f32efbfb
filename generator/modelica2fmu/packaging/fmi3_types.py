"""Type definitions of FMI 3.0: what variables have in common in quantity, unit and nominal value is said once."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field

from lxml import etree

from modelica2fmu.description.model_description import DataType, Variable
from modelica2fmu.packaging.description_xml import number


@dataclass(frozen=True)
class FloatTypes:
    """The types of a description's Float64 variables.

    Attributes:
        elements: by the attributes of each.
    """

    elements: dict[tuple[tuple[str, str], ...], etree._Element] = field(default_factory=dict)

    def name(self, variable: Variable) -> str | None:
        """The declared type of a variable; ``None`` if it needs none."""
        element = self.elements.get(_attributes(variable))
        return None if element is None else element.get("name")


def float_types(variables: Iterable[Variable]) -> FloatTypes:
    """The types that variables need, in their order; names tell what they say and are no names of Modelica."""
    types = FloatTypes()
    for variable in variables:
        attributes = _attributes(variable)
        if attributes and attributes not in types.elements:
            types.elements[attributes] = etree.Element("Float64Type", {"name": _name(variable), **dict(attributes)})
    return types


def set_display_units(types: FloatTypes, known: set[tuple[str, str]]) -> None:
    """Takes away display units that are not defined.

    Args:
        types: of the description.
        known: pairs (unit, display unit).
    """
    for element in types.elements.values():
        if "displayUnit" in element.attrib and (element.get("unit"), element.get("displayUnit")) not in known:
            del element.attrib["displayUnit"]


def _attributes(variable: Variable) -> tuple[tuple[str, str], ...]:
    if variable.type is not DataType.REAL:
        return ()
    attributes = [("quantity", variable.quantity), ("unit", variable.unit)]
    if variable.unit:
        attributes.append(("displayUnit", variable.display_unit))
    if variable.nominal is not None and math.isfinite(variable.nominal):
        attributes.append(("nominal", number(variable.nominal)))
    return tuple((name, value) for name, value in attributes if value)


def _name(variable: Variable) -> str:
    given = dict(_attributes(variable))
    parts = [
        f"{given.get('quantity', 'Real')} in {given['unit']}" if "unit" in given else given.get("quantity", "Real")
    ]
    if "displayUnit" in given:
        parts.append(f"shown in {given['displayUnit']}")
    if "nominal" in given:
        parts.append(f"nominally {given['nominal']}")
    return ", ".join(parts)
