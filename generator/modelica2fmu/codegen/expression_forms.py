"""Forms of expressions: what is left of them without the places and numbers at their leaves."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Hashable
from dataclasses import dataclass
from typing import Final

from modelica2fmu.symbolic.expression import Node

_PLACE: Final = re.compile(r"(.*[\[ ])(\d+)([\])])")
_COMMUTATIVE: Final = frozenset(("add", "mul"))  # exactly so in floating-point arithmetic


@dataclass(frozen=True)
class Leaf:
    """A place or number that an expression begins with. ``array`` is the C text around the index, if there is one."""

    array: str


@dataclass(frozen=True)
class Operation:
    """An operation on what came before; ``is_shared`` says that its value is used again as ``Again(number)``."""

    op: str
    count: int
    is_lane: bool
    is_shared: bool


@dataclass(frozen=True)
class Again:
    """The value of the ``number``-th shared operation."""

    number: int


Step = Leaf | Operation | Again
Form = tuple[Step, ...]
"""The steps of a stack machine."""

NUMBER: Final = Leaf("")


def split_place(place: str) -> tuple[str, int] | None:
    """The text of a C lvalue with ``{}`` for its index, and the index; None if it has none."""
    match = _PLACE.fullmatch(place)
    return None if match is None else (f"{match[1]}{{}}{match[3]}", int(match[2]))


class ExpressionForms:
    """Finds forms of expressions that end at symbols, constants and shared nodes.

    Args:
        shared: nodes that have a place of their own.
        lane_nodes: nodes that are vectors.
        location: C lvalue of a symbol.
    """

    def __init__(self, shared: Collection[Node], lane_nodes: Collection[Node], location: Callable[[str], str]) -> None:
        self._shared = shared
        self._lane_nodes = lane_nodes
        self._location = location
        self._leaves: dict[Node, tuple[Leaf, int]] = {}
        self._numbers: dict[Hashable, int] = {}
        self._outlines: dict[Node, int] = {}

    def form(self, root: Node) -> tuple[Form, tuple[Node, ...]]:
        """The form of an expression, and the leaves in the order of its steps."""
        if not root.args:
            return (self._leaf(root)[0],), (root,)
        uses = self._uses(root)
        steps: list[Step] = []
        leaves: list[Node] = []
        again: dict[Node, int] = {}
        stack = [(root, False)]
        while stack:
            node, is_ready = stack.pop()
            if node is not root and self._ends(node):
                steps.append(self._leaf(node)[0])
                leaves.append(node)
            elif node in again:
                steps.append(Again(again[node]))
            elif not is_ready:
                stack.append((node, True))
                stack.extend((arg, False) for arg in reversed(self._ordered(node)))
            else:
                is_shared = uses[node] > 1
                if is_shared:
                    again[node] = len(again)
                steps.append(Operation(node.op, len(node.args), node in self._lane_nodes, is_shared))
        return tuple(steps), tuple(leaves)

    def _ends(self, node: Node) -> bool:
        return not node.args or node in self._shared

    def _uses(self, root: Node) -> dict[Node, int]:
        uses = {root: 1}
        stack = [root]
        while stack:
            for arg in stack.pop().args:
                if self._ends(arg):
                    continue
                uses[arg] = uses.get(arg, 0) + 1
                if uses[arg] == 1:
                    stack.append(arg)
        return uses

    def _leaf(self, node: Node) -> tuple[Leaf, int]:
        """The leaf and its index."""
        known = self._leaves.get(node)
        if known is None:
            known = self._leaves[node] = self._new_leaf(node)
        return known

    def _new_leaf(self, node: Node) -> tuple[Leaf, int]:
        if node.op == "constant":
            return NUMBER, 0
        if node.args:
            return Leaf("shared lanes" if node in self._lane_nodes else "shared"), 0
        place = self._location(node.name)
        parts = split_place(place)
        return (Leaf(place), 0) if parts is None else (Leaf(parts[0]), parts[1])

    def _ordered(self, node: Node) -> tuple[Node, ...]:
        """The operands, those of commutative operations in an order that their forms determine."""
        if node.op not in _COMMUTATIVE:
            return node.args
        return tuple(sorted(node.args, key=lambda arg: (self._outline(arg), self._leaf_index(arg))))

    def _leaf_index(self, node: Node) -> int:
        return self._leaf(node)[1] if self._ends(node) else 0

    def _outline(self, root: Node) -> int:
        """A number that expressions of the same form share."""
        stack = [root]
        outlines = self._outlines
        while stack:
            node = stack[-1]
            if node in outlines:
                stack.pop()
                continue
            if self._ends(node):
                outlines[stack.pop()] = self._number(self._leaf(node)[0])
                continue
            pending = [arg for arg in node.args if arg not in outlines]
            if pending:
                stack += pending
                continue
            parts = [outlines[arg] for arg in node.args]
            if node.op in _COMMUTATIVE:
                parts.sort()
            outlines[stack.pop()] = self._number((node.op, *parts))
        return outlines[root]

    def _number(self, key: Hashable) -> int:
        return self._numbers.setdefault(key, len(self._numbers))
