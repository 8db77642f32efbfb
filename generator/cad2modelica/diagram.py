"""Places components on the diagram's grid and draws connection lines."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise

from cad2modelica.mechanism_view import Component, Connection, MechanismView

Point = tuple[int, int]
Extent = tuple[Point, Point]

HALF = 10  # half the size of a component
COLUMN = 40
ROW = 60
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
    """Lays the diagram out: the world on the left, one row for each chain, the contact manager on the right.

    Lines that go back to the left run between the rows; those to the contact manager through a lane over each row.
    """
    centers: dict[str, Point] = {"world": (LEFT, TOP)}
    for component in view.components:
        x, y = LEFT + COLUMN * (component.column + 1), TOP - ROW * component.row
        shift = (0, 0) if component.above == 0 else (2 * SMALL * (component.above - 1) - SMALL, 2 * HALF + SMALL)
        centers[component.name] = (x + shift[0], y + shift[1])
    small = {component.name for component in view.components if component.above}
    right = max(x for x, _ in centers.values()) + 2 * COLUMN
    bottom = min(y for _, y in centers.values())
    extents = {name: _square(center, SMALL if name in small else HALF) for name, center in centers.items()}
    if view.contacts is not None:
        middle = (TOP + bottom) // 2
        extents["contacts"] = _square((right, middle), 2 * HALF)
        centers["contacts"] = (right, middle)
    components = {component.name: component for component in view.components}
    lines = tuple(_line(connection, components, centers) for connection in view.connections)
    size = ((LEFT - 20, bottom - 40), (right + 40, TOP + 40))
    return Diagram(size, extents, lines)


def _square(center: Point, half: int) -> Extent:
    x, y = center
    return (x - half, y - half), (x + half, y + half)


def _line(
    connection: Connection, components: Mapping[str, Component], centers: Mapping[str, Point]
) -> tuple[Point, ...]:
    first, second = _anchor(connection.first, components, centers), _anchor(connection.second, components, centers)
    if connection.second.startswith("contacts."):
        lane = centers[connection.first.split(".")[0]][1] + 16
        gutter = second[0] - 14
        return _without_repeats(
            (first, (first[0] - 4, first[1]), (first[0] - 4, lane), (gutter, lane), (gutter, second[1]), second)
        )
    if connection.second.endswith((".axis", ".support")):
        return _without_repeats((first, (first[0], second[1] + 4), (second[0], second[1] + 4), second))
    if first[1] == second[1]:
        return first, second
    turn = min(first[0], second[0]) - 6 if second[0] < first[0] else second[0] - 6
    return _without_repeats((first, (turn, first[1]), (turn, second[1]), second))


def _anchor(connector: str, components: Mapping[str, Component], centers: Mapping[str, Point]) -> Point:
    name, port = connector.split(".")
    x, y = centers[name]
    component = components.get(name)
    if name == "contacts":
        return x - 2 * HALF, y
    if port == "flange":
        return x + SMALL, y
    if component is not None and component.above:
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
