"""The XML files of FMI 3.0.2: modelDescription, buildDescription, terminalsAndIcons.

FMI 3.0 numbers all variables in one sequence, so the uppermost four bits of a value reference say what kind it
is (``runtime/fmi/fmi3_values.c`` reads them). Variables that share a slot are aliases of one variable, except
outputs: an alias has no causality, so an output gets a reference of its own by the six bits after these.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Container, Iterable, Sequence
from dataclasses import dataclass, replace

from lxml import etree

from modelica2fmu.description.model_description import (
    Causality,
    DataType,
    Initial,
    ModelDescription,
    Variability,
    Variable,
)
from modelica2fmu.packaging.description_xml import (
    add_definitions,
    check_description,
    description_root,
    initial_unknowns,
    number,
    start_text,
    xml_bytes,
)
from modelica2fmu.packaging.fmi3_types import FloatTypes, float_types, set_display_units
from modelica2fmu.packaging.solver_variables import FIRST_REFERENCE
from modelica2fmu.packaging.source_folder import EXTERNAL_HEADERS

FMI_VERSION = "3.0"

_KIND_SHIFT = 28
_SLOT_BITS = 22
_MAXIMUM_COPIES = 63
_KIND = {
    DataType.REAL: 0,
    DataType.INTEGER: 1,
    DataType.ENUMERATION: 1,
    DataType.BOOLEAN: 2,
    DataType.STRING: 3,
}
_SOLVER_KIND = {DataType.REAL: 4, DataType.INTEGER: 5}
_INDICATOR_KIND = 6
_TIME_KIND = 7

_XML_TYPE = {
    DataType.REAL: "Float64",
    DataType.INTEGER: "Int32",
    DataType.BOOLEAN: "Boolean",
    DataType.STRING: "String",
    DataType.ENUMERATION: "Enumeration",
}

# Of variables that share a slot the one comes first whose role an importer must see.
_CAUSALITIES = (
    Causality.PARAMETER,
    Causality.INPUT,
    Causality.OUTPUT,
    Causality.CALCULATED_PARAMETER,
    Causality.LOCAL,
)
_INITIALS = (Initial.EXACT, Initial.APPROX, Initial.CALCULATED, None)


@dataclass(frozen=True)
class _Group:
    """Variables of one slot: the one that stands for all, and its aliases.

    Attributes:
        reference: value reference of FMI 3.0.
        variable: with the start value and the derivative that any of them has.
        aliases: the others.
    """

    reference: int
    variable: Variable
    aliases: tuple[Variable, ...]


def _value_references(variables: Sequence[Variable]) -> dict[str, int]:
    """The value references of FMI 3.0 by the names of the variables."""
    references = {variable.name: _slot_reference(variable) for variable in variables}
    used = Counter(references.values())
    copies: Counter[int] = Counter()
    for variable in variables:
        slot = references[variable.name]
        if variable.causality is Causality.OUTPUT and used[slot] > 1 and copies[slot] < _MAXIMUM_COPIES:
            copies[slot] += 1
            references[variable.name] = slot + (copies[slot] << _SLOT_BITS)
    return references


def _slot_reference(variable: Variable) -> int:
    if variable.causality is Causality.INDEPENDENT:
        return _TIME_KIND << _KIND_SHIFT
    if variable.value_reference >= FIRST_REFERENCE:
        return (_SOLVER_KIND[variable.type] << _KIND_SHIFT) + variable.value_reference - FIRST_REFERENCE
    return (_KIND[variable.type] << _KIND_SHIFT) + variable.value_reference


def _merge(reference: int, variables: Sequence[Variable], preferred: Container[str]) -> _Group:
    if variables[0].causality is Causality.INDEPENDENT:
        return _Group(reference, variables[0], tuple(variables[1:]))
    first = min(variables, key=lambda v: (_CAUSALITIES.index(v.causality), v.name not in preferred))
    started = min(variables, key=lambda variable: _INITIALS.index(variable.initial))
    if first.causality is not Causality.INPUT:
        first_merged = replace(first, initial=started.initial, start=started.start)
    else:
        first_merged = first
    if len(variables) > 1 and first.causality is Causality.CALCULATED_PARAMETER:
        # Means the same, and checkers that read an alias as a variable of the same causality find no fault with it.
        first_merged = replace(first_merged, causality=Causality.LOCAL)
    derivative = next((v.derivative_of for v in variables if v.derivative_of is not None), None)
    merged = replace(first_merged, derivative_of=derivative, reinit=any(v.reinit for v in variables))
    return _Group(reference, merged, tuple(variable for variable in variables if variable is not first))


def _with_own_variables(description: ModelDescription) -> ModelDescription:
    """Adds what FMI 3.0 wants as variables: the time and the event indicators."""
    variables = list(description.variables)
    names = {variable.name for variable in variables}
    if not any(variable.causality is Causality.INDEPENDENT for variable in variables):
        name = "time" if "time" not in names else "cmbTime"
        variables.append(
            Variable(
                name, DataType.REAL, 0, Causality.INDEPENDENT, Variability.CONTINUOUS, description="Time", unit="s"
            )
        )
    return replace(description, variables=tuple(variables))


def _groups(description: ModelDescription, references: dict[str, int]) -> list[_Group]:
    """The variables by reference; states and derivatives keep their names where others are equal to them."""
    preferred = {*description.states, *description.derivatives}
    slots: dict[int, list[Variable]] = {}
    for variable in description.variables:
        slots.setdefault(references[variable.name], []).append(variable)
    return [_merge(reference, members, preferred) for reference, members in slots.items()]


def _enumeration_element(definitions: etree._Element, name: str) -> etree._Element:
    return etree.SubElement(definitions, "EnumerationType", name=name)


def _set_bounds(element: etree._Element, variable: Variable) -> None:
    for name, bound in (("min", variable.minimum), ("max", variable.maximum)):
        if bound is not None and math.isfinite(bound):
            element.set(name, number(bound) if variable.type is DataType.REAL else str(int(bound)))


def _variable_element(
    group: _Group, references: dict[str, int], display_units: set[tuple[str, str]], types: FloatTypes
) -> etree._Element:
    variable = group.variable
    element = etree.Element(_XML_TYPE[variable.type], name=variable.name, valueReference=str(group.reference))
    if variable.description:
        element.set("description", variable.description)
    element.set("causality", variable.causality.value)
    element.set("variability", variable.variability.value)
    if variable.initial is not None and variable.causality not in (Causality.INPUT, Causality.INDEPENDENT):
        element.set("initial", variable.initial.value)
    if variable.type is DataType.ENUMERATION and variable.enumeration is not None:
        element.set("declaredType", variable.enumeration)
    declared = types.name(variable)
    if declared is not None:
        element.set("declaredType", declared)
    if variable.quantity and variable.type in (DataType.INTEGER, DataType.ENUMERATION):
        element.set("quantity", variable.quantity)
    if variable.type in (DataType.REAL, DataType.INTEGER):
        _set_bounds(element, variable)
    if variable.type is DataType.REAL:
        if variable.derivative_of is not None:
            element.set("derivative", str(references[variable.derivative_of]))
        if variable.reinit:
            element.set("reinit", "true")
    if variable.start is not None:
        if variable.type is DataType.STRING:
            etree.SubElement(element, "Start", value=start_text(variable))
        else:
            element.set("start", start_text(variable))
    for alias in group.aliases:
        child = etree.SubElement(element, "Alias", name=alias.name)
        if alias.description:
            child.set("description", alias.description)
        if variable.type is DataType.REAL and (variable.unit, alias.display_unit) in display_units:
            child.set("displayUnit", alias.display_unit)
    return element


def _model_structure(
    description: ModelDescription, merged: ModelDescription, references: dict[str, int]
) -> etree._Element:
    structure = etree.Element("ModelStructure")
    indicators = [(_INDICATOR_KIND << _KIND_SHIFT) + index for index in range(description.indicator_count)]
    for name, unknowns in (
        ("Output", [references[output] for output in description.outputs]),
        ("ContinuousStateDerivative", [references[derivative] for derivative in description.derivatives]),
        ("InitialUnknown", [references[unknown] for unknown in initial_unknowns(merged)]),
        ("EventIndicator", indicators),
    ):
        for reference in dict.fromkeys(unknowns):
            etree.SubElement(structure, name, valueReference=str(reference))
    return structure


def _indicator_elements(count: int) -> Iterable[etree._Element]:
    for index in range(count):
        yield etree.Element(
            "Float64",
            {
                "name": f"cmbIndicator[{index + 1}]",
                "valueReference": str((_INDICATOR_KIND << _KIND_SHIFT) + index),
                "description": "Event indicator",
                "causality": "local",
                "variability": "continuous",
                "initial": "calculated",
            },
        )


def fmi3_description(description: ModelDescription) -> bytes:
    """Writes modelDescription.xml.

    Args:
        description: the model, the integrator's variables included.

    Returns:
        UTF-8 text, the same bytes for the same description.

    Raises:
        ProblemList: the description contradicts itself.
    """
    check_description(description)
    complete = _with_own_variables(description)
    references = _value_references(complete.variables)
    groups = _groups(complete, references)
    primary = {group.reference: group.variable.name for group in groups}
    merged = replace(
        complete,
        variables=tuple(group.variable for group in groups),
        states=tuple(primary[references[name]] for name in complete.states),
        derivatives=tuple(primary[references[name]] for name in complete.derivatives),
    )
    root = description_root(description, FMI_VERSION, "instantiationToken")
    shared = {
        "modelIdentifier": description.identifier,
        "needsExecutionTool": "false",
        "canBeInstantiatedOnlyOncePerProcess": "false",
        "canGetAndSetFMUState": "true",
        "canSerializeFMUState": "true",
        "providesDirectionalDerivatives": "true",
    }
    needed = "true" if description.needs_completed_steps else "false"
    etree.SubElement(root, "ModelExchange", {**shared, "needsCompletedIntegratorStep": needed})
    co_simulation = {
        "canHandleVariableCommunicationStepSize": "true",
        "maxOutputDerivativeOrder": "0",
        "mightReturnEarlyFromDoStep": "true",
        "hasEventMode": "true",
    }
    etree.SubElement(root, "CoSimulation", {**shared, **co_simulation})
    types = float_types(merged.variables)
    display_units = add_definitions(root, description, merged.variables, _enumeration_element, types.elements.values())
    set_display_units(types, display_units)
    variables = etree.SubElement(root, "ModelVariables")
    for group in groups:
        variables.append(_variable_element(group, references, display_units, types))
    variables.extend(_indicator_elements(description.indicator_count))
    root.append(_model_structure(complete, merged, references))
    return xml_bytes(root)


def build_description(description: ModelDescription, sources: Iterable[str], options: Sequence[str]) -> bytes:
    """Writes sources/buildDescription.xml.

    Args:
        description: the model.
        sources: names of the C files in the sources folder.
        options: options of the C compiler.
    """
    root = etree.Element("fmiBuildDescription", fmiVersion=FMI_VERSION)
    configuration = etree.SubElement(
        root,
        "BuildConfiguration",
        modelIdentifier=description.identifier,
        description="Needs SUNDIALS 6 (CVODE) and the external libraries of the model",
    )
    files = etree.SubElement(
        configuration, "SourceFileSet", language="C11", compiler="gcc", compilerOptions=" ".join(options)
    )
    for source in sources:
        etree.SubElement(files, "SourceFile", name=source)
    etree.SubElement(files, "IncludeDirectory", name=".")
    etree.SubElement(files, "IncludeDirectory", name=EXTERNAL_HEADERS)
    for library in ("sundials_cvode", *description.external.libraries):
        etree.SubElement(configuration, "Library", name=library, external="true")
    return xml_bytes(root)


def terminals_and_icons() -> bytes:
    """Writes terminalsAndIcons/terminalsAndIcons.xml: where the icon lies."""
    root = etree.Element("fmiTerminalsAndIcons", fmiVersion=FMI_VERSION)
    representation = etree.SubElement(root, "GraphicalRepresentation")
    corners = {"x1": "-100", "y1": "-100", "x2": "100", "y2": "100"}
    etree.SubElement(representation, "CoordinateSystem", {**corners, "suggestedScalingFactorTo_mm": "0.1"})
    etree.SubElement(representation, "Icon", corners)
    return xml_bytes(root)
