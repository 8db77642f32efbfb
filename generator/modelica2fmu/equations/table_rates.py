"""Derivatives of tables by time: the same tables, asked for their slopes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Final

from modelica2fmu.expand.scalar_model import CallArgument, ExternalCall, Kind, ScalarModel, ScalarVariable
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node

# Of the runtime's functions (fmurt_table.h): the places of the inputs that a value may be differentiated by, each with
# the order that asks for the slope along it. Slopes of curves have slopes in turn, of one order more.
_SLOPES: Final = {
    "fmurt_table_value": ((-2, 1),),
    "fmurt_table_at_time": ((-4, 1),),
    "fmurt_table_surface": ((-3, 1), (-2, 2)),
}
_SMOOTHNESS: Final = {"fmurt_table_value": 3, "fmurt_table_at_time": 3, "fmurt_table_surface": 5}
# Modelica.Blocks.Types.Smoothness
_LINEAR: Final = 1
_CONSTANT: Final = 3
_HIGHEST_ORDER: Final = 2


class NotDifferentiableError(Exception):
    """An expression has no derivative by time; the message says what."""


class TableRates:
    """Makes the calls that give the derivatives of tables' values.

    Args:
        model: its calls and variables grow by those that are made.
    """

    def __init__(self, model: ScalarModel) -> None:
        self._model = model
        self._calls = {output: call for call in model.calls for output in call.outputs}
        self._made: dict[tuple[str, int], Node] = {}

    def rate(self, output: str, differentiate: Callable[[float | Node], float | Node]) -> float | Node:
        """The derivative by time of what a call gives.

        Args:
            output: symbol of the call's output.
            differentiate: gives the derivative by time of the call's inputs.

        Raises:
            NotDifferentiableError: it is no table, or its slope is infinite somewhere.
        """
        call = self._calls[output]
        if call.symbol not in _SLOPES:
            raise NotDifferentiableError("the output of an external function")
        order = _number(call.args[-1])
        smoothness = _number(call.args[_SMOOTHNESS[call.symbol]])
        if smoothness == _CONSTANT:
            raise NotDifferentiableError("a table that jumps (smoothness = ConstantSegments)")
        if order > 0 and (smoothness == _LINEAR or len(_SLOPES[call.symbol]) > 1):
            raise NotDifferentiableError(
                "the slope of a table that jumps (smoothness = LinearSegments; ContinuousDerivative has none)"
            )
        if order >= _HIGHEST_ORDER:
            raise NotDifferentiableError("the second derivative of a table, which jumps at its points")
        rate: float | Node = 0
        for place, slope in _SLOPES[call.symbol]:
            (given,) = call.args[place].values
            assert not isinstance(given, str)
            speed = differentiate(given)
            if speed != 0:
                rate = ex.add(rate, ex.multiply(self._slope(output, call, order + slope), speed))
        return rate

    def inputs(self, root: float | Node) -> list[Node]:
        """What the tables below an expression are asked for, and those below that."""
        found: dict[Node, None] = {}
        waiting = [root]
        while waiting:
            for name in ex.symbols(waiting.pop()):
                call = self._calls.get(name)
                if call is None:
                    continue
                for place, _ in _SLOPES.get(call.symbol, ()):
                    (given,) = call.args[place].values
                    if isinstance(given, Node) and given not in found:
                        found[given] = None
                        waiting.append(given)
        return list(found)

    def _slope(self, output: str, call: ExternalCall, order: int) -> Node:
        known = self._made.get((output, order))
        if known is not None:
            return known
        number = len(self._model.calls) + 1
        result = ex.symbol(f"$call[{number}].y")
        asked = CallArgument("Integer", (order,), is_array=False, is_output=False)
        made = replace(
            call, number=number, args=(*call.args[:-1], asked), result=(result.name, "Real"), outputs=(result.name,)
        )
        self._model.calls.append(made)
        self._model.variables[result.name] = ScalarVariable(result.name, "Real", Kind.CONTINUOUS, value=result)
        self._calls[result.name] = made
        self._made[output, order] = result
        return result


def _number(argument: CallArgument) -> int:
    (value,) = argument.values
    assert isinstance(value, int)
    return value
