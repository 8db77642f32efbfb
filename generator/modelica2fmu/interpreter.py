"""Evaluates Modelica expressions and functions on values that may be symbolic.

One interpreter serves two purposes. With constant operands it computes: array sizes, String parameters,
everything Modelica evaluates at translation. With symbolic operands it expands: arrays become scalars, functions
are inlined, loops unrolled, and an if with a symbolic condition becomes a ``select`` (both branches are executed
and what they assign is merged).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any, Final, Protocol

import numpy as np
from cmb_base.errors import InputError, UnsupportedModelError

from modelica2fmu import arrays, ir
from modelica2fmu import expression as ex
from modelica2fmu.arrays import Record, Scalar, ShapeError, Text, Value
from modelica2fmu.expression import Node
from modelica2fmu.source_map import SourceMap
from modelica2fmu.string_functions import STRING_FUNCTIONS

_CALL_DEPTH_LIMIT: Final = 100
_ITERATION_LIMIT: Final = 1_000_000
_UNROLLING_LIMIT: Final = 200  # of while-loops that variables end


class Host(Protocol):
    """What the interpreter asks of the model around it."""

    def variable(self, name: str) -> Value | None:
        """The value of a variable, record, or ``None`` if there is none of this name."""
        ...

    def enumeration_type(self, name: str) -> str | None:
        """Name of the enumeration type of a variable, or ``None``."""
        ...

    def derivative(self, value: float | Node, span: ir.Span | None) -> float | Node:
        """``der(value)``."""
        ...

    def previous(self, value: float | Node, span: ir.Span | None) -> float | Node:
        """``pre(value)``."""
        ...

    def relation(self, op: str, left: float | Node, right: float | Node) -> bool | Node:
        """A relation that may generate events."""
        ...

    def step(self, op: str, value: float | Node) -> float | Node:
        """``floor`` of a value or, for ``quotient``, the value rounded towards zero, with events where it changes."""
        ...

    def sample(self, start: float | Node, interval: float | Node, span: ir.Span | None) -> bool | Node:
        """``sample(start, interval)``."""
        ...

    def external(self, function: ir.Function, args: Mapping[str, Value], span: ir.Span | None) -> tuple[Value, ...]:
        """The outputs of an external function."""
        ...

    def delay(
        self, value: float | Node, delay: float | Node, longest: float | Node, span: ir.Span | None
    ) -> float | Node:
        """``delay(value, delay, longest)``."""
        ...

    def constant(self, value: Node, span: ir.Span | None, purpose: str) -> float:
        """The number that ``value`` has at translation; raises UnsupportedModelError if it can change."""
        ...

    def function_assert(self, condition: Scalar, message: Scalar, is_warning: bool) -> None:
        """An assertion met while a function was inlined."""
        ...


class _Scope:
    """Local variables of a function call or of loops; looks outwards to the model if it is not a function."""

    def __init__(self, parent: _Scope | None = None) -> None:
        self.values: dict[str, Value | None] = {}
        self.parent = parent
        # A return- or break-statement was executed, or, if a node, may have been: then assignments keep old values.
        self.returned: bool | Node = False
        self.broken: bool | Node = False

    def branch(self) -> _Scope:
        """A copy for one branch of an if-statement."""
        result = _Scope(self.parent)
        result.values = dict(self.values)
        result.returned, result.broken = self.returned, self.broken
        return result

    @property
    def left(self) -> bool | Node:
        """What follows is not executed."""
        return ex.logical_or(self.returned, self.broken)

    def find(self, name: str) -> Value | None:
        scope: _Scope | None = self
        while scope is not None:
            if name in scope.values:
                return scope.values[name]
            scope = scope.parent
        return None


class Interpreter:
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
        self._events = True  # relations generate events: not inside noEvent, smooth and functions
        self._call_depth = 0
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

    def evaluate(self, expression: ir.Expression, scope: _Scope | None = None, events: bool = True) -> Value:
        """The value of an expression of the model.

        Args:
            expression: what to evaluate.
            scope: local variables, if any.
            events: = false, if its relations generate no events.

        Raises:
            UnsupportedModelError: a construct that is not translated.
            InputError: operands that do not fit.
        """
        before = self._events
        self._events = events and before
        try:
            return self._value(expression, scope or _Scope())
        finally:
            self._events = before

    def _value(self, expression: ir.Expression, scope: _Scope) -> Value:
        try:
            return self._dispatch(expression, scope)
        except ShapeError as error:
            raise self.wrong(str(error), expression.span) from error

    def _dispatch(self, expression: ir.Expression, scope: _Scope) -> Value:
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
                outputs = self._call(expression, scope)
                return outputs[0] if len(outputs) == 1 else outputs
            case ir.If():
                return self._if(expression, scope)
            case ir.ArrayConstructor():
                return self._array(expression, scope)
            case ir.Range():
                return arrays.stack(self._range(expression, scope))
            case ir.Indexed(base=base, subscripts=subscripts):
                return self._indexed(self._value(base, scope), subscripts, scope, expression.span)
            case ir.FieldAccess(base=base, name=name):
                record = self._value(base, scope)
                if isinstance(record, tuple):
                    record = record[0]
                if isinstance(record, Record) and name in record.fields:
                    return self._known(record.fields[name])
                raise self.wrong(f"there is no field {name}", expression.span)
            case ir.Comprehension():
                return self._comprehension(expression, 0, scope)
            case ir.StringConversion():
                return self._string(expression, scope)
            case ir.TupleExpression(elements=elements):
                return tuple(None if item is None else self._value(item, scope) for item in elements)
        raise AssertionError(f"unknown expression {expression}")

    @staticmethod
    def _known(value: Value | None) -> Value:
        assert value is not None
        return value

    def _reference(self, reference: ir.Reference, scope: _Scope) -> Value:
        value = self._look_up(reference, scope)
        return self._indexed(value, reference.subscripts, scope, reference.span) if reference.subscripts else value

    def _look_up(self, reference: ir.Reference, scope: _Scope) -> Value:
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

    def _walk(self, reference: ir.Reference, scope: _Scope) -> Value | None:
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
                numbers = [
                    str(self._integer(self._subscript_value(item, scope), reference.span)) for item in subscripts
                ]
                path += f"[{','.join(numbers)}]"
                value = self._host.variable(path)
        return value

    def _subscript_value(self, subscript: ir.Subscript, scope: _Scope) -> Value:
        if isinstance(subscript, ir.Colon):
            raise self.unsupported("a slice of an array of components", None)
        return self._value(subscript, scope)

    def _integer(self, value: Value, span: ir.Span | None) -> int:
        """A whole number that is needed at translation."""
        if isinstance(value, Node):
            value = self._host.constant(value, span, "an array size, index or loop bound")
        if isinstance(value, float | int) and float(value).is_integer():
            return int(value)
        raise self.wrong(f"a whole number is needed here, not {value!r}", span)

    def _indexed(
        self, value: Value, subscripts: tuple[ir.Subscript, ...], scope: _Scope, span: ir.Span | None
    ) -> Value:
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
            inner = _Scope(scope)
            inner.values["end"] = value.shape[position]
            index = self._value(subscript, inner)
            if isinstance(index, np.ndarray):
                numbers = [self._checked(self._integer(item, span), value.shape[position], span) for item in index]
                result = np.take(result, numbers, axis=dimension)
                dimension += 1
                continue
            if isinstance(index, Node) and not self._is_constant(index, span):
                result = self._dynamic_element(result, index, dimension)
                continue
            number = self._checked(self._integer(index, span), value.shape[position], span)
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

    def _checked(self, index: int, size: int, span: ir.Span | None) -> int:
        if not 1 <= index <= size:
            raise self.wrong(f"index {index} is outside of 1 to {size}", span)
        return index - 1

    def _binary(self, expression: ir.Binary, scope: _Scope) -> Value:
        left = self._value(expression.left, scope)
        op = expression.op
        if op == "And" and left is False:
            return False
        if op == "Or" and left is True:
            return True
        right = self._value(expression.right, scope)
        if op in ("Add", "AddElem") and (isinstance(left, str | Text) or isinstance(right, str | Text)):
            return _concatenated(left, right)
        relation = _RELATIONS.get(op)
        if relation is not None:
            return self._relation(relation, left, right, expression.span)
        if op == "Mul":
            return arrays.multiply(left, right)
        if op == "Exp":
            if isinstance(left, np.ndarray):
                return arrays.matrix_power(left, self._integer(right, expression.span))
            return ex.power(_number(left), _number(right))
        if op == "Div" and isinstance(right, np.ndarray):
            raise self.wrong("a division by an array", expression.span)
        if op in ("Add", "Sub") and isinstance(left, np.ndarray) != isinstance(right, np.ndarray):
            raise self.wrong("a sum of a scalar and an array", expression.span)
        function = _ELEMENTWISE.get(op)
        if function is None:
            raise self.unsupported(f"the operator {op}", expression.span)
        return arrays.elementwise(function, left, right)

    def _relation(self, op: str, left: Value, right: Value, span: ir.Span | None) -> Value:
        if isinstance(left, str | Text) or isinstance(right, str | Text):
            first, second = self.text(left, span), self.text(right, span)
            return {"eq": first == second, "ne": first != second, "lt": first < second, "le": first <= second,
                    "gt": first > second, "ge": first >= second}[op]  # fmt: skip
        a, b = _number(left), _number(right)
        if self._events and op not in ("eq", "ne") and (isinstance(a, Node) or isinstance(b, Node)):
            return self._host.relation(op, a, b)
        return relation(op, a, b)

    def _unary(self, expression: ir.Unary, scope: _Scope) -> Value:
        operand = self._value(expression.operand, scope)
        if expression.op in ("Minus", "DotMinus", "MinusElem"):
            return arrays.elementwise(ex.negate, operand)
        if expression.op == "Not":
            return arrays.elementwise(ex.logical_not, operand)
        if expression.op in ("Plus", "DotPlus", "PlusElem"):
            return operand
        raise self.unsupported(f"the operator {expression.op}", expression.span)

    def _if(self, expression: ir.If, scope: _Scope) -> Value:
        for position, (condition, value) in enumerate(expression.branches):
            chosen = self._value(condition, scope)
            if isinstance(chosen, Node):
                rest = expression.branches[position + 1 :]
                otherwise = ir.If(rest, expression.otherwise, expression.span) if rest else expression.otherwise
                try:
                    return self._merged(
                        chosen, self._value(value, scope), self._value(otherwise, scope), expression.span
                    )
                except (UnsupportedModelError, ShapeError) as error:
                    # A branch cannot be translated; it need not be if parameters alone decide.
                    return self._value(value if self._decided(chosen, error) else otherwise, scope)
            if chosen:
                return self._value(value, scope)
        return self._value(expression.otherwise, scope)

    def _decided(self, condition: Node, error: Exception) -> bool:
        """A condition that parameters decide, which can no longer be changed; raises ``error`` for others."""
        try:
            return bool(self._host.constant(condition, None, "a condition"))
        except UnsupportedModelError:
            raise error from None

    def _merged(self, condition: Node, first: Value, second: Value, span: ir.Span | None = None) -> Value:
        if isinstance(first, Record) and isinstance(second, Record):
            return Record(
                {name: self._merged(condition, item, second.fields[name]) for name, item in first.fields.items()}
            )
        if isinstance(first, tuple) and isinstance(second, tuple):
            return tuple(self._merged(condition, a, b) for a, b in zip(first, second, strict=True))
        if isinstance(first, str | Text) or isinstance(second, str | Text):
            if first == second:
                return first
            chosen = self._host.constant(condition, span, "the choice of a String")
            return first if chosen else second
        return arrays.elementwise(lambda a, b: ex.select(condition, a, b), first, second)

    def _array(self, expression: ir.ArrayConstructor, scope: _Scope) -> Value:
        values = [self._value(element, scope) for element in expression.elements]
        if expression.kind is ir.Concatenation.ARRAY:
            return arrays.stack(values)
        dimensions = max([2, *(value.ndim for value in values if isinstance(value, np.ndarray))])
        matrices = [arrays.promoted(value, dimensions) for value in values]
        return arrays.concatenate(2 if expression.kind is ir.Concatenation.HORIZONTAL else 1, matrices)

    def _range(self, expression: ir.Range, scope: _Scope) -> list[Scalar]:
        start = self._constant_number(self._value(expression.start, scope), expression.span)
        stop = self._constant_number(self._value(expression.stop, scope), expression.span)
        step: float = 1
        if expression.step is not None:
            step = self._constant_number(self._value(expression.step, scope), expression.span)
        if step == 0:
            raise self.wrong("a range has step 0", expression.span)
        count = int(np.floor((stop - start) / step + 1e-10)) + 1
        if count > _ITERATION_LIMIT:
            raise self.wrong(f"a range has {count} elements", expression.span)
        return [start + step * number for number in range(max(count, 0))]

    def _constant_number(self, value: Value, span: ir.Span | None) -> float:
        if isinstance(value, Node):
            value = self._host.constant(value, span, "a range")
        if isinstance(value, float | int):
            return value
        raise self.wrong(f"a number is needed here, not {value!r}", span)

    def _comprehension(self, expression: ir.Comprehension, position: int, scope: _Scope) -> Value:
        # Modelica's {e for i in I, j in J} is {{e for i in I} for j in J}: the last index is the outermost.
        name, domain = expression.indices[len(expression.indices) - 1 - position]
        values = []
        for item in self._iterated(domain, scope):
            inner = _Scope(scope)
            inner.values[name] = item
            if position + 1 < len(expression.indices):
                values.append(self._comprehension(expression, position + 1, inner))
            else:
                values.append(self._value(expression.expression, inner))
        return arrays.stack(values)

    def _iterated(self, domain: ir.Expression, scope: _Scope) -> list[Value]:
        if isinstance(domain, ir.Range):
            return list(self._range(domain, scope))
        value = self._value(domain, scope)
        if not isinstance(value, np.ndarray):
            raise self.wrong("a loop runs over something that is no array", domain.span)
        return list(value)

    # --- strings ---

    def _string(self, expression: ir.StringConversion, scope: _Scope) -> Value:
        value = self._value(expression.value, scope)
        if isinstance(value, str | Text):
            return value
        digits = 6
        if expression.significant_digits is not None:
            digits = self._integer(self._value(expression.significant_digits, scope), expression.span)
        width, left = 0, True
        if expression.minimum_length is not None:
            width = self._integer(self._value(expression.minimum_length, scope), expression.span)
        if expression.left_justified is not None:
            left = bool(self._value(expression.left_justified, scope))
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

    def _builtin(self, expression: ir.Builtin, scope: _Scope) -> Value:
        name, span = expression.name, expression.span
        if name in ("noEvent", "smooth"):
            before, self._events = self._events, False
            try:
                return self._value(expression.args[-1], scope)
            finally:
                self._events = before
        if name == "homotopy":
            return self._value(expression.args[0], scope)
        if name == "size":
            return self._size(expression, scope)
        args = [self._value(arg, scope) for arg in expression.args]
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
            return self._host.sample(_number(args[0]), _number(args[1]), span)
        if name == "delay":
            longest = _number(args[-1])  # the delay itself, if there are two arguments
            return arrays.elementwise(
                lambda item: self._host.delay(_number(item), _number(args[1]), longest, span), args[0]
            )
        if name == "semiLinear":
            x = _number(args[0])
            positive = self._relation("ge", x, 0, span)
            assert isinstance(positive, bool | Node)
            return ex.multiply(ex.select(positive, _number(args[1]), _number(args[2])), x)
        if name in ("min", "max"):
            items = arrays.scalars(args[0]) if len(args) == 1 else args
            result = _number(items[0])
            for item in items[1:]:
                result = ex.binary(name, result, _number(item))
            return result
        if name in _STEPPING and self._events and any(isinstance(arg, Node) for arg in args):
            return arrays.elementwise(partial(self._stepping, name), *args)
        if name == "integer":
            return arrays.elementwise(lambda item: _whole(ex.unary("floor", item)), args[0])
        if name in ex.UNARY:
            return arrays.elementwise(lambda item: ex.unary(name, item), args[0])
        if name in ("mod", "rem"):
            return arrays.elementwise(lambda a, b: ex.binary(name, a, b), *args)
        if name == "div":
            return arrays.elementwise(lambda a, b: ex.binary("quotient", a, b), *args)
        if name == "atan2":
            return ex.binary("atan2", _number(args[0]), _number(args[1]))
        function = _VALUE_FUNCTIONS.get(name)
        return self._sized(name, args, span) if function is None else function(args)

    def _sized(self, name: str, args: list[Value], span: ir.Span | None) -> Value:
        """Functions whose result has a size that an argument gives."""
        if name == "fill":
            value = args[0]
            assert not isinstance(value, np.ndarray | Record | tuple)
            return arrays.filled([self._integer(arg, span) for arg in args[1:]], value)
        if name in ("zeros", "ones"):
            return arrays.filled([self._integer(arg, span) for arg in args], 0 if name == "zeros" else 1)
        if name == "identity":
            return arrays.identity(self._integer(args[0], span))
        if name == "cat":
            return arrays.concatenate(self._integer(args[0], span), [_array(arg) for arg in args[1:]])
        if name == "linspace":
            first, last, count = _number(args[0]), _number(args[1]), self._integer(args[2], span)
            step = ex.divide(ex.subtract(last, first), count - 1)
            return arrays.from_function((count,), lambda i: ex.add(first, ex.multiply(i, step)))
        raise self.unsupported(f"{name}()", span)

    def _stepping(self, name: str, x: Scalar, y: Scalar = 1) -> Scalar:
        """A function that jumps, with events."""
        a, b = _number(x), _number(y)
        if name == "ceil":
            return ex.negate(self._host.step("floor", ex.negate(a)))
        if name in ("floor", "integer"):
            return self._host.step("floor", a)
        quotient = self._host.step("floor" if name == "mod" else "quotient", ex.divide(a, b))
        return quotient if name == "div" else ex.subtract(a, ex.multiply(quotient, b))

    def _size(self, expression: ir.Builtin, scope: _Scope) -> Value:
        value = self._value(expression.args[0], scope)
        shape = value.shape if isinstance(value, np.ndarray) else ()
        if len(expression.args) == 1:
            return arrays.stack(list(shape)) if shape else arrays.filled((0,), 0)
        dimension = self._integer(self._value(expression.args[1], scope), expression.span)
        if not 1 <= dimension <= len(shape):
            raise self.wrong(f"size() of dimension {dimension}, there are {len(shape)}", expression.span)
        return int(shape[dimension - 1])

    # --- functions ---

    def _call(self, call: ir.Call, scope: _Scope) -> tuple[Value, ...]:
        function = self._model.functions.get(call.name)
        if function is None:
            builtin = call.name.rsplit(".", 1)[-1]
            if call.name in ("Modelica.Math." + builtin, builtin) and builtin in ex.UNARY:
                return (ex.unary(builtin, _number(self._value(call.args[0], scope))),)
            raise self.unsupported(f"the function {call.name}", call.span)
        args = [self._value(arg, scope) for arg in call.args]
        return self._invoke(function, args, call.span)

    def _invoke(self, function: ir.Function, args: list[Value], span: ir.Span | None) -> tuple[Value, ...]:
        if self._call_depth >= _CALL_DEPTH_LIMIT:
            raise self.unsupported(f"a recursion deeper than {_CALL_DEPTH_LIMIT} in {function.name}", span)
        local = _Scope()
        for position, variable in enumerate(function.inputs):
            if position < len(args):
                local.values[variable.name] = args[position]
            elif variable.default is not None:
                local.values[variable.name] = self._value(variable.default, local)
            else:
                raise self.wrong(f"{function.name} is called without {variable.name}", span)
        if function.is_constructor:
            return (Record({variable.name: self._known(local.values[variable.name]) for variable in function.inputs}),)
        before, self._events = self._events, False
        self._call_depth += 1
        try:
            for variable in (*function.locals, *function.outputs):
                local.values[variable.name] = self._initial_value(variable, local)
            if function.external is not None:
                return self._external(function, local, span)
            self._execute(function.body, local)
        finally:
            self._call_depth -= 1
            self._events = before
        outputs = []
        for variable in function.outputs:
            value = local.values[variable.name]
            if value is None:
                raise self.wrong(f"{function.name} does not assign its output {variable.name}", function.span)
            outputs.append(value)
        return tuple(outputs)

    def _external(self, function: ir.Function, local: _Scope, span: ir.Span | None) -> tuple[Value, ...]:
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

    def _mathematical(self, function: ir.Function, local: _Scope, span: ir.Span | None) -> Value:
        """A function that only gives one of the language's own a second name, like those of Modelica.Math."""
        assert function.external is not None
        name = function.external.name
        args = [_number(self._value(arg, local)) for arg in function.external.args]
        if len(args) == 1 and name in ex.UNARY:
            return ex.unary(name, args[0])
        if len(args) == 2 and name in ex.BINARY:
            return ex.binary(name, *args)
        raise self.unsupported(f"the built-in function {name} of {function.name}", span)

    def _initial_value(self, variable: ir.FunctionVariable, local: _Scope) -> Value | None:
        if variable.default is not None:
            return self._value(variable.default, local)
        record = self._constructors.get(variable.type)
        if variable.is_record or record is not None:
            return Record(dict.fromkeys(record.fields)) if record is not None else None
        if not variable.shape:
            return None
        if any(isinstance(item, ir.Colon) for item in variable.shape):
            return None
        sizes = [
            self._integer(self._value(item, local), None) for item in variable.shape if not isinstance(item, ir.Colon)
        ]
        return arrays.filled(sizes, "" if variable.type == "String" else 0)

    def function_shape(self, variable: ir.FunctionVariable, values: Mapping[str, Value]) -> tuple[int, ...]:
        """The shape of an output of an external function for given inputs."""
        local = _Scope()
        local.values.update(values)
        return tuple(self._integer(self._subscript_value(subscript, local), None) for subscript in variable.shape)

    def evaluate_in_function(self, expression: ir.Expression, values: Mapping[str, Value]) -> Value:
        """The value of an expression inside a function with the given local variables."""
        local = _Scope()
        local.values.update(values)
        return self.evaluate(expression, local, events=False)

    # --- statements ---

    def execute_algorithm(
        self, statements: tuple[ir.Statement, ...], values: dict[str, Value | None], events: bool
    ) -> dict[str, Value | None]:
        """Runs a model's algorithm (without when) on ``values`` and returns them as they are at its end."""
        before = self._events
        self._events = events
        scope = _Scope()
        scope.values = dict(values)
        try:
            self._execute(statements, scope)
        finally:
            self._events = before
        return scope.values

    def _execute(self, statements: tuple[ir.Statement, ...], scope: _Scope) -> None:
        for statement in statements:
            if scope.left is True:
                return
            self._statement(statement, scope)

    def _statement(self, statement: ir.Statement, scope: _Scope) -> None:
        match statement:
            case ir.Assignment(target=target, value=value):
                self._assign(target, self._value(value, scope), scope)
            case ir.CallAssignment(targets=targets, call=call):
                outputs = self._call(call, scope)
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
                text = self._value(message, scope)
                assert isinstance(text, str | Text)
                checked = self._value(condition, scope)
                assert isinstance(checked, bool | int | float | Node)
                if scope.left is False:
                    self._host.function_assert(checked, text, is_warning)
            case ir.Return():
                scope.returned = True
            case ir.Break():
                scope.broken = True
            case _:
                raise self.unsupported(f"{type(statement).__name__} here", statement.span)

    def _assign(self, target: ir.Reference, value: Value, scope: _Scope) -> None:
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
        old = scope.values[name]
        scope.values[name] = self._unless_left(scope, old, self._with_element(old, target, value, scope))

    def _unless_left(self, scope: _Scope, old: Value | None, new: Value) -> Value | None:
        """The new value, or the old one where a return or break was executed before."""
        left = scope.left
        return self._merged_local(left, old, new) if isinstance(left, Node) else new

    def _with_element(self, old: Value | None, target: ir.Reference, value: Value, scope: _Scope) -> Value:
        if not target.subscripts:
            return value.copy() if isinstance(value, np.ndarray) else value
        if not isinstance(old, np.ndarray):
            raise self.unsupported("an assignment to elements of an array of unknown size", target.span)
        result = old.copy()
        index: list[Any] = []
        for position, subscript in enumerate(target.subscripts):
            if isinstance(subscript, ir.Colon):
                index.append(slice(None))
                continue
            inner = _Scope(scope)
            inner.values["end"] = old.shape[position]
            item = self._value(subscript, inner)
            if isinstance(item, np.ndarray):
                index.append(
                    [self._checked(self._integer(n, target.span), old.shape[position], target.span) for n in item]
                )
            else:
                index.append(self._checked(self._integer(item, target.span), old.shape[position], target.span))
        result[tuple(index)] = value
        return result

    def _if_statement(
        self,
        branches: tuple[tuple[ir.Expression, tuple[ir.Statement, ...]], ...],
        otherwise: tuple[ir.Statement, ...],
        scope: _Scope,
    ) -> None:
        for position, (condition, body) in enumerate(branches):
            chosen = self._value(condition, scope)
            if not isinstance(chosen, Node):
                if chosen:
                    self._execute(body, scope)
                    return
                continue
            first, second = scope.branch(), scope.branch()
            self._execute(body, first)
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
        return self._merged(condition, first, second)

    def _for(
        self, indices: tuple[tuple[str, ir.Expression], ...], body: tuple[ir.Statement, ...], scope: _Scope
    ) -> None:
        name, domain = indices[0]
        hidden = scope.values.get(name)
        was_there = name in scope.values
        outer, scope.broken = scope.broken, False
        try:
            for item in self._iterated(domain, scope):
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

    def _while(self, statement: ir.While, scope: _Scope) -> None:
        outer, scope.broken = scope.broken, False
        self._iterate(statement, scope, 0)
        scope.broken = outer

    def _iterate(self, statement: ir.While, scope: _Scope, unrolled: int) -> None:
        """Runs a while-loop from here on.

        If its condition is a node, both ways are followed: the loop ends where, on the way on which it always went on,
        the condition becomes a constant (a counter passes its limit).
        """
        for _ in range(_ITERATION_LIMIT):
            if scope.left is True:
                return
            condition = self._value(statement.condition, scope)
            if isinstance(condition, Node):
                if unrolled >= _UNROLLING_LIMIT:
                    raise self.unsupported(
                        f"a while-loop that variables end and that may run more than {_UNROLLING_LIMIT} times",
                        statement.span,
                    )
                on = scope.branch()
                self._execute(statement.body, on)
                self._iterate(statement, on, unrolled + 1)
                for name in scope.values:
                    scope.values[name] = self._merged_local(condition, on.values[name], scope.values[name])
                scope.returned = _either(condition, on.returned, scope.returned)
                return
            if not condition:
                return
            self._execute(statement.body, scope)
        raise self.wrong(f"a while-loop runs more than {_ITERATION_LIMIT} times", statement.span)


def _either(condition: Node, first: bool | Node, second: bool | Node) -> bool | Node:
    """``first`` where the condition holds, else ``second``."""
    return (
        ex.logical_or(ex.logical_and(condition, first), ex.logical_and(ex.logical_not(condition), second))
        if first is not second
        else first
    )


def relation(op: str, a: float | Node, b: float | Node) -> bool | Node:
    """The relation ``a op b`` as it is; ``op`` is one of lt, le, gt, ge, eq, ne."""
    if op == "lt":
        return ex.less(a, b)
    if op == "le":
        return ex.less_equal(a, b)
    if op == "gt":
        return ex.less(b, a)
    if op == "ge":
        return ex.less_equal(b, a)
    return ex.equal(a, b) if op == "eq" else ex.not_equal(a, b)


def _number(value: Value) -> float | Node:
    if isinstance(value, float | int | Node):
        return value
    if isinstance(value, np.ndarray) and value.size == 1:
        return _number(value.reshape(-1)[0])
    raise ShapeError("a scalar number is needed here")


def _whole(value: float | Node) -> float | Node:
    return value if isinstance(value, Node) else int(value)


def _concatenated(left: Value, right: Value) -> Value:
    parts: list[str | Node] = []
    for value in (left, right):
        if isinstance(value, Text):
            parts.extend(value.parts)
        elif isinstance(value, str | Node):
            parts.append(value)
        else:
            parts.append(str(value))
    if all(isinstance(part, str) for part in parts):
        return "".join(part for part in parts if isinstance(part, str))
    return Text(tuple(parts))


_RELATIONS: Final = {"Lt": "lt", "Le": "le", "Gt": "gt", "Ge": "ge", "Eq": "eq", "Neq": "ne", "Ne": "ne"}
_STEPPING: Final = frozenset({"floor", "ceil", "integer", "div", "mod", "rem"})
_ELEMENTWISE: Final[dict[str, Callable[..., Scalar]]] = {
    "Add": ex.add, "Sub": ex.subtract, "Div": ex.divide, "AddElem": ex.add, "SubElem": ex.subtract,
    "MulElem": ex.multiply, "DivElem": ex.divide, "ExpElem": ex.power, "And": ex.logical_and, "Or": ex.logical_or,
}  # fmt: skip


def _array(value: Value) -> arrays.Array:
    if isinstance(value, np.ndarray):
        return value
    raise ShapeError("an array is needed here")


_VALUE_FUNCTIONS: Final[dict[str, Callable[[list[Value]], Value]]] = {
    "sum": lambda args: arrays.total(args[0]),
    "product": lambda args: arrays.product(args[0]),
    "ndims": lambda args: args[0].ndim if isinstance(args[0], np.ndarray) else 0,
    "scalar": lambda args: _number(args[0]),
    "vector": lambda args: arrays.stack(arrays.scalars(args[0])),
    "matrix": lambda args: arrays.promoted(args[0], 2),
    "diagonal": lambda args: arrays.diagonal(_array(args[0])),
    "transpose": lambda args: _array(args[0]).swapaxes(0, 1),
    "outerProduct": lambda args: arrays.outer_product(_array(args[0]), _array(args[1])),
    "symmetric": lambda args: arrays.symmetric(_array(args[0])),
    "cross": lambda args: arrays.cross(_array(args[0]), _array(args[1])),
    "skew": lambda args: arrays.skew(_array(args[0])),
}
