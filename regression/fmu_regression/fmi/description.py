"""What an FMU (FMI 2.0 or 3.0) says about itself, and whether names and values given for its variables fit."""

from __future__ import annotations

import hashlib
import math
import zipfile
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any

from contact_foundation.errors import InputError, Place
from fmpy.model_description import read_model_description

from fmu_regression.fmi.binding import Mode
from fmu_regression.results.result import close_names_remedy

StartValue = float | int | bool | str

FMI_VERSIONS = ("2.0", "3.0")
_MOST_KNOWN = 64
MOST_KINDS = 4
"""How many kinds of messages a terminal takes."""


@dataclass(frozen=True)
class Variable:
    """A scalar variable of an FMU.

    Attributes:
        name: Modelica name.
        reference: FMI value reference.
        data_type: the FMI type, "Real" in FMI 2.0 or "Float64" in 3.0.
        kind: "Real", "Integer", "Boolean", "String" or "Enumeration".
        causality: FMI causality, e.g. "output", "local", "parameter".
        variability: FMI variability, e.g. "continuous", "discrete", "fixed".
        unit: unit symbol or "".
        settable: whether a start value may be given before the simulation.
        start: start value in the description, as text, or None.
        least, largest: bounds of the value; None where there are none.
    """

    name: str
    reference: int
    data_type: str
    kind: str
    causality: str
    variability: str
    unit: str
    settable: bool
    start: str | None = None
    least: float | None = None
    largest: float | None = None


@dataclass(frozen=True)
class ModelDescription:
    """What an FMU says about itself, as far as simulating it needs.

    Attributes:
        fmi: version of the standard, "2.0" or "3.0".
        name: model name.
        guid: identity of the binary (FMI 3.0: instantiation token).
        identifiers: mode to the name of the binary; has a key for each mode that the FMU offers.
        variables: name to variable; arrays, binaries and clocks of FMI 3.0 are left out.
        states: names of the continuous states, in the FMU's order.
        state_count: number of continuous states, elements of arrays included.
        indicator_count: number of event indicators.
        needs_completed_step: whether the FMU wants to hear of every completed step.
        start, stop, tolerance, interval: the default experiment, where given.
        generation_tool: the tool that wrote the FMU, or "".
        keeps_states: whether the co-simulation saves and restores its whole state.
    """

    fmi: str
    name: str
    guid: str
    identifiers: Mapping[Mode, str]
    variables: Mapping[str, Variable]
    states: tuple[str, ...]
    state_count: int
    indicator_count: int
    needs_completed_step: bool
    start: float
    stop: float | None
    tolerance: float | None
    interval: float | None
    generation_tool: str
    keeps_states: bool = False


# Descriptions by the digests of their texts.
_KNOWN: dict[bytes, ModelDescription] = {}


def read_description(path: Path) -> ModelDescription:
    """Reads the description of an FMU file without unpacking it; that of the same text is read and checked once.

    Raises:
        InputError: the file is missing, no FMU, or neither FMI 2.0 nor 3.0.
    """
    with suppress(Exception):  # what is wrong with the file is told below
        with zipfile.ZipFile(path) as archive:
            key = hashlib.sha256(archive.read("modelDescription.xml")).digest()
        if key not in _KNOWN:
            if len(_KNOWN) >= _MOST_KNOWN:
                _KNOWN.clear()
            _KNOWN[key] = _read(path)
        return _KNOWN[key]
    return _read(path)


def _read(path: Path) -> ModelDescription:
    try:
        raw = read_model_description(str(path), validate=True)
    except Exception as error:
        raise InputError(f"not a valid FMU: {_invalid(error)}", place=Place(file=path)) from error
    version = ".".join(raw.fmiVersion.split(".")[:2])
    if version not in FMI_VERSIONS:
        raise InputError(
            f"FMI {raw.fmiVersion} is not supported",
            place=Place(file=path),
            remedy="export the model as FMI 2.0 or 3.0",
        )
    identifiers: dict[Mode, str] = {}
    if raw.modelExchange is not None:
        identifiers["me"] = raw.modelExchange.modelIdentifier
    if raw.coSimulation is not None:
        identifiers["cs"] = raw.coSimulation.modelIdentifier
    experiment = raw.defaultExperiment
    variables = (_variable(v) for v in raw.modelVariables if not v.shape)
    return ModelDescription(
        fmi=version,
        name=raw.modelName,
        guid=raw.guid,
        identifiers=MappingProxyType(identifiers),
        variables=MappingProxyType({v.name: v for v in variables if v is not None}),
        states=tuple(d.variable.derivative.name for d in raw.derivatives or [] if d.variable.derivative is not None),
        state_count=sum(math.prod(d.variable.shape or ()) for d in raw.derivatives or []),
        indicator_count=int(raw.numberOfEventIndicators or 0),
        needs_completed_step=bool(raw.modelExchange is not None and raw.modelExchange.needsCompletedIntegratorStep),
        start=_number(experiment.startTime if experiment else None) or 0.0,
        stop=_number(experiment.stopTime if experiment else None),
        tolerance=_number(experiment.tolerance if experiment else None),
        interval=_number(experiment.stepSize if experiment else None),
        generation_tool=raw.generationTool or "",
        keeps_states=bool(raw.coSimulation is not None and raw.coSimulation.canGetAndSetFMUstate),
    )


def check_signals(description: ModelDescription, names: Sequence[str]) -> tuple[Variable, ...]:
    """The variables of the names, each once, in the given order.

    Raises:
        InputError: a name is unknown or a string variable.
    """
    variables = []
    for name in dict.fromkeys(names):
        variable = description.variables.get(name)
        if variable is None:
            raise InputError(
                f"the FMU has no variable {name!r}",
                place=Place(component=description.name),
                remedy=close_names_remedy(name, list(description.variables)),
            )
        if variable.kind == "String":
            raise InputError(f"{name!r} is a string and cannot be recorded", place=Place(component=description.name))
        if name != "time":
            variables.append(variable)
    return tuple(variables)


def check_start_values(description: ModelDescription, values: Mapping[str, StartValue]) -> Mapping[str, StartValue]:
    """Checks names, types and settability of start values and converts texts to the variables' types.

    Raises:
        InputError: a name is unknown, a variable cannot be set, or a value has the wrong type or is out of bounds.
    """
    checked: dict[str, StartValue] = {}
    for name, value in values.items():
        place = Place(component=f"{description.name}.{name}")
        variable = description.variables.get(name)
        if variable is None:
            raise InputError(
                "the FMU has no such variable",
                place=place,
                remedy=close_names_remedy(name, [v.name for v in description.variables.values() if v.settable]),
            )
        if not variable.settable:
            raise InputError(
                f"a {variable.variability} {variable.causality} variable cannot be set",
                place=place,
                remedy="it is computed by the model or was fixed when the FMU was built",
            )
        checked[name] = _within_bounds(variable, _converted(variable, value, place), place)
    return MappingProxyType(checked)


def _within_bounds(variable: Variable, value: StartValue, place: Place) -> StartValue:
    if variable.kind in ("Real", "Integer") and not isinstance(value, str):
        below = variable.least is not None and value < variable.least
        if below or (variable.largest is not None and value > variable.largest):
            bound = f"less than its least value {variable.least:g}" if below else f"more than {variable.largest:g}"
            raise InputError(f"{value:g} is {bound}", place=place, remedy="Give a value within the bounds.")
    return value


def _converted(variable: Variable, value: StartValue, place: Place) -> StartValue:
    try:
        if variable.kind == "String":
            return str(value)
        if variable.kind == "Boolean":
            if isinstance(value, str):
                return {"true": True, "false": False, "1": True, "0": False}[value.lower()]
            if value not in (0, 1):
                raise ValueError
            return bool(value)
        number = float(value)
        if not math.isfinite(number):
            raise ValueError
        if variable.kind == "Real":
            return number
        if number != int(number):
            raise ValueError
        return int(number)
    except (ValueError, KeyError):
        raise InputError(f"{value!r} is not a value of type {variable.kind}", place=place) from None


def _kind(data_type: str) -> str | None:
    """Real, Integer, Boolean, String or Enumeration; None for types that no simulation here reads."""
    if data_type.startswith("Float"):
        return "Real"
    if data_type.startswith(("Int", "UInt")):
        return "Integer"
    return data_type if data_type in ("Real", "Boolean", "String", "Enumeration") else None


def _variable(raw: Any) -> Variable | None:
    kind = _kind(raw.type)
    if kind is None:
        return None
    causality = raw.causality or "local"
    variability = raw.variability or "continuous"
    settable = causality == "input" or (
        variability != "constant" and raw.initial in ("exact", "approx") and causality != "calculatedParameter"
    )
    unit = raw.unit or (raw.declaredType.unit if raw.declaredType is not None else None) or ""
    return Variable(
        name=raw.name,
        reference=int(raw.valueReference),
        data_type=raw.type,
        kind=kind,
        causality=causality,
        variability=variability,
        unit=unit,
        settable=settable,
        start=raw.start,
        least=_bound(raw, "min"),
        largest=_bound(raw, "max"),
    )


def _bound(raw: Any, name: str) -> float | None:
    text = getattr(raw, name, None)
    if text is None and raw.declaredType is not None:
        text = getattr(raw.declaredType, name, None)
    return _number(text)


def _number(text: str | float | None) -> float | None:
    return None if text is None else float(text)


def _invalid(error: BaseException) -> str:
    """What is wrong with a description, not more than a terminal takes."""
    lines = str(error).splitlines() or [type(error).__name__]
    left = len(lines) - 1 - MOST_KINDS
    return "\n".join((*lines[: 1 + MOST_KINDS], *([f"- and {left} more"] if left > 0 else ())))
