"""Derivatives of expressions."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Final

from modelica2fmu.symbolic.expression_nodes import Node, arguments_first, value_of
from modelica2fmu.symbolic.expression_operations import (
    add,
    divide,
    less,
    multiply,
    negate,
    power,
    select,
    subtract,
    unary,
)


class Differentiation:
    """Forward derivative of expressions for given derivatives of the symbols.

    Serves both the derivative by time (rates of all symbols) and partial derivatives (one symbol with 1).
    Relations, ``floor``, ``sign`` and the like have derivative zero.

    Args:
        rate: derivative of a symbol by its name.
    """

    def __init__(self, rate: Callable[[str], float | Node]) -> None:
        self._rate = rate
        self._memo: dict[Node, float | Node] = {}

    def __call__(self, root: float | Node) -> float | Node:
        """The derivative of ``root``."""
        if not isinstance(root, Node):
            return 0
        memo = self._memo
        for node in arguments_first(root, memo):
            if node.op == "symbol":
                memo[node] = self._rate(node.name)
                continue
            rates = [memo[arg] for arg in node.args]
            if node.op != "select" and all(not isinstance(rate, Node) and rate == 0 for rate in rates):
                memo[node] = 0
            else:
                memo[node] = _derivative(node, [value_of(arg) for arg in node.args], rates)
        return memo[root]


def _derivative(node: Node, args: list[float | Node], rates: list[float | Node]) -> float | Node:
    op = node.op
    if op == "select":
        return select(args[0], rates[1], rates[2])
    if op in _ZERO_DERIVATIVE:
        return 0
    if op == "add":
        return add(*rates)
    if op == "sub":
        return subtract(*rates)
    if op == "neg":
        return negate(rates[0])
    if op == "mul":
        return add(multiply(rates[0], args[1]), multiply(args[0], rates[1]))
    if op == "div":
        # (a' - (a/b) b') / b shares the quotient that is computed anyway.
        return divide(subtract(rates[0], multiply(node, rates[1])), args[1])
    if op == "pow":
        base = multiply(multiply(args[1], power(args[0], subtract(args[1], 1))), rates[0])
        if not isinstance(rates[1], Node) and rates[1] == 0:
            return base
        return add(base, multiply(multiply(node, unary("log", args[0])), rates[1]))
    if op == "atan2":
        square = add(multiply(args[0], args[0]), multiply(args[1], args[1]))
        return divide(subtract(multiply(rates[0], args[1]), multiply(args[0], rates[1])), square)
    if op in ("min", "max"):
        first_smaller = less(args[0], args[1])
        return select(first_smaller, *(rates if op == "min" else reversed(rates)))
    if op == "mod":
        return rates[0]
    inner = rates[0]
    return multiply(_outer_derivative(node, args[0]), inner)


_ZERO_DERIVATIVE: Final = frozenset(
    {"not", "sign", "floor", "ceil", "rem", "quotient", "lt", "le", "eq", "ne", "and", "or"}
)


def _outer_derivative(node: Node, a: float | Node) -> float | Node:
    op = node.op
    if op == "abs":
        return unary("sign", a)
    if op == "sqrt":
        return divide(0.5, node)
    if op == "sin":
        return unary("cos", a)
    if op == "cos":
        return negate(unary("sin", a))
    if op == "tan":
        return add(1, multiply(node, node))
    if op == "asin":
        return divide(1, unary("sqrt", subtract(1, multiply(a, a))))
    if op == "acos":
        return divide(-1, unary("sqrt", subtract(1, multiply(a, a))))
    if op == "atan":
        return divide(1, add(1, multiply(a, a)))
    if op == "sinh":
        return unary("cosh", a)
    if op == "cosh":
        return unary("sinh", a)
    if op == "tanh":
        return subtract(1, multiply(node, node))
    if op == "exp":
        return node
    if op == "log":
        return divide(1, a)
    if op == "log10":
        return divide(1 / math.log(10), a)
    raise AssertionError(f"no derivative rule for {op}")
