"""The generated files around the functions of a model: common header, tables and ``fmurt_model``."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Final

from modelica2fmu.codegen.c_expressions import c_text, number
from modelica2fmu.codegen.c_functions import Function
from modelica2fmu.codegen.slots import Slot, Slots, Store
from modelica2fmu.equations.alias import ReducedModel
from modelica2fmu.expand.scalar_model import Kind, ScalarModel, derivative_name
from modelica2fmu.symbolic.expression import Node

GUID_PLACE: Final = "@guid@"
_INDICATOR_TEXT: Final = 200


@dataclass(frozen=True)
class ModelParts:
    """What ``model.c`` tells the runtime.

    Attributes:
        reduced: variables and what was removed.
        slots: where variables live.
        states: names of the states, in order.
        functions: all of the model, of which ``model.c`` calls those with the prefixes of its tables.
        jacobian: text of the function ``jacobian``; empty if there is none.
        parts: text of the description ``parts``; empty if there is none.
        scenes: text of the array ``scene``; empty if there is none.
        scene_count: of its elements.
        reals: size of the work array.
        integers: size of that of integers.
        followed: slots of the unknowns of nonlinear systems.
        thicknesses: slots of the thicknesses of what may touch.
        is_simulated_at_start: whether initialization solves the blocks of the simulation between its own.
    """

    reduced: ReducedModel
    slots: Slots
    states: Sequence[str]
    functions: Sequence[Function]
    jacobian: str
    parts: str
    scenes: str
    scene_count: int
    reals: int
    integers: int
    followed: Sequence[int]
    thicknesses: Sequence[int]
    is_simulated_at_start: bool


def model_header(functions: Iterable[Function]) -> str:
    """Text of ``model_parts.h``."""
    return _HEADER + "".join(f"{function.text.splitlines()[0]};\n" for function in functions) + "#endif\n"


def state_nominal(model: ScalarModel, name: str) -> float:
    """Size of a state."""
    variable = model.variables.get(name)
    return abs(variable.nominal) if variable is not None and variable.nominal else 1.0


def _is_length(model: ScalarModel, name: str) -> bool:
    """Whether a state is in metres and nothing says what size it has."""
    variable = model.variables.get(name)
    declaration = None if variable is None else variable.declaration
    return variable is not None and not variable.nominal and declaration is not None and declaration.unit == "m"


def function_calls(functions: Iterable[Function], prefix: str, args: str = "v") -> str:
    """C that calls the functions ``prefix_1``, ``prefix_2``, ... one after the other."""
    names = [function.name for function in functions if function.name.startswith(prefix + "_")]
    return "".join(
        f"  if ((result = {name}({args})) != FMURT_RESULT_OK) return (fmurt_result)result;\n" for name in names
    )


def model_file(parts: ModelParts) -> str:
    """Text of ``model.c``, with ``GUID_PLACE`` where the GUID belongs."""
    model, slots, states, functions = parts.reduced.model, parts.slots, parts.states, parts.functions
    counts = slots.counts
    real, integer, boolean, string = _start_tables(parts)
    texts = [c_text(f"{item.indicator} > 0"[:_INDICATOR_TEXT]) for item in model.relations] or ["NULL"]
    nominal = [number(state_nominal(model, name)) for name in states]
    lengths = [str(int(_is_length(model, name))) for name in states]
    state = [str(slots.of[name].index) for name in states]
    rates = [str(slots.of[derivative_name(name)].index) for name in states]
    parameters = function_calls(functions, "fmurt_part_parameters")
    asserts = function_calls(functions, "fmurt_part_assert")
    integrated = [item for item in functions if not item.is_discrete and not item.on_request]
    continuous = function_calls(integrated, "fmurt_part_simulate") + asserts
    remaining = function_calls([item for item in functions if item.on_request], "fmurt_part_simulate")
    initialize = function_calls(functions, "fmurt_part_initialize")
    if parts.is_simulated_at_start:
        initialize += function_calls(integrated, "fmurt_part_simulate") + remaining
    initialize += function_calls(functions, "fmurt_part_initialized") + asserts
    discrete = function_calls(functions, "fmurt_part_simulate")
    discrete += function_calls(functions, "fmurt_part_event", "v, states_changed")
    indicators = function_calls(functions, "fmurt_part_indicators", "v, indicator")
    settle = function_calls(functions, "fmurt_part_simulate")
    warnings = function_calls(functions, "fmurt_part_warn")
    return f"""#include "model_parts.h"

static const unsigned state[] = {{{_wrapped(state)}}};
static const unsigned derivative[] = {{{_wrapped(rates)}}};
static const double state_nominal[] = {{{_wrapped(nominal)}}};
static const unsigned char is_length[] = {{{_wrapped(lengths)}}};
static const unsigned thickness[] = {{{_wrapped([str(slot) for slot in parts.thicknesses])}}};
static const double real_start[] = {{{_wrapped(real)}}};
static const int integer_start[] = {{{_wrapped(integer)}}};
static const int boolean_start[] = {{{_wrapped(boolean)}}};
static const char *const string_start[] = {{{_wrapped(string)}}};
static const unsigned followed[] = {{{_wrapped([str(slot) for slot in parts.followed])}}};
static const char *const indicator_text[] = {{{_wrapped(texts)}}};

static fmurt_result parameters(fmurt_values *v)
{{
  int result = FMURT_RESULT_OK;
{parameters}  return (fmurt_result)result;
}}

static fmurt_result initialize(fmurt_values *v)
{{
  int result = FMURT_RESULT_OK;
{initialize}  return (fmurt_result)result;
}}

static fmurt_result continuous(fmurt_values *v)
{{
  int result = FMURT_RESULT_OK;
{continuous}  return (fmurt_result)result;
}}

static inline fmurt_result remaining(fmurt_values *v)
{{
  int result = FMURT_RESULT_OK;
{remaining}  return (fmurt_result)result;
}}

static fmurt_result indicators(fmurt_values *v, double *indicator)
{{
  int result = FMURT_RESULT_OK;
{indicators}  return (fmurt_result)result;
}}

static fmurt_result discrete(fmurt_values *v, int *states_changed)
{{
  int result = FMURT_RESULT_OK;
{discrete}  return (fmurt_result)result;
}}

static inline fmurt_result settle(fmurt_values *v)
{{
  int result = FMURT_RESULT_OK;
{settle}  return (fmurt_result)result;
}}

static inline fmurt_result warnings(fmurt_values *v)
{{
  int result = FMURT_RESULT_OK;
{warnings}  return (fmurt_result)result;
}}

{parts.jacobian}{parts.parts}{parts.scenes}const fmurt_model_description fmurt_model = {{
  .name = {c_text(model.name)},
  .guid = "{GUID_PLACE}",
  .real_count = {counts[Store.REAL]},
  .integer_count = {counts[Store.INTEGER]},
  .boolean_count = {counts[Store.BOOLEAN]},
  .string_count = {counts[Store.STRING]},
  .state_count = {len(states)},
  .indicator_count = {len(model.relations)},
  .work_count = {parts.reals},
  .integer_work_count = {parts.integers},
  .delay_count = {sum(call.symbol == "fmurt_delay" for call in model.calls)},
  .state = state,
  .derivative = derivative,
  .state_nominal = state_nominal,
  .is_length = is_length,
  .thickness_count = {len(parts.thicknesses)},
  .thickness = thickness,
  .real_start = real_start,
  .integer_start = integer_start,
  .boolean_start = boolean_start,
  .string_start = string_start,
  .parameters = parameters,
  .initialize = initialize,
  .continuous = continuous,
  .indicators = indicators,
  .discrete = discrete,
  .indicator_text = indicator_text,
  .settle = {"settle" if model.relations else "NULL"},
  .followed_count = {len(parts.followed)},
  .followed = followed,
  .warnings = {"warnings" if warnings else "NULL"},
  .jacobian = {"jacobian" if parts.jacobian else "NULL"},
  .remaining = {"remaining" if remaining else "NULL"},
  .parts = {"&parts" if parts.parts else "NULL"},
  .scene_count = {parts.scene_count},
  .scene = {"scene" if parts.scenes else "NULL"},
}};
"""


def _start_tables(parts: ModelParts) -> tuple[list[str], list[str], list[str], list[str]]:
    counts = parts.slots.counts
    real = ["0.0"] * counts[Store.REAL]
    integer = ["0"] * counts[Store.INTEGER]
    boolean = ["0"] * counts[Store.BOOLEAN]
    string = ['""'] * counts[Store.STRING]
    for name, variable in parts.reduced.model.variables.items():
        slot = parts.slots.of.get(name)
        if slot is None or _is_alias(parts, name, slot):
            continue
        value = variable.value if variable.kind in (Kind.CONSTANT, Kind.PARAMETER) else variable.start
        if value is None or isinstance(value, Node):
            continue
        if slot.store is Store.STRING:
            string[slot.index] = c_text(str(value))
        elif isinstance(value, str):
            continue
        elif slot.store is Store.REAL:
            real[slot.index] = number(value).strip("()")
        elif slot.store is Store.INTEGER:
            integer[slot.index] = str(int(value))
        else:
            boolean[slot.index] = str(int(bool(value)))
    return real, integer, boolean, string


def _is_alias(parts: ModelParts, name: str, slot: Slot) -> bool:
    by = parts.reduced.replacements.get(name)
    return isinstance(by, Node) and by.op == "symbol" and parts.slots.of.get(by.name) == slot


def _wrapped(items: Sequence[str]) -> str:
    """Items of an initializer, eight a line; C wants at least one."""
    if not items:
        return "0"
    rows = [", ".join(items[start : start + 8]) for start in range(0, len(items), 8)]
    return ",\n  ".join(rows)


_HEADER: Final = """#ifndef MODEL_PARTS_H
#define MODEL_PARTS_H
#include <math.h>
#include <stdio.h>
#include <string.h>
#include "fmurt_model.h"

/* Derivatives along FMURT_LANES directions, and where they are in the work array. */
typedef double fmurt_lanes
  __attribute__((vector_size(FMURT_LANES * sizeof(double)), aligned(sizeof(double)), may_alias));
#define LANES(w, offset) (*(fmurt_lanes *)((w) + (offset)))

static inline double fmurt_min(double x, double y) { return x < y ? x : y; }
static inline double fmurt_max(double x, double y) { return x > y ? x : y; }
static inline double fmurt_sign(double x) { return (double)((x > 0.0) - (x < 0.0)); }
static inline double fmurt_mod(double x, double y) { return x - floor(x / y) * y; }
static inline double fmurt_rem(double x, double y) { return x - trunc(x / y) * y; }
static inline double fmurt_quotient(double x, double y) { return trunc(x / y); }
static inline void fmurt_next_time(fmurt_values *v, double time)
{
  if (time > v->time && time < v->next_time_event) v->next_time_event = time;
}

"""
