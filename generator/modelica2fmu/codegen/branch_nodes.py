"""Which nodes one branch of a conditional expression alone needs, so that they are computed where it is taken."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Final

from modelica2fmu.symbolic.expression import Node

_COSTS: Final = dict.fromkeys(
    ("sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "log", "log10", "pow", "atan2"), 20
) | {"sqrt": 5, "div": 5, "mod": 10, "rem": 10, "quotient": 10}
_LEAST: Final = 40
"""Cost, by that of an addition, from which on nodes are worth a jump that a processor may guess wrongly."""


def nodes_of_branch(
    select: Node, branch: Node, uses: Mapping[Node, int], is_needed_elsewhere: Callable[[Node], bool]
) -> dict[Node, None]:
    """The nodes with operands that nothing but this branch uses; none where computing them costs little.

    Args:
        select: the conditional expression.
        branch: its second or third operand.
        uses: how often a node is an operand or the value of a statement, within the function.
        is_needed_elsewhere: whether other functions read a node, or compute it.
    """
    found: dict[Node, None] = {}
    left: dict[Node, int] = {branch: uses[branch] - select.args.count(branch) + 1}
    stack = [branch]
    while stack:
        node = stack.pop()
        left[node] = left.get(node, uses.get(node, 0)) - 1
        if left[node] == 0 and node.args and not is_needed_elsewhere(node):
            found[node] = None
            stack.extend(node.args)
    return found if sum(_COSTS.get(node.op, 1) for node in found) >= _LEAST else {}
