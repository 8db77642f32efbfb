"""Missions as users write them: TOML files such as those of ``Resources/missions``."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from contact_foundation.errors import InputError, Place
from contact_foundation.near_names import did_you_mean
from contact_foundation.toml_text import read_toml

Vector = tuple[float, float, float]
_RED: Final = (0.78, 0.28, 0.20)


@dataclass(frozen=True)
class Obstacle:
    """A box of the course.

    Attributes:
        name: of the part.
        size: edges along its axes, m.
        position: of its middle, m.
        angles: about the world's axes x, y, z, applied in this order, degrees.
        density: kg/m³ of one that can be moved; 0: it is fixed.
        color: red, green, blue from 0 to 1.
    """

    name: str
    size: Vector
    position: Vector
    angles: Vector
    density: float
    color: Vector

    @property
    def movable(self) -> bool:
        """Whether it can be pushed."""
        return self.density > 0


@dataclass(frozen=True)
class Goal:
    """A cylinder that stands upright on the floor, in which a body must come.

    Attributes:
        body: name of the body in the scene.
        position: of its axis, x and y, m.
        radius: m.
        height: of the body's origin at least, m; -inf: any.
    """

    body: str
    position: tuple[float, float]
    radius: float
    height: float


@dataclass(frozen=True)
class Phase:
    """Inputs that a scripted operator holds until a condition is met.

    Attributes:
        towards: a point to steer to, x and y in m; None: ``inputs`` alone are held.
        until: s for which it lasts at most.
        inputs: values by name.
    """

    towards: tuple[float, float] | None
    until: float
    inputs: Mapping[str, float]


@dataclass(frozen=True)
class Steering:
    """How a scripted operator heads for points.

    Attributes:
        body: name of the body that is steered.
        forward, turn: names of the inputs.
        heading: signal of the direction, rad from the x axis.
        speed: value of ``forward`` where the machine looks at the point.
        gain: value of ``turn`` for a radian of deviation.
        near: distance at which a point is reached, m.
    """

    body: str
    forward: str
    turn: str
    heading: str
    speed: float
    gain: float
    near: float


@dataclass(frozen=True)
class Mission:
    """What is to be driven, where, and to which end.

    Attributes:
        file: it was read from.
        title: of the mission.
        assembly: file or folder of the machine; None: ``model`` is a model of its own.
        sources: Modelica files and packages beside the mission, for such a model.
        model: Modelica class that is driven.
        supports: parts of the machine that touch the course and the boxes.
        ground: name of the plane on which boxes lie.
        obstacles: of the course.
        goal: to be reached.
        time_limit: s.
        step: of communication, s.
        collisions: names of bodies; to touch one of them counts as a collision.
        harmless: names of bodies that may touch them all the same.
        steering: of the scripted operator, or None.
        phases: of the scripted operator.
    """

    file: Path
    title: str
    assembly: Path | None
    sources: tuple[Path, ...]
    model: str
    supports: tuple[str, ...]
    ground: str
    obstacles: tuple[Obstacle, ...]
    goal: Goal
    time_limit: float
    step: float
    collisions: tuple[str, ...]
    harmless: tuple[str, ...]
    steering: Steering | None
    phases: tuple[Phase, ...]


def read_mission(file: Path) -> Mission:
    """Reads a mission.

    Raises:
        InputError: the file does not exist, or what it says makes no mission.
    """
    table = _Table(read_toml(file, "a mission"), file, "")
    goal, operator = table.table("goal"), table.table("operator", optional=True)
    assembly, model = table.text("assembly", ""), table.text("model")
    obstacles = tuple(_obstacle(each) for each in table.tables("obstacle"))
    mission = Mission(
        file=file,
        title=table.text("title"),
        assembly=_beside(file, assembly) if assembly else None,
        sources=tuple(_beside(file, name) for name in table.texts("sources")),
        model=model,
        supports=table.texts("supports"),
        ground=table.text("ground", "floor"),
        obstacles=obstacles,
        goal=Goal(
            goal.text("body"), goal.pair("position"), goal.positive("radius"), goal.number("height", default=-math.inf)
        ),
        time_limit=table.positive("time_limit"),
        step=table.positive("step", default=0.01),
        collisions=table.texts("collisions"),
        harmless=table.texts("harmless"),
        steering=_steering(operator) if operator.has("forward") or operator.has("body") else None,
        phases=tuple(_phase(each) for each in operator.tables("phase")),
    )
    for each in (goal, operator, table):
        each.end()
    if mission.steering is None and any(phase.towards is not None for phase in mission.phases):
        raise operator.wrong("phases lead towards points, but the operator has no forward and turn")
    return mission


def _obstacle(table: _Table) -> Obstacle:
    made = Obstacle(
        table.text("name"),
        table.vector("size"),
        table.vector("position"),
        table.vector("angles", (0.0, 0.0, 0.0)),
        table.number("density", default=0.0),
        table.vector("color", _RED),
    )
    table.end()
    if min(made.size) <= 0 or made.density < 0:
        raise table.wrong("size must be positive, and density not negative")
    return made


def _steering(table: _Table) -> Steering:
    return Steering(
        table.text("body"),
        table.text("forward"),
        table.text("turn"),
        table.text("heading"),
        table.positive("speed"),
        table.positive("gain"),
        table.positive("near"),
    )


def _phase(table: _Table) -> Phase:
    inputs = table.table("inputs", optional=True)
    phase = Phase(
        table.pair("towards") if table.has("towards") else None,
        table.positive("until"),
        {name: inputs.number(name) for name in inputs.names()},
    )
    inputs.end()
    table.end()
    return phase


def _beside(file: Path, name: str) -> Path:
    path = file.parent / name
    if not path.exists():
        raise InputError(f"{name} does not exist", place=Place(file=file), remedy="Correct the path.")
    return path


class _Table:
    """A table of the file, of which every key must be taken."""

    def __init__(self, content: Mapping[str, Any], file: Path, name: str) -> None:
        self._content, self._file, self._name = content, file, name
        self._taken: set[str] = set()

    def wrong(self, message: str, remedy: str | None = None) -> InputError:
        return InputError(message, place=Place(file=self._file, component=self._name or None), remedy=remedy)

    def has(self, key: str) -> bool:
        return key in self._content

    def names(self) -> Sequence[str]:
        return list(self._content)

    def end(self) -> None:
        for key in self._content:
            if key not in self._taken:
                raise self.wrong(f"{key} has no meaning", did_you_mean(key, self._taken))

    def _take(self, key: str, default: Any) -> Any:
        self._taken.add(key)
        if key in self._content:
            return self._content[key]
        if default is None:
            raise self.wrong(f"{key} is missing")
        return default

    def text(self, key: str, default: str | None = None) -> str:
        value = self._take(key, default)
        if not isinstance(value, str):
            raise self.wrong(f"{key} is no text")
        return value

    def texts(self, key: str) -> tuple[str, ...]:
        value = self._take(key, [])
        if not isinstance(value, list) or not all(isinstance(each, str) for each in value):
            raise self.wrong(f"{key} is no list of texts")
        return tuple(value)

    def number(self, key: str, default: float | None = None) -> float:
        return self._number(key, self._take(key, default))

    def positive(self, key: str, default: float | None = None) -> float:
        value = self.number(key, default)
        if value <= 0:
            raise self.wrong(f"{key} is not positive")
        return value

    def vector(self, key: str, default: Vector | None = None) -> Vector:
        x, y, z = self._numbers(key, 3, default)
        return x, y, z

    def pair(self, key: str) -> tuple[float, float]:
        x, y = self._numbers(key, 2, None)
        return x, y

    def table(self, key: str, optional: bool = False) -> _Table:
        value = self._take(key, {} if optional else None)
        if not isinstance(value, dict):
            raise self.wrong(f"{key} is no table")
        return _Table(value, self._file, key)

    def tables(self, key: str) -> list[_Table]:
        value = self._take(key, [])
        if not isinstance(value, list) or not all(isinstance(each, dict) for each in value):
            raise self.wrong(f"{key} is no list of tables")
        return [_Table(each, self._file, f"{key} {each.get('name', k)}") for k, each in enumerate(value, 1)]

    def _numbers(self, key: str, count: int, default: Sequence[float] | None) -> list[float]:
        value = self._take(key, default)
        if not isinstance(value, list | tuple) or len(value) != count:
            raise self.wrong(f"{key} is no list of {count} numbers")
        return [self._number(key, each) for each in value]

    def _number(self, key: str, value: Any) -> float:
        if isinstance(value, bool) or not isinstance(value, int | float) or math.isnan(value):
            raise self.wrong(f"{key} is no number")
        return float(value)
