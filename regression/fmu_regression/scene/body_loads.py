"""What contacts do to each body, where the manager tells forces of bodies instead of pairs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fmu_regression.results.result import FloatArray, SimulationResult
from fmu_regression.scene.scene_file import Scene
from fmu_regression.scene.signals import body_force_names


@dataclass(frozen=True)
class BodyLoad:
    """The contact force on one body, summed over all bodies that it touches.

    Attributes:
        body: its name.
        strength: shape (n,), magnitude of the force, N.
        touching: time in which there is one, s.
        mean_force: magnitude averaged over that time, N.
        peak_force: largest magnitude, N.
        peak_time: when, s.
    """

    body: str
    strength: FloatArray
    touching: float
    mean_force: float
    peak_force: float
    peak_time: float


def body_loads(scene: Scene, result: SimulationResult) -> tuple[BodyLoad, ...]:
    """Loads of all bodies that are ever touched, in the manager's order; none where the manager shows pairs."""
    loads = (_load(scene, result, number, body) for number, body in enumerate(scene.colliders, start=1))
    return tuple(load for load in loads if load is not None)


def _load(scene: Scene, result: SimulationResult, number: int, body: str) -> BodyLoad | None:
    strength = np.linalg.norm(result.vector(body_force_names(scene, number)), axis=1)
    if not strength.any():
        return None
    touching = float(np.trapezoid((strength > 0).astype(float), result.time))
    peak = int(strength.argmax())
    return BodyLoad(
        body,
        strength,
        touching,
        float(np.trapezoid(strength, result.time)) / touching if touching > 0 else float(strength[peak]),
        float(strength[peak]),
        float(result.time[peak]),
    )
