"""Opening an FMU (FMI 2.0 or 3.0) through FMPy: its description, its variables and instances of it."""

from __future__ import annotations

import math
import os
import re
import shutil
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import Any

import fmpy
from contact_foundation.errors import InputError, Place, SimulationError
from fmpy.fmi1 import FMICallException
from fmpy.model_description import read_model_description

from fmu_regression.fmi.binary_check import require_whole
from fmu_regression.fmi.binding import Binding, Identity, Mode
from fmu_regression.fmi.fmi2_binding import Fmi2Binding
from fmu_regression.fmi.fmi3_binding import Fmi3Binding
from fmu_regression.results.result import close_names_remedy

__all__ = [
    "Fmu",
    "Instance",
    "Mode",
    "ModelDescription",
    "StartValue",
    "Variable",
    "check_signals",
    "check_start_values",
    "open_fmu",
    "read_description",
]

StartValue = float | int | bool | str

_MAX_LOG_LINES = 200
MOST_KINDS = 4
_FOLDERS = re.compile(r"(?<![\w/])/(?:[^\s/:]+/)+(?=[^\s/:])")
_NUMBER = re.compile(r"[-+]?\d[\d.]*(?:[eE][-+]?\d+)?")
_STATUS_NAMES = ("ok", "warning", "discard", "error", "fatal", "pending")
_DISCARDED = "[discard]"

_BINDINGS: Mapping[str, type[Fmi2Binding] | type[Fmi3Binding]] = {"2.0": Fmi2Binding, "3.0": Fmi3Binding}


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
        variable_steps: whether the co-simulation takes communication steps of different lengths.
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
    variable_steps: bool
    start: float
    stop: float | None
    tolerance: float | None
    interval: float | None
    generation_tool: str
    keeps_states: bool = False


class Instance:
    """An instance of an FMU: its functions with the messages that it logged.

    Attributes:
        functions: the FMI functions of the instance.
        description: the FMU's description.
        messages: logged lines, "[status] category: text".
    """

    def __init__(self, functions: Binding, description: ModelDescription, messages: list[str]) -> None:
        self.functions = functions
        self.description = description
        self.messages = messages

    def told(self) -> list[str]:
        """What the FMU logged: the last messages of each kind, those that differ in numbers alone as one."""
        return _told_once(self.messages)

    def failure(self, what: str, cause: BaseException | None = None) -> SimulationError:
        """A SimulationError that carries what the FMU logged last."""
        text = what
        if isinstance(cause, FMICallException):
            text = f"{what}: {cause.function} returned {_status_name(cause.status)}"
        elif cause is not None:
            text = f"{what}: {cause}"
        lines = self.told()
        if lines:
            text += "\n" + "\n".join(f"  {line}" for line in lines)
        return SimulationError(text, place=Place(component=self.description.name))

    def forget_discards(self) -> None:
        """Forgets what was told of points that could not be evaluated and that a shorter step has avoided."""
        self.messages[:] = [message for message in self.messages if not message.startswith(_DISCARDED)]

    def set_start_values(self, values: Mapping[str, StartValue]) -> None:
        """Sets start values; names and types must have been checked by ``check_start_values``."""
        for name, value in values.items():
            variable = self.description.variables[name]
            self.functions.set(variable.data_type, variable.reference, value)


@dataclass(frozen=True)
class Fmu:
    """An unpacked FMU.

    Attributes:
        path: the FMU file.
        folder: where it lies unpacked; removed when the context that opened it ends.
        description: its description.
    """

    path: Path
    folder: Path
    description: ModelDescription = field(repr=False)

    def _binary(self, identifier: str) -> Path:
        return self.folder / "binaries" / _platform(self.description) / f"{identifier}{fmpy.sharedLibraryExtension}"

    @contextmanager
    def instantiate(self, mode: Mode, *, logging: bool = False) -> Iterator[Instance]:
        """Yields a fresh instance, freed afterwards.

        Args:
            mode: model exchange or co-simulation.
            logging: whether the FMU's debug messages are wanted too.

        Raises:
            InputError: the FMU does not offer the mode, or its binary is damaged, cannot be loaded or refuses to be
                instantiated.
        """
        description = self.description
        if mode not in description.identifiers:
            offered = ", ".join(sorted(description.identifiers)) or "nothing"
            raise InputError(f"the FMU offers {offered}, not {mode}", place=Place(file=self.path))
        messages: list[str] = []
        identity = Identity(self.folder, description.name, description.guid, description.identifiers[mode])
        working_folder = os.getcwd()
        require_whole(self._binary(identity.model_identifier), self.path)
        try:
            functions: Binding = _BINDINGS[description.fmi](identity, mode)
        except Exception as error:
            os.chdir(working_folder)  # FMPy loads in the binary's folder, and stays there where that fails
            said = _FOLDERS.sub("", " ".join(str(error).split()))
            raise InputError(f"cannot load the FMU's binary: {said}", place=Place(file=self.path)) from error
        instance = Instance(functions, description, messages)

        def log(status: int, category: str, text: str) -> None:
            if len(messages) >= _MAX_LOG_LINES:
                del messages[: _MAX_LOG_LINES // 2]
            kind = f" {category}:" if category else ""
            messages.append(f"[{_status_name(status)}]{kind} {text.rstrip()}")

        try:
            functions.instantiate(log, logging)
        except Exception as error:
            functions.unload()
            refusal = instance.failure("the FMU cannot be instantiated", error)
            raise InputError(refusal.message, place=Place(file=self.path)) from error
        try:
            yield instance
        finally:
            functions.free()


def _platform(description: ModelDescription) -> str:
    """Name of this machine's folder of binaries."""
    return str(fmpy.platform if description.fmi == "2.0" else fmpy.platform_tuple)


def _invalid(error: BaseException) -> str:
    """What is wrong with a description, not more than a terminal takes."""
    lines = str(error).splitlines() or [type(error).__name__]
    left = len(lines) - 1 - MOST_KINDS
    return "\n".join((*lines[: 1 + MOST_KINDS], *([f"- and {left} more"] if left > 0 else ())))


def _told_once(messages: Sequence[str]) -> list[str]:
    """The last messages of each kind, those that differ in numbers alone as one, without folders of the builder."""
    kinds: dict[str, list[str]] = {}
    for message in messages:
        line = _FOLDERS.sub("", " ".join(message.split()))
        kinds.setdefault(_NUMBER.sub("#", line), []).append(line)
    return [
        lines[-1] + (f" (and {len(lines) - 1} more of this kind)" if len(lines) > 1 else "")
        for lines in list(kinds.values())[-MOST_KINDS:]
    ]


@contextmanager
def open_fmu(path: Path) -> Iterator[Fmu]:
    """Unpacks an FMU into a temporary folder and reads its description.

    Raises:
        InputError: the file is missing, no FMU, neither FMI 2.0 nor 3.0, or has no binary for this platform.
    """
    if not path.is_file():
        raise InputError("there is no such file", place=Place(file=path))
    description = read_description(path)
    folder = Path(tempfile.mkdtemp(prefix="cmb-fmu-"))
    try:
        try:
            fmpy.extract(str(path), str(folder))
        except Exception as error:
            raise InputError(f"the FMU cannot be unpacked: {error}", place=Place(file=path)) from error
        platform = _platform(description)
        if not (folder / "binaries" / platform).is_dir():
            raise InputError(f"the FMU has no binary for {platform}", place=Place(file=path))
        yield Fmu(path=path, folder=folder, description=description)
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def read_description(path: Path) -> ModelDescription:
    """Reads the description of an FMU file without unpacking it.

    Raises:
        InputError: the file is missing, no FMU, or neither FMI 2.0 nor 3.0.
    """
    try:
        raw = read_model_description(str(path), validate=True)
    except Exception as error:
        raise InputError(f"not a valid FMU: {_invalid(error)}", place=Place(file=path)) from error
    version = ".".join(raw.fmiVersion.split(".")[:2])
    if version not in _BINDINGS:
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
        variable_steps=bool(raw.coSimulation is not None and raw.coSimulation.canHandleVariableCommunicationStepSize),
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


def _status_name(status: int) -> str:
    return _STATUS_NAMES[status] if 0 <= status < len(_STATUS_NAMES) else f"status {status}"
