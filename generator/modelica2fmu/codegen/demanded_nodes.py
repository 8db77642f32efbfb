"""Under which conditions nodes are needed.

What a branch of a conditional expression alone uses is needed where that branch is taken.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Final

from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node

_MOST: Final = 8  # conditions that are told apart for a node


@dataclass(frozen=True)
class Literal:
    """A condition, or that it does not hold."""

    condition: Node
    holds: bool


_ALWAYS: Final[frozenset[Literal]] = frozenset()


def demands(roots: Iterable[float | Node]) -> dict[Node, frozenset[Literal]]:
    """Literals of each node with operands that all hold wherever its value is needed; none for a root.

    Args:
        roots: expressions whose values are needed.
    """
    wanted = [root for root in roots if isinstance(root, Node)]
    found: dict[Node, frozenset[Literal]] = dict.fromkeys(wanted, _ALWAYS)
    for node in reversed(ex.topological(wanted)):
        mine = found[node]
        for position, arg in enumerate(node.args):
            through = mine
            if node.op == "select" and position > 0 and len(mine) < _MOST:
                through = mine | {Literal(node.args[0], position == 1)}
            before = found.get(arg)
            found[arg] = through if before is None else before & through
    return found
