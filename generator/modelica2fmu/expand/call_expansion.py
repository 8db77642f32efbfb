"""Expands calls of external functions: their outputs become symbols of the scalar model."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from contact_foundation.errors import UnsupportedModelError

from modelica2fmu.expand.scalar_model import CallArgument, ExternalCall, Kind, ScalarModel, ScalarVariable
from modelica2fmu.expand.scalar_values import (
    BASE_TYPES,
    as_float,
    element_names,
    is_fixed_while_simulating,
    only_parameters,
)
from modelica2fmu.expand.tables import Tables, is_table_function
from modelica2fmu.frontend import ir
from modelica2fmu.interpreter import arrays
from modelica2fmu.interpreter.arrays import Record, Text, Value
from modelica2fmu.interpreter.interpreter import Interpreter
from modelica2fmu.library.source_map import SourceMap, Span
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node


class CallExpansion:
    """Adds external calls to a scalar model, equal ones once.

    Args:
        result: the model that is made.
        interpreter: evaluates sizes and arguments.
        source_map: for the places in error messages.
        files: the file that a name in the model means.
        constant: the number that an expression has at translation (``Host.constant``).
        is_enumeration: = true for names of enumeration types.
    """

    def __init__(
        self,
        result: ScalarModel,
        interpreter: Interpreter,
        source_map: SourceMap,
        files: Callable[[str], Path],
        constant: Callable[[Node, Span | None, str], float],
        is_enumeration: Callable[[str], bool],
    ) -> None:
        self._result = result
        self._interpreter = interpreter
        self._source_map = source_map
        self._files = files
        self._constant = constant
        self._is_enumeration = is_enumeration
        self._calls: dict[tuple[Any, ...], tuple[Value, ...]] = {}
        self._delays: dict[tuple[float | Node, ...], int] = {}

    def external(self, function: ir.Function, args: Mapping[str, Value], span: Span | None) -> tuple[Value, ...]:
        """The outputs of an external function, as symbols; see :class:`interpreter_host.Host`."""
        external = function.external
        assert external is not None
        if is_table_function(external.name):
            return self._table(function, args, span)
        for variable in (*function.inputs, *function.outputs):
            is_known = variable.type in BASE_TYPES or variable.is_record or self._is_enumeration(variable.type)
            if not is_known and variable.type.rsplit(".", 1)[-1] not in BASE_TYPES:
                # Neither a number nor an enumeration: a pointer that the equations cannot carry.
                raise UnsupportedModelError(
                    f"the external object {variable.type} of the function {function.name} is not translated",
                    place=self._source_map.place(span or function.span),
                    remedy="use a function of arrays, as tables can be written, or blocks without external objects",
                )
        key = (
            function.name,
            *((name.name, tuple(arrays.scalars(args[name.name]))) for name in function.inputs),
        )
        known = self._calls.get(key)
        if known is not None:
            return known
        number = len(self._result.calls) + 1
        outputs: dict[str, Value] = {}
        for variable in function.outputs:
            shape = self._interpreter.function_shape(variable, args)
            names = element_names(f"$call[{number}].{variable.name}", shape)
            outputs[variable.name] = (
                arrays.stack([ex.symbol(name) for name in names]).reshape(shape) if shape else ex.symbol(names[0])
            )
            if variable.type == "String":
                raise UnsupportedModelError(
                    f"the String output {variable.name} of the external function {function.name} is not translated",
                    place=self._source_map.place(function.span),
                )
        arguments = tuple(self._argument(function, argument, args, outputs) for argument in external.args)
        inputs = [
            item for argument in arguments if not argument.is_output for item in argument.values
            if isinstance(item, Node)
        ]  # fmt: skip
        of_parameters = all(only_parameters(self._result, item) for item in inputs)
        is_whole = {variable.name: variable.type != "Real" for variable in function.outputs}
        for variable in function.outputs:
            for item in arrays.scalars(outputs[variable.name]):
                assert isinstance(item, Node)
                if of_parameters:
                    kind = Kind.PARAMETER
                else:
                    kind = Kind.DISCRETE if is_whole[variable.name] else Kind.CONTINUOUS
                type_name = variable.type if variable.type in BASE_TYPES else "Integer"
                self._result.variables[item.name] = ScalarVariable(item.name, type_name, kind, value=item)
        result = None
        if external.result is not None:
            (node,) = arrays.scalars(outputs[external.result])
            assert isinstance(node, Node)
            result = (node.name, self._result.variables[node.name].type)
        call = ExternalCall(
            number=number,
            function=function.name,
            symbol=external.name,
            args=arguments,
            result=result,
            outputs=tuple(
                item.name for value in outputs.values() for item in arrays.scalars(value) if isinstance(item, Node)
            ),
            has_prototype=any(name == "Include" for name, _ in external.annotations),
            span=span,
        )
        self._result.calls.append(call)
        for annotation in external.annotations:
            if annotation not in self._result.external_annotations:
                self._result.external_annotations.append(annotation)
        value = tuple(outputs[variable.name] for variable in function.outputs)
        self._calls[key] = value
        return value

    def _table(self, function: ir.Function, args: Mapping[str, Value], span: Span | None) -> tuple[Value, ...]:
        """A function of the Standard Library's tables."""

        def number(value: Value) -> float:
            return self._constant(value, span, "the data of a table") if isinstance(value, Node) else as_float(value)

        def lookup(symbol: str, arguments: Sequence[CallArgument]) -> Node:
            return self.lookup(function.name, symbol, tuple(arguments), span)

        assert function.external is not None
        return Tables(lookup, number, self._files).call(function.external.name, args)

    def lookup(self, function: str, symbol: str, arguments: tuple[CallArgument, ...], span: Span | None) -> Node:
        """The result of a call of a function of the runtime, made once for equal arguments."""
        key = (symbol, arguments)
        known = self._calls.get(key)
        if known is not None:
            (value,) = known
            assert isinstance(value, Node)
            return value
        number = len(self._result.calls) + 1
        result = ex.symbol(f"$call[{number}].y")
        inputs = [item for argument in arguments for item in argument.values if isinstance(item, Node)]
        kind = Kind.PARAMETER if all(only_parameters(self._result, item) for item in inputs) else Kind.CONTINUOUS
        self._result.variables[result.name] = ScalarVariable(result.name, "Real", kind, value=result)
        self._result.calls.append(
            ExternalCall(number, function, symbol, arguments, (result.name, "Real"), (result.name,), True, span)
        )
        header = ("Include", (f'#include "{"fmurt_delay.h" if symbol == "fmurt_delay" else "fmurt_table.h"}"',))
        if header not in self._result.external_annotations:
            self._result.external_annotations.append(header)
        self._calls[key] = (result,)
        return result

    def delay(self, value: float | Node, delay: float | Node, longest: float | Node, span: Span | None) -> float | Node:
        """See :class:`interpreter_host.Host`; a call of the runtime, which keeps the history."""
        if not isinstance(value, Node) or only_parameters(self._result, value):
            return value
        if isinstance(longest, Node) and not is_fixed_while_simulating(self._result, longest):
            raise UnsupportedModelError(
                "delay() with a delay that changes and no longest one is not translated",
                place=self._source_map.place(span),
                remedy="give the longest delay as third argument",
            )
        key = (value, delay, longest)
        number = self._delays.setdefault(key, len(self._delays))
        reals = (CallArgument("Real", (item,), is_array=False, is_output=False) for item in key)
        position = CallArgument("Integer", (number,), is_array=False, is_output=False)
        instance = CallArgument("Instance", (), is_array=False, is_output=False)
        return self.lookup("delay", "fmurt_delay", (instance, position, *reals), span)

    def _argument(
        self,
        function: ir.Function,
        expression: ir.Expression,
        args: Mapping[str, Value],
        outputs: Mapping[str, Value],
    ) -> CallArgument:
        if isinstance(expression, ir.Builtin) and expression.name == "size":
            size = self._interpreter.evaluate_in_function(expression, {**args, **outputs})
            return CallArgument("size", (int(as_float(size)),), is_array=False, is_output=False)
        types = {variable.name: variable for variable in (*function.inputs, *function.outputs, *function.locals)}
        name = expression.name if isinstance(expression, ir.Reference) and not expression.subscripts else ""
        if name in outputs:
            value = outputs[name]
            names = tuple(item for item in arrays.scalars(value) if isinstance(item, Node))
            return CallArgument(_c_type(types[name].type), names, isinstance(value, np.ndarray), is_output=True)
        value = args[name] if name in args else self._interpreter.evaluate_in_function(expression, args)
        if isinstance(value, Record | tuple):
            raise UnsupportedModelError(
                f"a record as argument of the external function {function.name} is not translated",
                place=self._source_map.place(function.span),
            )
        items = arrays.scalars(value)
        if name in types:
            type_name = _c_type(types[name].type)
        else:
            type_name = "String" if any(isinstance(item, str) for item in items) else "Real"
            if all(isinstance(item, int) for item in items):
                type_name = "Integer"
        values = []
        for item in items:
            if isinstance(item, Text):
                raise UnsupportedModelError(
                    f"a String that depends on variables as argument of {function.name} is not translated",
                    place=self._source_map.place(function.span),
                )
            values.append(item)
        return CallArgument(type_name, tuple(values), isinstance(value, np.ndarray), is_output=False)


def _c_type(name: str) -> str:
    return name if name in BASE_TYPES else "Integer"
