"""What errors are measured against: closed forms, and rigid bodies solved to rounding error."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any, Final

import numpy as np
from scipy.integrate import solve_ivp

from peer_bench.scenes import (
    BLOCK_STOPS,
    BOX_EDGE,
    CRADLE_BALLS,
    CRADLE_GAP,
    CRADLE_LENGTH,
    CRADLE_MASS,
    CRADLE_RADIUS,
    CRADLE_START,
    GRAVITY,
    ROD_LENGTH,
    ROD_RADIUS,
    ROD_TILT,
    FloatArray,
    Scene,
)

_TIGHT: Final = 1e-12
_MOST_IMPACTS: Final = 1000


def reference(scene: Scene) -> FloatArray | None:
    """What is compared at the scene's times, shape (times, values); None where each program has its own."""
    found = _REFERENCES.get(scene.name)
    return None if found is None else found(scene.times)


def error(scene: Scene, truth: FloatArray, values: FloatArray) -> float:
    """The largest difference at the compared times by the scene's scale.

    Args:
        scene: which.
        truth: shape (times, values).
        values: of a run, the same shape.
    """
    compared = scene.times >= scene.since - 1e-9
    found = values
    if scene.name == "creep on an incline":  # how the box comes to lie is not creep
        found = values - values[np.flatnonzero(compared)[0]]
    return float(np.abs(found - truth)[compared].max()) / scene.scale


def _ball(times: FloatArray) -> FloatArray:
    e, radius = 0.7, 0.1
    heights = []
    for time in times.tolist():
        since, speed, first = time, 0.0, math.sqrt(2 / GRAVITY)
        if time <= first:
            heights.append(radius + 1.0 - GRAVITY * time**2 / 2)
            continue
        since -= first
        speed = e * GRAVITY * first
        while since > 2 * speed / GRAVITY:
            since -= 2 * speed / GRAVITY
            speed *= e
        heights.append(radius + speed * since - GRAVITY * since**2 / 2)
    return np.array(heights)[:, None]


def _block(times: FloatArray) -> FloatArray:
    moving = np.minimum(times, BLOCK_STOPS)
    way: FloatArray = 2.0 * moving - 0.3 * GRAVITY * moving**2 / 2
    return way[:, None]


def _creep(times: FloatArray) -> FloatArray:
    return np.zeros((times.size, 1))


def _rolling(times: FloatArray) -> FloatArray:
    rolls = 2 * 2.0 / (7 * 0.3 * GRAVITY)
    sliding = np.minimum(times, rolls)
    way: FloatArray = 2.0 * sliding - 0.3 * GRAVITY * sliding**2 / 2 + 5 / 7 * 2.0 * np.maximum(times - rolls, 0.0)
    return way[:, None]


def _stack(times: FloatArray) -> FloatArray:
    shifts = ((0.0, 0.0), (0.01, 0.0), (0.0, 0.01), (-0.01, 0.0), (0.0, -0.01))
    place = [value for k, (x, y) in enumerate(shifts) for value in (x, y, BOX_EDGE * (k + 0.5))]
    return np.tile(np.array(place), (times.size, 1))


def _rod(times: FloatArray) -> FloatArray:
    mass, half = 1.0, ROD_LENGTH / 2
    inertia = mass * ROD_LENGTH**2 / 12

    def rates(_: float, state: FloatArray) -> list[float]:
        angle, speed = state
        sine, cosine = math.sin(angle), math.cos(angle)
        torque = mass * half * sine * (GRAVITY - half * cosine * speed**2)
        return [speed, torque / (inertia + mass * (half * sine) ** 2)]

    found = solve_ivp(rates, (0.0, float(times[-1])), [ROD_TILT, 0.0], "DOP853", times, rtol=_TIGHT, atol=_TIGHT)
    height: FloatArray = ROD_RADIUS + half * np.cos(found.y[0])
    return height[:, None]


def _cradle(times: FloatArray) -> FloatArray:
    n, length = CRADLE_BALLS, CRADLE_LENGTH
    inertia = CRADLE_MASS * length**2 + 0.4 * CRADLE_MASS * CRADLE_RADIUS**2
    hooks = np.arange(n) * (2 * CRADLE_RADIUS + CRADLE_GAP)

    def centres(angles: FloatArray) -> FloatArray:
        return np.column_stack([hooks - length * np.sin(angles), -length * np.cos(angles)])

    def rates(_: float, state: FloatArray) -> FloatArray:
        return np.concatenate([state[n:], -CRADLE_MASS * GRAVITY * length / inertia * np.sin(state[:n])])

    def gap(k: int) -> Callable[[float, FloatArray], float]:
        def event(_: float, state: FloatArray) -> float:
            a, b = centres(state[:n])[k : k + 2]
            return float(np.hypot(*(b - a))) - 2 * CRADLE_RADIUS

        event.terminal, event.direction = True, -1.0  # type: ignore[attr-defined]
        return event

    events: list[Any] = [gap(k) for k in range(n - 1)]
    state = np.concatenate([[CRADLE_START], np.zeros(2 * n - 1)])
    now, rows = 0.0, np.empty((times.size, n))
    for _ in range(_MOST_IMPACTS):
        found = solve_ivp(
            rates, (now, float(times[-1])), state, "DOP853", dense_output=True, events=events, rtol=_TIGHT, atol=_TIGHT
        )
        dense: Any = found.sol
        here = (times >= now) & (times <= found.t[-1])
        if here.any():
            rows[here] = dense(times[here])[:n].T
        now, state = float(found.t[-1]), found.y[:, -1].copy()
        struck = [k for k, instants in enumerate(found.t_events or ()) if instants.size]
        if not struck:
            return rows
        for k in struck:
            _strike(state, k, centres(state[:n]), n, length)
    raise ArithmeticError("the cradle does not come to an end")


def _strike(state: FloatArray, k: int, centres: FloatArray, n: int, length: float) -> None:
    """An elastic impact of the balls k and k + 1, whose inertias are equal."""
    normal = (centres[k + 1] - centres[k]) / np.hypot(*(centres[k + 1] - centres[k]))
    angles = state[[k, k + 1]]
    lever = np.column_stack([-length * np.cos(angles), length * np.sin(angles)]) @ normal
    closing = lever[1] * state[n + k + 1] - lever[0] * state[n + k]
    impulse = -2 * closing / (lever[0] ** 2 + lever[1] ** 2)
    state[n + k] -= lever[0] * impulse
    state[n + k + 1] += lever[1] * impulse


_REFERENCES: Final[Mapping[str, Callable[[FloatArray], FloatArray]]] = {
    "ball, first apex": _ball,
    "ball, three impacts": _ball,
    "block that stops": _block,
    "creep on an incline": _creep,
    "rolling sphere": _rolling,
    "stack of five boxes": _stack,
    "Newton's cradle": _cradle,
    "falling rod": _rod,
}
