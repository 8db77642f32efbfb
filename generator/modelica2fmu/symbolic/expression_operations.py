"""Operations on expressions, simplified as they are made: constants are computed, and ``0*x`` or ``x - x`` is zero."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Final

from modelica2fmu.symbolic.expression_nodes import Node, make_node, node_of, value_of


def _ordered(op: str, a: float | Node, b: float | Node) -> Node:
    first, second = node_of(a), node_of(b)
    return make_node(op, second, first) if second.digest < first.digest else make_node(op, first, second)


def _fold(op: str, compute: Callable[[], float], *args: float | Node) -> float | Node:
    """The constant that ``compute`` gives, or the operation itself outside of its domain."""
    try:
        result = compute()
    except (ValueError, OverflowError, ZeroDivisionError):
        return make_node(op, *args)
    return make_node(op, *args) if isinstance(result, complex) else result


def _is_op(value: float | Node, op: str) -> bool:
    return isinstance(value, Node) and value.op == op


def negate(a: float | Node) -> float | Node:
    """-a."""
    if not isinstance(a, Node):
        return -a if a else 0
    if a.op == "neg":
        return value_of(a.args[0])
    if a.op == "sub":
        return make_node("sub", a.args[1], a.args[0])
    return make_node("neg", a)


def add(a: float | Node, b: float | Node) -> float | Node:
    """A + b."""
    if not isinstance(a, Node):
        if not isinstance(b, Node):
            return a + b
        if a == 0:
            return b
    elif not isinstance(b, Node) and b == 0:
        return a
    if _is_op(b, "neg"):
        return subtract(a, b.args[0])  # type: ignore[union-attr]
    if _is_op(a, "neg"):
        return subtract(b, a.args[0])  # type: ignore[union-attr]
    return _ordered("add", a, b)


def subtract(a: float | Node, b: float | Node) -> float | Node:
    """A - b."""
    if a is b:
        return 0
    if not isinstance(a, Node):
        if not isinstance(b, Node):
            return a - b
        if a == 0:
            return negate(b)
    elif not isinstance(b, Node) and b == 0:
        return a
    b = value_of(b) if isinstance(b, Node) else b
    a = value_of(a) if isinstance(a, Node) else a
    if not isinstance(a, Node) and not isinstance(b, Node):
        return a - b
    if _is_op(b, "neg"):
        return add(a, b.args[0])  # type: ignore[union-attr]
    if _is_op(a, "neg"):
        return negate(add(a.args[0], b))  # type: ignore[union-attr]
    return make_node("sub", a, b)


def multiply(a: float | Node, b: float | Node) -> float | Node:
    """A * b; zero times anything is zero."""
    if not isinstance(a, Node):
        if not isinstance(b, Node):
            return a * b
        if a == 0:
            return 0
        if a == 1:
            return b
        if a == -1:
            return negate(b)
    elif not isinstance(b, Node):
        return multiply(b, a)
    if _is_op(a, "neg"):
        return negate(multiply(a.args[0], b))  # type: ignore[union-attr]
    if _is_op(b, "neg"):
        return negate(multiply(a, b.args[0]))
    return _ordered("mul", a, b)


def divide(a: float | Node, b: float | Node) -> float | Node:
    """A / b; a division by the constant zero stays as it is, since it may stand in a branch never taken."""
    if not isinstance(b, Node):
        if b == 0:
            return make_node("div", a, b)
        if not isinstance(a, Node):
            return a / b
        if b == 1:
            return a
        if b == -1:
            return negate(a)
    if not isinstance(a, Node) and a == 0:
        return 0
    if a is b:
        return 1
    if _is_op(a, "neg"):
        return negate(divide(a.args[0], b))  # type: ignore[union-attr]
    if _is_op(b, "neg"):
        return negate(divide(a, b.args[0]))  # type: ignore[union-attr]
    return make_node("div", a, b)


def power(a: float | Node, b: float | Node) -> float | Node:
    """A ^ b; small whole exponents become products."""
    if not isinstance(b, Node):
        if not isinstance(a, Node):
            return _fold("pow", lambda: float(a) ** b, a, b)
        if b == 0:
            return 1
        if b == 1:
            return a
        if b == 2:
            return multiply(a, a)
        if b == 3:
            return multiply(multiply(a, a), a)
        if b == 4:
            return multiply(multiply(a, a), multiply(a, a))
        if b == 0.5:
            return unary("sqrt", a)
        if b == -1:
            return divide(1, a)
    return make_node("pow", a, b)


_UNARY_FUNCTIONS: Final[dict[str, Callable[[float], float]]] = {
    "abs": abs, "sqrt": math.sqrt, "sin": math.sin, "cos": math.cos, "tan": math.tan, "asin": math.asin,
    "acos": math.acos, "atan": math.atan, "sinh": math.sinh, "cosh": math.cosh, "tanh": math.tanh,
    "exp": math.exp, "log": math.log, "log10": math.log10, "floor": math.floor, "ceil": math.ceil,
    "sign": lambda x: (x > 0) - (x < 0),
}  # fmt: skip


def unary(op: str, a: float | Node) -> float | Node:
    """One of ``UNARY`` applied to ``a``."""
    if op == "neg":
        return negate(a)
    if op == "not":
        return logical_not(a)
    if not isinstance(a, Node):
        number = a
        return _fold(op, lambda: _UNARY_FUNCTIONS[op](number), a)
    if op == "abs" and a.op in ("neg", "abs"):
        a = a.args[0] if a.op == "neg" else a
        return a if a.op == "abs" else make_node("abs", a)
    if a.op == "neg":
        if op in ("sin", "tan", "asin", "atan", "sinh", "tanh", "sign"):
            return negate(unary(op, a.args[0]))
        if op in ("cos", "cosh"):
            return unary(op, a.args[0])
    return make_node(op, a)


def _modulo(x: float, y: float) -> float:
    return x - math.floor(x / y) * y


_BINARY_FUNCTIONS: Final[dict[str, Callable[[float, float], float]]] = {
    "atan2": math.atan2, "min": min, "max": max, "mod": _modulo,
    "rem": lambda x, y: x - math.trunc(x / y) * y, "quotient": lambda x, y: math.trunc(x / y),
}  # fmt: skip
_COMMUTATIVE: Final = frozenset({"min", "max"})


def binary(op: str, a: float | Node, b: float | Node) -> float | Node:
    """One of ``BINARY`` applied to ``a`` and ``b``."""
    function = _ALGEBRA.get(op)
    if function is not None:
        return function(a, b)
    if not isinstance(a, Node) and not isinstance(b, Node):
        return _fold(op, lambda: _BINARY_FUNCTIONS[op](a, b), a, b)
    if op in _COMMUTATIVE:
        return a if a is b else _ordered(op, a, b)
    return make_node(op, a, b)


def less(a: float | Node, b: float | Node) -> bool | Node:
    """A < b."""
    if not isinstance(a, Node) and not isinstance(b, Node):
        return a < b
    return False if a is b else make_node("lt", a, b)


def less_equal(a: float | Node, b: float | Node) -> bool | Node:
    """A <= b."""
    if not isinstance(a, Node) and not isinstance(b, Node):
        return a <= b
    return True if a is b else make_node("le", a, b)


def equal(a: float | Node, b: float | Node) -> bool | Node:
    """A == b."""
    if not isinstance(a, Node) and not isinstance(b, Node):
        return a == b
    return True if a is b else _ordered("eq", a, b)


def not_equal(a: float | Node, b: float | Node) -> bool | Node:
    """A <> b."""
    if not isinstance(a, Node) and not isinstance(b, Node):
        return a != b
    return False if a is b else _ordered("ne", a, b)


def logical_not(a: float | Node) -> bool | Node:
    """Not a."""
    if not isinstance(a, Node):
        return not a
    if a.op == "not":
        return a.args[0]
    return make_node("not", a)


def logical_and(a: float | Node, b: float | Node) -> bool | Node:
    """A and b."""
    if not isinstance(a, Node):
        return _as_boolean(b) if a else False
    if not isinstance(b, Node):
        return a if b else False
    return a if a is b else _ordered("and", a, b)


def logical_or(a: float | Node, b: float | Node) -> bool | Node:
    """A or b."""
    if not isinstance(a, Node):
        return True if a else _as_boolean(b)
    if not isinstance(b, Node):
        return True if b else a
    return a if a is b else _ordered("or", a, b)


def _as_boolean(a: float | Node) -> bool | Node:
    return a if isinstance(a, Node) else bool(a)


def select(condition: float | Node, a: float | Node, b: float | Node) -> float | Node:
    """If condition then a else b."""
    if not isinstance(condition, Node):
        return a if condition else b
    if a is b or (not isinstance(a, Node) and not isinstance(b, Node) and a == b):
        return a
    if condition.op == "not":
        return select(condition.args[0], b, a)
    # What the outer condition has decided: if c then (if c then x else y) else z.
    if isinstance(a, Node) and a.op == "select" and a.args[0] is condition:
        return select(condition, value_of(a.args[1]), b)
    if isinstance(b, Node) and b.op == "select" and b.args[0] is condition:
        return select(condition, a, value_of(b.args[2]))
    return make_node("select", condition, a, b)


_ALGEBRA: Final[dict[str, Callable[[float | Node, float | Node], float | Node]]] = {
    "add": add, "sub": subtract, "mul": multiply, "div": divide, "pow": power, "lt": less, "le": less_equal,
    "eq": equal, "ne": not_equal, "and": logical_and, "or": logical_or,
}  # fmt: skip


def apply(op: str, args: Sequence[float | Node]) -> float | Node:
    """Any operation but ``symbol`` and ``constant``, simplified."""
    if len(args) == 1:
        return unary(op, args[0])
    if len(args) == 2:
        return binary(op, args[0], args[1])
    return select(args[0], args[1], args[2])
