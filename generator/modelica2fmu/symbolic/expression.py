"""Scalar expressions as a directed acyclic graph in which equal expressions are one node.

Nodes are interned (hash consing, Filliatre and Conchon 2006, "Type-safe modular hash-consing"), so common
subexpressions are found when they arise, and structural zeros disappear before any equation is looked at. A
value is a Python number where it is constant and a :class:`Node` where it is not. Everything is a real number
to the graph: Booleans are 0 and 1, integers are whole; Modelica's types live in the variables.
"""

from __future__ import annotations

from collections.abc import Mapping

from modelica2fmu.symbolic.differentiation import Differentiation
from modelica2fmu.symbolic.expression_nodes import (
    BINARY,
    UNARY,
    Node,
    arguments_first,
    new_graph,
    node_of,
    symbol,
    symbols,
    to_text,
    topological,
    value_of,
)
from modelica2fmu.symbolic.expression_operations import (
    add,
    apply,
    binary,
    divide,
    equal,
    less,
    less_equal,
    logical_and,
    logical_not,
    logical_or,
    multiply,
    negate,
    not_equal,
    power,
    select,
    subtract,
    unary,
)

__all__ = [
    "BINARY",
    "UNARY",
    "Differentiation",
    "Node",
    "Substitution",
    "add",
    "apply",
    "binary",
    "divide",
    "equal",
    "evaluate",
    "less",
    "less_equal",
    "logical_and",
    "logical_not",
    "logical_or",
    "multiply",
    "negate",
    "new_graph",
    "node_of",
    "not_equal",
    "power",
    "select",
    "subtract",
    "symbol",
    "symbols",
    "to_text",
    "topological",
    "unary",
    "value_of",
]


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
        for node in arguments_first(root, memo):
            if node.op == "symbol":
                memo[node] = self._mapping.get(node.name, node)
                continue
            if node.op == "constant":
                memo[node] = node.value
                continue
            args = [memo[arg] for arg in node.args]
            if all(new is old or (old.op == "constant") for new, old in zip(args, node.args, strict=True)):
                memo[node] = node
            else:
                memo[node] = apply(node.op, args)
        return memo[root]


def evaluate(root: float | Node, values: Mapping[str, float]) -> float:
    """The number that ``root`` has for the ``values`` of its symbols (tests and start values)."""
    if not isinstance(root, Node):
        return float(root)
    constants = {name: values[name] for name in symbols(root)}
    result = Substitution(constants)(root)
    if isinstance(result, Node):
        raise ValueError(f"no finite value: {result}")
    return float(result)
