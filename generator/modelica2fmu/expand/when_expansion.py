"""Expands when-clauses and algorithm sections to equations and actions at events."""

from __future__ import annotations

from typing import Any

import numpy as np
from contact_foundation.errors import InputError

from modelica2fmu.expand.scalar_model import (
    INITIAL,
    Kind,
    Reinitialization,
    ScalarAssert,
    ScalarEquation,
    ScalarModel,
    ScalarVariable,
    Termination,
    previous_name,
)
from modelica2fmu.expand.scalar_values import as_number, element_names, text_of
from modelica2fmu.frontend import ir
from modelica2fmu.interpreter import arrays
from modelica2fmu.interpreter.arrays import Scalar, Value
from modelica2fmu.interpreter.interpreter import Interpreter
from modelica2fmu.library.source_map import SourceMap, Span
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node


class WhenExpansion:
    """Adds what when-clauses and algorithms mean to a scalar model.

    Args:
        model: the flat model.
        result: the model that is made; its variables are declared.
        interpreter: evaluates expressions and executes statements.
        source_map: for the places in error messages.
    """

    def __init__(
        self, model: ir.FlatModel, result: ScalarModel, interpreter: Interpreter, source_map: SourceMap
    ) -> None:
        self._model = model
        self._result = result
        self._interpreter = interpreter
        self._source_map = source_map

    def _triggers(self, condition: ir.Expression, label: str) -> float | Node:
        """True in the event iteration in which a when-clause is active."""
        if isinstance(condition, ir.ArrayConstructor):
            elements = condition.elements
        else:
            value = self._interpreter.evaluate(condition)
            if isinstance(value, np.ndarray):
                return self._trigger_of_values(list(value.reshape(-1)), label, condition.span)
            elements = (condition,)
        values = [self._interpreter.evaluate(element) for element in elements]
        return self._trigger_of_values(values, label, condition.span)

    def _trigger_of_values(self, values: list[Any], label: str, span: Span | None) -> float | Node:
        trigger: float | Node = False
        for position, value in enumerate(values):
            if isinstance(value, Node) and value.op == "symbol" and value.name == INITIAL:
                trigger = ex.logical_or(trigger, value)
                continue
            name = f"{label}.condition[{position + 1}]"
            self._result.variables[name] = ScalarVariable(name, "Boolean", Kind.DISCRETE, start=False, span=span)
            self._result.equations.append(ScalarEquation(ex.symbol(name), value, span, target=name))
            rising = ex.logical_and(ex.symbol(name), ex.logical_not(ex.symbol(previous_name(name))))
            trigger = ex.logical_or(trigger, ex.logical_and(ex.logical_not(ex.symbol(INITIAL)), rising))
        return trigger

    def when(
        self,
        branches: list[tuple[ir.Expression, tuple[ir.Statement, ...]]],
        label: str,
        values: dict[str, Value | None] | None = None,
    ) -> None:
        """Expands a when-clause: every variable that it assigns gets one equation, reinit and the like actions.

        With ``values``, the clause stands in an algorithm and works on these.
        """
        assigned: dict[str, float | Node] = {}
        blocked: float | Node = False
        updates: list[tuple[float | Node, dict[str, float | Node]]] = []
        for position, (condition, body) in enumerate(branches):
            trigger = self._triggers(condition, f"{label}.{position + 1}" if len(branches) > 1 else label)
            active = ex.logical_and(trigger, ex.logical_not(blocked))
            blocked = ex.logical_or(blocked, trigger)
            update: dict[str, float | Node] = {}
            self._when_body(body, active, update, values)
            updates.append((active, update))
        for _, update in updates:
            for name in update:
                assigned.setdefault(name, self._unassigned(name, values))
        for chosen, update in reversed(updates):
            for name in assigned:
                if name in update:
                    assigned[name] = ex.select(chosen, update[name], assigned[name])
        for name, value in assigned.items():
            if values is None:
                self._result.equations.append(ScalarEquation(ex.symbol(name), value, target=name))
            else:
                values[name] = value

    def _unassigned(self, name: str, values: dict[str, Value | None] | None) -> float | Node:
        if values is not None and isinstance(values.get(name), float | int | Node):
            value = values[name]
            assert isinstance(value, float | int | Node)
            return value
        return ex.symbol(previous_name(name))

    def _when_body(
        self,
        body: tuple[ir.Statement, ...],
        active: float | Node,
        update: dict[str, float | Node],
        values: dict[str, Value | None] | None,
    ) -> None:
        for statement in body:
            match statement:
                case ir.Assignment(target=target, value=expression):
                    names = self._target_names(target)
                    items = arrays.scalars(self._evaluate_local(expression, update, values))
                    self._update(update, names, items, statement.span)
                case ir.CallAssignment(targets=targets, call=call):
                    outputs = [
                        self._local(output, update, values) for output in self._interpreter.outputs(call, events=False)
                    ]
                    for reference, output in zip(targets, outputs, strict=False):
                        if reference is not None:
                            self._update(update, self._target_names(reference), arrays.scalars(output), statement.span)
                case ir.IfStatement(branches=branches, otherwise=otherwise):
                    self._when_if(branches, otherwise, active, update, values)
                case ir.Reinit(state=state, value=expression):
                    items = arrays.scalars(self._evaluate_local(expression, update, values))
                    for name, item in zip(self._target_names(state), items, strict=True):
                        self._result.reinitializations.append(
                            Reinitialization(active, name, as_number(item), statement.span)
                        )
                case ir.Assert(condition=condition, message=message, is_warning=is_warning):
                    checked = self._evaluate_local(condition, update, values)
                    text = text_of(self._interpreter.evaluate(message, events=False))
                    self._result.asserts.append(ScalarAssert(as_number(checked), text, is_warning, active))
                case ir.Terminate(message=message):
                    text = text_of(self._interpreter.evaluate(message, events=False))
                    self._result.terminations.append(Termination(active, text))
                case _:
                    raise self._interpreter.unsupported(f"{type(statement).__name__} in a when-clause", statement.span)

    def _when_if(
        self,
        branches: tuple[tuple[ir.Expression, tuple[ir.Statement, ...]], ...],
        otherwise: tuple[ir.Statement, ...],
        active: float | Node,
        update: dict[str, float | Node],
        values: dict[str, Value | None] | None,
    ) -> None:
        remaining: float | Node = active
        parts: list[tuple[float | Node, dict[str, float | Node]]] = []
        for condition, body in branches:
            chosen = as_number(self._evaluate_local(condition, update, values))
            part = dict(update)
            self._when_body(body, ex.logical_and(remaining, chosen), part, values)
            remaining = ex.logical_and(remaining, ex.logical_not(chosen))
            parts.append((chosen, part))
        rest = dict(update)
        self._when_body(otherwise, remaining, rest, values)
        for name in {name: None for part in (*(part for _, part in parts), rest) for name in part}:
            value = rest.get(name, self._unassigned(name, values))
            for chosen, part in reversed(parts):
                value = ex.select(chosen, part.get(name, self._unassigned(name, values)), value)
            update[name] = value

    def _evaluate_local(
        self, expression: ir.Expression, update: dict[str, float | Node], values: dict[str, Value | None] | None
    ) -> Value:
        return self._local(self._interpreter.evaluate(expression, events=False), update, values)

    @staticmethod
    def _local(value: Value, update: dict[str, float | Node], values: dict[str, Value | None] | None) -> Value:
        if values is None:
            return value  # equations: what stands on the right is the solution, not the last assignment
        local: dict[str, float | Node] = {
            name: item for name, item in values.items() if isinstance(item, float | int | Node)
        }
        local.update(update)
        substitution = ex.Substitution(local)
        return arrays.elementwise(lambda item: substitution(item) if isinstance(item, Node) else item, value)

    def _update(
        self, update: dict[str, float | Node], names: list[str], items: list[Scalar], span: Span | None
    ) -> None:
        if len(items) == 1 and len(names) > 1:
            items = items * len(names)
        if len(items) != len(names):
            raise InputError("the sides of an assignment do not fit", place=self._source_map.place(span))
        for name, item in zip(names, items, strict=True):
            update[name] = as_number(item)

    def _target_names(self, target: ir.Reference) -> list[str]:
        value = self._interpreter.evaluate(target, events=False)
        return [item.name for item in arrays.scalars(value) if isinstance(item, Node)]

    def algorithm(self, algorithm: ir.Algorithm) -> None:
        """An algorithm becomes one equation for each variable that it assigns."""
        values: dict[str, Value | None] = {}
        outputs: dict[str, None] = {}
        for name in algorithm.outputs:
            declared = self._model.variables.get(name)
            names = element_names(name, declared.shape) if declared is not None else [name]
            outputs.update(dict.fromkeys(names))
        for name in outputs:
            variable = self._result.variables[name]
            values[name] = (
                ex.symbol(previous_name(name)) if variable.kind is Kind.DISCRETE else as_number(variable.start or 0)
            )
        label = f"$algorithm[{self._model.algorithms.index(algorithm) + 1}]"
        for position, statement in enumerate(algorithm.statements):
            if isinstance(statement, ir.WhenStatement):
                self.when(list(statement.branches), f"{label}.when[{position + 1}]", values)
            else:
                values = self._run_statement(statement, values)
        for name in outputs:
            value = values[name]
            assert isinstance(value, float | int | Node)
            self._result.equations.append(ScalarEquation(ex.symbol(name), value, algorithm.span, target=name))

    def _run_statement(self, statement: ir.Statement, values: dict[str, Value | None]) -> dict[str, Value | None]:
        grouped = dict(values)
        shaped: dict[str, list[str]] = {}
        for declared in self._model.variables.values():
            if declared.shape:
                names = element_names(declared.name, declared.shape)
                if names and all(name in values for name in names):
                    shaped[declared.name] = names
                    array: arrays.Array = np.empty(declared.shape, dtype=object)
                    flat = array.reshape(-1)
                    for position, name in enumerate(names):
                        flat[position] = grouped.pop(name)
                    grouped[declared.name] = array
        after = self._interpreter.execute_algorithm((statement,), grouped, events=True)
        result: dict[str, Value | None] = {}
        for name, value in after.items():
            if name in shaped:
                assert isinstance(value, np.ndarray)
                result.update(zip(shaped[name], value.reshape(-1), strict=True))
            else:
                result[name] = value
        return result

    def initial_algorithm(self, algorithm: ir.Algorithm) -> None:
        """An initial algorithm becomes initial equations."""
        values: dict[str, Value | None] = {}
        outputs: dict[str, None] = {}
        for name in algorithm.outputs:
            declared = self._model.variables.get(name)
            outputs.update(dict.fromkeys(element_names(name, declared.shape) if declared is not None else [name]))
        for name in outputs:
            values[name] = as_number(self._result.variables[name].start or 0)
        for statement in algorithm.statements:
            values = self._run_statement(statement, values)
        for name in outputs:
            value = values[name]
            assert isinstance(value, float | int | Node)
            self._result.initial_equations.append(ScalarEquation(ex.symbol(name), value, algorithm.span))
