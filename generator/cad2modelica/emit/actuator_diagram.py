"""Places actuators, inputs and outputs on the left of the mechanics' diagram."""

from __future__ import annotations

from dataclasses import dataclass

from cad2modelica.actuators.placement import Actuator
from cad2modelica.modelica.diagram import TOP, Diagram, Extent, Point

ROW = 60
SIZE = 20  # half an actuator
PORT = 5  # half an input or output of the model
LANE = 4  # between lines that run down side by side
MECHANICAL, SIGNAL = "{0,0,0}", "{0,0,127}"

# Heights of the actuators' output connectors, in parts of SIZE (from their placements in the library).
_OUTPUT_HEIGHTS = (-0.4, -0.6, -0.8)
_CURRENT_HEIGHT = 0.6


@dataclass(frozen=True)
class DrawnConnection:
    """A connection with its line."""

    first: str
    second: str
    points: tuple[Point, ...]
    color: str


@dataclass(frozen=True)
class ActuatorDiagram:
    """Extents of actuators, inputs and outputs, their connections, and the size of the whole diagram."""

    extents: dict[str, Extent]
    connections: tuple[DrawnConnection, ...]
    size: Extent


def draw_actuators(actuators: tuple[Actuator, ...], mechanics: Diagram) -> ActuatorDiagram:
    """One row an actuator: its inputs on the left, its outputs on the right, then lanes for the lines to the joints."""
    (left, bottom), (right, top) = mechanics.size
    if not actuators:
        return ActuatorDiagram({}, (), mechanics.size)
    lanes = left - 2 * LANE * len(actuators) - LANE
    x = lanes - 4 * SIZE
    extents: dict[str, Extent] = {}
    connections: list[DrawnConnection] = []
    for row, actuator in enumerate(actuators):
        y = TOP - ROW * row
        extents[actuator.name] = _square((x, y), SIZE)
        connections += _signals(actuator, (x, y), extents)
        lane = left - LANE - 2 * LANE * row
        connections += _to_joint(actuator, (x, y), lane, mechanics, extents)
    lowest = min(bottom, TOP - ROW * len(actuators))
    return ActuatorDiagram(extents, tuple(connections), ((x - 4 * SIZE, lowest), (right, top)))


def _signals(actuator: Actuator, center: Point, extents: dict[str, Extent]) -> list[DrawnConnection]:
    x, y = center
    lines = []
    for k, signal in enumerate(actuator.inputs):
        height = y - 12 * k
        extents[signal.name] = _square((x - 3 * SIZE, height), PORT)
        points = ((x - 3 * SIZE + PORT, height), (x - SIZE - 4, height))
        lines.append(DrawnConnection(signal.name, f"{actuator.name}.{signal.connector}", points, SIGNAL))
    measured = [signal for signal in actuator.outputs if signal.connector != "i"]
    for k, signal in enumerate(actuator.outputs):
        current = signal.connector == "i"
        share = _CURRENT_HEIGHT if current else _OUTPUT_HEIGHTS[measured.index(signal)]
        start, height = y + round(share * SIZE), y + 12 - 11 * k
        extents[signal.name] = _square((x + 2 * SIZE + PORT, height), PORT)
        turn = x + SIZE + 6 + 3 * k
        line = ((x + SIZE + 2, start), (turn, start), (turn, height), (x + 2 * SIZE, height))
        lines.append(DrawnConnection(f"{actuator.name}.{signal.connector}", signal.name, line, SIGNAL))
    return lines


def _to_joint(
    actuator: Actuator, center: Point, lane: int, mechanics: Diagram, extents: dict[str, Extent]
) -> list[DrawnConnection]:
    x, y = center
    lines = []
    for side, (own, other) in enumerate(actuator.connections):
        # The flange leaves at the right and runs above the outputs, the housing below them.
        start: tuple[Point, ...] = ((x, y - SIZE), (x, y - SIZE - 6)) if side else ((x + SIZE, y), (x + SIZE + 3, y))
        level = y - SIZE - 6 if side else y + SIZE + 3
        component, port = other.split(".")
        column = lane - LANE * side
        if component in mechanics.extents:
            (x1, _), (x2, y2) = mechanics.extents[component]
            end_x = (x1 + x2) // 2 - (6 if port == "support" else 0)
            end: tuple[Point, ...] = ((end_x, y2 + 10 - 2 * side), (end_x, y2))
        else:
            (x1, y1), (_, y2) = extents.get(component, _square(center, SIZE))
            end = (
                (column, (y1 + y2) // 2 + SIZE + 8),
                (x1 - 6, (y1 + y2) // 2 + SIZE + 8),
                (x1 - 6, (y1 + y2) // 2),
                (x1, (y1 + y2) // 2),
            )
        line: tuple[Point, ...] = (*start, (start[-1][0], level), (column, level), (column, end[0][1]), *end)
        lines.append(DrawnConnection(f"{actuator.name}.{own}", other, _distinct(line), MECHANICAL))
    return lines


def _distinct(points: tuple[Point, ...]) -> tuple[Point, ...]:
    return tuple(point for k, point in enumerate(points) if k == 0 or point != points[k - 1])


def _square(center: Point, half: int) -> Extent:
    x, y = center
    return (x - half, y - half), (x + half, y + half)
