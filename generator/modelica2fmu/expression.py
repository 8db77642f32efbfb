"""Scalar expressions as a directed acyclic graph in which equal expressions are one node.

Nodes are interned (hash consing, Filliatre and Conchon 2006, "Type-safe modular hash-consing"), so common
subexpressions are found when they arise, and structural zeros disappear before any equation is looked at. A
value is a Python number where it is constant and a :class:`Node` where it is not. Everything is a real number
to the graph: Booleans are 0 and 1, integers are whole; Modelica's types live in the variables.
"""

from __future__ import annotations

import hashlib
import math
import threading
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Final


class Node:
    """One operation of the graph; compare with ``is``.

    Attributes:
        op: operation (``symbol``, ``constant`` or one of the operators below).
        args: operands.
        value: number of a constant, 0 otherwise.
        name: name of a symbol, empty otherwise.
        digest: the same for the same structure in every run, used to order operands.
    """

    __slots__ = ("args", "digest", "name", "op", "value")

    def __init__(self, op: str, args: tuple[Node, ...], value: float, name: str, digest: int) -> None:
        self.op = op
        self.args = args
        self.value = value
        self.name = name
        self.digest = digest

    def __repr__(self) -> str:
        return to_text(self)


UNARY: Final = (
    "neg", "not", "abs", "sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp",
    "log", "log10", "sign", "floor", "ceil",
)  # fmt: skip
BINARY: Final = (
    "add", "sub", "mul", "div", "pow", "atan2", "min", "max", "mod", "rem", "quotient", "lt", "le", "eq", "ne",
    "and", "or",
)  # fmt: skip
_CODES: Final = {op: code for code, op in enumerate(("symbol", "constant", *UNARY, *BINARY, "select"))}


class _Graph(threading.local):
    """The interning table of one thread."""

    def __init__(self) -> None:
        self.table: dict[tuple[object, ...], Node] = {}


_graph = _Graph()


def new_graph() -> None:
    """Forgets all nodes of this thread, so that a build neither grows memory nor depends on what ran before."""
    _graph.table = {}


def symbol(name: str) -> Node:
    """The symbol ``name``."""
    key = ("symbol", name)
    node = _graph.table.get(key)
    if node is None:
        digest = int.from_bytes(hashlib.blake2b(name.encode(), digest_size=7).digest(), "big")
        node = _graph.table[key] = Node("symbol", (), 0.0, name, digest)
    return node


def node_of(value: float | Node) -> Node:
    """``value`` as a node, constants included."""
    if isinstance(value, Node):
        return value
    number = float(value)
    key = ("constant", number, math.copysign(1.0, number))
    node = _graph.table.get(key)
    if node is None:
        node = _graph.table[key] = Node("constant", (), number, "", hash((1, number)))
    return node


def value_of(node: Node) -> float | Node:
    """A number if ``node`` is constant, else the node."""
    return node.value if node.op == "constant" else node


def _make(op: str, *args: float | Node) -> Node:
    nodes = tuple(node_of(arg) for arg in args)
    key = (op, *nodes)
    node = _graph.table.get(key)
    if node is None:
        digest = hash((_CODES[op], *(arg.digest for arg in nodes)))
        node = _graph.table[key] = Node(op, nodes, 0.0, "", digest)
    return node


def _ordered(op: str, a: float | Node, b: float | Node) -> Node:
    first, second = node_of(a), node_of(b)
    return _make(op, second, first) if second.digest < first.digest else _make(op, first, second)


def _fold(op: str, compute: Callable[[], float], *args: float | Node) -> float | Node:
    """The constant that ``compute`` gives, or the operation itself outside of its domain."""
    try:
        result = compute()
    except (ValueError, OverflowError, ZeroDivisionError):
        return _make(op, *args)
    return _make(op, *args) if isinstance(result, complex) else result


def _is_op(value: float | Node, op: str) -> bool:
    return isinstance(value, Node) and value.op == op


def negate(a: float | Node) -> float | Node:
    """-a."""
    if not isinstance(a, Node):
        return -a if a else 0
    if a.op == "neg":
        return value_of(a.args[0])
    if a.op == "sub":
        return _make("sub", a.args[1], a.args[0])
    return _make("neg", a)


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
    return _make("sub", a, b)


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
            return _make("div", a, b)
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
    return _make("div", a, b)


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
    return _make("pow", a, b)


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
        return a if a.op == "abs" else _make("abs", a)
    if a.op == "neg":
        if op in ("sin", "tan", "asin", "atan", "sinh", "tanh", "sign"):
            return negate(unary(op, a.args[0]))
        if op in ("cos", "cosh"):
            return unary(op, a.args[0])
    return _make(op, a)


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
    return _make(op, a, b)


def less(a: float | Node, b: float | Node) -> bool | Node:
    """A < b."""
    if not isinstance(a, Node) and not isinstance(b, Node):
        return a < b
    return False if a is b else _make("lt", a, b)


def less_equal(a: float | Node, b: float | Node) -> bool | Node:
    """A <= b."""
    if not isinstance(a, Node) and not isinstance(b, Node):
        return a <= b
    return True if a is b else _make("le", a, b)


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
    return _make("not", a)


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
    return _make("select", condition, a, b)


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


def topological(roots: Iterable[float | Node], seen: set[Node] | None = None) -> list[Node]:
    """All nodes below ``roots``, operands before what uses them, in an order the roots alone determine.

    Args:
        roots: where to begin.
        seen: nodes that are left out with what is below them; the others are added.
    """
    order: list[Node] = []
    seen = set() if seen is None else seen
    for root in roots:
        if not isinstance(root, Node) or root in seen:
            continue
        stack: list[tuple[Node, bool]] = [(root, False)]
        while stack:
            node, done = stack.pop()
            if done:
                order.append(node)
                continue
            if node in seen:
                continue
            seen.add(node)
            stack.append((node, True))
            stack.extend((arg, False) for arg in reversed(node.args) if arg not in seen)
    return order


def symbols(*roots: float | Node) -> list[str]:
    """Names of the symbols below ``roots``, each once."""
    return [node.name for node in topological(roots) if node.op == "symbol"]


class Substitution:
    """Replaces symbols; keeps what it has replaced, so that shared subexpressions stay shared.

    Args:
        mapping: replacement of each symbol.
    """

    def __init__(self, mapping: Mapping[str, float | Node]) -> None:
        self._mapping = mapping
        self._memo: dict[Node, float | Node] = {}

    def __call__(self, root: float | Node) -> float | Node:
        """``root`` with all symbols of the mapping replaced, once each."""
        if not isinstance(root, Node):
            return root
        memo = self._memo
        if root in memo:
            return memo[root]
        stack = [root]
        while stack:
            node = stack[-1]
            if node in memo:
                stack.pop()
                continue
            if node.op == "symbol":
                memo[node] = self._mapping.get(node.name, node)
                stack.pop()
                continue
            if node.op == "constant":
                memo[node] = node.value
                stack.pop()
                continue
            pending = [arg for arg in node.args if arg not in memo]
            if pending:
                stack.extend(pending)
                continue
            stack.pop()
            args = [memo[arg] for arg in node.args]
            if all(new is old or (old.op == "constant") for new, old in zip(args, node.args, strict=True)):
                memo[node] = node
            else:
                memo[node] = apply(node.op, args)
        return memo[root]


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
        stack = [root]
        while stack:
            node = stack[-1]
            if node in memo:
                stack.pop()
                continue
            if node.op == "symbol":
                memo[node] = self._rate(node.name)
                stack.pop()
                continue
            pending = [arg for arg in node.args if arg not in memo]
            if pending:
                stack.extend(pending)
                continue
            stack.pop()
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


def evaluate(root: float | Node, values: Mapping[str, float]) -> float:
    """The number that ``root`` has for the ``values`` of its symbols (tests and start values)."""
    if not isinstance(root, Node):
        return float(root)
    constants = {name: values[name] for name in symbols(root)}
    result = Substitution(constants)(root)
    if isinstance(result, Node):
        raise ValueError(f"no finite value: {result}")
    return float(result)


_INFIX: Final = {
    "add": "+", "sub": "-", "mul": "*", "div": "/", "pow": "^", "lt": "<", "le": "<=", "eq": "==", "ne": "<>",
    "and": "and", "or": "or",
}  # fmt: skip


def to_text(root: float | Node) -> str:
    """Readable form, for messages and logs."""
    if not isinstance(root, Node):
        return repr(root)
    if root.op == "symbol":
        return root.name
    if root.op == "constant":
        return repr(root.value)
    args = [to_text(arg) for arg in root.args]
    if root.op in _INFIX:
        return f"({args[0]} {_INFIX[root.op]} {args[1]})"
    if root.op == "select":
        return f"(if {args[0]} then {args[1]} else {args[2]})"
    return f"{'-' if root.op == 'neg' else root.op}({', '.join(args)})"
