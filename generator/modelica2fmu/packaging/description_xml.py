"""What modelDescription.xml of FMI 2.0 and of FMI 3.0 have in common."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator
from importlib import metadata

from contact_foundation.errors import InputError, Place, ProblemList
from lxml import etree

from modelica2fmu.description.model_description import (
    Causality,
    DataType,
    EnumerationType,
    Initial,
    ModelDescription,
    Variability,
    Variable,
)
from modelica2fmu.description.units import BASE_UNITS, display_conversion, parse_unit

#: Names of the runtime's log categories (``fmurt_instance.h``).
LOG_CATEGORIES = (
    ("logEvents", "Events: relations that change"),
    ("logSolver", "Integrator: failed steps and evaluations"),
    ("logStatusWarning", "Warnings of the model"),
    ("logStatusDiscard", "Values that cannot be computed"),
    ("logStatusError", "Errors"),
    ("logAll", "All messages"),
)

_WITH_START = {Initial.EXACT, Initial.APPROX}

_NOT_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")  # XML 1.0, production 2


def generation_tool() -> str:
    """Name and version of the program, for the attribute ``generationTool``."""
    try:
        return f"ContactMultiBody {metadata.version('contactmultibody')}"
    except metadata.PackageNotFoundError:
        return "ContactMultiBody"


def number(value: float) -> str:
    """The shortest decimal text that reads back as the same double."""
    return repr(float(value))


def boolean(value: bool) -> str:
    """XML's spelling of a truth value."""
    return "true" if value else "false"


_NAME_PART = r"(?:[A-Za-z_]\w*|'(?:[^'\\]|\\.)+')(?:\[\d+(?:,\d+)*\])?"
_STRUCTURED = re.compile(rf"{_NAME_PART}(?:\.{_NAME_PART})*", re.ASCII)
_STRUCTURED_DERIVATIVE = re.compile(rf"der\((?:{_STRUCTURED.pattern})(?:,\d+)?\)", re.ASCII)


def _naming_convention(variables: Iterable[Variable]) -> str:
    """``structured`` if all names are such (FMI 2.0.4, section 2.2.9), else ``flat``."""
    structured = all(
        _STRUCTURED.fullmatch(variable.name) or _STRUCTURED_DERIVATIVE.fullmatch(variable.name)
        for variable in variables
    )
    return "structured" if structured else "flat"


def _texts(description: ModelDescription) -> Iterator[tuple[str, tuple[str, ...]]]:
    """All free texts of a description, with the component each belongs to."""
    yield description.name, (description.name, description.description, description.guid)
    for enumeration in description.enumerations:
        for item in enumeration.items:
            yield enumeration.name, (enumeration.name, item.name, item.description)
    for variable in description.variables:
        start = variable.start if isinstance(variable.start, str) else ""
        yield (
            variable.name,
            (variable.name, variable.description, variable.unit, variable.display_unit, variable.quantity, start),
        )


def check_description(description: ModelDescription) -> None:
    """Finds what no valid modelDescription.xml could be written from.

    Raises:
        ProblemList: unknown names in states, derivatives, outputs or types, doubled names, start values that
            are missing, not finite or where none may be.
    """
    problems: list[InputError] = []

    def problem(component: str, message: str) -> None:
        problems.append(InputError(message, place=Place(component=component)))

    for component, texts in _texts(description):
        if any(_NOT_XML.search(text) for text in texts):
            problem(_NOT_XML.sub("?", component), "a text has characters that XML does not know")
    known: set[str] = set()
    enumerations = {enumeration.name for enumeration in description.enumerations}
    for variable in description.variables:
        if variable.name in known:
            problem(variable.name, "two variables have this name")
        known.add(variable.name)
        needs_start = variable.initial in _WITH_START or variable.causality is Causality.INPUT
        if needs_start and variable.start is None:
            problem(variable.name, "a start value is missing")
        if not needs_start and variable.start is not None:
            problem(variable.name, "a variable that is calculated has a start value")
        if isinstance(variable.start, float) and not math.isfinite(variable.start):
            problem(variable.name, f"the start value {variable.start} is not finite")
        if variable.type is DataType.ENUMERATION and variable.enumeration not in enumerations:
            problem(variable.name, f"the enumeration type {variable.enumeration} is not described")
        if variable.type is not DataType.REAL and variable.variability is Variability.CONTINUOUS:
            problem(variable.name, "only Real variables are continuous")
    for role, names in (
        ("state", description.states),
        ("derivative", description.derivatives),
        ("output", description.outputs),
        ("state", tuple(v.derivative_of for v in description.variables if v.derivative_of is not None)),
    ):
        for name in names:
            if name not in known:
                problem(name, f"this {role} is not among the variables")
    if len(description.states) != len(description.derivatives):
        problem(description.name, "the numbers of states and derivatives differ")
    if problems:
        raise ProblemList(f"description of the model {description.name}", problems)


def _unit_definitions(variables: Iterable[Variable]) -> tuple[etree._Element, set[tuple[str, str]]]:
    """The element ``UnitDefinitions`` and the pairs (unit, display unit) that it defines."""
    displays: dict[str, set[str]] = {}
    for variable in variables:
        if variable.unit:
            displays.setdefault(variable.unit, set())
            if variable.display_unit:
                displays[variable.unit].add(variable.display_unit)
    definitions = etree.Element("UnitDefinitions")
    defined: set[tuple[str, str]] = set()
    for name in sorted(displays):
        element = etree.SubElement(definitions, "Unit", name=name)
        unit = parse_unit(name)
        if unit is None:
            continue
        base = etree.SubElement(element, "BaseUnit")
        for base_name, exponent in zip(BASE_UNITS, unit.exponents, strict=True):
            if exponent != 0:
                base.set(base_name, str(exponent))
        if unit.factor != 1.0:
            base.set("factor", number(unit.factor))
        if unit.offset != 0.0:
            base.set("offset", number(unit.offset))
        for display_name in sorted(displays[name]):
            display = parse_unit(display_name)
            conversion = display_conversion(unit, display) if display is not None else None
            if conversion is None:
                continue
            factor, offset = conversion
            defined.add((name, display_name))
            shown = etree.SubElement(element, "DisplayUnit", name=display_name)
            if factor != 1.0:
                shown.set("factor", number(factor))
            if offset != 0.0:
                shown.set("offset", number(offset))
    return definitions, defined


def _log_categories() -> etree._Element:
    """The element ``LogCategories``."""
    categories = etree.Element("LogCategories")
    for name, text in LOG_CATEGORIES:
        etree.SubElement(categories, "Category", name=name, description=text)
    return categories


def initial_unknowns(description: ModelDescription) -> list[str]:
    """Names of the variables that initialization computes and the model structure lists, in order of the variables."""
    watched = set(description.states) | set(description.derivatives)
    computed = {Initial.APPROX, Initial.CALCULATED}
    return [
        variable.name
        for variable in description.variables
        if variable.causality is Causality.CALCULATED_PARAMETER
        or (variable.initial in computed and (variable.causality is Causality.OUTPUT or variable.name in watched))
    ]


def _default_experiment(description: ModelDescription) -> etree._Element:
    """The element ``DefaultExperiment``, the same in FMI 2.0 and 3.0."""
    experiment = description.experiment
    element = etree.Element("DefaultExperiment")
    for name, value in (
        ("startTime", experiment.start if experiment.start is not None else 0.0),
        ("stopTime", experiment.stop),
        ("tolerance", experiment.tolerance),
        ("stepSize", experiment.interval),
    ):
        if value is not None:
            element.set(name, number(value))
    return element


def description_root(description: ModelDescription, version: str, token: str) -> etree._Element:
    """The document's root element without children.

    Args:
        description: the model.
        version: of FMI.
        token: the attribute that tells models apart, ``guid`` or ``instantiationToken``.
    """
    root = etree.Element(
        "fmiModelDescription",
        {
            "fmiVersion": version,
            "modelName": description.name,
            token: description.guid,
            "generationTool": generation_tool(),
            "variableNamingConvention": _naming_convention(description.variables),
        },
    )
    if description.description:
        root.set("description", description.description)
    return root


EnumerationElement = Callable[[etree._Element, str], etree._Element]
"""Declares an enumeration of a name below ``TypeDefinitions`` and returns the element that takes its items."""


def add_definitions(
    root: etree._Element,
    description: ModelDescription,
    variables: Iterable[Variable],
    enumeration_element: EnumerationElement,
    types: Iterable[etree._Element] = (),
) -> set[tuple[str, str]]:
    """Adds units, types, log categories and the default experiment, which both versions have in this order.

    Args:
        root: of the description.
        description: the model.
        variables: whose units are defined.
        enumeration_element: makes the definition of an enumeration.
        types: definitions beside those of enumerations.

    Returns:
        the pairs (unit, display unit) that are defined.
    """
    units, display_units = _unit_definitions(variables)
    if len(units):
        root.append(units)
    types = list(types)
    if description.enumerations or types:
        definitions = etree.SubElement(root, "TypeDefinitions")
        definitions.extend(types)
        for enumeration in description.enumerations:
            _add_items(enumeration_element(definitions, enumeration.name), enumeration)
    root.append(_log_categories())
    root.append(_default_experiment(description))
    return display_units


def _add_items(element: etree._Element, enumeration: EnumerationType) -> None:
    for item in enumeration.items:
        child = etree.SubElement(element, "Item", name=item.name, value=str(item.value))
        if item.description:
            child.set("description", item.description)


def start_text(variable: Variable) -> str:
    """XML's spelling of a variable's start value, which must be there."""
    start = variable.start
    if variable.type is DataType.REAL and isinstance(start, int | float):
        return number(start)
    return boolean(bool(start)) if variable.type is DataType.BOOLEAN else str(start)


def xml_bytes(root: etree._Element) -> bytes:
    """The document, indented, in UTF-8."""
    etree.indent(root)
    return etree.tostring(root, xml_declaration=True, encoding="UTF-8") + b"\n"
