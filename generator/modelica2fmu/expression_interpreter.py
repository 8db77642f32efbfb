"""Evaluates Modelica expressions on values that may be symbolic; see :mod:`modelica2fmu.interpreter`."""

from __future__ import annotations

from abc import ABC, abstractmethod
from functools import partial
from typing import Final

import numpy as np
from cmb_base.errors import InputError, UnsupportedModelError

from modelica2fmu import arrays, ir
from modelica2fmu import expression as ex
from modelica2fmu.arrays import Record, Scalar, ShapeError, Text, Value
from modelica2fmu.expression import Node
from modelica2fmu.interpreter_host import Host, Scope
from modelica2fmu.source_map import SourceMap
from modelica2fmu.value_functions import (
    ELEMENTWISE,
    RELATIONS,
    STEPPING,
    VALUE_FUNCTIONS,
    array_value,
    concatenated,
    relation,
    scalar_number,
    whole_value,
)

ITERATION_LIMIT: Final = 1_000_000


class ExpressionInterpreter(ABC):
    """Evaluates expressions of one flat model.

    Args:
        model: the model whose functions and enumerations are known.
        host: see :class:`Host`.
        source_map: for the places in error messages.
    """

    def __init__(self, model: ir.FlatModel, host: Host, source_map: SourceMap) -> None:
        self._model = model
        self._host = host
        self._source_map = source_map
        self.events = True  # relations generate events: not inside noEvent, smooth and functions
        self.call_depth = 0
        self._constructors = model.record_types

    # --- errors ---

    def unsupported(self, construct: str, span: ir.Span | None) -> UnsupportedModelError:
        """The error for a construct that is not translated."""
        return UnsupportedModelError(
            f"{construct} is not translated",
            place=self._source_map.place(span),
            remedy="see docs/fmu-builder.md for the constructs that are, and rewrite the model with those",
        )

    def wrong(self, message: str, span: ir.Span | None) -> InputError:
        """The error for a model that is wrong."""
        return InputError(message, place=self._source_map.place(span))

    # --- expressions ---

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
        before = self.events
        self.events = events and before
        try:
            return self.value(expression, scope or Scope())
        finally:
            self.events = before

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
                return self._reference(expression, scope)
            case ir.Binary():
                return self._binary(expression, scope)
            case ir.Unary():
                return self._unary(expression, scope)
            case ir.Builtin():
                return self._builtin(expression, scope)
            case ir.Call():
                outputs = self.call(expression, scope)
                return outputs[0] if len(outputs) == 1 else outputs
            case ir.If():
                return self._if(expression, scope)
            case ir.ArrayConstructor():
                return self._array(expression, scope)
            case ir.Range():
                return arrays.stack(self._range(expression, scope))
            case ir.Indexed(base=base, subscripts=subscripts):
                return self._indexed(self.value(base, scope), subscripts, scope, expression.span)
            case ir.FieldAccess(base=base, name=name):
                record = self.value(base, scope)
                if isinstance(record, tuple):
                    record = record[0]
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

    def _reference(self, reference: ir.Reference, scope: Scope) -> Value:
        value = self._look_up(reference, scope)
        return self._indexed(value, reference.subscripts, scope, reference.span) if reference.subscripts else value

    def _look_up(self, reference: ir.Reference, scope: Scope) -> Value:
        name = reference.name
        value = scope.find(name)
        if value is None:
            value = self._host.variable(name)
        if value is None:
            ordinal = self._model.enumeration_literals.get(name)
            if ordinal is not None:
                return ordinal
            if name == "time":
                return ex.symbol("time")
            value = self._walk(reference, scope)
        if value is None:
            raise self.wrong(f"there is no variable {name}", reference.span)
        return value

    def _walk(self, reference: ir.Reference, scope: Scope) -> Value | None:
        """Finds a component part by part: fields of local records, subscripts that are not literal."""
        path = ""
        value: Value | None = None
        parts = reference.parts
        if len(parts) == 1 and "." in parts[0][0]:
            parts = tuple((piece, ()) for piece in parts[0][0].split("."))
        for identifier, subscripts in parts:
            if isinstance(value, Record):
                value = value.fields.get(identifier)
                if value is not None and subscripts:
                    value = self._indexed(value, subscripts, scope, reference.span)
                continue
            path = f"{path}.{identifier}" if path else identifier
            value = scope.find(path)
            if value is None:
                value = self._host.variable(path)
            if value is not None:
                if subscripts:
                    value = self._indexed(value, subscripts, scope, reference.span)
            elif subscripts:
                numbers = [str(self.integer(self._subscript_value(item, scope), reference.span)) for item in subscripts]
                path += f"[{','.join(numbers)}]"
                value = self._host.variable(path)
        return value

    def _subscript_value(self, subscript: ir.Subscript, scope: Scope) -> Value:
        if isinstance(subscript, ir.Colon):
            raise self.unsupported("a slice of an array of components", None)
        return self.value(subscript, scope)

    def integer(self, value: Value, span: ir.Span | None) -> int:
        """A whole number that is needed at translation."""
        if isinstance(value, Node):
            value = self._host.constant(value, span, "an array size, index or loop bound")
        if isinstance(value, float | int) and float(value).is_integer():
            return int(value)
        raise self.wrong(f"a whole number is needed here, not {value!r}", span)

    def _indexed(self, value: Value, subscripts: tuple[ir.Subscript, ...], scope: Scope, span: ir.Span | None) -> Value:
        if not isinstance(value, np.ndarray):
            raise self.wrong("a scalar has subscripts", span)
        if len(subscripts) > value.ndim:
            raise self.wrong("there are more subscripts than dimensions", span)
        result: Value = value
        dimension = 0
        for position, subscript in enumerate(subscripts):
            assert isinstance(result, np.ndarray)
            if isinstance(subscript, ir.Colon):
                dimension += 1
                continue
            inner = Scope(scope)
            inner.values["end"] = value.shape[position]
            index = self.value(subscript, inner)
            if isinstance(index, np.ndarray):
                numbers = [self.checked(self.integer(item, span), value.shape[position], span) for item in index]
                result = np.take(result, numbers, axis=dimension)
                dimension += 1
                continue
            if isinstance(index, Node) and not self._is_constant(index, span):
                result = self._dynamic_element(result, index, dimension)
                continue
            number = self.checked(self.integer(index, span), value.shape[position], span)
            result = result[(slice(None),) * dimension + (number,)]
        return result

    def _is_constant(self, index: Node, span: ir.Span | None) -> bool:
        try:
            self._host.constant(index, span, "an index")
        except UnsupportedModelError:
            return False
        return True

    def _dynamic_element(self, value: arrays.Array, index: Node, dimension: int) -> Value:
        """An element whose index changes at run time."""
        size = value.shape[dimension]
        if size == 0:
            raise ShapeError("an element of an empty array")
        result: Value = np.take(value, size - 1, axis=dimension)
        for number in range(size - 1, 0, -1):
            item = np.take(value, number - 1, axis=dimension)
            result = arrays.elementwise(partial(ex.select, ex.equal(index, number)), item, result)
        return result

    def checked(self, index: int, size: int, span: ir.Span | None) -> int:
        """An index counted from 0; raises InputError outside of the array."""
        if not 1 <= index <= size:
            raise self.wrong(f"index {index} is outside of 1 to {size}", span)
        return index - 1

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

    def _relation(self, op: str, left: Value, right: Value, span: ir.Span | None) -> Value:
        if isinstance(left, str | Text) or isinstance(right, str | Text):
            first, second = self.text(left, span), self.text(right, span)
            return {"eq": first == second, "ne": first != second, "lt": first < second, "le": first <= second,
                    "gt": first > second, "ge": first >= second}[op]  # fmt: skip
        a, b = scalar_number(left), scalar_number(right)
        if self.events and op not in ("eq", "ne") and (isinstance(a, Node) or isinstance(b, Node)):
            return self._host.relation(op, a, b)
        return relation(op, a, b)

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
                    return self.merged(chosen, self.value(value, scope), self.value(otherwise, scope), expression.span)
                except (UnsupportedModelError, ShapeError) as error:
                    # A branch cannot be translated; it need not be if parameters alone decide.
                    return self.value(value if self._decided(chosen, error) else otherwise, scope)
            if chosen:
                return self.value(value, scope)
        return self.value(expression.otherwise, scope)

    def _decided(self, condition: Node, error: Exception) -> bool:
        """A condition that parameters decide, which can no longer be changed; raises ``error`` for others."""
        try:
            return bool(self._host.constant(condition, None, "a condition"))
        except UnsupportedModelError:
            raise error from None

    def merged(self, condition: Node, first: Value, second: Value, span: ir.Span | None = None) -> Value:
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
        start = self._constant_number(self.value(expression.start, scope), expression.span)
        stop = self._constant_number(self.value(expression.stop, scope), expression.span)
        step: float = 1
        if expression.step is not None:
            step = self._constant_number(self.value(expression.step, scope), expression.span)
        if step == 0:
            raise self.wrong("a range has step 0", expression.span)
        count = int(np.floor((stop - start) / step + 1e-10)) + 1
        if count > ITERATION_LIMIT:
            raise self.wrong(f"a range has {count} elements", expression.span)
        return [start + step * number for number in range(max(count, 0))]

    def _constant_number(self, value: Value, span: ir.Span | None) -> float:
        if isinstance(value, Node):
            value = self._host.constant(value, span, "a range")
        if isinstance(value, float | int):
            return value
        raise self.wrong(f"a number is needed here, not {value!r}", span)

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

    # --- strings ---

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
        if isinstance(value, Node):
            if not self._depends_on_parameters_only(value):
                return Text((value,))
            value = self._host.constant(value, expression.span, "a String")
            if float(value).is_integer() and self._is_whole(expression.value):
                value = int(value)
        text = self._formatted(value, digits, expression.value)
        return text.ljust(width) if left else text.rjust(width)

    def _depends_on_parameters_only(self, value: Node) -> bool:
        try:
            self._host.constant(value, None, "")
        except UnsupportedModelError:
            return False
        return True

    def _is_whole(self, expression: ir.Expression) -> bool:
        variable = self._model.variables.get(expression.name) if isinstance(expression, ir.Reference) else None
        return variable is not None and variable.type == "Integer"

    def _formatted(self, value: Value, digits: int, source: ir.Expression) -> str:
        if isinstance(value, bool):
            return "true" if value else "false"
        if isinstance(source, ir.Reference):
            literal = self._literal_name(source.name, value)
            if literal is not None:
                return literal
        if isinstance(value, int):
            return str(value)
        return f"{value:.{digits}g}"

    def _literal_name(self, name: str, value: Value) -> str | None:
        if name in self._model.enumeration_literals:
            return name.rsplit(".", 1)[-1]
        enumeration = self._host.enumeration_type(name)
        if enumeration is None:
            return None
        for literal, ordinal in self._model.enumeration_literals.items():
            if literal.rsplit(".", 1)[0] == enumeration and ordinal == value and not literal.endswith("'"):
                return literal.rsplit(".", 1)[-1]
        return None

    def text(self, value: Value, span: ir.Span | None) -> str:
        """A String that is needed at translation."""
        if isinstance(value, str):
            return value
        raise self.unsupported("a String that depends on variables", span)

    # --- built-in operators ---

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
        if name == "size":
            return self._size(expression, scope)
        args = [self.value(arg, scope) for arg in expression.args]
        if name == "initial":
            return ex.symbol("initial()")
        if name == "terminal":
            return ex.symbol("terminal()")
        if name == "der":
            return arrays.elementwise(lambda item: self._host.derivative(item, span), args[0])
        if name == "pre":
            return arrays.elementwise(lambda item: self._host.previous(item, span), args[0])
        if name == "edge":
            return arrays.elementwise(
                lambda item: ex.logical_and(item, ex.logical_not(self._host.previous(item, span))), args[0]
            )
        if name == "change":
            return arrays.elementwise(lambda item: ex.not_equal(item, self._host.previous(item, span)), args[0])
        if name == "sample":
            return self._host.sample(scalar_number(args[0]), scalar_number(args[1]), span)
        if name == "delay":
            longest = scalar_number(args[-1])  # the delay itself, if there are two arguments
            return arrays.elementwise(
                lambda item: self._host.delay(scalar_number(item), scalar_number(args[1]), longest, span), args[0]
            )
        if name == "semiLinear":
            x = scalar_number(args[0])
            positive = self._relation("ge", x, 0, span)
            assert isinstance(positive, bool | Node)
            return ex.multiply(ex.select(positive, scalar_number(args[1]), scalar_number(args[2])), x)
        if name in ("min", "max"):
            items = arrays.scalars(args[0]) if len(args) == 1 else args
            result = scalar_number(items[0])
            for item in items[1:]:
                result = ex.binary(name, result, scalar_number(item))
            return result
        if name in STEPPING and self.events and any(isinstance(arg, Node) for arg in args):
            return arrays.elementwise(partial(self._stepping, name), *args)
        if name == "integer":
            return arrays.elementwise(lambda item: whole_value(ex.unary("floor", item)), args[0])
        if name in ex.UNARY:
            return arrays.elementwise(lambda item: ex.unary(name, item), args[0])
        if name in ("mod", "rem"):
            return arrays.elementwise(lambda a, b: ex.binary(name, a, b), *args)
        if name == "div":
            return arrays.elementwise(lambda a, b: ex.binary("quotient", a, b), *args)
        if name == "atan2":
            return ex.binary("atan2", scalar_number(args[0]), scalar_number(args[1]))
        function = VALUE_FUNCTIONS.get(name)
        return self._sized(name, args, span) if function is None else function(args)

    def _sized(self, name: str, args: list[Value], span: ir.Span | None) -> Value:
        """Functions whose result has a size that an argument gives."""
        if name == "fill":
            value = args[0]
            assert not isinstance(value, np.ndarray | Record | tuple)
            return arrays.filled([self.integer(arg, span) for arg in args[1:]], value)
        if name in ("zeros", "ones"):
            return arrays.filled([self.integer(arg, span) for arg in args], 0 if name == "zeros" else 1)
        if name == "identity":
            return arrays.identity(self.integer(args[0], span))
        if name == "cat":
            return arrays.concatenate(self.integer(args[0], span), [array_value(arg) for arg in args[1:]])
        if name == "linspace":
            first, last, count = scalar_number(args[0]), scalar_number(args[1]), self.integer(args[2], span)
            step = ex.divide(ex.subtract(last, first), count - 1)
            return arrays.from_function((count,), lambda i: ex.add(first, ex.multiply(i, step)))
        raise self.unsupported(f"{name}()", span)

    def _stepping(self, name: str, x: Scalar, y: Scalar = 1) -> Scalar:
        """A function that jumps, with events."""
        a, b = scalar_number(x), scalar_number(y)
        if name == "ceil":
            return ex.negate(self._host.step("floor", ex.negate(a)))
        if name in ("floor", "integer"):
            return self._host.step("floor", a)
        quotient = self._host.step("floor" if name == "mod" else "quotient", ex.divide(a, b))
        return quotient if name == "div" else ex.subtract(a, ex.multiply(quotient, b))

    def _size(self, expression: ir.Builtin, scope: Scope) -> Value:
        value = self.value(expression.args[0], scope)
        shape = value.shape if isinstance(value, np.ndarray) else ()
        if len(expression.args) == 1:
            return arrays.stack(list(shape)) if shape else arrays.filled((0,), 0)
        dimension = self.integer(self.value(expression.args[1], scope), expression.span)
        if not 1 <= dimension <= len(shape):
            raise self.wrong(f"size() of dimension {dimension}, there are {len(shape)}", expression.span)
        return int(shape[dimension - 1])

    @abstractmethod
    def call(self, call: ir.Call, scope: Scope) -> tuple[Value, ...]:
        """The outputs of a function."""
