"""C statements of blocks: assignments, calls, linear systems and Newton iterations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Final

from modelica2fmu.codegen.c_expressions import bare, c_text, number
from modelica2fmu.codegen.c_functions import Function, numbers_of_lanes, single_function
from modelica2fmu.codegen.call_code import call_statement
from modelica2fmu.codegen.statements import Group, Lines, Statement, Write
from modelica2fmu.codegen.symbol_places import SymbolPlaces, set_lanes, set_work
from modelica2fmu.equations.blocks import Assignment, Block, LinearBlock, LinearSystem, NonlinearBlock
from modelica2fmu.equations.lanes import LANES, lane_passes
from modelica2fmu.equations.systems import PlaceOf
from modelica2fmu.equations.tangents import TangentAssignment, is_tangent, probe, probe_name
from modelica2fmu.expand.scalar_model import ExternalCall, ScalarVariable
from modelica2fmu.library.source_map import Span
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node

_NEWTON_TOLERANCE: Final = 1e-12


@dataclass(frozen=True)
class Factors:
    """Offsets in the work arrays of a factorized matrix, the scales of its rows, and its pivots."""

    matrix: int
    scale: int
    pivot: int


class BlockCode:
    """Writes blocks.

    Args:
        places: where symbols live.
        variables: of the model, for nominal values.
        followed: the blocks whose solutions are followed from step to step where they are nonlinear.
        place: place of a span.

    Attributes:
        functions: residuals of nonlinear blocks, which the statements call.
        factors: of the linear systems, by their unknowns; of the last block that has these.
        followed: slots of the unknowns of nonlinear blocks, which the runtime keeps of accepted steps.
    """

    def __init__(
        self,
        places: SymbolPlaces,
        variables: Mapping[str, ScalarVariable],
        followed: Sequence[Block],
        place: PlaceOf,
    ) -> None:
        self._places = places
        self._variables = variables
        self._place = place
        self._evaluated = 0
        self.functions: list[Function] = []
        self.factors: dict[tuple[str, ...], Factors] = {}
        self.followed: list[int] = []
        self._accepted: dict[tuple[str, ...], int] = {}
        for block in followed:
            if isinstance(block, NonlinearBlock):
                self._accepted[block.torn] = len(self.followed)
                self.followed.extend(places.slots.of[name].index for name in block.torn)

    def statements(self, block: Block) -> list[Statement]:
        """The statements that solve a block."""
        if isinstance(block, Assignment):
            return [self._places.assign(block.target, block.value, block.is_discrete)]
        if isinstance(block, ExternalCall):
            return [call_statement(block, self._places.store)]
        if isinstance(block, NonlinearBlock):
            return [self._nonlinear(block)]
        if block.system is None:
            return self._evaluated_system(block)
        inner = [self._places.assign(step.target, step.value) for step in block.inner]
        if len(block.torn) == 1:
            return [self._single(block.torn[0], block.system.matrix[0][0], block.system.right[0]), *inner]
        return [*self._symbolic_system(block, block.system), *inner]

    # --- linear ---

    def _single(self, name: str, factor: float | Node, right: float | Node) -> Statement:
        """A linear equation of one unknown whose factor may vanish."""
        if not isinstance(factor, Node):
            return self._places.assign(name, ex.divide(right, factor))
        value = ex.divide(right, factor)
        message = c_text(f"The equation for {name} is singular")

        def lines(write: Write) -> list[str]:
            return [
                f"if ({write(factor)} == 0.0) {{",
                f"  fmurt_report_error(v, {message});",
                "  return FMURT_RESULT_DISCARD;",
                "}",
                self._places.store(name, write(value)),
            ]

        return Statement((factor, value), lines)

    def _places_of_factors(self, torn: tuple[str, ...]) -> Factors:
        work, n = self._places.work, len(torn)
        factors = Factors(work.real(n * n), work.real(n), work.integer(n))
        self.factors[torn] = factors
        return factors

    @staticmethod
    def _singular(torn: Sequence[str]) -> str:
        """The message for a singular system, as a C literal."""
        n = len(torn)
        names = ", ".join(torn[:3]) + (", ..." if n > 3 else "")
        return c_text(f"A linear system of {n} equations is singular (unknowns {names})")

    def _symbolic_system(self, block: LinearBlock, system: LinearSystem) -> list[Statement]:
        n = len(block.torn)
        places = self._places_of_factors(block.torn)
        right = self._places.work.real(n)
        statements = [Statement((), lambda _: [f"memset(w + {places.matrix}, 0, {n * n} * sizeof(double));"])]
        for row in range(n):
            for column in range(n):
                value = system.matrix[row][column]
                if isinstance(value, Node) or value != 0:
                    statements.append(set_work(places.matrix + column * n + row, value))
            statements.append(set_work(right + row, system.right[row]))
        arguments = f"w + {places.matrix}, w + {places.scale}, v->integer_work + {places.pivot}"
        message = self._singular(block.torn)

        def solve(_: Write) -> list[str]:
            lines = [
                f"if (fmurt_factorize({n}, {arguments}) != 0) {{",
                f"  fmurt_report_error(v, {message});",
                "  return FMURT_RESULT_DISCARD;",
                "}",
                f"fmurt_substitute({n}, {arguments}, w + {right});",
            ]
            return lines + [self._places.store(name, f"w[{right + k}]") for k, name in enumerate(block.torn)]

        return [*statements, Statement((), solve)]

    def _evaluated_system(self, block: LinearBlock) -> list[Statement]:
        """A system whose matrix and right-hand side come from evaluating its equations; see fmurt_solve_linear."""
        self._evaluated += 1
        n, places, work = len(block.torn), self._places, self._places.work
        prefix = f"fmurt_linear_{self._evaluated}"
        factors = self._places_of_factors(block.torn)
        solution = work.real(n)
        inner, last = Group(f"{prefix}_inner", 2), Group(f"{prefix}_residuals", 1)
        columns, numbers = Group(f"{prefix}_columns", lane_passes(n)), Group(f"{prefix}_numbers", 1)

        statements = [Statement((), self._take(name, solution + k), group=inner) for k, name in enumerate(block.torn)]
        for step in block.inner:
            statements.append(replace(places.assign(step.target, step.value), group=inner))
        for k, residual in enumerate(block.residuals):
            statements.append(replace(set_work(solution + k, ex.negate(residual)), group=last))

        steps, derivatives = probe(block)
        seeds = places.put_tangents(tuple(probe_name(name) for name in block.torn))
        column = work.real(n * LANES)
        lanes = [
            set_lanes(places.tangent(step.target), step.value, step.target)
            for step in steps
            if isinstance(step, TangentAssignment)
        ]
        lanes += [set_lanes(column + k * LANES, value) for k, value in enumerate(derivatives)]
        statements += numbers_of_lanes(lanes, is_tangent, numbers)
        statements += [replace(item, group=columns) for item in lanes]

        message = self._singular(block.torn)
        solve = [
            "static const fmurt_linear_system system = {",
            f"  .size = {n}, .matrix = {factors.matrix}, .scale = {factors.scale}, .pivot = {factors.pivot},",
            f"  .solution = {solution}, .seeds = {seeds}, .columns = {column},",
            f"  .evaluate_inner = {inner.name}, .evaluate_residuals = {last.name},",
            f"  .evaluate_numbers = {numbers.name}, .evaluate_columns = {columns.name},",
            f"  .singular = {message},",
            "};",
            "const int result = fmurt_solve_linear(v, &system);",
            "if (result != FMURT_RESULT_OK) return result;",
        ]
        statements.append(Statement((), lambda _: solve, calls_model=True))
        return statements

    def _take(self, name: str, offset: int) -> Lines:
        return lambda _: [self._places.store(name, f"w[{offset}]")]

    # --- nonlinear ---

    def _nonlinear(self, block: NonlinearBlock) -> Statement:
        name = f"fmurt_residual_{len(self.functions) + 1}"
        n = len(block.torn)
        take = Statement((), lambda _: [self._places.store(torn, f"x[{k}]") for k, torn in enumerate(block.torn)])
        inner = [statement for step in block.inner for statement in self.statements(step)]
        give = [_give(k, value) for k, value in enumerate(block.residuals)]
        frame = self._places.frame(
            ", const void *context, const double *x, double *residual", ("  (void)context; (void)x; (void)residual;",)
        )
        self.functions.append(single_function(name, [take, *inner, *give], frame))
        work, integers = self._places.work.real(n * n + 7 * n), self._places.work.integer(n)
        nominal = [
            (variable.nominal if (variable := self._variables.get(torn)) is not None else None) or 0.0
            for torn in block.torn
        ]
        nominals = ", ".join(number(value) for value in nominal)
        unknowns = ", ".join(c_text(torn) for torn in block.torn)
        accepted = self._accepted.get(block.torn)
        function = (
            "fmurt_solve_nonlinear(v, NULL" if accepted is None else f"fmurt_follow_nonlinear(v, {accepted}, NULL"
        )
        equations = ", ".join(c_text(self._stated(span)) for span in block.spans)

        def solve(_: Write) -> list[str]:
            starts = ", ".join(self._places.location(torn) for torn in block.torn)
            return [
                "{",
                f"  double x[{n}] = {{{starts}}}, residual[{n}];",
                f"  static const double nominal[{n}] = {{{nominals}}};",
                f"  int result = {function}, {name}, {n}, x, nominal, {number(_NEWTON_TOLERANCE)},",
                f"                                   w + {work}, v->integer_work + {integers});",
                "  if (result != FMURT_RESULT_OK) {",
                f"    static const char *const unknown[{n}] = {{{unknowns}}}, *const equation[{n}] = {{{equations}}};",
                f"    return fmurt_report_unsolved(v, {name}, {n}, x, residual, unknown, equation, result);",
                "  }",
                f"  result = {name}(v, NULL, x, residual);",
                "  if (result != FMURT_RESULT_OK) return result;",
                "}",
            ]

        return Statement((), solve, calls_model=True)

    def _stated(self, span: Span | None) -> str:
        """Where an equation stands, without its folder, which would make the code depend on the machine."""
        place = self._place(span).without_folder()
        if place.file is None:
            return "that the translation made"
        return f"in {place.file}" + (f", line {place.line}," if place.line is not None else "")


def _give(position: int, value: float | Node) -> Statement:
    return Statement((value,), lambda write: [f"residual[{position}] = {bare(write(value))};"])
