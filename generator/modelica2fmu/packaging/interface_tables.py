"""The C tables of ``runtime/model/fmurt_interface.h``: which variable may be set when, and their names."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence

from modelica2fmu.description.model_description import (
    Causality,
    DataType,
    Initial,
    ModelDescription,
    Variability,
    Variable,
)
from modelica2fmu.packaging.solver_variables import FIRST_REFERENCE, SolverOptions, effective_tolerance

SET_INSTANTIATED = 1
SET_INITIALIZATION = 2
SET_EVENT = 4
SET_CONTINUOUS = 8
IS_DISCRETE = 16
IS_PARAMETER = 32
IS_INDEPENDENT = 64

_PARAMETERS = {Variability.FIXED, Variability.TUNABLE}


def access(variable: Variable) -> int:
    """What the runtime permits for a variable, as bits of ``fmurt_interface.h``."""
    bits = 0
    if variable.causality is Causality.INDEPENDENT:
        return IS_INDEPENDENT
    if variable.causality is Causality.INPUT:
        bits |= SET_INSTANTIATED | SET_INITIALIZATION | SET_EVENT
        if variable.variability is Variability.CONTINUOUS:
            bits |= SET_CONTINUOUS
    elif variable.variability is not Variability.CONSTANT:
        if variable.initial is Initial.EXACT:
            bits |= SET_INSTANTIATED | SET_INITIALIZATION
        elif variable.initial is Initial.APPROX:
            bits |= SET_INSTANTIATED
        if variable.causality is Causality.PARAMETER and variable.variability is Variability.TUNABLE:
            bits |= SET_EVENT
    if variable.variability in _PARAMETERS:
        bits |= IS_PARAMETER
    elif variable.variability is Variability.DISCRETE:
        bits |= IS_DISCRETE
    return bits


def c_string(text: str) -> str:
    """A C string literal of a text, in ASCII with octal escapes of its UTF-8 bytes."""
    characters = []
    for byte in text.encode("utf-8"):
        character = chr(byte)
        plain = 32 <= byte < 127 and character not in '"\\?'
        characters.append(character if plain else f"\\{byte:03o}")
    return '"' + "".join(characters) + '"'


def _lines(items: Iterable[str], separator: str = ", ", width: int = 110) -> str:
    lines = [" "]
    for item in items:
        if len(lines[-1]) + len(item) + len(separator) > width:
            lines.append(" ")
        lines[-1] += f" {item},"
    return "\n".join(lines)


def _table(name: str, variables: list[Variable], internal_parameters: Sequence[int]) -> tuple[str, str]:
    """Definitions and initializer of one slot table."""
    variables = [variable for variable in variables if variable.value_reference < FIRST_REFERENCE]
    if not variables and not internal_parameters:
        return "", f".{name} = {{0, NULL, NULL, 0, NULL}}"
    count = 1 + max((*(variable.value_reference for variable in variables), *internal_parameters))
    bits = [0] * count
    for slot in internal_parameters:
        bits[slot] = IS_PARAMETER
    names: list[str | None] = [None] * count
    for variable in variables:
        slot = variable.value_reference
        bits[slot] |= access(variable)
        if names[slot] is None:
            names[slot] = variable.name
    definitions = (
        f"static const unsigned char {name}_access[{count}] = {{\n{_lines(str(bit) for bit in bits)}\n}};\n"
        f"static const char *const {name}_name[{count}] = {{\n"
        f"{_lines('NULL' if text is None else c_string(text) for text in names)}\n}};\n\n"
    )
    bounds = _bounds(variables)
    if bounds:
        definitions += f"static const fmurt_bounds {name}_bounds[{len(bounds)}] = {{\n{_lines(bounds)}\n}};\n\n"
    return definitions, (
        f".{name} = {{{count}, {name}_access, {name}_name, {len(bounds)}, {f'{name}_bounds' if bounds else 'NULL'}}}"
    )


def _bounds(variables: Iterable[Variable]) -> list[str]:
    """Initializers of the bounds of parameters, by slot."""
    bounded = {
        variable.value_reference: (variable.minimum, variable.maximum)
        for variable in variables
        if variable.causality is Causality.PARAMETER
        and variable.type is not DataType.ENUMERATION
        and (variable.minimum is not None or variable.maximum is not None)
    }
    return [
        f"{{{slot}, {c_double(least, '-HUGE_VAL')}, {c_double(largest, 'HUGE_VAL')}}}"
        for slot, (least, largest) in sorted(bounded.items())
    ]


def c_double(value: float | None, default: str) -> str:
    """A C double literal that reads back exactly."""
    if value is None:
        return default
    if math.isinf(value):
        return "HUGE_VAL" if value > 0 else "-HUGE_VAL"
    return repr(float(value))


def interface_source(description: ModelDescription, options: SolverOptions) -> str:
    """Text of ``fmurt_interface.c`` for a description."""
    groups: tuple[tuple[str, Callable[[Variable], bool]], ...] = (
        ("real", lambda variable: variable.type is DataType.REAL),
        ("integer", lambda variable: variable.type in (DataType.INTEGER, DataType.ENUMERATION)),
        ("boolean", lambda variable: variable.type is DataType.BOOLEAN),
        ("string", lambda variable: variable.type is DataType.STRING),
    )
    tables = [
        _table(
            name,
            [variable for variable in description.variables if belongs(variable)],
            description.internal_parameters if name == "real" else (),
        )
        for name, belongs in groups
    ]
    experiment = description.experiment
    members = [initializer for _, initializer in tables]
    members += [
        f".start_time = {c_double(experiment.start, '0.0')}",
        f".stop_time = {c_double(experiment.stop, 'HUGE_VAL')}",
        f".relative_tolerance = {effective_tolerance(description, options)!r}",
        f".absolute_tolerance = {options.absolute_tolerance!r}",
        f".maximum_step = {options.maximum_step!r}",
        f".maximum_steps = {options.maximum_steps}",
    ]
    return (
        "/* Generated: the interface of the model's variables, as in modelDescription.xml. */\n"
        '#include <math.h>\n\n#include "fmurt_interface.h"\n\n'
        + "".join(definitions for definitions, _ in tables)
        + "const fmurt_interface fmurt_interface_tables = {\n"
        + "".join(f"  {member},\n" for member in members)
        + "};\n"
    )
