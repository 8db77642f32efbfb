"""Places components on the diagram's grid and draws connection lines."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

from cad2modelica.modelica.view import Component, Connection, MechanismView

Point = tuple[int, int]
Extent = tuple[Point, Point]

HALF = 10  # half the size of a component
COLUMN = 40  # smallest width of a column
GRID = 20  # widths of columns are multiples of it
CHARACTER = 0.24  # width of a letter of a name, by half of its component's size: names are 0.4 of that high
GAP = 6  # between names
ROW = 80
UNDER = 26  # of a body under its line
SMALL = 8  # half of a component that stands over a joint
LEFT = -160  # centre of the world's column
TOP = 80


@dataclass(frozen=True)
class Diagram:
    """Where everything stands.

    Attributes:
        size: extent of the diagram's coordinate system.
        extents: of every component, by its name.
        lines: points of every connection, in the order of the connections.
    """

    size: Extent
    extents: dict[str, Extent]
    lines: tuple[tuple[Point, ...], ...]


def draw(view: MechanismView) -> Diagram:
    """Lays the diagram out: the world on the left, chains as lines with their bodies below, contacts on the right.

    A chain's first branch goes on in its line, others begin lines of their own. Stops, friction and couplings stand
    over their joints; lines to the contact manager run below the bodies. Columns are as wide as names need.
    """
    components = {component.name: component for component in view.components}
    columns = _columns(view.components)
    over = _over_joints(view.components)
    centers: dict[str, Point] = {"world": (LEFT, TOP)}
    for component in view.components:
        x, y = columns[component.column], TOP - ROW * component.row
        if component.level > 0:
            x, y = x + over[component.name], y + 2 * HALF + SMALL
        centers[component.name] = (x, y - UNDER if component.level < 0 else y)
    right = max(x for x, _ in centers.values()) + 2 * COLUMN
    bottom = min(y for _, y in centers.values())
    small = {component.name for component in view.components if component.level > 0}
    extents = {name: _square(center, SMALL if name in small else HALF) for name, center in centers.items()}
    if view.contacts is not None:
        middle = (TOP + bottom) // 2
        extents["contacts"] = _square((right, middle), 2 * HALF)
        centers["contacts"] = (right, middle)
    lines = tuple(_line(connection, components, centers) for connection in view.connections)
    size = ((LEFT - 20, bottom - 40), (right + 40, TOP + 50))
    return Diagram(size, extents, lines)


def _width(component: Component) -> int:
    """Room that a component and its name need side by side with others."""
    half = SMALL if component.level > 0 else HALF
    return max(2 * half, math.ceil(len(component.name) * CHARACTER * half) + GAP)


def _columns(components: Sequence[Component]) -> dict[int, int]:
    """Middle of every column: as wide as the names in it; the world's is -1."""
    widths: dict[int, int] = {-1: COLUMN}
    stacked: dict[tuple[int, int], int] = {}
    for component in components:
        place = (component.column, component.row)
        if component.level > 0:
            stacked[place] = stacked.get(place, 0) + _width(component)
        needed = stacked[place] if component.level > 0 else _width(component)
        widths[component.column] = max(widths.get(component.column, COLUMN), GRID * math.ceil(needed / GRID))
    middles = {-1: LEFT}
    for column in range(max(widths) + 1):
        before, own = widths.get(column - 1, COLUMN), widths.get(column, COLUMN)
        middles[column] = middles[column - 1] + (before + own) // 2
    return middles


def _over_joints(components: Sequence[Component]) -> dict[str, int]:
    """Places of what stands over joints, from the joint's middle: beside each other, by level."""
    groups: dict[tuple[int, int], list[Component]] = {}
    for component in components:
        if component.level > 0:
            groups.setdefault((component.column, component.row), []).append(component)
    places = {}
    for group in groups.values():
        left = -sum(_width(component) for component in group) // 2
        for component in sorted(group, key=lambda item: item.level):
            places[component.name] = left + _width(component) // 2
            left += _width(component)
    return places


def _square(center: Point, half: int) -> Extent:
    x, y = center
    return (x - half, y - half), (x + half, y + half)


def _line(
    connection: Connection, components: Mapping[str, Component], centers: Mapping[str, Point]
) -> tuple[Point, ...]:
    first, second = _anchor(connection.first, components, centers), _anchor(connection.second, components, centers)
    under = [_hangs(name, components) for name in (connection.first, connection.second)]
    if connection.second.startswith("contacts."):
        side = first[0] - 4
        lane = first[1] - HALF - 5 if under[0] else first[1] + 6
        gutter = second[0] - 14
        return _without_repeats((first, (side, first[1]), (side, lane), (gutter, lane), (gutter, second[1]), second))
    if connection.second.endswith((".axis", ".support")):
        return _without_repeats((first, (first[0], second[1] + 4), (second[0], second[1] + 4), second))
    if under[0] or under[1]:
        turn = (first if under[0] else second)[0] - 4
        return _without_repeats((first, (turn, first[1]), (turn, second[1]), second))
    if first[1] == second[1]:
        return first, second
    turn = second[0] - 6
    return _without_repeats((first, (turn, first[1]), (turn, second[1]), second))


def _hangs(connector: str, components: Mapping[str, Component]) -> bool:
    """Whether the connector is that of a body under its line."""
    component = components.get(connector.split(".")[0])
    return component is not None and component.level < 0


def _anchor(connector: str, components: Mapping[str, Component], centers: Mapping[str, Point]) -> Point:
    name, port = connector.split(".")
    x, y = centers[name]
    component = components.get(name)
    if name == "contacts":
        return x - 2 * HALF, y
    if port == "flange":
        return x + SMALL, y
    if component is not None and component.level > 0:
        return x, y - SMALL
    if port in ("axis", "support"):
        return x if port == "axis" else x - 6, y + HALF
    if component is not None and component.class_name.endswith("Ground"):
        return x, y + HALF
    return (x + HALF, y) if port == "frame_b" else (x - HALF, y)


def _without_repeats(points: tuple[Point, ...]) -> tuple[Point, ...]:
    kept = [points[0]]
    kept += [point for previous, point in pairwise(points) if point != previous]
    return tuple(kept)
