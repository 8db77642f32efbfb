"""Expands a flat model to scalars: arrays, functions, loops, when-clauses and algorithms."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

from contact_foundation.errors import UnsupportedModelError

from modelica2fmu.expand.call_expansion import CallExpansion
from modelica2fmu.expand.enumeration_types import EnumerationTypes
from modelica2fmu.expand.equation_expansion import EquationExpansion
from modelica2fmu.expand.event_operators import EventOperators
from modelica2fmu.expand.scalar_model import TIME, Kind, ScalarModel, derivative_name
from modelica2fmu.expand.size_check import require_tractable
from modelica2fmu.expand.variable_declaration import VariableDeclaration
from modelica2fmu.expand.variable_values import VariableValues
from modelica2fmu.expand.when_expansion import WhenExpansion
from modelica2fmu.frontend import ir
from modelica2fmu.interpreter.arrays import Scalar, Value
from modelica2fmu.interpreter.interpreter import Interpreter
from modelica2fmu.library.source_map import SourceMap, Span
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node


def scalarize(model: ir.FlatModel, source_map: SourceMap, files: Callable[[str], Path] = Path) -> ScalarModel:
    """The scalar form of ``model``.

    Args:
        model: what to expand.
        source_map: for the places in error messages.
        files: the file that a name in the model means.

    Raises:
        UnsupportedModelError: a construct that is not translated.
        InputError: the model is wrong (a parameter without value, operands that do not fit).
    """
    return _Scalarizer(model, source_map, files).run()


class _Scalarizer:
    """Host of the interpreter; gives each part of the flat model to who expands it."""

    def __init__(self, model: ir.FlatModel, source_map: SourceMap, files: Callable[[str], Path]) -> None:
        self._model = model
        self._source_map = source_map
        self._result = ScalarModel(model.name, model.description, warnings=list(model.warnings))
        self._enumerations = EnumerationTypes(model)
        self._interpreter = Interpreter(model, self, source_map)
        self._values = VariableValues(model, self._result, self._interpreter, source_map)
        self._events = EventOperators(self._result, source_map)
        self._calls = CallExpansion(
            self._result, self._interpreter, source_map, files, self._values.constant, self._enumerations.is_known
        )
        self._equations = EquationExpansion(self._result, self._interpreter, self._values, source_map)
        self._whens = WhenExpansion(model, self._result, self._interpreter, source_map)

    def run(self) -> ScalarModel:
        model, result = self._model, self._result
        variables = [variable for variable in model.variables.values() if not self._values.is_table(variable)]
        require_tractable(variables, self._source_map.place)
        declaration = VariableDeclaration(model, self._enumerations)
        for variable in variables:
            result.variables.update({scalar.name: scalar for scalar in declaration.scalars(variable)})
        for variable in variables:
            self._values.set_attributes(variable)
        with self._equations.lasting():
            for variable in variables:
                if variable.binding is not None and variable.variability not in ("parameter", "constant"):
                    if variable.causality == "input" and variable.is_top_level and "." not in variable.name:
                        continue  # a default value of a top-level input
                    self._equations.binding(variable)
            for equation in model.equations:
                result.equations.extend(self._equations.equation(equation))
        for algorithm in model.algorithms:
            self._whens.algorithm(algorithm)
        for position, when in enumerate(model.whens):
            self._whens.when([(branch.condition, branch.body) for branch in when.branches], f"$when[{position + 1}]")
        for equation in model.initial_equations:
            result.initial_equations.extend(self._equations.equation(equation, events=False))
        for algorithm in model.initial_algorithms:
            self._whens.initial_algorithm(algorithm)
        for item in (*model.asserts, *model.initial_asserts):
            self._equations.assertion(item)
        self._values.fix_structural()
        result.enumerations = self._enumerations.literals({variable.type for variable in result.variables.values()})
        return result

    def variable(self, name: str) -> Value | None:
        """See :class:`interpreter_host.Host`."""
        return self._values.variable(name)

    def enumeration_type(self, name: str) -> str | None:
        """See :class:`interpreter_host.Host`."""
        return self._enumerations.of_variable(name)

    def derivative(self, value: float | Node, span: Span | None) -> float | Node:
        """See :class:`interpreter_host.Host`."""

        def rate(name: str) -> float | Node:
            if name == TIME:
                return 1
            variable = self._result.variables.get(name)
            if variable is None or variable.kind is Kind.CONTINUOUS:
                return ex.symbol(derivative_name(name))
            if variable.kind is Kind.INPUT:
                raise UnsupportedModelError(
                    f"the derivative of the input {name} is not translated", place=self._source_map.place(span)
                )
            return 0

        return ex.Differentiation(rate)(value)

    def previous(self, value: float | Node, span: Span | None) -> float | Node:
        """See :class:`interpreter_host.Host`."""
        del span
        return self._events.previous(value)

    def relation(self, op: str, left: float | Node, right: float | Node) -> bool | Node:
        """See :class:`interpreter_host.Host`."""
        return self._events.relation(op, left, right)

    def step(self, op: str, value: float | Node) -> float | Node:
        """See :class:`interpreter_host.Host`."""
        return self._events.step(op, value)

    def sample(self, start: float | Node, interval: float | Node, span: Span | None) -> bool | Node:
        """See :class:`interpreter_host.Host`."""
        return self._events.sample(start, interval, span)

    def external(self, function: ir.Function, args: Mapping[str, Value], span: Span | None) -> tuple[Value, ...]:
        """See :class:`interpreter_host.Host`."""
        return self._calls.external(function, args, span)

    def delay(self, value: float | Node, delay: float | Node, longest: float | Node, span: Span | None) -> float | Node:
        """See :class:`interpreter_host.Host`."""
        return self._calls.delay(value, delay, longest, span)

    def constant(self, value: Node, span: Span | None, purpose: str) -> float:
        """See :class:`interpreter_host.Host`."""
        return self._values.constant(value, span, purpose)

    def function_assert(self, condition: Scalar, message: Scalar, is_warning: bool) -> None:
        """See :class:`interpreter_host.Host`."""
        self._equations.function_assert(condition, message, is_warning)
