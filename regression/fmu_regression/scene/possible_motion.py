"""Whether a result can be the motion of a scene: numbers that no body's pose or force has, and jumps."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from contact_foundation.errors import InputError, Place
from numpy.typing import NDArray

from fmu_regression.results.result import FloatArray, SimulationResult
from fmu_regression.scene.motion import body_motions
from fmu_regression.scene.scene_file import Scene, SceneBody
from fmu_regression.scene.signals import (
    body_force_names,
    elastic_energy_name,
    first_present,
    force_names,
    pair_signal,
    position_names,
    rotation_names,
    velocity_candidates,
)

_FARTHEST = 1e9  # m; beyond it no body of a mechanism is, and no picture shows it
_ROTATION = 0.1  # error of T T' in a rotation that is still drawn as one; integrated ones drift by less than 1e-3
_HASTE = 10.0  # a way of that many times what the largest speed allows is a jump: rows may miss the fastest moments
_NEAR = 1e-3  # m; shorter jumps are not told
_REMEDY = "Correct the row, or simulate again."


def require_possible_motion(scene: Scene, result: SimulationResult, place: Place) -> None:
    """Refuses a result whose numbers cannot be poses, forces or energies of the scene; the first row is told.

    Raises:
        InputError: a value is infinite or undefined, a position is beyond 1e9 m, or a matrix is no rotation.
    """
    for body in scene.bodies:
        if body.fixed:
            continue
        positions, rotations = position_names(body), rotation_names(body)
        for name in (*positions, *rotations, *(first_present(velocity_candidates(body), result.signals) or ())):
            _require(np.isfinite, name, result, place)
        for name in positions:
            _require(lambda values: np.abs(values) <= _FARTHEST, name, result, place)
        if all(name in result for name in rotations):
            matrix = result.vector(rotations).reshape(-1, 3, 3)
            error = np.abs(matrix @ np.swapaxes(matrix, 1, 2) - np.eye(3)).max(axis=(1, 2))
            wrong = np.flatnonzero(error > _ROTATION)
            if wrong.size:
                raise InputError(
                    f"{body.variable}.frame_a.R.T at {result.time[wrong[0]]:.9g} s is no rotation",
                    place=place,
                    remedy=_REMEDY,
                )
    for pair in scene.pairs:
        for name in (pair_signal(scene, pair, "normalForce"), *force_names(scene, pair)):
            _require(np.isfinite, name, result, place)
    for number in range(1, len(scene.colliders) + 1):
        for name in body_force_names(scene, number):
            _require(np.isfinite, name, result, place)
    _require(np.isfinite, elastic_energy_name(scene), result, place)


def jump_notes(scene: Scene, result: SimulationResult) -> tuple[str, ...]:
    """A note on each body that is somewhere else from one row to the next than its speeds can bring it."""
    notes = (_jump(motion.body, motion.position, result) for motion in body_motions(scene, result))
    return tuple(note for note in notes if note is not None)


def _jump(body: SceneBody, position: FloatArray, result: SimulationResult) -> str | None:
    names = first_present(velocity_candidates(body), result.signals)
    if body.fixed or names is None or result.time.size < 2:
        return None
    fastest = float(np.linalg.norm(result.vector(names), axis=1).max())
    way = np.linalg.norm(np.diff(position, axis=0), axis=1)
    jumps = np.flatnonzero(way > _HASTE * fastest * np.diff(result.time) + _NEAR)
    if not jumps.size:
        return None
    row = int(jumps[0])
    others = jumps.size - 1
    more = f", and {others} more such jump{'s' * (others > 1)}" if others else ""
    return (
        f"{body.label} jumps by {way[row]:.4g} m between {result.time[row]:.9g} s and {result.time[row + 1]:.9g} s, "
        f"though its recorded speed is {fastest:.4g} m/s at most{more}"
    )


def _require(
    allows: Callable[[FloatArray], NDArray[np.bool_]], name: str, result: SimulationResult, place: Place
) -> None:
    """Refuses a signal, where it is recorded, with a value that is not allowed."""
    wrong = np.flatnonzero(~allows(result[name])) if name in result else np.empty(0, dtype=np.intp)
    if wrong.size:
        row = wrong[0]
        raise InputError(
            f"{name} is {result[name][row]:.4g} at {result.time[row]:.9g} s, which no body's is",
            place=place,
            remedy=_REMEDY,
        )
