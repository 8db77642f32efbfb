"""Evaluates Modelica expressions on values that may be symbolic; see :mod:`modelica2fmu.interpreter.interpreter`."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

import numpy as np
from contact_foundation.errors import UnsupportedModelError

from modelica2fmu.frontend import ir
from modelica2fmu.interpreter import arrays
from modelica2fmu.interpreter.arrays import Record, Scalar, ShapeError, Text, Value
from modelica2fmu.interpreter.builtin_functions import BuiltinFunctions
from modelica2fmu.interpreter.interpreter_host import Host, Scope
from modelica2fmu.interpreter.references import References
from modelica2fmu.interpreter.string_operator import StringOperator
from modelica2fmu.interpreter.translation_values import TranslationValues
from modelica2fmu.interpreter.value_functions import ELEMENTWISE, RELATIONS, concatenated, scalar_number
from modelica2fmu.library.source_map import SourceMap, Span
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node

ITERATION_LIMIT: Final = 1_000_000


class ExpressionInterpreter(TranslationValues, ABC):
    """Evaluates expressions of one flat model.

    Args:
        model: the model whose functions and enumerations are known.
        host: see :class:`Host`.
        source_map: for the places in error messages.
    """

    def __init__(self, model: ir.FlatModel, host: Host, source_map: SourceMap) -> None:
        super().__init__(host, source_map)
        self._model = model
        self._references = References(model, host, self, self.value)
        self._builtins = BuiltinFunctions(host, self)
        self._strings = StringOperator(model, host, self)
        self.events = True  # relations generate events: not inside noEvent, smooth and functions
        self.call_depth = 0
        self._taken: bool | Node = True  # = true, where what is evaluated is that of the branch that holds
        self._constructors = model.record_types

    def evaluate(self, expression: ir.Expression, scope: Scope | None = None, events: bool = True) -> Value:
        """The value of an expression of the model.

        Args:
            expression: what to evaluate.
            scope: local variables, if any.
            events: = false, if its relations generate no events.

        Raises:
            UnsupportedModelError: a construct that is not translated.
            InputError: operands that do not fit.
        """
        with self._of_model(events):
            return self.value(expression, scope or Scope())

    def outputs(self, call: ir.Expression, scope: Scope | None = None, events: bool = True) -> tuple[Value, ...]:
        """All outputs of a call, whose value is the first (Modelica 3.6, section 12.4.3).

        Args:
            call: what to evaluate.
            scope: local variables, if any.
            events: = false, if its relations generate no events.
        """
        if not isinstance(call, ir.Call):
            return (self.evaluate(call, scope, events),)
        try:
            with self._of_model(events):
                return self.call(call, scope or Scope())
        except ShapeError as error:
            raise self.wrong(str(error), call.span) from error

    @contextmanager
    def _of_model(self, events: bool) -> Iterator[None]:
        """What is evaluated within belongs to the model, in whatever branch its value was asked for."""
        before = self.events, self._taken
        self.events, self._taken = events and self.events, True
        try:
            yield
        finally:
            self.events, self._taken = before

    def value(self, expression: ir.Expression, scope: Scope) -> Value:
        """The value of an expression with local variables; errors name its place."""
        try:
            return self._dispatch(expression, scope)
        except ShapeError as error:
            raise self.wrong(str(error), expression.span) from error

    def _dispatch(self, expression: ir.Expression, scope: Scope) -> Value:
        match expression:
            case ir.Literal(value=value):
                return value
            case ir.Reference():
                return self._references.reference(expression, scope)
            case ir.Binary():
                return self._binary(expression, scope)
            case ir.Unary():
                return self._unary(expression, scope)
            case ir.Builtin():
                return self._builtin(expression, scope)
            case ir.Call():
                outputs = self.call(expression, scope)
                return outputs[0] if outputs else ()
            case ir.If():
                return self._if(expression, scope)
            case ir.ArrayConstructor():
                return self._array(expression, scope)
            case ir.Range():
                return arrays.stack(self._range(expression, scope))
            case ir.Indexed(base=base, subscripts=subscripts):
                return self._references.indexed(self.value(base, scope), subscripts, scope, expression.span)
            case ir.FieldAccess(base=base, name=name):
                record = self.value(base, scope)
                if isinstance(record, Record) and name in record.fields:
                    return self.known(record.fields[name])
                raise self.wrong(f"there is no field {name}", expression.span)
            case ir.Comprehension():
                return self._comprehension(expression, 0, scope)
            case ir.StringConversion():
                return self._string(expression, scope)
            case ir.TupleExpression(elements=elements):
                return tuple(None if item is None else self.value(item, scope) for item in elements)
        raise AssertionError(f"unknown expression {expression}")

    @staticmethod
    def known(value: Value | None) -> Value:
        """The value of something that has one."""
        assert value is not None
        return value

    def _binary(self, expression: ir.Binary, scope: Scope) -> Value:
        left = self.value(expression.left, scope)
        op = expression.op
        if op == "And" and left is False:
            return False
        if op == "Or" and left is True:
            return True
        right = self.value(expression.right, scope)
        if op in ("Add", "AddElem") and (isinstance(left, str | Text) or isinstance(right, str | Text)):
            return concatenated(left, right)
        relation = RELATIONS.get(op)
        if relation is not None:
            return self._relation(relation, left, right, expression.span)
        if op == "Mul":
            return arrays.multiply(left, right)
        if op == "Exp":
            if isinstance(left, np.ndarray):
                return arrays.matrix_power(left, self.integer(right, expression.span))
            return ex.power(scalar_number(left), scalar_number(right))
        if op == "Div" and isinstance(right, np.ndarray):
            raise self.wrong("a division by an array", expression.span)
        if op in ("Add", "Sub") and isinstance(left, np.ndarray) != isinstance(right, np.ndarray):
            raise self.wrong("a sum of a scalar and an array", expression.span)
        function = ELEMENTWISE.get(op)
        if function is None:
            raise self.unsupported(f"the operator {op}", expression.span)
        return arrays.elementwise(function, left, right)

    def _relation(self, op: str, left: Value, right: Value, span: Span | None) -> Value:
        if isinstance(left, str | Text) or isinstance(right, str | Text):
            first, second = self.text(left, span), self.text(right, span)
            return {"eq": first == second, "ne": first != second, "lt": first < second, "le": first <= second,
                    "gt": first > second, "ge": first >= second}[op]  # fmt: skip
        return self._builtins.relation(op, scalar_number(left), scalar_number(right), self.events)

    def _unary(self, expression: ir.Unary, scope: Scope) -> Value:
        operand = self.value(expression.operand, scope)
        if expression.op in ("Minus", "DotMinus", "MinusElem"):
            return arrays.elementwise(ex.negate, operand)
        if expression.op == "Not":
            return arrays.elementwise(ex.logical_not, operand)
        if expression.op in ("Plus", "DotPlus", "PlusElem"):
            return operand
        raise self.unsupported(f"the operator {expression.op}", expression.span)

    def _if(self, expression: ir.If, scope: Scope) -> Value:
        for position, (condition, value) in enumerate(expression.branches):
            chosen = self.value(condition, scope)
            if isinstance(chosen, Node):
                rest = expression.branches[position + 1 :]
                otherwise = ir.If(rest, expression.otherwise, expression.span) if rest else expression.otherwise
                try:
                    with self._where(chosen):
                        first = self.value(value, scope)
                    with self._where(ex.logical_not(chosen)):
                        second = self.value(otherwise, scope)
                    return self.merged(chosen, first, second, expression.span)
                except (UnsupportedModelError, ShapeError) as error:
                    # A branch cannot be translated; it need not be if parameters alone decide.
                    return self.value(value if self._decided(chosen, error) else otherwise, scope)
            if chosen:
                return self.value(value, scope)
        return self.value(expression.otherwise, scope)

    @contextmanager
    def _where(self, condition: bool | Node) -> Iterator[None]:
        """What is evaluated within counts where a condition holds: assertions are checked there alone."""
        before, self._taken = self._taken, ex.logical_and(self._taken, condition)
        try:
            yield
        finally:
            self._taken = before

    def _decided(self, condition: Node, error: Exception) -> bool:
        """A condition that parameters decide, which can no longer be changed; raises ``error`` for others."""
        try:
            return bool(self._host.constant(condition, None, "a condition"))
        except UnsupportedModelError:
            raise error from None

    def merged(self, condition: Node, first: Value, second: Value, span: Span | None = None) -> Value:
        """``first`` where the condition holds, else ``second``, element by element."""
        if isinstance(first, Record) and isinstance(second, Record):
            return Record(
                {name: self.merged(condition, item, second.fields[name]) for name, item in first.fields.items()}
            )
        if isinstance(first, tuple) and isinstance(second, tuple):
            return tuple(self.merged(condition, a, b) for a, b in zip(first, second, strict=True))
        if isinstance(first, str | Text) or isinstance(second, str | Text):
            if first == second:
                return first
            chosen = self._host.constant(condition, span, "the choice of a String")
            return first if chosen else second
        return arrays.elementwise(lambda a, b: ex.select(condition, a, b), first, second)

    def _array(self, expression: ir.ArrayConstructor, scope: Scope) -> Value:
        values = [self.value(element, scope) for element in expression.elements]
        if expression.kind is ir.Concatenation.ARRAY:
            return arrays.stack(values)
        dimensions = max([2, *(value.ndim for value in values if isinstance(value, np.ndarray))])
        matrices = [arrays.promoted(value, dimensions) for value in values]
        return arrays.concatenate(2 if expression.kind is ir.Concatenation.HORIZONTAL else 1, matrices)

    def _range(self, expression: ir.Range, scope: Scope) -> list[Scalar]:
        start = self.number(self.value(expression.start, scope), expression.span, "a range")
        stop = self.number(self.value(expression.stop, scope), expression.span, "a range")
        step: float = 1
        if expression.step is not None:
            step = self.number(self.value(expression.step, scope), expression.span, "a range")
        if step == 0:
            raise self.wrong("a range has step 0", expression.span)
        count = int(np.floor((stop - start) / step + 1e-10)) + 1
        if count > ITERATION_LIMIT:
            raise self.wrong(f"a range has {count} elements", expression.span)
        return [start + step * number for number in range(max(count, 0))]

    def _comprehension(self, expression: ir.Comprehension, position: int, scope: Scope) -> Value:
        # Modelica's {e for i in I, j in J} is {{e for i in I} for j in J}: the last index is the outermost.
        name, domain = expression.indices[len(expression.indices) - 1 - position]
        values = []
        for item in self.iterated(domain, scope):
            inner = Scope(scope)
            inner.values[name] = item
            if position + 1 < len(expression.indices):
                values.append(self._comprehension(expression, position + 1, inner))
            else:
                values.append(self.value(expression.expression, inner))
        return arrays.stack(values)

    def iterated(self, domain: ir.Expression, scope: Scope) -> list[Value]:
        """What a loop runs over."""
        if isinstance(domain, ir.Range):
            return list(self._range(domain, scope))
        value = self.value(domain, scope)
        if not isinstance(value, np.ndarray):
            raise self.wrong("a loop runs over something that is no array", domain.span)
        return list(value)

    def _string(self, expression: ir.StringConversion, scope: Scope) -> Value:
        value = self.value(expression.value, scope)
        if isinstance(value, str | Text):
            return value
        digits = 6
        if expression.significant_digits is not None:
            digits = self.integer(self.value(expression.significant_digits, scope), expression.span)
        width, left = 0, True
        if expression.minimum_length is not None:
            width = self.integer(self.value(expression.minimum_length, scope), expression.span)
        if expression.left_justified is not None:
            left = bool(self.value(expression.left_justified, scope))
        return self._strings.convert(value, expression.value, digits, width, left, expression.span)

    def _builtin(self, expression: ir.Builtin, scope: Scope) -> Value:
        name, span = expression.name, expression.span
        if name in ("noEvent", "smooth"):
            before, self.events = self.events, False
            try:
                return self.value(expression.args[-1], scope)
            finally:
                self.events = before
        if name == "homotopy":
            return self.value(expression.args[0], scope)
        return self._builtins.call(name, [self.value(arg, scope) for arg in expression.args], self.events, span)

    @abstractmethod
    def call(self, call: ir.Call, scope: Scope) -> tuple[Value, ...]:
        """The outputs of a function."""
