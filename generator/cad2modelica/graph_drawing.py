"""The mechanism's graph as an SVG drawing: bodies, tree joints, and the cut joints that close loops."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from xml.sax.saxutils import escape

from cad2modelica.kinematic_graph import KinematicTree
from cad2modelica.model import GROUND, Assembly, Joint
from cad2modelica.planar_loops import Loop

COLUMN = 270
ROW = 56
WIDTH = 130
HEIGHT = 28
MARGIN = 24
LONGEST_NAME = 19
LONGEST_LABEL = 22

_STYLE = (
    "text{font:12px sans-serif;fill:#222}"
    ".joint{fill:#555;font-size:11px}"
    ".closing{fill:#b03a2e}"
    ".body{fill:#eef3f8;stroke:#4a6785}"
    ".fixed{fill:#ddd;stroke:#666}"
    ".tree{stroke:#4a6785;stroke-width:1.5;fill:none}"
    ".cut{stroke:#b03a2e;stroke-width:1.5;stroke-dasharray:5 4;fill:none}"
)


@dataclass(frozen=True)
class _Spot:
    """Where a node stands: column by distance from its root, row in the order of the walk."""

    column: int
    row: int

    @property
    def left(self) -> int:
        return MARGIN + COLUMN * self.column

    @property
    def middle(self) -> int:
        return MARGIN + ROW * self.row + HEIGHT // 2


def graph_svg(assembly: Assembly, tree: KinematicTree, loops: Sequence[Loop]) -> str:
    """Draws the graph; the same mechanism gives the same text.

    Roots stand on the left, every part one column to the right of its predecessor; cut joints are dashed, and joints
    in loops bear the loops' numbers, counted from 1.
    """
    spots = _spots(tree)
    numbers: dict[str, list[int]] = {}
    for number, loop in enumerate(loops, start=1):
        for joint, _ in loop.steps:
            numbers.setdefault(joint.name, []).append(number)
    lines: list[str] = []
    for branch in tree.branches:
        if branch.predecessor is not None:
            lines += _edge(spots[branch.predecessor], spots[branch.part.name], branch.joint, "tree", numbers)
    for joint in tree.cut_joints:
        lines += _edge(spots[joint.parent], spots[joint.child], joint, "cut", numbers)
    if GROUND in spots:
        lines += _node(spots[GROUND], GROUND, "fixed")
    for part in assembly.parts:
        lines += _node(spots[part.name], part.name, "fixed" if part.name in tree.fixed else "body")
    width = 2 * MARGIN + COLUMN * max(spot.column for spot in spots.values()) + WIDTH
    height = 3 * MARGIN + ROW * max(spot.row for spot in spots.values()) + HEIGHT
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" '
        f'role="img"><title>{escape(assembly.name)}: bodies and joints</title><style>{_STYLE}</style>'
    )
    return "\n".join([head, *lines, "</svg>"]) + "\n"


def _spots(tree: KinematicTree) -> dict[str, _Spot]:
    children: dict[str, list[str]] = {}
    for branch in tree.branches:
        children.setdefault(branch.predecessor or "", []).append(branch.part.name)
    spots: dict[str, _Spot] = {}
    row = 0
    # Depth first with a stack: chains in CAD systems may be longer than Python's recursion limit.
    roots = [*([GROUND] if GROUND in children else []), *children.get("", [])]
    stack = [(name, 0) for name in reversed(roots)]
    leaf_before = False
    while stack:
        name, column = stack.pop()
        if leaf_before:
            row += 1
        spots[name] = _Spot(column, row)
        following = children.get(name, [])
        leaf_before = not following
        stack += [(child, column + 1) for child in reversed(following)]
    return spots


def _edge(
    first: _Spot, second: _Spot, joint: Joint | None, style: str, numbers: Mapping[str, Sequence[int]]
) -> list[str]:
    if style == "tree":
        x1, x2 = first.left + WIDTH, second.left
        bend = x1 + (COLUMN - WIDTH) // 8
        path = f"M{x1},{first.middle} H{bend} V{second.middle} H{x2}"
        label = (bend + 5, second.middle - 5, "start")
    else:
        x1, x2 = first.left + WIDTH // 2, second.left + WIDTH // 2
        y1, y2 = first.middle + HEIGHT // 2, second.middle + HEIGHT // 2
        low = max(y1, y2) + 14
        path = f"M{x1},{y1} C{x1},{low} {x2},{low} {x2},{y2}"
        label = ((x1 + x2) // 2, low + 6, "middle")
    lines = [f'<path class="{style}" d="{path}"/>']
    if joint is not None:
        x, y, anchor = label
        loops = f" [{','.join(map(str, numbers[joint.name]))}]" if joint.name in numbers else ""
        text = escape(_short(f"{joint.name} ({joint.type.value})", LONGEST_LABEL - len(loops)) + loops)
        kind = "joint closing" if style == "cut" else "joint"
        lines.append(f'<text class="{kind}" x="{x}" y="{y}" text-anchor="{anchor}">{text}</text>')
    return lines


def _node(spot: _Spot, name: str, style: str) -> list[str]:
    top = spot.middle - HEIGHT // 2
    text = escape(_short(name, LONGEST_NAME))
    return [
        f'<rect class="{style}" x="{spot.left}" y="{top}" width="{WIDTH}" height="{HEIGHT}" rx="5"/>',
        f'<text x="{spot.left + WIDTH // 2}" y="{spot.middle + 4}" text-anchor="middle">{text}</text>',
    ]


def _short(text: str, longest: int) -> str:
    return text if len(text) <= longest else text[: longest - 1] + "…"
