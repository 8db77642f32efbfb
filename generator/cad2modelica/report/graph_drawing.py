"""The mechanism's graph as an SVG drawing: bodies, tree joints, and the cut joints that close loops."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from xml.sax.saxutils import escape

from cad2modelica.kinematics.kinematic_graph import KinematicTree
from cad2modelica.kinematics.planar_loops import Loop
from cad2modelica.mechanism.model import GROUND, Assembly, Joint

ROW = 56
HEIGHT = 28
MARGIN = 24
NARROWEST = 90  # of boxes, and of the gaps between them
LONGEST = 40  # characters of a name; the whole one is shown where the mouse points
NAME_ADVANCE = 7.2  # of a character, px: more than that of digits and of most letters at 12 px
LABEL_ADVANCE = 6.4  # the same at 11 px
BEND = 16  # from a box to where its lines part
SMALLEST_SCALE = 0.85  # to which a page may shrink the drawing before it scrolls

_STYLE = (
    "text{font:12px sans-serif;fill:#222}"
    ".joint{fill:#333;font-size:11px}"
    ".type{fill:#6b7c8d;font-style:italic}"
    ".closing{fill:#b03a2e}"
    ".body{fill:#eef3f8;stroke:#4a6785}"
    ".fixed{fill:#ddd;stroke:#666}"
    ".tree{stroke:#4a6785;stroke-width:1.5;fill:none}"
    ".cut{stroke:#b03a2e;stroke-width:1.5;stroke-dasharray:5 4;fill:none}"
)


@dataclass(frozen=True)
class _Sizes:
    """Widths of boxes and of the gaps between them, px, so that the names fit."""

    box: int
    gap: int


@dataclass(frozen=True)
class _Spot:
    """Where a node stands: column by distance from its root, row in the order of the walk."""

    column: int
    row: int
    sizes: _Sizes

    @property
    def left(self) -> int:
        return MARGIN + (self.sizes.box + self.sizes.gap) * self.column

    @property
    def right(self) -> int:
        return self.left + self.sizes.box

    @property
    def center(self) -> int:
        return self.left + self.sizes.box // 2

    @property
    def middle(self) -> int:
        return MARGIN + ROW * self.row + HEIGHT // 2


def graph_svg(assembly: Assembly, tree: KinematicTree, loops: Sequence[Loop]) -> str:
    """Draws the graph; the same mechanism gives the same text.

    Roots stand on the left, every part one column to the right of its predecessor; cut joints are dashed, and joints
    in loops bear the loops' numbers, counted from 1.
    """
    numbers: dict[str, list[int]] = {}
    for number, loop in enumerate(loops, start=1):
        for joint, _ in loop.steps:
            numbers.setdefault(joint.name, []).append(number)
    spots = _spots(tree, _sizes(assembly, numbers))
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
    width = MARGIN + max(spot.right for spot in spots.values())
    height = 3 * MARGIN + ROW * max(spot.row for spot in spots.values()) + HEIGHT
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" '
        f'style="max-width:100%;min-width:{round(SMALLEST_SCALE * width)}px;height:auto" role="img">'
        f"<title>{escape(assembly.name)}: bodies and joints</title><style>{_STYLE}</style>"
    )
    return "\n".join([head, *lines, "</svg>"]) + "\n"


def _sizes(assembly: Assembly, numbers: Mapping[str, Sequence[int]]) -> _Sizes:
    names = [GROUND, *(part.name for part in assembly.parts)]
    labels = [text for joint in assembly.joints for text in (joint.name, joint.type.value + _loops(joint, numbers))]
    box = max(min(len(name), LONGEST) for name in names) * NAME_ADVANCE + 16
    gap = max((min(len(label), LONGEST) for label in labels), default=0) * LABEL_ADVANCE + BEND + 12
    return _Sizes(max(NARROWEST, round(box)), max(NARROWEST, round(gap)))


def _spots(tree: KinematicTree, sizes: _Sizes) -> dict[str, _Spot]:
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
        spots[name] = _Spot(column, row, sizes)
        following = children.get(name, [])
        leaf_before = not following
        stack += [(child, column + 1) for child in reversed(following)]
    return spots


def _edge(
    first: _Spot, second: _Spot, joint: Joint | None, style: str, numbers: Mapping[str, Sequence[int]]
) -> list[str]:
    if style == "tree":
        x1, x2 = first.right, second.left
        bend = x1 + BEND
        path = f"M{x1},{first.middle} H{bend} V{second.middle} H{x2}"
        label = (bend + 5, second.middle - 5, "start")
    else:
        x1, x2 = first.center, second.center
        y1, y2 = first.middle + HEIGHT // 2, second.middle + HEIGHT // 2
        low = max(y1, y2) + 14
        path = f"M{x1},{y1} C{x1},{low} {x2},{low} {x2},{y2}"
        label = ((x1 + x2) // 2, low + 6, "middle")
    lines = [f'<path class="{style}" d="{path}"/>']
    if joint is not None:
        x, y, anchor = label
        loops = _loops(joint, numbers)
        kind = "closing" if style == "cut" else "joint"
        way = f"{joint.name}: {joint.type.value}, {joint.parent} to {joint.child}"
        title = f"<title>{escape(way)}</title>"
        texts = [(0, _short(joint.name), kind), (17, f"{joint.type.value}{loops}", "type")]
        if style == "cut":  # there is no room for a second line over the next row
            texts = [(0, f"{_short(joint.name)} ({joint.type.value}){loops}", kind)]
        lines += [
            f'<text class="joint {look}" x="{x}" y="{y + down}" text-anchor="{anchor}">{escape(text)}{title}</text>'
            for down, text, look in texts
        ]
    return lines


def _node(spot: _Spot, name: str, style: str) -> list[str]:
    top = spot.middle - HEIGHT // 2
    text = f"{escape(_short(name))}<title>{escape(name)}</title>"
    return [
        f'<rect class="{style}" x="{spot.left}" y="{top}" width="{spot.sizes.box}" height="{HEIGHT}" rx="5"/>',
        f'<text x="{spot.center}" y="{spot.middle + 4}" text-anchor="middle">{text}</text>',
    ]


def _loops(joint: Joint, numbers: Mapping[str, Sequence[int]]) -> str:
    """Numbers of the loops that a joint is in; empty if it is in none."""
    return f" [{','.join(map(str, numbers[joint.name]))}]" if joint.name in numbers else ""


def _short(text: str) -> str:
    return text if len(text) <= LONGEST else text[: LONGEST - 1] + "…"
