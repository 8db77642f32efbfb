"""C of the Jacobian of the states' derivatives, from the tangents of all blocks.

Tangents are vectors of ``LANES`` directions, so that what does not depend on the direction is computed once for
several columns; there are as many passes as it takes to give each state a direction. A pass executes the clusters that
its directions move; what the others left from the pass before is set to zero.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Final

from modelica2fmu.codegen.block_code import Factors
from modelica2fmu.codegen.c_expressions import bare, number
from modelica2fmu.codegen.c_functions import Function, functions_of, numbers_of_lanes, single_function
from modelica2fmu.codegen.call_code import call_statement
from modelica2fmu.codegen.model_file import function_calls
from modelica2fmu.codegen.rolled_code import rolled
from modelica2fmu.codegen.statements import Group, Statement, Write
from modelica2fmu.codegen.symbol_places import PROLOGUE, SIGNATURE, SymbolPlaces, set_lanes
from modelica2fmu.equations.blocks import NonlinearBlock
from modelica2fmu.equations.direction_passes import Cluster, direction_passes
from modelica2fmu.equations.lanes import LANES
from modelica2fmu.equations.tangents import (
    CallTangent,
    SolvedTangent,
    Tangent,
    TangentAssignment,
    is_tangent,
    probe_name,
    tangent_name,
    tangent_targets,
)
from modelica2fmu.expand.scalar_model import ExternalCall
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node

_INPUT: Final = "$input["
_NUMBERS: Final = "fmurt_tangent_numbers"
_CLUSTER: Final = "fmurt_tangent_cluster"
_RELATIVE_STEP: Final = 1.5e-8  # of difference quotients of external functions: the root of the rounding error


@dataclass(frozen=True)
class JacobianCode:
    """Functions, and the text of ``jacobian`` of fmurt_model.h that calls them."""

    functions: tuple[Function, ...]
    text: str


def jacobian_code(
    steps: Sequence[Tangent],
    states: Sequence[str],
    rates: Sequence[str],
    places: SymbolPlaces,
    factors: Mapping[tuple[str, ...], Factors],
) -> JacobianCode:
    """The C that fills ``jacobian[i + j * states]`` after ``continuous`` was called.

    Args:
        steps: see :func:`modelica2fmu.equations.tangents.tangents`.
        states: the columns.
        rates: the rows.
        places: where symbols live.
        factors: what the solution of linear systems left, by their unknowns.
    """
    return _Writer(steps, states, rates, places, factors).run()


class _Writer:
    def __init__(
        self,
        steps: Sequence[Tangent],
        states: Sequence[str],
        rates: Sequence[str],
        places: SymbolPlaces,
        factors: Mapping[tuple[str, ...], Factors],
    ) -> None:
        self._steps = steps
        self._states = states
        self._rates = rates
        self._places = places
        self._factors = factors
        self._step = places.work.real(LANES)
        self._functions: list[Function] = []
        self._probes: list[str] = []
        self._shifted: dict[int, str] = {}

    def run(self) -> JacobianCode:
        wanted = [tangent_name(rate) for rate in self._rates]
        schedule = direction_passes(self._steps, self._states, wanted)
        clusters = [
            [
                replace(statement, group=Group(f"{_CLUSTER}_{number}", cluster.passes.bit_count()))
                for step in cluster.steps
                for statement in self._statements(step)
            ]
            for number, cluster in enumerate(schedule.clusters, 1)
        ]
        statements = [statement for cluster in clusters for statement in cluster]
        # What does not depend on the direction is computed once for all passes.
        numbers = numbers_of_lanes(statements, is_tangent, Group(_NUMBERS, 1))
        functions = functions_of("fmurt_part_tangent", [*numbers, *statements], self._places.frame())
        self._functions.extend(functions)
        kept = {function.name: function.kept for function in functions}
        return JacobianCode(tuple(self._functions), self._driver(schedule.columns, schedule.clusters, kept))

    # --- steps ---

    def _statements(self, step: Tangent) -> list[Statement]:
        if isinstance(step, TangentAssignment):
            return [set_lanes(self._places.tangent(step.target), step.value, step.target)]
        if isinstance(step, CallTangent):
            return [self._call(step)]
        return self._solved(step)

    def _solved(self, step: SolvedTangent) -> list[Statement]:
        n = len(step.targets)
        factors = self._factors.get(step.block.torn)
        if isinstance(step.block, NonlinearBlock) or factors is None:
            factors = self._probe(step, n)
        offset = self._places.put_tangents(step.targets)
        statements = [set_lanes(offset + k * LANES, ex.negate(item)) for k, item in enumerate(step.residuals)]
        text = (
            f"fmurt_substitute_lanes({n}, w + {factors.matrix}, w + {factors.scale}, "
            f"v->integer_work + {factors.pivot}, w + {offset});"
        )
        return [*statements, Statement((), lambda _: [text])]

    def _probe(self, step: SolvedTangent, n: int) -> Factors:
        """A function that computes and factorizes the Jacobian of a nonlinear block."""
        work = self._places.work
        factors = Factors(work.real(n * n), work.real(n), work.integer(n))
        inner = [statement for item in step.probe for statement in self._statements(item)]
        columns = [work.real(LANES) for _ in step.columns]
        inner += [set_lanes(offset, value) for offset, value in zip(columns, step.columns, strict=True)]
        name = f"fmurt_probe_{len(self._probes) + 1}"
        parts = functions_of(f"{name}_part", inner, self._places.frame())
        seeds = [self._places.tangent(probe_name(torn)) for torn in step.block.torn]
        sizes = [f"fmax(fabs({self._places.location(torn)}), 1.0)" for torn in step.block.torn]
        text = _PROBE.format(
            name=name, signature=SIGNATURE, prologue="\n".join(PROLOGUE), n=n,
            step=self._step, relative=number(_RELATIVE_STEP), seeds=_joined(seeds), sizes=", ".join(sizes),
            columns=_joined(columns), matrix=factors.matrix, scale=factors.scale, pivot=factors.pivot,
            calls=_indented(function_calls(parts, f"{name}_part")),
        )  # fmt: skip
        self._functions.extend([*parts, Function(name, text, False, text.count("\n"))])
        self._probes.append(name)
        return factors

    # --- external calls ---

    def _call(self, step: CallTangent) -> Statement:
        function = self._shifted_call(step)
        inputs = step.inputs
        outputs = [(f"(w + lane)[{self._places.tangent(target)}]", name) for name, target in step.outputs]
        zeros = rolled([f"{place} = 0.0;" for place, _ in outputs])
        quotients = rolled(
            [
                f"{place} = (output[{k}] - {self._places.location(name)}) / step;"
                for k, (place, name) in enumerate(outputs)
            ]
        )

        def lines(write: Write) -> list[str]:
            result = ["{"]
            result += [f"  const fmurt_lanes d{k} = {bare(write(rate))};" for k, (_, rate) in enumerate(inputs)]
            moves = " || ".join(f"d{k}[lane] != 0.0" for k in range(len(inputs)))
            result += [
                "  for (int lane = 0; lane < FMURT_LANES; ++lane) {",
                f"    const double step = w[{self._step} + lane];",
                *(f"    {line}" for line in zeros),
                f"    if (!({moves})) continue;",
                f"    double output[{len(outputs)}];",
                f"    const double input[{len(inputs)}] = {{",
                *(f"      {write(value)} + step * d{k}[lane]," for k, (value, _) in enumerate(inputs)),
                "    };",
                f"    const int result = {function}(v, input, output);",
                "    if (result != FMURT_RESULT_OK) return result;",
                *(f"    {line}" for line in quotients),
                "  }",
                "}",
            ]
            return result

        return Statement(tuple(item for pair in inputs for item in pair), lines)

    def _shifted_call(self, step: CallTangent) -> str:
        """A function that makes a call with other Real inputs."""
        key = len(self._shifted) + 1
        name = f"fmurt_shifted_call_{key}"
        shifted = {value: ex.symbol(f"{_INPUT}{k}]") for k, (value, _) in enumerate(step.inputs)}
        places = {name: k for k, (name, _) in enumerate(step.outputs)}

        def store(target: str, text: str) -> str:
            return f"output[{places[target]}] = {text};" if target in places else f"(void)({text});"

        def location(symbol: str) -> str:
            return f"input[{symbol[len(_INPUT) : -1]}]" if symbol.startswith(_INPUT) else self._places.location(symbol)

        frame = self._places.frame(", const double *input, double *output", ("  (void)input; (void)output;",))
        call = call_statement(_with_inputs(step.call, shifted), store)
        self._functions.append(single_function(name, [call], replace(frame, location=location)))
        self._shifted[key] = name
        return name

    # --- the whole ---

    def _driver(
        self, passes: Sequence[Sequence[int]], clusters: Sequence[Cluster], kept: Mapping[str, tuple[int, ...]]
    ) -> str:
        computed = {name for step in self._steps for name in tangent_targets(step)}
        seeds = [self._places.tangent(tangent_name(name)) for name in self._states]
        computed |= {tangent_name(name) for name in self._states}
        rates = [self._places.tangent(name) if (name := tangent_name(rate)) in computed else -1 for rate in self._rates]
        names = [f"{_CLUSTER}_{number}" for number in range(1, len(clusters) + 1)]
        left = [
            [*map(self._places.tangent, cluster.handed_on), *kept[name]]
            for name, cluster in zip(names, clusters, strict=True)
        ]
        ends = [sum(map(len, left[: number + 1])) for number in range(len(left))]
        return _DRIVER.format(
            n=len(self._states), seeds=_joined(seeds), rates=_joined(rates), step=self._step,
            relative=number(_RELATIVE_STEP), probes="".join(_call(name) for name in self._probes),
            numbers=_call(_NUMBERS), passes=len(passes), clusters=len(clusters), names=",\n    ".join(names),
            columns=_joined([column for group in passes for column in [*group, *[-1] * (LANES - len(group))]]),
            active=_joined([cluster.passes >> turn & 1 for turn in range(len(passes)) for cluster in clusters]),
            left=_joined([offset for offsets in left for offset in offsets] or [0]), ends=_joined(ends),
        )  # fmt: skip


def _with_inputs(call: ExternalCall, inputs: Mapping[Node, Node]) -> ExternalCall:
    """The call with some inputs replaced."""
    args = tuple(
        replace(
            argument,
            values=tuple(inputs.get(value, value) if isinstance(value, Node) else value for value in argument.values),
        )
        if argument.type == "Real" and not argument.is_output
        else argument
        for argument in call.args
    )
    return replace(call, args=args)


def _joined(items: Sequence[int]) -> str:
    rows = [", ".join(str(item) for item in items[start : start + 12]) for start in range(0, len(items), 12)]
    return ",\n    ".join(rows)


def _call(name: str) -> str:
    return f"  if ((result = {name}(v)) != FMURT_RESULT_OK) return (fmurt_result)result;\n"


def _indented(text: str) -> str:
    return "".join(f"  {line}\n" for line in text.splitlines())


_PROBE: Final = """int {name}({signature})
{{
{prologue}
  static const int seed[{n}] = {{{seeds}}}, column[{n}] = {{{columns}}};
  const double size[{n}] = {{{sizes}}};
  int result = FMURT_RESULT_OK;
  for (int first = 0; first < {n}; first += FMURT_LANES) {{
    for (int j = 0; j < {n}; ++j) {{
      for (int lane = 0; lane < FMURT_LANES; ++lane) {{
        LANES(w, seed[j])[lane] = first + lane == j;
        if (first + lane == j) w[{step} + lane] = {relative} * size[j];
      }}
    }}
{calls}    for (int lane = 0; lane < FMURT_LANES && first + lane < {n}; ++lane) {{
      for (int i = 0; i < {n}; ++i) w[{matrix} + (first + lane) * {n} + i] = LANES(w, column[i])[lane];
    }}
  }}
  if (fmurt_factorize({n}, w + {matrix}, w + {scale}, v->integer_work + {pivot}) != 0) return FMURT_RESULT_DISCARD;
  return result;
}}
"""

_DRIVER: Final = """static fmurt_result jacobian(fmurt_values *v, double *jacobian)
{{
  static const int seed[{n}] = {{
    {seeds}}};
  static const int rate[{n}] = {{
    {rates}}};
  static const int column[{passes} * FMURT_LANES] = {{
    {columns}}};
  static int (*const cluster[{clusters}])(fmurt_values *) = {{
    {names}}};
  static const unsigned char is_active[{passes} * {clusters}] = {{
    {active}}};
  static const int left[] = {{
    {left}}};
  static const int left_end[{clusters}] = {{
    {ends}}};
  double *const w = v->work;
  int result = FMURT_RESULT_OK;
{numbers}{probes}  for (int j = 0; j < {n}; ++j) LANES(w, seed[j]) = (fmurt_lanes){{0}};
  for (int pass = 0; pass < {passes}; ++pass) {{
    const int *const columns = column + pass * FMURT_LANES;
    const unsigned char *const active = is_active + pass * {clusters};
    for (int lane = 0; lane < FMURT_LANES; ++lane) {{
      const int j = columns[lane];
      if (j < 0) continue;
      w[seed[j] + lane] = 1.0;
      w[{step} + lane] = {relative} * fmax(fabs(v->real[state[j]]), v->state_nominal[j]);
    }}
    for (int k = 0; k < {clusters}; ++k) {{
      if (active[k]) {{
        if ((result = cluster[k](v)) != FMURT_RESULT_OK) return (fmurt_result)result;
      }} else if (pass == 0 || active[k - {clusters}]) {{
        for (int e = k > 0 ? left_end[k - 1] : 0; e < left_end[k]; ++e) LANES(w, left[e]) = (fmurt_lanes){{0}};
      }}
    }}
    for (int lane = 0; lane < FMURT_LANES; ++lane) {{
      const int j = columns[lane];
      if (j < 0) continue;
      double *const to = jacobian + (size_t)j * {n};
      for (int i = 0; i < {n}; ++i) to[i] = rate[i] >= 0 ? w[rate[i] + lane] : 0.0;
      w[seed[j] + lane] = 0.0;
    }}
  }}
  return (fmurt_result)result;
}}

"""
