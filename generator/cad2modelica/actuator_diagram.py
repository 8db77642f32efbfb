"""Places actuators and their inputs beside the mechanics' diagram."""

from __future__ import annotations

from dataclasses import dataclass

from cad2modelica.actuators import Actuator
from cad2modelica.diagram import HALF, TOP, Diagram, Extent, Point

ROW = 40
MECHANICAL, SIGNAL = "{0,0,0}", "{0,0,127}"


@dataclass(frozen=True)
class DrawnConnection:
    """A connection with its line."""

    first: str
    second: str
    points: tuple[Point, ...]
    color: str


@dataclass(frozen=True)
class ActuatorDiagram:
    """Extents of actuators and inputs, their connections, and the size of the whole diagram."""

    extents: dict[str, Extent]
    connections: tuple[DrawnConnection, ...]
    size: Extent


def draw_actuators(actuators: tuple[Actuator, ...], mechanics: Diagram) -> ActuatorDiagram:
    """Actuators stand in a column on the right of the mechanics, each on a row, its input on its right."""
    (left, bottom), (right, top) = mechanics.size
    x = right + 2 * HALF
    extents: dict[str, Extent] = {}
    connections: list[DrawnConnection] = []
    for row, actuator in enumerate(actuators):
        y = TOP - ROW * row
        extents[actuator.name] = _square((x, y))
        if actuator.input is not None:
            connector, signal = actuator.input
            extents[actuator.name] = _mirrored(extents[actuator.name])
            extents[signal] = _mirrored(_square((x + 4 * HALF, y)))
            straight = ((x + 3 * HALF, y), (x + HALF, y))
            connections.append(DrawnConnection(signal, f"{actuator.name}.{connector}", straight, SIGNAL))
        (x1, _), (x2, y2) = mechanics.extents[actuator.joint]
        middle = (x1 + x2) // 2
        for flange, port, offset in zip(actuator.flanges, ("axis", "support"), (0, -6), strict=True):
            line = ((middle + offset, y2), (middle + offset, y2 + 6), (x - HALF, y2 + 6), (x - HALF, y))
            connections.append(
                DrawnConnection(f"{actuator.joint}.{port}", f"{actuator.name}.{flange}", line, MECHANICAL)
            )
    lowest = min(bottom, TOP - ROW * len(actuators))
    return ActuatorDiagram(extents, tuple(connections), ((left, lowest), (x + 6 * HALF, top)))


def _mirrored(extent: Extent) -> Extent:
    """The same square for an icon that looks to the left."""
    (left, bottom), (right, top) = extent
    return (right, bottom), (left, top)


def _square(center: Point) -> Extent:
    x, y = center
    return (x - HALF, y - HALF), (x + HALF, y + HALF)
