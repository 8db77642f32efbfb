"""Generates the C of a model: the functions of ``runtime/cmb_model.h`` from the blocks of both systems."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Final

from modelica2fmu import expression as ex
from modelica2fmu import ir
from modelica2fmu.alias import ReducedModel
from modelica2fmu.arrays import Text
from modelica2fmu.blocks import (
    Assignment,
    Block,
    LinearBlock,
    NonlinearBlock,
    block_roots,
    block_targets,
    needed_blocks,
    solve_order,
)
from modelica2fmu.c_expressions import Function, Statement, WorkSpace, Write, bare, c_text, functions_of, number
from modelica2fmu.call_code import call_statement
from modelica2fmu.expression import Node
from modelica2fmu.jacobian_code import Factors, JacobianCode, JacobianPlaces, jacobian_code
from modelica2fmu.packaging import GeneratedSource
from modelica2fmu.scalar_model import (
    INITIAL,
    TERMINAL,
    TIME,
    ExternalCall,
    Kind,
    ScalarAssert,
    derivative_name,
    start_name,
    unwrapped,
)
from modelica2fmu.slots import Slot, Slots, Store, assign_slots
from modelica2fmu.systems import PlaceOf, Systems
from modelica2fmu.tangents import tangents

_SIGNATURE: Final = "cmb_values *v"
_PROLOGUE: Final = (
    "  double *const restrict r = v->real;",
    "  double *const restrict w = v->work;",
    "  int *const restrict i = v->integer;",
    "  int *const restrict b = v->boolean;",
    "  (void)r; (void)w; (void)i; (void)b;",
)
_LINES_PER_FILE: Final = 5000
_NEWTON_TOLERANCE: Final = 1e-12
_STATES_WITHOUT_JACOBIAN: Final = 500  # KRYLOV_STATES of runtime/cmb_solver.c: the integrator needs none from there on
_INDICATOR_TEXT: Final = 200
_GUID_PLACE: Final = "@guid@"
_ARRAYS: Final = {Store.REAL: "r", Store.INTEGER: "i", Store.BOOLEAN: "b"}
_PREVIOUS: Final = {Store.REAL: "v->pre_real", Store.INTEGER: "v->pre_integer", Store.BOOLEAN: "v->pre_boolean"}


@dataclass(frozen=True)
class GeneratedModel:
    """The generated C and what the description of the FMU needs of it.

    Attributes:
        sources: C files and their common header.
        guid: hash of the code, in the form of a GUID.
        slots: where variables live.
        states: names of the states, in order.
        operations: number of lines of C that one evaluation of the derivatives executes.
    """

    sources: tuple[GeneratedSource, ...]
    guid: str
    slots: Slots
    states: tuple[str, ...]
    operations: int


def generate(reduced: ReducedModel, systems: Systems, includes: Sequence[str], place: PlaceOf) -> GeneratedModel:
    """Generates the C of a model.

    Args:
        reduced: variables and what was removed.
        systems: blocks and states.
        includes: texts of Include annotations, in order.
        place: place of a span.
    """
    return _Generator(reduced, systems, includes, place).run()


class _Generator:
    def __init__(self, reduced: ReducedModel, systems: Systems, includes: Sequence[str], place: PlaceOf) -> None:
        self._reduced = reduced
        self._systems = systems
        self._model = systems.model
        self._includes = includes
        self._place = place
        self._work = WorkSpace()
        self._functions: list[Function] = []
        self._starts: dict[str, int] = {}
        self._residuals = 0
        self._slots = Slots()
        self._factors: dict[tuple[str, ...], Factors] = {}  # of linear systems while simulating, by their unknowns
        self._jacobian: JacobianCode | None = None

    def run(self) -> GeneratedModel:
        systems, model = self._systems, self._model
        rates = [derivative_name(name) for name in systems.reduction.states]
        wanted = [name for name, variable in model.variables.items() if variable.declaration is not None]
        wanted += [name for name in model.variables if name.startswith("$")]
        wanted += rates
        wanted += ex.symbols(*(item.indicator for item in model.relations))
        wanted += ex.symbols(*(root for item in model.reinitializations for root in (item.trigger, item.value)))
        wanted += ex.symbols(*(root for item in model.asserts for root in (item.condition, item.trigger or 0)))
        wanted += ex.symbols(*(by for _, by in self._reduced.replacements.items()))
        simulation = needed_blocks(systems.simulation, wanted)
        initialization = needed_blocks(systems.initialization, [*wanted, *systems.reduction.states])
        used = [name for block in [*simulation, *initialization] for name in block_targets(block)]
        used += ex.symbols(*(root for block in [*simulation, *initialization] for root in block_roots(block)))
        derivatives = list(dict.fromkeys(name for name in used if unwrapped(name)[0] == "der"))
        derivatives += [name for name in systems.reduction.states if unwrapped(name)[0] == "der"]
        self._slots = assign_slots(self._reduced, [*dict.fromkeys([*rates, *derivatives])])

        self._add("cmb_part_parameters", self._parameters())
        self._add("cmb_part_initialize", self._initialize(initialization))
        simulation_statements = [statement for block in simulation for statement in self._block(block)]
        simulation_statements += self._negated_statements()
        self._add("cmb_part_simulate", simulation_statements)
        continuous_asserts = [item for item in self._lasting_asserts() if not self._is_invariant(item.condition)]
        self._add("cmb_part_assert", [self._assert(item, "CMB_RESULT_DISCARD") for item in continuous_asserts])
        self._add("cmb_part_event", self._event())
        self._add("cmb_part_indicators", [], self._indicators())
        self._add_jacobian(simulation)
        return self._assemble()

    # --- places of symbols ---

    def _location(self, name: str) -> str:
        """C lvalue of a symbol."""
        slot = self._slots.of.get(name)
        if slot is not None:
            return f"{_ARRAYS[slot.store]}[{slot.index}]"
        if name == TIME:
            return "v->time"
        if name == INITIAL:
            return "v->initial"
        if name == TERMINAL:
            return "v->terminal"
        if name.startswith("relation["):
            return f"v->relation[{int(name[9:-1]) - 1}]"
        if name.startswith("start("):
            inner = name[6:-1]
            if inner not in self._starts:
                self._starts[inner] = self._work.real(1)
            return f"w[{self._starts[inner]}]"
        wrapper, inner = unwrapped(name)
        slot = self._slots.of.get(inner)
        if wrapper == "pre" and slot is not None:
            return f"{_PREVIOUS[slot.store]}[{slot.index}]"
        raise AssertionError(f"no place for {name}")

    def _store(self, name: str, text: str) -> str:
        slot = self._slots.of.get(name) or self._slots.of.get(unwrapped(name)[1])
        target = self._location(name)
        if slot is None or slot.store is Store.REAL:
            return f"{target} = {bare(text)};"
        if slot.store is Store.BOOLEAN:
            return f"{target} = ({text} != 0);"
        return f"{target} = (int)lrint({bare(text)});"

    def _assign(self, name: str, value: float | Node, is_discrete: bool = False) -> Statement:
        return Statement((value,), lambda write: [self._store(name, write(value))], is_discrete)

    # --- blocks ---

    def _block(self, block: Block) -> list[Statement]:
        if isinstance(block, Assignment):
            return [self._assign(block.target, block.value, block.is_discrete)]
        if isinstance(block, ExternalCall):
            return [call_statement(block, self._store)]
        if isinstance(block, LinearBlock):
            return self._linear(block)
        return [self._nonlinear(block)]

    def _linear(self, block: LinearBlock) -> list[Statement]:
        n = len(block.torn)
        statements: list[Statement] = []
        if n == 1:
            statements.append(self._single(block))
        else:
            statements.extend(self._linear_system(block, n))
        statements.extend(self._assign(step.target, step.value) for step in block.inner)
        return statements

    def _single(self, block: LinearBlock) -> Statement:
        """A linear equation of one unknown whose factor may vanish."""
        name, factor, right = block.torn[0], block.matrix[0][0], block.right[0]
        if not isinstance(factor, Node):
            return self._assign(name, ex.divide(right, factor))
        value = ex.divide(right, factor)
        message = c_text(f"The equation for {name} is singular")

        def lines(write: Write) -> list[str]:
            return [
                f"if ({write(factor)} == 0.0) {{",
                f"  cmb_report_error(v, {message});",
                "  return CMB_RESULT_DISCARD;",
                "}",
                self._store(name, write(value)),
            ]

        return Statement((factor, value), lines)

    def _linear_system(self, block: LinearBlock, n: int) -> list[Statement]:
        matrix, scale, right = self._work.real(n * n), self._work.real(n), self._work.real(n)
        pivot = self._work.integer(n)
        self._factors[block.torn] = Factors(matrix, scale, pivot)
        statements = [
            Statement((), lambda _: [f"memset(w + {matrix}, 0, {n * n} * sizeof(double));"]),
        ]
        for row in range(n):
            for column in range(n):
                value = block.matrix[row][column]
                if isinstance(value, Node) or value != 0:
                    statements.append(self._work_statement(matrix + column * n + row, value))
            statements.append(self._work_statement(right + row, block.right[row]))
        names = ", ".join(block.torn[:3]) + (", ..." if n > 3 else "")
        message = c_text(f"A linear system of {n} equations is singular (unknowns {names})")

        def solve(_: Write) -> list[str]:
            lines = [
                f"if (cmb_factorize({n}, w + {matrix}, w + {scale}, v->integer_work + {pivot}) != 0) {{",
                f"  cmb_report_error(v, {message});",
                "  return CMB_RESULT_DISCARD;",
                "}",
                f"cmb_substitute({n}, w + {matrix}, w + {scale}, v->integer_work + {pivot}, w + {right});",
            ]
            return lines + [self._store(name, f"w[{right + k}]") for k, name in enumerate(block.torn)]

        statements.append(Statement((), solve))
        return statements

    @staticmethod
    def _work_statement(offset: int, value: float | Node) -> Statement:
        return Statement((value,), lambda write: [f"w[{offset}] = {bare(write(value))};"])

    def _nonlinear(self, block: NonlinearBlock) -> Statement:
        self._residuals += 1
        name = f"cmb_residual_{self._residuals}"
        n = len(block.torn)
        take = Statement((), lambda _: [self._store(torn, f"x[{k}]") for k, torn in enumerate(block.torn)])
        inner = [statement for step in block.inner for statement in self._block(step)]
        give = [Statement((value,), _lines(f"residual[{k}] = {{}};", value)) for k, value in enumerate(block.residuals)]
        signature = f"{_SIGNATURE}, const void *context, const double *x, double *residual"
        prologue = (*_PROLOGUE, "  (void)context;")
        self._functions.extend(
            functions_of(name, [take, *inner, *give], self._location, self._work, signature, prologue, split=False)
        )
        work = self._work.real(n * n + 7 * n)
        integers = self._work.integer(n)
        nominal = [
            (variable.nominal if (variable := self._model.variables.get(torn)) is not None else None) or 0.0
            for torn in block.torn
        ]
        nominals = ", ".join(number(value) for value in nominal)

        unknowns = ", ".join(c_text(torn) for torn in block.torn)
        equations = ", ".join(c_text(self._stated(span)) for span in block.spans)

        def solve(_: Write) -> list[str]:
            starts = ", ".join(self._location(torn) for torn in block.torn)
            return [
                "{",
                f"  double x[{n}] = {{{starts}}}, residual[{n}];",
                f"  static const double nominal[{n}] = {{{nominals}}};",
                f"  int result = cmb_solve_nonlinear(v, NULL, {name}, {n}, x, nominal, {number(_NEWTON_TOLERANCE)},",
                f"                                   w + {work}, v->integer_work + {integers});",
                "  if (result != CMB_RESULT_OK) {",
                f"    static const char *const unknown[{n}] = {{{unknowns}}}, *const equation[{n}] = {{{equations}}};",
                f"    return cmb_report_unsolved(v, {name}, {n}, x, residual, unknown, equation, result);",
                "  }",
                f"  result = {name}(v, NULL, x, residual);",
                "  if (result != CMB_RESULT_OK) return result;",
                "}",
            ]

        return Statement((), solve)

    def _stated(self, span: ir.Span | None) -> str:
        """Where an equation stands, without its folder, which would make the code depend on the machine."""
        place = self._place(span)
        if place.file is None:
            return "that the translation made"
        return f"in {place.file.name}" + (f", line {place.line}," if place.line is not None else "")

    # --- parameters ---

    def _parameters(self) -> list[Statement]:
        model = self._model
        entries: list[Assignment | ExternalCall] = []
        unknowns: list[str] = []
        for call in model.calls:
            if call.outputs and all(model.variables[name].kind is Kind.PARAMETER for name in call.outputs):
                entries.append(call)
                unknowns.extend(call.outputs)
        outputs = set(unknowns)
        for name, variable in model.variables.items():
            if variable.kind is Kind.PARAMETER and isinstance(variable.value, Node) and name not in outputs:
                entries.append(Assignment(name, variable.value))
                unknowns.append(name)
        statements = [
            statement for block in solve_order(entries, unknowns, [], self._place) for statement in self._block(block)
        ]
        removed = {*self._reduced.replacements, *(name for name, _ in self._reduced.invariants)}
        for name, variable in model.variables.items():
            if name in removed or variable.kind in (Kind.PARAMETER, Kind.CONSTANT):
                continue
            if isinstance(variable.start, Node):
                statements.append(self._assign(name, variable.start))
        statements.extend(self._negated_statements(of_parameters=True))
        return statements

    def _is_invariant(self, node: float | Node) -> bool:
        """True for what depends on parameters alone."""
        return all(
            (variable := self._model.variables.get(name)) is not None and variable.kind is Kind.PARAMETER
            for name in ex.symbols(node)
        )

    def _negated_statements(self, of_parameters: bool = False) -> list[Statement]:
        return [self._assign(name, by) for name, by in self._slots.negated if self._is_invariant(by) == of_parameters]

    # --- initialization ---

    def _initialize(self, blocks: Sequence[Block]) -> list[Statement]:
        names = ex.symbols(*(root for block in blocks for root in block_roots(block)))
        starts = [name[6:-1] for name in names if name.startswith("start(")]
        statements: list[Statement] = []
        for name in starts:
            place, value = self._location(start_name(name)), self._location(name)
            statements.append(Statement((), _fixed([f"{place} = {value};"])))
        for block in blocks:
            statements.extend(self._block(block))
        statements = [Statement(item.roots, item.lines) for item in statements]
        statements.extend(self._negated_statements())
        statements.extend(
            self._assert(item, "CMB_RESULT_ERROR")
            for item in self._lasting_asserts()
            if self._is_invariant(item.condition)
        )
        return statements

    # --- events ---

    def _event(self) -> list[Statement]:
        model = self._model
        running = ex.Substitution({INITIAL: 0})
        statements: list[Statement] = []
        for assertion in model.asserts:
            if assertion.trigger is not None or assertion.is_warning:
                statements.append(self._assert(assertion, "CMB_RESULT_ERROR"))
        for termination in model.terminations:
            trigger = running(termination.trigger)
            message = termination.message

            def terminate(write: Write, trigger: float | Node = trigger, message: Text = message) -> list[str]:
                return [
                    f"if ({write(trigger)}) {{", *_message(message, write, "cmb_report_warning"),
                    "  v->terminate = 1;", "}",
                ]  # fmt: skip

            statements.append(Statement((trigger, *_nodes(message)), terminate))
        offset = self._work.real(2 * len(model.reinitializations))
        for position, item in enumerate(model.reinitializations):
            trigger, value = running(item.trigger), running(item.value)
            statements.append(self._work_statement(offset + 2 * position, trigger))
            statements.append(self._work_statement(offset + 2 * position + 1, value))
        for position, item in enumerate(model.reinitializations):
            flag, value_place = f"w[{offset + 2 * position}]", f"w[{offset + 2 * position + 1}]"
            state = self._location(item.state)
            lines = [f"if ({flag} != 0.0) {{ {state} = {value_place}; *states_changed = 1; }}"]
            statements.append(Statement((), _fixed(lines)))
        statements.append(Statement((), lambda _: ["v->next_time_event = HUGE_VAL;"]))
        for threshold in model.time_thresholds:
            statements.append(self._next_time(threshold))
        for sample in model.samples:
            since = ex.divide(ex.subtract(ex.symbol(TIME), sample.start), sample.interval)
            count = ex.binary("max", ex.add(ex.unary("floor", ex.add(since, 5e-10)), 1), 0)
            statements.append(self._next_time(ex.add(sample.start, ex.multiply(count, sample.interval))))
        return [Statement(item.roots, item.lines, is_discrete=True) for item in statements]

    @staticmethod
    def _next_time(value: float | Node) -> Statement:
        return Statement((value,), lambda write: [f"cmb_next_time(v, {bare(write(value))});"])

    def _lasting_asserts(self) -> list[ScalarAssert]:
        """Assertions at level error that hold all the time."""
        return [item for item in self._model.asserts if item.trigger is None and not item.is_warning]

    def _assert(self, item: ScalarAssert, severity: str) -> Statement:
        running = ex.Substitution({INITIAL: 0})
        condition: float | Node = ex.logical_not(running(item.condition))
        if item.trigger is not None:
            condition = ex.logical_and(running(item.trigger), condition)

        def lines(write: Write) -> list[str]:
            report = "cmb_report_warning" if item.is_warning else "cmb_report_error"
            end = [] if item.is_warning else [f"  return {severity};"]
            return [f"if ({write(condition)}) {{", *_message(item.message, write, report), *end, "}"]

        return Statement((condition, *_nodes(item.message)), lines)

    def _indicators(self) -> list[Statement]:
        return [
            Statement((item.indicator,), _lines(f"indicator[{item.number - 1}] = {{}};", item.indicator))
            for item in self._model.relations
        ]

    # --- files ---

    def _add(self, prefix: str, statements: Sequence[Statement], indicators: Sequence[Statement] = ()) -> None:
        prologue: tuple[str, ...]
        if prefix == "cmb_part_indicators":
            signature = f"{_SIGNATURE}, double *indicator"
            prologue = (*_PROLOGUE, "  (void)indicator;")
            statements = indicators
        elif prefix == "cmb_part_event":
            signature = f"{_SIGNATURE}, int *states_changed"
            prologue = (*_PROLOGUE, "  (void)states_changed;")
        else:
            signature, prologue = _SIGNATURE, _PROLOGUE
        self._functions.extend(functions_of(prefix, statements, self._location, self._work, signature, prologue))

    def _add_jacobian(self, simulation: Sequence[Block]) -> None:
        """Code of the Jacobian, where it pays."""
        states = self._systems.reduction.states
        rates = [derivative_name(name) for name in states]
        if not states or len(states) >= _STATES_WITHOUT_JACOBIAN:
            return
        steps = tangents(needed_blocks(simulation, rates), states, rates)
        places = JacobianPlaces(
            self._location, self._work, self._factors, [self._nominal(name) for name in states], _SIGNATURE, _PROLOGUE
        )
        self._jacobian = jacobian_code(steps, states, rates, places)
        self._functions.extend(self._jacobian.functions)

    def _nominal(self, name: str) -> float:
        variable = self._model.variables.get(name)
        return abs(variable.nominal) if variable is not None and variable.nominal else 1.0

    def _assemble(self) -> GeneratedModel:
        header = _HEADER + "".join(f"{function.text.splitlines()[0]};\n" for function in self._functions) + "#endif\n"
        includes = '#include "model_parts.h"\n' + "".join(f"{text}\n" for text in self._includes)
        files: list[tuple[str, list[str], int]] = []
        for function in self._functions:
            if not files or files[-1][2] + function.size > _LINES_PER_FILE:
                files.append((f"model_part{len(files) + 1}.c", [], 0))
            name, texts, size = files[-1]
            texts.append(function.text)
            files[-1] = (name, texts, size + function.size)
        sources = [GeneratedSource("model_parts.h", header)]
        sources += [GeneratedSource(name, includes + "\n" + "\n".join(texts)) for name, texts, _ in files]
        main = self._main()
        digest = hashlib.blake2b(digest_size=16)
        for source in [*sources, GeneratedSource("model.c", main)]:
            digest.update(source.name.encode() + b"\0" + source.text.encode() + b"\0")
        text = digest.hexdigest()
        guid = f"{{{text[:8]}-{text[8:12]}-{text[12:16]}-{text[16:20]}-{text[20:]}}}"
        sources.append(GeneratedSource("model.c", main.replace(_GUID_PLACE, guid)))
        operations = sum(
            function.size
            for function in self._functions
            if function.name.startswith("cmb_part_simulate") and not function.is_discrete
        )
        return GeneratedModel(tuple(sources), guid, self._slots, tuple(self._systems.reduction.states), operations)

    def _names(self, prefix: str, with_discrete: bool = True) -> list[str]:
        return [
            function.name
            for function in self._functions
            if function.name.startswith(prefix + "_") and (with_discrete or not function.is_discrete)
        ]

    def _main(self) -> str:
        slots, states = self._slots, self._systems.reduction.states
        counts = slots.counts
        real, integer, boolean, string = self._start_tables()
        texts = [c_text(f"{item.indicator} > 0"[:_INDICATOR_TEXT]) for item in self._model.relations] or ["NULL"]
        nominal = [number(self._nominal(name)) for name in states]
        state = [str(slots.of[name].index) for name in states]
        rates = [str(slots.of[derivative_name(name)].index) for name in states]
        parameters = _calls(self._names("cmb_part_parameters"))
        initialize = _calls([*self._names("cmb_part_initialize"), *self._names("cmb_part_assert")])
        continuous = _calls([*self._names("cmb_part_simulate", with_discrete=False), *self._names("cmb_part_assert")])
        discrete = _calls(self._names("cmb_part_simulate")) + _calls(self._names("cmb_part_event"), "v, states_changed")
        indicators = _calls(self._names("cmb_part_indicators"), "v, indicator")
        return f"""#include "model_parts.h"

static const unsigned state[] = {{{_wrapped(state)}}};
static const unsigned derivative[] = {{{_wrapped(rates)}}};
static const double state_nominal[] = {{{_wrapped(nominal)}}};
static const double real_start[] = {{{_wrapped(real)}}};
static const int integer_start[] = {{{_wrapped(integer)}}};
static const int boolean_start[] = {{{_wrapped(boolean)}}};
static const char *const string_start[] = {{{_wrapped(string)}}};
static const char *const indicator_text[] = {{{_wrapped(texts)}}};

static cmb_result parameters(cmb_values *v)
{{
  int result = CMB_RESULT_OK;
{parameters}  return (cmb_result)result;
}}

static cmb_result initialize(cmb_values *v)
{{
  int result = CMB_RESULT_OK;
{initialize}  return (cmb_result)result;
}}

static cmb_result continuous(cmb_values *v)
{{
  int result = CMB_RESULT_OK;
{continuous}  return (cmb_result)result;
}}

static cmb_result indicators(cmb_values *v, double *indicator)
{{
  int result = CMB_RESULT_OK;
{indicators}  return (cmb_result)result;
}}

static cmb_result discrete(cmb_values *v, int *states_changed)
{{
  int result = CMB_RESULT_OK;
{discrete}  return (cmb_result)result;
}}

{"" if self._jacobian is None else self._jacobian.text}const cmb_model_description cmb_model = {{
  .name = {c_text(self._model.name)},
  .guid = "{_GUID_PLACE}",
  .real_count = {counts[Store.REAL]},
  .integer_count = {counts[Store.INTEGER]},
  .boolean_count = {counts[Store.BOOLEAN]},
  .string_count = {counts[Store.STRING]},
  .state_count = {len(states)},
  .indicator_count = {len(self._model.relations)},
  .work_count = {self._work.reals},
  .integer_work_count = {self._work.integers},
  .state = state,
  .derivative = derivative,
  .state_nominal = state_nominal,
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
  .jacobian = {"NULL" if self._jacobian is None else "jacobian"},
}};
"""

    def _start_tables(self) -> tuple[list[str], list[str], list[str], list[str]]:
        counts = self._slots.counts
        real = ["0.0"] * counts[Store.REAL]
        integer = ["0"] * counts[Store.INTEGER]
        boolean = ["0"] * counts[Store.BOOLEAN]
        string = ['""'] * counts[Store.STRING]
        for name, variable in self._model.variables.items():
            slot = self._slots.of.get(name)
            if slot is None or self._is_alias(name, slot):
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

    def _is_alias(self, name: str, slot: Slot) -> bool:
        by = self._reduced.replacements.get(name)
        return isinstance(by, Node) and by.op == "symbol" and self._slots.of.get(by.name) == slot


def _lines(template: str, value: float | Node) -> Callable[[Write], Sequence[str]]:
    """One line with an expression in it."""
    return lambda write: [template.format(bare(write(value)))]


def _fixed(lines: Sequence[str]) -> Callable[[Write], Sequence[str]]:
    """Lines without expressions."""
    return lambda _: lines


def _calls(names: Iterable[str], args: str = "v") -> str:
    return "".join(f"  if ((result = {name}({args})) != CMB_RESULT_OK) return (cmb_result)result;\n" for name in names)


def _nodes(message: Text) -> tuple[Node, ...]:
    return tuple(part for part in message.parts if isinstance(part, Node))


def _message(message: Text, write: Write, report: str) -> list[str]:
    parts = "".join("%.6g" if isinstance(part, Node) else part.replace("%", "%%") for part in message.parts)
    values = "".join(f", (double)({write(part)})" for part in message.parts if isinstance(part, Node))
    return [
        "  char message[512];",
        f"  snprintf(message, sizeof message, {c_text(parts)}{values});",
        f"  {report}(v, message);",
    ]


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
#include "cmb_model.h"

/* Derivatives along CMB_LANES directions, and where they are in the work array. */
typedef double cmb_lanes __attribute__((vector_size(CMB_LANES * sizeof(double)), aligned(sizeof(double)), may_alias));
#define LANES(w, offset) (*(cmb_lanes *)((w) + (offset)))

static inline double cmb_min(double x, double y) { return x < y ? x : y; }
static inline double cmb_max(double x, double y) { return x > y ? x : y; }
static inline double cmb_sign(double x) { return (double)((x > 0.0) - (x < 0.0)); }
static inline double cmb_mod(double x, double y) { return x - floor(x / y) * y; }
static inline double cmb_rem(double x, double y) { return x - trunc(x / y) * y; }
static inline double cmb_quotient(double x, double y) { return trunc(x / y); }
static inline void cmb_next_time(cmb_values *v, double time)
{
  if (time > v->time && time < v->next_time_event) v->next_time_event = time;
}

"""
