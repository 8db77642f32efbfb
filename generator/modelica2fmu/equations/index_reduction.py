"""Index reduction: which equations must be differentiated, and their derivatives.

The algorithm is that of Pantelides 1988, "The consistent initialization of differential-algebraic systems".

The rotation matrix of an Orientation record has the known derivative ``der(T) = -skew(w) T``. Using it instead of
differentiating what defines ``T`` (as the derivative annotations of ``resolve1`` and ``resolve2`` in the Modelica
Standard Library do) keeps the differentiated system small.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Final

from contact_foundation.errors import InputError, Place, UnsupportedModelError

from modelica2fmu.equations.continuous_system import (
    ContinuousEquation,
    ReducedSystem,
    continuous_symbols,
    order_and_variable,
)
from modelica2fmu.equations.matching import Matching
from modelica2fmu.equations.state_selection import StateSelection
from modelica2fmu.equations.table_rates import NotDifferentiableError, TableRates
from modelica2fmu.expand.scalar_model import Kind, ScalarModel, derivative_name, is_call_output, unwrapped
from modelica2fmu.library.source_map import Span
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node

_ORDER_LIMIT: Final = 6


def reduce_index(
    model: ScalarModel,
    residuals: Sequence[tuple[float | Node, Span | None]],
    unknowns: Sequence[str],
    others: Sequence[float | Node],
    resolve: Callable[[str], float | Node],
    place: Callable[[Span | None], Place],
) -> ReducedSystem:
    """Reduces the index of ``residuals = 0`` and chooses states.

    Args:
        model: for the attributes of variables.
        residuals: continuous equations.
        unknowns: continuous variables, each of which some equation must determine.
        others: expressions outside of the equations that may contain derivatives.
        resolve: what a removed variable is (aliases, constants).
        place: place of a span.

    Raises:
        InputError: the equations are structurally singular.
        UnsupportedModelError: an equation that must be differentiated cannot be.
    """
    return _Reducer(model, residuals, unknowns, others, resolve, place).run()


class _Reducer:
    def __init__(
        self,
        model: ScalarModel,
        residuals: Sequence[tuple[float | Node, Span | None]],
        unknowns: Sequence[str],
        others: Sequence[float | Node],
        resolve: Callable[[str], float | Node],
        place: Callable[[Span | None], Place],
    ) -> None:
        self._model = model
        self._resolve = resolve
        self._place = place
        self._tables = TableRates(model)
        names: dict[str, None] = dict.fromkeys(unknowns)
        for name in continuous_symbols(model, [*(residual for residual, _ in residuals), *others]):
            order, inner = order_and_variable(name)
            current = inner
            names.setdefault(current)
            for _ in range(order):
                current = derivative_name(current)
                names.setdefault(current)
        self._names = names
        residuals = [(self._with_rates_of_tables(residual, span), span) for residual, span in residuals]
        self._equations = [
            ContinuousEquation(number, residual, span) for number, (residual, span) in enumerate(residuals)
        ]
        for root, span in (*residuals, *((other, None) for other in others)):
            self._require_derivatives(root, span)
        self._differentiate = ex.Differentiation(self._rate)
        self._incidence: dict[int, list[str]] = {}
        for equation in self._equations:
            self._incidence[equation.number] = self._symbols(equation.residual)
        # Elements of rotation matrices with the equations that define them: they take no part in the search for
        # equations to differentiate, since their derivative is known from the angular velocity.
        self._defined, self._definitions = self._matrix_definitions()
        self._incidence_is_stale = False
        self._angular_velocities = self._angular_velocity_names()

    def _symbols(self, residual: float | Node) -> list[str]:
        """Continuous unknowns of an equation, those that its tables are asked for among them."""
        return continuous_symbols(self._model, [residual, *self._tables.inputs(residual)])

    def _with_rates_of_tables(self, root: float | Node, span: Span | None) -> float | Node:
        """The same with what gives the derivatives of tables' values in their place."""
        rates: dict[str, float | Node] = {}
        for name in ex.symbols(root):
            order, inner = order_and_variable(name)
            if order == 0 or not is_call_output(inner) or unwrapped(name)[0] == "pre":
                continue
            rate: float | Node = ex.symbol(inner)
            try:
                for _ in range(order):
                    rate = ex.Differentiation(self._rate)(rate)
            except NotDifferentiableError as error:
                raise UnsupportedModelError(
                    f"the derivative of {error} is not translated",
                    place=self._place(span),
                    remedy="prescribe the motion with its derivatives",
                ) from error
            rates[name] = rate
        return ex.Substitution(rates)(root) if rates else root

    def _require_derivatives(self, root: float | Node, span: Span | None) -> None:
        """Only continuous variables of the equations have derivatives."""
        for name in ex.symbols(root):
            order, inner = order_and_variable(name)
            if order == 0 or name in self._names or unwrapped(name)[0] == "pre":
                continue
            what = "the output of an external function" if is_call_output(inner) else f"{inner}"
            raise UnsupportedModelError(
                f"the derivative of {what} is not translated",
                place=self._place(span),
                remedy="prescribe the motion with its derivatives",
            )

    def _matrix_definitions(self) -> tuple[set[str], set[int]]:
        matrices = [
            name
            for name in self._names
            if (variable := self._model.variables.get(name)) is not None and variable.orientation is not None
        ]
        candidates: dict[str, list[str]] = {name: [] for name in matrices}
        for equation in self._equations:
            for name in explicit_variables(equation.residual):
                if name in candidates:
                    candidates[name].append(str(equation.number))
        matching = Matching({position: candidates[name] for position, name in enumerate(matrices)})
        defined = {name for position, name in enumerate(matrices) if matching.augment(position)}
        for name in matrices:
            if name not in defined or derivative_name(name) in self._names:
                self._model.variables[name].orientation = None
        defined = {name for name in defined if self._model.variables[name].orientation is not None}
        rows = {int(matching.column_of[position]) for position, name in enumerate(matrices) if name in defined}
        return defined, rows

    def _angular_velocity_names(self) -> set[str]:
        records = {item.orientation[0] for item in self._model.variables.values() if item.orientation is not None}
        names = set()
        for record in records:
            for index in range(3):
                by = self._resolve(f"{record}.w[{index + 1}]")
                names.update(ex.symbols(by))
        return names

    # --- derivatives ---

    def _rate(self, name: str) -> float | Node:
        if name == "time":
            return 1
        order, inner = order_and_variable(name)
        variable = self._model.variables.get(inner)
        if variable is None or unwrapped(name)[0] == "pre":
            return 0
        if variable.kind is Kind.INPUT:
            raise NotDifferentiableError(f"the input {name}")
        if variable.kind is not Kind.CONTINUOUS:
            return 0
        if is_call_output(inner):
            return self._tables.rate(inner, ex.Differentiation(self._rate))
        if order == 0 and variable.orientation is not None:
            return self._orientation_rate(*variable.orientation)
        if order >= _ORDER_LIMIT:
            raise NotDifferentiableError(f"{inner} more than {_ORDER_LIMIT} times")
        derivative = derivative_name(name)
        self._names.setdefault(derivative)
        return ex.symbol(derivative)

    def _orientation_rate(self, record: str, row: int, column: int) -> float | Node:
        second, third = (row + 1) % 3, (row + 2) % 3
        w2, w3 = (self._resolve(f"{record}.w[{index + 1}]") for index in (second, third))
        t2, t3 = (self._resolve(f"{record}.T[{index + 1},{column + 1}]") for index in (second, third))
        return ex.subtract(ex.multiply(w3, t2), ex.multiply(w2, t3))

    def _add_derivative(self, equation: ContinuousEquation) -> ContinuousEquation:
        try:
            residual = self._differentiate(equation.residual)
        except NotDifferentiableError as error:
            raise UnsupportedModelError(
                f"an equation must be differentiated for index reduction, but contains {error}",
                place=self._place(equation.span),
                remedy="break the constraint by a compliant element, or prescribe the motion with its derivatives",
            ) from error
        derivative = ContinuousEquation(len(self._equations), residual, equation.span, equation.number)
        equation.derivative = derivative.number
        self._equations.append(derivative)
        self._incidence[derivative.number] = self._symbols(residual)
        return derivative

    # --- Pantelides ---

    def run(self) -> ReducedSystem:
        self._require_regular()
        matching = Matching()
        for number in range(len(self._equations)):
            if number not in self._definitions:
                self._match(matching, number)
        return StateSelection(
            self._model, self._equations, self._incidence, self._names, self._angular_velocities, self._place
        ).run()

    def _require_regular(self) -> None:
        """A matching must exist when a variable and its derivatives count as one; else nothing helps."""
        merged = {
            number: list(dict.fromkeys(order_and_variable(name)[1] for name in names))
            for number, names in self._incidence.items()
        }
        matching = Matching(merged)
        problems = [number for number in merged if not matching.augment(number)]
        variables = dict.fromkeys(order_and_variable(name)[1] for name in self._names)
        missing = [name for name in variables if name not in matching.row_of]
        if not problems and not missing:
            return
        texts = []
        place = None
        if problems:
            equations = [self._equations[number] for number in problems[:5]]
            place = self._place(equations[0].span)
            texts.append("equations that determine nothing: " + "; ".join(f"0 = {e.residual}" for e in equations))
        if missing:
            texts.append("variables that no equation determines: " + ", ".join(missing[:10]))
        raise InputError(
            f"the model is structurally singular ({len(self._equations)} equations, {len(variables)} unknowns): "
            + "; ".join(texts),
            place=place,
        )

    def _highest(self, number: int) -> list[str]:
        return [
            name
            for name in self._incidence[number]
            if derivative_name(name) not in self._names and name not in self._defined
        ]

    def _match(self, matching: Matching, number: int) -> None:
        while True:
            if self._incidence_is_stale:  # some names have got derivatives and are no longer the highest ones
                matching.incidence = {row: self._highest(row) for row in matching.column_of}
                self._incidence_is_stale = False
                for row, column in list(matching.column_of.items()):
                    if derivative_name(column) in self._names:
                        del matching.column_of[row], matching.row_of[column]
                        if row != number:
                            raise AssertionError("a matched variable got a derivative without its equation")
            matching.incidence[number] = self._highest(number)
            found, reached_rows, reached_columns = matching.search(number)
            if found:
                return
            self._incidence_is_stale = True
            for name in reached_columns:
                self._names.setdefault(derivative_name(name))
            created = {}
            for row in reached_rows:
                created[row] = self._add_derivative(self._equations[row]).number
            for name in reached_columns:
                row = matching.row_of.pop(name)
                matching.column_of[created[row]] = derivative_name(name)
                matching.row_of[derivative_name(name)] = created[row]
                del matching.column_of[row]
            number = created[number]


def explicit_variables(residual: float | Node) -> list[str]:
    """Symbols that ``residual = 0`` gives by an addition alone: one side of the difference, found nowhere else."""
    if not isinstance(residual, Node):
        return []
    sides = residual.args if residual.op in ("sub", "add") else (residual,)
    result = []
    for position, side in enumerate(sides):
        inner = side.args[0] if side.op == "neg" else side
        if inner.op == "symbol" and inner.name not in ex.symbols(*(s for i, s in enumerate(sides) if i != position)):
            result.append(inner.name)
    return result
