"""The nodes of scalar expressions: a directed acyclic graph in which equal expressions are one node.

Nodes are interned (hash consing, Filliatre and Conchon 2006, "Type-safe modular hash-consing"), so common
subexpressions are found when they arise, and structural zeros disappear before any equation is looked at. A
value is a Python number where it is constant and a :class:`Node` where it is not. Everything is a real number
to the graph: Booleans are 0 and 1, integers are whole; Modelica's types live in the variables.
"""

from __future__ import annotations

import hashlib
import math
import threading
from collections.abc import Container, Iterable, Iterator
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


def make_node(op: str, *args: float | Node) -> Node:
    """The node of an operation as it is; :mod:`modelica2fmu.symbolic.expression_operations` simplifies."""
    nodes = tuple(node_of(arg) for arg in args)
    key = (op, *nodes)
    node = _graph.table.get(key)
    if node is None:
        digest = hash((_CODES[op], *(arg.digest for arg in nodes)))
        node = _graph.table[key] = Node(op, nodes, 0.0, "", digest)
    return node


def topological(roots: Iterable[float | Node], seen: set[Node] | None = None) -> list[Node]:
    """All nodes below ``roots``, operands before what uses them, in an order the roots alone determine.

    Args:
        roots: where to begin.
        seen: nodes that are left out with what is below them; the others are added.
    """
    order: list[Node] = []
    seen = set() if seen is None else seen
    for root in roots:
        stack = [root] if isinstance(root, Node) else []
        while stack:  # as arguments_first, but without the price of an iterator
            node = stack[-1]
            if node in seen:
                stack.pop()
                continue
            if node.args:
                pending = [arg for arg in node.args if arg not in seen]
                if pending:
                    pending.reverse()
                    stack += pending
                    continue
            stack.pop()
            seen.add(node)
            order.append(node)
    return order


def symbols(*roots: float | Node) -> list[str]:
    """Names of the symbols below ``roots``, each once, in the order of ``topological``."""
    names: list[str] = []
    seen: set[Node] = set()
    stack = [root for root in reversed(roots) if isinstance(root, Node)]
    while stack:
        node = stack.pop()
        if node in seen:
            continue
        seen.add(node)
        if node.args:
            stack += node.args[::-1]
        elif node.op == "symbol":
            names.append(node.name)
    return names


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


def arguments_first(root: Node, done: Container[Node]) -> Iterator[Node]:
    """The nodes of ``root`` that are not in ``done``, each after its arguments.

    Args:
        root: where the graph begins.
        done: what is known already; the caller adds each node before it asks for the next.
    """
    stack = [root]
    while stack:
        node = stack[-1]
        if node in done:
            stack.pop()
            continue
        pending = [arg for arg in node.args if arg not in done]
        if pending:
            stack.extend(reversed(pending))
            continue
        stack.pop()
        yield node
