"""Motion of the bodies of a scene, read from a result; speeds are differentiated where they are missing."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from fmu_regression.results.result import FloatArray, SimulationResult
from fmu_regression.scene.scene_file import Scene, SceneBody
from fmu_regression.scene.signals import (
    angular_velocity_candidates,
    first_present,
    position_names,
    rotation_names,
    velocity_candidates,
)


@dataclass(frozen=True)
class BodyMotion:
    """Motion of one body; n rows as in the result.

    Attributes:
        body: the body.
        position: shape (n, 3), of the body's frame, world axes, m.
        rotation: shape (n, 3, 3), T: v_body = T v_world.
        velocity: shape (n, 3), of the body's frame, world axes, m/s.
        angular_velocity: shape (n, 3), body axes, rad/s.
        notes: what was not found in the result and how it was replaced; empty if all was there.
    """

    body: SceneBody
    position: FloatArray
    rotation: FloatArray
    velocity: FloatArray
    angular_velocity: FloatArray
    notes: tuple[str, ...]


def body_motions(scene: Scene, result: SimulationResult) -> tuple[BodyMotion, ...]:
    """Motion of every body of a scene, fixed ones included, in the scene's order."""
    return tuple(_motion(body, result) for body in scene.bodies)


def smooth_segments(time: FloatArray) -> list[slice]:
    """The stretches between events: slices of rows within which no two rows have the same time."""
    cuts = [0, *(np.flatnonzero(np.diff(time) <= 0) + 1).tolist(), time.size]
    return [slice(a, b) for a, b in pairwise(cuts)]


def derivative(time: FloatArray, values: FloatArray) -> FloatArray:
    """Time derivative by second-order differences that do not reach across events.

    Args:
        time: shape (n,).
        values: shape (n, ...).

    Returns:
        array of the shape of values; a stretch of a single row takes the derivative of the row before it.
    """
    result = np.zeros_like(values)
    for part in smooth_segments(time):
        count = part.stop - part.start
        if count >= 2:
            result[part] = np.gradient(values[part], time[part], axis=0, edge_order=2 if count > 2 else 1)
        elif part.start > 0:
            result[part] = result[part.start - 1]
    return result


def angular_velocity_of(time: FloatArray, rotation: FloatArray) -> FloatArray:
    """Angular velocity in body axes from rotations T: skew(w) = T d(T')/dt.

    Args:
        time: shape (n,).
        rotation: shape (n, 3, 3).

    Returns:
        shape (n, 3), rad/s.
    """
    rate = derivative(time, np.swapaxes(rotation, 1, 2))
    skew = rotation @ rate
    skew = (skew - np.swapaxes(skew, 1, 2)) / 2
    return np.stack([skew[:, 2, 1], skew[:, 0, 2], skew[:, 1, 0]], axis=1)


def _motion(body: SceneBody, result: SimulationResult) -> BodyMotion:
    count = result.time.size
    notes: list[str] = []
    position = np.broadcast_to(body.position, (count, 3))
    rotation = np.broadcast_to(body.rotation, (count, 3, 3))
    still = np.zeros((count, 3))
    if body.fixed:
        return BodyMotion(body, position, rotation, still, still, ())
    moves = turns = True
    if all(name in result for name in position_names(body)):
        position = result.vector(position_names(body))
    else:
        moves = False
        notes.append(f"{body.label}: position not recorded, drawn where it starts")
    if all(name in result for name in rotation_names(body)):
        rotation = result.vector(rotation_names(body)).reshape(count, 3, 3)
    else:
        turns = False
        notes.append(f"{body.label}: rotation not recorded, drawn as it starts")
    velocity_names = first_present(velocity_candidates(body), result.signals)
    if velocity_names:
        velocity = result.vector(velocity_names)
    else:
        velocity = derivative(result.time, position) if moves else still
        if moves:
            notes.append(f"{body.label}: velocity differentiated from the position")
    turn_names = first_present(angular_velocity_candidates(body), result.signals)
    if turn_names:
        angular_velocity = result.vector(turn_names)
    else:
        angular_velocity = angular_velocity_of(result.time, rotation) if turns else still
        if turns:
            notes.append(f"{body.label}: angular velocity differentiated from the rotation")
    return BodyMotion(body, position, rotation, velocity, angular_velocity, tuple(notes))


def center_of_mass(motion: BodyMotion) -> FloatArray:
    """Position of the centre of mass, world axes, shape (n, 3)."""
    offset: FloatArray = np.einsum("nji,j->ni", motion.rotation, motion.body.center_of_mass)
    return motion.position + offset
