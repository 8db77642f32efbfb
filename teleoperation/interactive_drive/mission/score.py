"""What became of a mission, from positions and contact forces alone."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from contact_foundation.errors import InputError, Place
from fmu_regression.results.result import FloatArray, SimulationResult
from fmu_regression.scene.scene_file import ContactPair, Scene
from fmu_regression.scene.signals import pair_signal, position_names

from interactive_drive.mission.mission_file import Mission

_APART = 0.25  # s without force after which a touch is a new collision


@dataclass(frozen=True)
class Collision:
    """Something touched that should not be.

    Attributes:
        time: when it began, s.
        bodies: names of the two.
        impulse: of the normal force until they parted, N s.
        largest: normal force, N.
    """

    time: float
    bodies: tuple[str, str]
    impulse: float
    largest: float


@dataclass(frozen=True)
class Score:
    """How a mission went.

    Attributes:
        title: of the mission.
        reached: time at which the goal was reached, s; None if it was not within the time limit.
        time: driven, s; until the goal, if it was reached.
        path: way of the goal's body, along the floor, m.
        shortest: from its start straight to the goal's edge, m.
        distance: from the goal's edge at the end, m; 0 within.
        collisions: in order of time, until the goal.
    """

    title: str
    reached: float | None
    time: float
    path: float
    shortest: float
    distance: float
    collisions: tuple[Collision, ...]


def watched_signals(mission: Mission, scene: Scene) -> list[str]:
    """Signals that a score needs.

    Raises:
        InputError: the scene has no body of the name that the goal is for, or that counts as a collision.
    """
    _check(mission, scene)
    body = next(each for each in scene.bodies if each.name == mission.goal.body)
    return [*position_names(body), *(pair_signal(scene, pair, "normalForce") for pair in _forbidden(mission, scene))]


def score(mission: Mission, scene: Scene, result: SimulationResult) -> Score:
    """Scores a record.

    Args:
        mission: that was driven.
        scene: of the machine.
        result: with the ``watched_signals``.

    Raises:
        InputError: the scene or the record lacks something.
    """
    names = watched_signals(mission, scene)
    missing = [name for name in names if name not in result.signals]
    if missing:
        raise InputError(
            f"the record has no {missing[0]}",
            place=Place(component=mission.title),
            remedy="Score a record of this mission's machine.",
        )
    time = result.time - result.time[0]
    place = np.column_stack([result[name] for name in names[:3]])
    away = np.hypot(place[:, 0] - mission.goal.position[0], place[:, 1] - mission.goal.position[1])
    there = (away <= mission.goal.radius) & (place[:, 2] >= mission.goal.height) & (time <= mission.time_limit)
    last = int(np.argmax(there)) if there.any() else len(time) - 1
    steps = np.hypot(np.diff(place[: last + 1, 0]), np.diff(place[: last + 1, 1]))
    collisions = [
        collision
        for pair, name in zip(_forbidden(mission, scene), names[3:], strict=True)
        for collision in _collisions(pair, time[: last + 1], result[name][: last + 1])
    ]
    return Score(
        mission.title,
        float(time[last]) if there.any() else None,
        float(time[last]),
        float(steps.sum()),
        max(0.0, float(away[0]) - mission.goal.radius),
        max(0.0, float(away[last]) - mission.goal.radius),
        tuple(sorted(collisions, key=lambda each: each.time)),
    )


def _collisions(pair: ContactPair, time: FloatArray, force: FloatArray) -> list[Collision]:
    """Times in which a pair's normal force acts; those that little time parts are one."""
    acting = np.flatnonzero(force > 0)
    if not acting.size:
        return []
    groups = np.split(acting, np.flatnonzero(np.diff(time[acting]) > _APART) + 1)
    made = []
    for group in groups:
        part = slice(group[0], group[-1] + 1)
        impulse = float(np.trapezoid(force[part], time[part])) if len(time[part]) > 1 else 0.0
        made.append(Collision(float(time[group[0]]), pair.bodies, impulse, float(force[part].max())))
    return made


def _forbidden(mission: Mission, scene: Scene) -> list[ContactPair]:
    """Pairs of which one body counts as a collision and the other is not harmless."""
    counted, harmless = set(mission.collisions), set(mission.harmless)
    return [
        pair
        for pair in scene.pairs
        if any(b in counted and other not in harmless | counted for b, other in (pair.bodies, pair.bodies[::-1]))
    ]


def _check(mission: Mission, scene: Scene) -> None:
    known = {body.name for body in scene.bodies}
    for name in (mission.goal.body, *mission.collisions, *mission.harmless):
        if name not in known:
            raise InputError(
                f"the machine has no body {name}",
                place=Place(file=mission.file),
                remedy=f"Its bodies are {', '.join(sorted(known))}.",
            )


def table(made: Score, most: int = 8) -> str:
    """A score in lines of a name and a value."""
    detour = made.path / made.shortest if made.shortest > 0 else math.nan
    rows = [
        ("goal", f"reached after {made.reached:.2f} s" if made.reached is not None else "not reached"),
        ("time", f"{made.time:.2f} s"),
        ("path", f"{made.path:.3f} m, {detour:.2f} times the shortest"),
        ("distance left", f"{made.distance:.3f} m"),
        ("collisions", f"{len(made.collisions)}"),
    ]
    rows += [("", _told(each)) for each in made.collisions[:most]]
    if len(made.collisions) > most:
        rows.append(("", f"and {len(made.collisions) - most} more"))
    return "\n".join([made.title, *(f"  {name:<15}{value}" for name, value in rows)])


def _told(collision: Collision) -> str:
    first, second = collision.bodies
    force = f"up to {collision.largest:.1f} N, {collision.impulse:.3f} N s"
    return f"at {collision.time:.2f} s: {first} and {second}, {force}"
