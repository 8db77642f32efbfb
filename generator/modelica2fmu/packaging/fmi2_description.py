"""modelDescription.xml of FMI 2.0.4."""

from __future__ import annotations

import math

from lxml import etree

from modelica2fmu.description.model_description import Causality, DataType, ModelDescription, Variable
from modelica2fmu.packaging.description_xml import (
    add_definitions,
    check_description,
    description_root,
    initial_unknowns,
    number,
    start_text,
    xml_bytes,
)

_XML_TYPE = {
    DataType.REAL: "Real",
    DataType.INTEGER: "Integer",
    DataType.BOOLEAN: "Boolean",
    DataType.STRING: "String",
    DataType.ENUMERATION: "Enumeration",
}


def _enumeration_element(definitions: etree._Element, name: str) -> etree._Element:
    return etree.SubElement(etree.SubElement(definitions, "SimpleType", name=name), "Enumeration")


def _scalar_variable(
    variable: Variable, index_of: dict[str, int], display_units: set[tuple[str, str]]
) -> etree._Element:
    element = etree.Element("ScalarVariable", name=variable.name, valueReference=str(variable.value_reference))
    if variable.description:
        element.set("description", variable.description)
    element.set("causality", variable.causality.value)
    element.set("variability", variable.variability.value)
    if variable.initial is not None and variable.causality not in (Causality.INPUT, Causality.INDEPENDENT):
        element.set("initial", variable.initial.value)
    kind = etree.SubElement(element, _XML_TYPE[variable.type])
    if variable.type is DataType.ENUMERATION and variable.enumeration is not None:
        kind.set("declaredType", variable.enumeration)
    if variable.type is not DataType.BOOLEAN and variable.type is not DataType.STRING and variable.quantity:
        kind.set("quantity", variable.quantity)
    if variable.type is DataType.REAL and variable.unit:
        kind.set("unit", variable.unit)
        if (variable.unit, variable.display_unit) in display_units:
            kind.set("displayUnit", variable.display_unit)
    if variable.type in (DataType.REAL, DataType.INTEGER):
        for name, bound in (("min", variable.minimum), ("max", variable.maximum)):
            if bound is not None and math.isfinite(bound):
                kind.set(name, number(bound) if variable.type is DataType.REAL else str(int(bound)))
    if variable.type is DataType.REAL and variable.nominal is not None and math.isfinite(variable.nominal):
        kind.set("nominal", number(variable.nominal))
    if variable.start is not None:
        kind.set("start", start_text(variable))
    if variable.type is DataType.REAL:
        if variable.derivative_of is not None:
            kind.set("derivative", str(index_of[variable.derivative_of]))
        if variable.reinit:
            kind.set("reinit", "true")
    return element


def _model_structure(description: ModelDescription, index_of: dict[str, int]) -> etree._Element:
    structure = etree.Element("ModelStructure")
    for name, unknowns in (
        ("Outputs", description.outputs),
        ("Derivatives", description.derivatives),
        ("InitialUnknowns", initial_unknowns(description)),
    ):
        if unknowns:
            group = etree.SubElement(structure, name)
            for unknown in unknowns:
                etree.SubElement(group, "Unknown", index=str(index_of[unknown]))
    return structure


def fmi2_description(description: ModelDescription) -> bytes:
    """Writes modelDescription.xml.

    Args:
        description: the model, the integrator's variables included.

    Returns:
        UTF-8 text, the same bytes for the same description.

    Raises:
        ProblemList: the description contradicts itself.
    """
    check_description(description)
    index_of = {variable.name: index for index, variable in enumerate(description.variables, start=1)}
    root = description_root(description, "2.0", "guid")
    root.set("numberOfEventIndicators", str(description.indicator_count))
    shared = {
        "modelIdentifier": description.identifier,
        "needsExecutionTool": "false",
        "canBeInstantiatedOnlyOncePerProcess": "false",
        "canNotUseMemoryManagementFunctions": "true",
        "canGetAndSetFMUstate": "true",
        "canSerializeFMUstate": "true",
        "providesDirectionalDerivative": "true",
    }
    not_needed = "false" if description.needs_completed_steps else "true"
    etree.SubElement(root, "ModelExchange", {**shared, "completedIntegratorStepNotNeeded": not_needed})
    co_simulation = {
        "canHandleVariableCommunicationStepSize": "true",
        "canInterpolateInputs": "false",
        "maxOutputDerivativeOrder": "0",
        "canRunAsynchronuously": "false",
    }
    etree.SubElement(root, "CoSimulation", {**shared, **co_simulation})
    display_units = add_definitions(root, description, description.variables, _enumeration_element)
    variables = etree.SubElement(root, "ModelVariables")
    for variable in description.variables:
        variables.append(_scalar_variable(variable, index_of, display_units))
    root.append(_model_structure(description, index_of))
    return xml_bytes(root)
