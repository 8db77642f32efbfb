"""Which nodes several statements use, so that they can be statements of their own."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from modelica2fmu.codegen.statements import Statement
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node

_SEVERAL: Final = -1


@dataclass(frozen=True)
class SharedNode:
    """A node that more than one statement, or more than one other shared node, uses.

    Attributes:
        node: itself.
        first: number of the first statement that uses it.
        is_discrete: = true, if none that is executed all the time does.
        crosses_groups: = true, if statements of several groups do.
    """

    node: Node
    first: int
    is_discrete: bool
    crosses_groups: bool


def shared_nodes(statements: Sequence[Statement]) -> list[SharedNode]:
    """The nodes with operands that are used in several places, operands before what uses them."""
    order, first = _first_uses(statements)
    owner: dict[Node, int] = {}
    lasting: set[Node] = set()
    groups: dict[Node, int] = {}
    numbers: dict[str, int] = {}
    for position, statement in enumerate(statements):
        name = "" if statement.group is None else statement.group.name
        group = numbers.setdefault(name, len(numbers))
        for root in statement.roots:
            if isinstance(root, Node) and root.args:
                _give(owner, root, position)
                _give(groups, root, group)
                if not statement.is_discrete:
                    lasting.add(root)
    found = []
    for position in range(len(order) - 1, -1, -1):
        node = order[position]
        user = owner[node]
        if user == _SEVERAL:
            user = len(statements) + position
            found.append(SharedNode(node, first[node], node not in lasting, groups[node] == _SEVERAL))
        for arg in node.args:
            if arg.args:
                _give(owner, arg, user)
                _give(groups, arg, groups[node])
                if node in lasting:
                    lasting.add(arg)
    found.reverse()
    return found


def _first_uses(statements: Sequence[Statement]) -> tuple[list[Node], dict[Node, int]]:
    order: list[Node] = []
    first: dict[Node, int] = {}
    seen: set[Node] = set()
    for position, statement in enumerate(statements):
        for node in ex.topological(statement.roots, seen):
            if node.args:
                order.append(node)
                first[node] = position
    return order, first


def _give(values: dict[Node, int], node: Node, value: int) -> None:
    """Notes a value of a node, or that it has several."""
    if values.setdefault(node, value) != value:
        values[node] = _SEVERAL
