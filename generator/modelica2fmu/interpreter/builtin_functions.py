"""Built-in functions and operators of the language (Modelica 3.6, section 3.7) on evaluated arguments."""

from __future__ import annotations

from functools import partial

import numpy as np

from modelica2fmu.interpreter import arrays
from modelica2fmu.interpreter.arrays import Record, Scalar, Value
from modelica2fmu.interpreter.interpreter_host import Host
from modelica2fmu.interpreter.translation_values import TranslationValues
from modelica2fmu.interpreter.value_functions import (
    STEPPING,
    VALUE_FUNCTIONS,
    array_value,
    relation,
    scalar_number,
    whole_value,
)
from modelica2fmu.library.source_map import Span
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node


class BuiltinFunctions:
    """Calls built-in functions; those with events or derivatives ask the model.

    Args:
        host: see :class:`Host`.
        known: asks for what is needed at translation.
    """

    def __init__(self, host: Host, known: TranslationValues) -> None:
        self._host = host
        self._known = known

    def call(self, name: str, args: list[Value], events: bool, span: Span | None) -> Value:
        """The value of a function.

        Args:
            name: as in the language.
            args: its arguments.
            events: = true, if what jumps generates events.
            span: for the place in error messages.

        Raises:
            UnsupportedModelError: a function that is not translated.
            InputError: a size that is wrong.
            ShapeError: arguments that do not fit.
        """
        value = self._of_the_model(name, args, span)
        if value is None:
            value = self._of_numbers(name, args, events)
        return self._with_sizes(name, args, span) if value is None else value

    def relation(self, op: str, left: float | Node, right: float | Node, events: bool) -> bool | Node:
        """A relation of numbers; ``op`` is one of lt, le, gt, ge, eq, ne."""
        if events and op not in ("eq", "ne") and (isinstance(left, Node) or isinstance(right, Node)):
            return self._host.relation(op, left, right)
        return relation(op, left, right)

    def _of_the_model(self, name: str, args: list[Value], span: Span | None) -> Value | None:
        """Functions of what the model is at other times; ``None`` for others."""
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
        return None

    def _of_numbers(self, name: str, args: list[Value], events: bool) -> Value | None:
        """Functions of numbers and arrays; ``None`` for others."""
        if name == "semiLinear":
            x = scalar_number(args[0])
            positive = self.relation("ge", x, 0, events)
            return ex.multiply(ex.select(positive, scalar_number(args[1]), scalar_number(args[2])), x)
        if name in ("min", "max"):
            items = arrays.scalars(args[0]) if len(args) == 1 else args
            result = scalar_number(items[0])
            for item in items[1:]:
                result = ex.binary(name, result, scalar_number(item))
            return result
        if name in STEPPING and events and any(isinstance(arg, Node) for arg in args):
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
        return None if function is None else function(args)

    def _with_sizes(self, name: str, args: list[Value], span: Span | None) -> Value:
        """Functions of sizes: they ask for one, or an argument gives that of the result."""
        if name == "size":
            return self._size(args, span)
        if name == "fill":
            value = args[0]
            assert not isinstance(value, np.ndarray | Record | tuple)
            return arrays.filled([self._known.integer(arg, span) for arg in args[1:]], value)
        if name in ("zeros", "ones"):
            return arrays.filled([self._known.integer(arg, span) for arg in args], 0 if name == "zeros" else 1)
        if name == "identity":
            return arrays.identity(self._known.integer(args[0], span))
        if name == "cat":
            return arrays.concatenate(self._known.integer(args[0], span), [array_value(arg) for arg in args[1:]])
        if name == "linspace":
            first, last, count = scalar_number(args[0]), scalar_number(args[1]), self._known.integer(args[2], span)
            step = ex.divide(ex.subtract(last, first), count - 1)
            return arrays.from_function((count,), lambda i: ex.add(first, ex.multiply(i, step)))
        raise self._known.unsupported(f"{name}()", span)

    def _stepping(self, name: str, x: Scalar, y: Scalar = 1) -> Scalar:
        """A function that jumps, with events."""
        a, b = scalar_number(x), scalar_number(y)
        if name == "ceil":
            return ex.negate(self._host.step("floor", ex.negate(a)))
        if name in ("floor", "integer"):
            return self._host.step("floor", a)
        quotient = self._host.step("floor" if name == "mod" else "quotient", ex.divide(a, b))
        return quotient if name == "div" else ex.subtract(a, ex.multiply(quotient, b))

    def _size(self, args: list[Value], span: Span | None) -> Value:
        value = args[0]
        shape = value.shape if isinstance(value, np.ndarray) else ()
        if len(args) == 1:
            return arrays.stack(list(shape)) if shape else arrays.filled((0,), 0)
        dimension = self._known.integer(args[1], span)
        if not 1 <= dimension <= len(shape):
            raise self._known.wrong(f"size() of dimension {dimension}, there are {len(shape)}", span)
        return int(shape[dimension - 1])
