"""The lines of a generated function: expressions as C, what is shared as local constants."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Final

from modelica2fmu.codegen.c_expressions import bare, number, operation
from modelica2fmu.codegen.statements import Statement
from modelica2fmu.equations.lanes import lanes_at
from modelica2fmu.symbolic.expression import Node

_INLINE_LENGTH: Final = 160
BEFORE: Final = -1
"""Position of what is in the work array whatever function reads it."""


class FunctionBody:
    """Writes the lines of a function.

    A node that is used more than once is a local constant; one that other functions use too has a home in the work
    array.

    Args:
        statements: of the function, in order.
        position: of the function in the order of execution.
        homes: of shared nodes: position of the function that computes them, offset in the work array.
        location: C lvalue of a symbol.
        lane_nodes: nodes that are vectors.

    Attributes:
        executed: number of lines that are executed, known once the lines are written.
    """

    def __init__(
        self,
        statements: Sequence[Statement],
        position: int,
        homes: Mapping[Node, tuple[int, int]],
        location: Callable[[str], str],
        lane_nodes: Collection[Node],
    ) -> None:
        self._lane_nodes = lane_nodes
        self._statements = statements
        self._position = position
        self._homes = homes
        self._location = location
        self._names: dict[Node, str] = {}
        self._lines: list[str] = []
        self._uses: dict[Node, int] = {}
        self.executed = 0
        self._count_uses()

    def _count_uses(self) -> None:
        for statement in self._statements:
            for root in statement.roots:
                if isinstance(root, Node):
                    self._use(root)

    def _is_elsewhere(self, node: Node) -> bool:
        home = self._homes.get(node)
        return home is not None and home[0] != self._position and home[0] < self._position

    def _use(self, root: Node) -> None:
        stack = [root]
        while stack:
            node = stack.pop()
            count = self._uses.get(node, 0)
            self._uses[node] = count + 1
            if count == 0 and not self._is_elsewhere(node):
                stack.extend(node.args)

    def lines(self) -> list[str]:
        """The lines, indented."""
        for statement in self._statements:
            for root in statement.roots:
                if isinstance(root, Node):
                    self._prepare(root)
            before = len(self._lines)
            self._lines.extend(f"  {line}" for line in statement.lines(self._write))
            if statement.executed:
                self.executed += statement.executed - (len(self._lines) - before)
        self.executed += len(self._lines)
        return self._lines

    def _write(self, root: float | Node) -> str:
        if not isinstance(root, Node):
            return number(root)
        return self._names[root]

    def _prepare(self, root: Node) -> None:
        """Makes sure that ``root`` has a text, declaring constants for shared nodes."""
        stack = [(root, False)]
        while stack:
            node, ready = stack.pop()
            if node in self._names:
                continue
            if node.op == "symbol":
                self._names[node] = self._location(node.name)
                continue
            if node.op == "constant":
                self._names[node] = number(node.value)
                continue
            if self._is_elsewhere(node):
                self._names[node] = self._home(node)
                continue
            if not ready:
                stack.append((node, True))
                stack.extend((arg, False) for arg in node.args if arg not in self._names)
                continue
            self._name(node)

    def _home(self, node: Node) -> str:
        offset = self._homes[node][1]
        return lanes_at(offset) if node in self._lane_nodes else f"w[{offset}]"

    def _name(self, node: Node) -> None:
        text = self._text(node)
        home = self._homes.get(node)
        if home is None and self._uses[node] == 1 and len(text) <= _INLINE_LENGTH:
            self._names[node] = text
            return
        name = f"n{len(self._names)}"
        type_name = "fmurt_lanes" if node in self._lane_nodes else "double"
        self._lines.append(f"  const {type_name} {name} = {bare(text)};")
        self._names[node] = name
        if home is not None:
            self._lines.append(f"  {self._home(node)} = {name};")

    def _text(self, node: Node) -> str:
        args = [self._names[arg] for arg in node.args]
        if node.op == "select" and node in self._lane_nodes:
            # A branch that is no vector is the number zero: derivatives are linear in the directions.
            args[1:] = [
                f"(fmurt_lanes){text}" if arg in self._lane_nodes else "(fmurt_lanes){0}"
                for arg, text in zip(node.args[1:], args[1:], strict=True)
            ]
        return operation(node.op, args)
