"""FMI 3.0: quantities, units and nominal values stand in type definitions, which strict parsers take."""

from __future__ import annotations

from lxml import etree
from modelica2fmu.description.model_description import Causality, DataType, ModelDescription, Variability, Variable
from modelica2fmu.packaging.fmi3_description import fmi3_description

# Attributes of a Float64 that importers with a parser of their own know, as fmi-sim 0.7.
KNOWN = {
    *("name", "valueReference", "description", "causality", "variability", "declaredType", "start", "initial"),
    *("min", "max", "derivative", "reinit"),
}


def variable(name: str, slot: int, **attributes: object) -> Variable:
    return Variable(name, DataType.REAL, slot, Causality.LOCAL, Variability.CONTINUOUS, **attributes)  # type: ignore[arg-type]


def test_types_carry_what_variables_have_in_common() -> None:
    angle = {"quantity": "Angle", "unit": "rad", "display_unit": "deg"}
    variables = (
        variable("phi", 0, **angle),
        variable("psi", 1, **angle, minimum=-1.0),
        variable("big", 2, **angle, nominal=100.0),
        variable("plain", 3),
    )
    description = ModelDescription("M", "M", "{guid}", variables, states=(), derivatives=())
    root = etree.fromstring(fmi3_description(description))
    types = {element.get("name"): dict(element.attrib) for element in root.findall("TypeDefinitions/Float64Type")}
    of = {element.get("name"): element for element in root.findall("ModelVariables/Float64")}
    assert of["phi"].get("declaredType") == of["psi"].get("declaredType")
    first, second = (types[of[name].get("declaredType")] for name in ("phi", "big"))
    assert {name: first[name] for name in first if name != "name"} == {
        "quantity": "Angle",
        "unit": "rad",
        "displayUnit": "deg",
    }
    assert second["nominal"] == "100.0"
    assert of["psi"].get("min") == "-1.0"
    assert of["plain"].get("declaredType") is None
    assert not types.keys() & of.keys()
    for element in of.values():
        assert set(element.attrib) <= KNOWN
