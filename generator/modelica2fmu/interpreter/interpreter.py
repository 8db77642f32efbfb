"""Evaluates Modelica expressions and functions on values that may be symbolic.

One interpreter serves two purposes. With constant operands it computes: array sizes, String parameters,
everything Modelica evaluates at translation. With symbolic operands it expands: arrays become scalars, functions
are inlined, loops unrolled, and an if with a symbolic condition becomes a ``select`` (both branches are executed
and what they assign is merged).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

import numpy as np
from contact_foundation.errors import UnsupportedModelError

from modelica2fmu.frontend import ir
from modelica2fmu.interpreter import arrays
from modelica2fmu.interpreter.arrays import Record, Scalar, ShapeError, Text, Value
from modelica2fmu.interpreter.declaration_order import declaration_order
from modelica2fmu.interpreter.expression_interpreter import ITERATION_LIMIT, ExpressionInterpreter
from modelica2fmu.interpreter.interpreter_host import Host, Scope
from modelica2fmu.interpreter.size_requirements import require_sizes
from modelica2fmu.interpreter.string_functions import STRING_FUNCTIONS
from modelica2fmu.interpreter.value_functions import scalar_number, selected_shape, with_elements
from modelica2fmu.interpreter.vectorized_calls import arguments_of_element, results_as_arrays, vectorized_shape
from modelica2fmu.library.source_map import SourceMap, Span
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node

_CALL_DEPTH_LIMIT: Final = 100
_REMEDY_OF_SIZES: Final = "give it as many, or declare it with as many"
_UNROLLING_LIMIT: Final = 200  # of while-loops that variables end


class Interpreter(ExpressionInterpreter):
    """Evaluates expressions of one flat model, and executes functions and algorithms.

    Args:
        model: the model whose functions and enumerations are known.
        host: see :class:`modelica2fmu.interpreter.interpreter_host.Host`.
        source_map: for the places in error messages.
    """

    def __init__(self, model: ir.FlatModel, host: Host, source_map: SourceMap) -> None:
        super().__init__(model, host, source_map)
        self._is_unproven = False  # = true, in functions whose sizes the front end has not checked, and what they call
        # Local variables and outputs by name, in the order of their values: of the functions that were called, and of
        # the one that is executed.
        self._declarations: dict[str, Mapping[str, ir.FunctionVariable]] = {}
        self._declared: Mapping[str, ir.FunctionVariable] = {}

    # --- functions ---

    def call(self, call: ir.Call, scope: Scope) -> tuple[Value, ...]:
        """See :class:`ExpressionInterpreter`."""
        function = self._model.functions.get(call.name)
        if function is None:
            builtin = call.name.rsplit(".", 1)[-1]
            if call.name in ("Modelica.Math." + builtin, builtin) and builtin in ex.UNARY:
                return (ex.unary(builtin, scalar_number(self.value(call.args[0], scope))),)
            raise self.unsupported(f"the function {call.name}", call.span)
        args = [self.value(arg, scope) for arg in call.args]
        try:
            shape = vectorized_shape(function, args)
        except ShapeError as error:
            raise self.wrong(str(error), call.span) from error
        if not shape:
            return self._invoke(function, args, call.span)
        if 0 in shape:
            return tuple(np.empty(shape, dtype=object) for _ in function.outputs)
        elements = (arguments_of_element(function, args, shape, index) for index in np.ndindex(*shape))
        return results_as_arrays([self._invoke(function, each, call.span) for each in elements], shape)

    def _invoke(self, function: ir.Function, args: list[Value], span: Span | None) -> tuple[Value, ...]:
        if self.call_depth >= _CALL_DEPTH_LIMIT:
            raise self.unsupported(f"a recursion deeper than {_CALL_DEPTH_LIMIT} in {function.name}", span)
        local = Scope()
        for position, variable in enumerate(function.inputs):
            if position < len(args):
                local.values[variable.name] = args[position]
            elif variable.default is not None:
                local.values[variable.name] = self.value(variable.default, local)
            else:
                raise self.wrong(f"{function.name} is called without {variable.name}", span)
        if self._is_unproven:
            for variable in function.inputs:
                self._require_sizes(variable, self.known(local.values[variable.name]), local, span)
        if function.is_constructor:
            return (Record({variable.name: self.known(local.values[variable.name]) for variable in function.inputs}),)
        before = self.events, self._is_unproven, self._declared
        self.events, self._is_unproven = False, self._is_unproven or function.is_unproven
        self._declared = self._declarations_of(function)
        self.call_depth += 1
        try:
            for variable in self._declared.values():
                local.values[variable.name] = self._initial_value(variable, local)
            if function.external is not None:
                return self._external(function, local, span)
            self._execute(function.body, local)
        finally:
            self.call_depth -= 1
            self.events, self._is_unproven, self._declared = before
        outputs = []
        for variable in function.outputs:
            value = local.values[variable.name]
            if value is None:
                raise self.wrong(f"{function.name} does not assign its output {variable.name}", function.span)
            outputs.append(value)
        return tuple(outputs)

    def _declarations_of(self, function: ir.Function) -> Mapping[str, ir.FunctionVariable]:
        found = self._declarations.get(function.name)
        if found is None:
            found = {variable.name: variable for variable in declaration_order(function)}
            self._declarations[function.name] = found
        return found

    def _require_sizes(self, variable: ir.FunctionVariable, value: Value, local: Scope, span: Span | None) -> None:
        """Raises InputError where a variable of a function is given a value of other sizes than it is declared with."""
        wanted = [
            None if isinstance(each, ir.Colon) else self.integer(self._references.subscript_value(each, local), span)
            for each in variable.shape
        ]
        if len(wanted) != variable.rank:  # some are those of its type
            return
        try:
            require_sizes(variable.name, wanted, value)
        except ShapeError as error:
            raise self.wrong(str(error), span, _REMEDY_OF_SIZES) from error

    def _external(self, function: ir.Function, local: Scope, span: Span | None) -> tuple[Value, ...]:
        assert function.external is not None
        if function.external.language not in ("C", "builtin"):
            raise self.unsupported(f"an external function in {function.external.language}", function.span)
        if function.external.language == "builtin":
            return (self._mathematical(function, local, span),)
        values = {name: value for name, value in local.values.items() if value is not None}
        known = STRING_FUNCTIONS.get(function.external.name)
        if known is not None:
            args = [self.evaluate_in_function(arg, values) for arg in function.external.args]
            if all(isinstance(arg, str | int | float) for arg in args):
                return (known(*args),)
        return self._host.external(function, values, span)

    def _mathematical(self, function: ir.Function, local: Scope, span: Span | None) -> Value:
        """A function that only gives one of the language's own a second name, like those of Modelica.Math."""
        assert function.external is not None
        name = function.external.name
        args = [scalar_number(self.value(arg, local)) for arg in function.external.args]
        if len(args) == 1 and name in ex.UNARY:
            return ex.unary(name, args[0])
        if len(args) == 2 and name in ex.BINARY:
            return ex.binary(name, *args)
        raise self.unsupported(f"the built-in function {name} of {function.name}", span)

    def _initial_value(self, variable: ir.FunctionVariable, local: Scope) -> Value | None:
        if variable.default is not None:
            return self.value(variable.default, local)
        record = self._constructors.get(variable.type)
        if variable.is_record or record is not None:
            return Record(dict.fromkeys(record.fields)) if record is not None else None
        if not variable.shape:
            return None
        if any(isinstance(item, ir.Colon) for item in variable.shape):
            return None
        sizes = [
            self.integer(self.value(item, local), None) for item in variable.shape if not isinstance(item, ir.Colon)
        ]
        return arrays.filled(sizes, "" if variable.type == "String" else 0)

    def function_shape(self, variable: ir.FunctionVariable, values: Mapping[str, Value]) -> tuple[int, ...]:
        """The shape of an output of an external function for given inputs."""
        local = Scope()
        local.values.update(values)
        return tuple(
            self.integer(self._references.subscript_value(subscript, local), None) for subscript in variable.shape
        )

    def evaluate_in_function(self, expression: ir.Expression, values: Mapping[str, Value]) -> Value:
        """The value of an expression inside a function with the given local variables."""
        local = Scope()
        local.values.update(values)
        return self.evaluate(expression, local, events=False)

    # --- statements ---

    def execute_algorithm(
        self, statements: tuple[ir.Statement, ...], values: dict[str, Value | None], events: bool
    ) -> dict[str, Value | None]:
        """Runs a model's algorithm (without when) on ``values`` and returns them as they are at its end."""
        before = self.events
        self.events = events
        scope = Scope()
        scope.values = dict(values)
        try:
            self._execute(statements, scope)
        finally:
            self.events = before
        return scope.values

    def _execute(self, statements: tuple[ir.Statement, ...], scope: Scope) -> None:
        for statement in statements:
            if scope.left is True:
                return
            self._statement(statement, scope)

    def _statement(self, statement: ir.Statement, scope: Scope) -> None:
        match statement:
            case ir.Assignment(target=target, value=value):
                self._assign(target, self.value(value, scope), scope)
            case ir.CallAssignment(targets=targets, call=call):
                outputs = self.call(call, scope)
                for receiver, output in zip(targets, outputs, strict=False):
                    if receiver is not None:
                        self._assign(receiver, output, scope)
            case ir.IfStatement():
                self._if_statement(statement.branches, statement.otherwise, scope)
            case ir.For(indices=indices, body=body):
                self._for(indices, body, scope)
            case ir.While():
                self._while(statement, scope)
            case ir.Assert(condition=condition, message=message, is_warning=is_warning):
                text = self.value(message, scope)
                assert isinstance(text, str | Text)
                checked = self.value(condition, scope)
                assert isinstance(checked, bool | int | float | Node)
                passed_by = ex.logical_or(ex.logical_not(self._taken), scope.left)
                self._host.function_assert(ex.logical_or(passed_by, checked), text, is_warning)
            case ir.Return():
                scope.returned = True
            case ir.Break():
                scope.broken = True
            case _:
                raise self.unsupported(f"{type(statement).__name__} here", statement.span)

    def _assign(self, target: ir.Reference, value: Value, scope: Scope) -> None:
        name = target.parts[0][0]
        if len(target.parts) == 1 and target.name in scope.values:
            name = target.name
        if isinstance(value, tuple):
            value = value[0]
        fields = [part[0] for part in target.parts[1:]]
        if target.name in scope.values:
            name, fields = target.name, []
        if name not in scope.values:
            raise self.wrong(f"there is no variable {target.name} to assign to", target.span)
        if fields:
            record = scope.values[name]
            record = Record(dict(record.fields)) if isinstance(record, Record) else Record({})
            old = record.fields.get(fields[0])
            record.fields[fields[0]] = self._unless_left(scope, old, self._with_element(old, target, value, scope))
            scope.values[name] = record
            return
        if self._is_unproven and not target.subscripts and name in self._declared:
            self._require_sizes(self._declared[name], value, scope, target.span)
        old = scope.values[name]
        scope.values[name] = self._unless_left(scope, old, self._with_element(old, target, value, scope))

    def _unless_left(self, scope: Scope, old: Value | None, new: Value) -> Value | None:
        """The new value, or the old one where a return or break was executed before."""
        left = scope.left
        return self._merged_local(left, old, new) if isinstance(left, Node) else new

    def _with_element(self, old: Value | None, target: ir.Reference, value: Value, scope: Scope) -> Value:
        if not target.subscripts:
            return value.copy() if isinstance(value, np.ndarray) else value
        if not isinstance(old, np.ndarray):
            raise self.unsupported("an assignment to elements of an array of unknown size", target.span)
        index: list[Any] = []
        for position, subscript in enumerate(target.subscripts):
            if isinstance(subscript, ir.Colon):
                index.append(slice(None))
                continue
            inner = Scope(scope)
            inner.values["end"] = old.shape[position]
            item = self.value(subscript, inner)
            if isinstance(item, np.ndarray):
                index.append(
                    [self.checked(self.integer(n, target.span), old.shape[position], target.span) for n in item]
                )
            elif isinstance(item, Node) and not self.is_known(item, target.span, "an index"):
                index.append(item)
            else:
                index.append(self.checked(self.integer(item, target.span), old.shape[position], target.span))
        try:
            if self._is_unproven:
                require_sizes(f"a part of {target.name}", selected_shape(old, index), value)
            return with_elements(old, index, value)
        except ShapeError as error:
            raise self.wrong(str(error), target.span, _REMEDY_OF_SIZES) from error

    def _if_statement(
        self,
        branches: tuple[tuple[ir.Expression, tuple[ir.Statement, ...]], ...],
        otherwise: tuple[ir.Statement, ...],
        scope: Scope,
    ) -> None:
        for position, (condition, body) in enumerate(branches):
            chosen = self.value(condition, scope)
            if not isinstance(chosen, Node):
                if chosen:
                    self._execute(body, scope)
                    return
                continue
            first, second = scope.branch(), scope.branch()
            with self._where(chosen):
                self._execute(body, first)
            with self._where(ex.logical_not(chosen)):
                self._if_statement(branches[position + 1 :], otherwise, second)
            for name in scope.values:
                scope.values[name] = self._merged_local(chosen, first.values[name], second.values[name])
            scope.returned = _either(chosen, first.returned, second.returned)
            scope.broken = _either(chosen, first.broken, second.broken)
            return
        self._execute(otherwise, scope)

    def _merged_local(self, condition: Node, first: Value | None, second: Value | None) -> Value | None:
        # What only one branch assigns is undefined after the other, so the assigned value may stand for both.
        if first is None or first is second:
            return second
        if second is None:
            return first
        if isinstance(first, Record) and isinstance(second, Record):
            return Record(
                {
                    name: self._merged_local(condition, first.fields.get(name), second.fields.get(name))
                    for name in first.fields
                }
            )
        return self.merged(condition, first, second)

    def _for(
        self, indices: tuple[tuple[str, ir.Expression], ...], body: tuple[ir.Statement, ...], scope: Scope
    ) -> None:
        name, domain = indices[0]
        hidden = scope.values.get(name)
        was_there = name in scope.values
        outer, scope.broken = scope.broken, False
        try:
            for item in self.iterated(domain, scope):
                if scope.left is True:
                    break
                scope.values[name] = item
                if len(indices) > 1:
                    self._for(indices[1:], body, scope)
                else:
                    self._execute(body, scope)
        finally:
            scope.broken = outer
            if was_there:
                scope.values[name] = hidden
            else:
                scope.values.pop(name, None)

    def _while(self, statement: ir.While, scope: Scope) -> None:
        outer, scope.broken = scope.broken, False
        trial = scope.branch()
        try:
            self._iterate(statement, trial, 0)
        except UnsupportedModelError:
            # Parameters that decide how often it runs can be changed no more.
            trial = scope.branch()
            trial.values = {name: self._settled(value, statement.span) for name, value in scope.values.items()}
            if all(value is scope.values[name] for name, value in trial.values.items()):
                raise
            self._iterate(statement, trial, 0)
        scope.values, scope.returned, scope.broken = trial.values, trial.returned, outer

    def _settled(self, value: Value | None, span: Span | None) -> Value | None:
        """The number that a value has which depends on parameters alone; others as they are."""
        if isinstance(value, np.ndarray) and any(isinstance(item, Node) for item in value.flat):
            return arrays.elementwise(lambda item: self._settled_number(item, span), value)
        return self._settled_number(value, span) if isinstance(value, Node) else value

    def _settled_number(self, value: Scalar, span: Span | None) -> Scalar:
        is_known = isinstance(value, Node) and self.is_known(value, span, "a value that a while-loop begins with")
        return self._host.constant(value, span, "a loop") if is_known and isinstance(value, Node) else value

    def _iterate(self, statement: ir.While, scope: Scope, unrolled: int) -> None:
        """Runs a while-loop from here on.

        If its condition is a node, both ways are followed: the loop ends where, on the way on which it always went on,
        the condition becomes a constant (a counter passes its limit).
        """
        for _ in range(ITERATION_LIMIT):
            if scope.left is True:
                return
            condition = self.value(statement.condition, scope)
            if isinstance(condition, Node):
                if unrolled >= _UNROLLING_LIMIT:
                    raise self.unsupported(
                        f"a while-loop that variables end and that may run more than {_UNROLLING_LIMIT} times",
                        statement.span,
                    )
                on = scope.branch()
                with self._where(condition):
                    self._execute(statement.body, on)
                    self._iterate(statement, on, unrolled + 1)
                for name in scope.values:
                    scope.values[name] = self._merged_local(condition, on.values[name], scope.values[name])
                scope.returned = _either(condition, on.returned, scope.returned)
                return
            if not condition:
                return
            self._execute(statement.body, scope)
        raise self.wrong(f"a while-loop runs more than {ITERATION_LIMIT} times", statement.span)


def _either(condition: Node, first: bool | Node, second: bool | Node) -> bool | Node:
    """``first`` where the condition holds, else ``second``."""
    return (
        ex.logical_or(ex.logical_and(condition, first), ex.logical_and(ex.logical_not(condition), second))
        if first is not second
        else first
    )
