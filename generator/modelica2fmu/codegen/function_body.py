"""The lines of a generated function: expressions as C, what is shared as local constants."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from typing import Final

from modelica2fmu.codegen.branch_nodes import nodes_of_branch
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
    array. What one branch of a conditional expression alone needs is computed where that branch is taken: most contacts
    are open most of the time.

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
        self._branched: set[Node] = set()
        self._indent = "  "
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
                stack.extend((arg, False) for arg in self._needed_before(node) if arg not in self._names)
                continue
            if node in self._branched:
                self._name_by_branches(node)
            else:
                self._name(node)

    def _needed_before(self, node: Node) -> Iterable[Node]:
        """What has a text before the node gets one: its operands, or what they need where branches are taken apart."""
        if node.op != "select":
            return node.args
        branches = [nodes_of_branch(node, arg, self._uses, self._homes.__contains__) for arg in node.args[1:]]
        if not any(branches):
            return node.args
        self._branched.add(node)
        inside = {**branches[0], **branches[1]}
        outer = [node.args[0], *(arg for arg in node.args[1:] if arg not in inside)]
        outer += [arg for item in inside for arg in item.args if arg not in inside]
        return dict.fromkeys(outer)

    def _name_by_branches(self, node: Node) -> None:
        """Declares a variable that the branch taken assigns."""
        name = f"n{len(self._names)}"
        self._names[node] = name
        outer = self._indent
        self._lines.append(f"{outer}{self._type(node)} {name};")
        for head, branch in zip((f"if ({bare(self._names[node.args[0]])}) {{", "} else {"), node.args[1:], strict=True):
            self._lines.append(outer + head)
            self._indent = outer + "  "
            self._prepare(branch)
            self._lines.append(f"{self._indent}{name} = {bare(self._branch_text(node, branch))};")
        self._indent = outer
        self._lines.append(outer + "}")
        if node in self._homes:
            self._lines.append(f"{outer}{self._home(node)} = {name};")

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
        self._lines.append(f"{self._indent}const {self._type(node)} {name} = {bare(text)};")
        self._names[node] = name
        if home is not None:
            self._lines.append(f"{self._indent}{self._home(node)} = {name};")

    def _type(self, node: Node) -> str:
        return "fmurt_lanes" if node in self._lane_nodes else "double"

    def _text(self, node: Node) -> str:
        args = [self._names[arg] for arg in node.args]
        if node.op == "select":
            args[1:] = [self._branch_text(node, branch) for branch in node.args[1:]]
        return operation(node.op, args)

    def _branch_text(self, node: Node, branch: Node) -> str:
        """A branch; one that is no vector where the other is one is the number zero: derivatives are linear."""
        if node not in self._lane_nodes:
            return self._names[branch]
        return f"(fmurt_lanes){self._names[branch]}" if branch in self._lane_nodes else "(fmurt_lanes){0}"
