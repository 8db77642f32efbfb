"""What each contact pair carries over a simulation, and how far it slides."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fmu_regression.results.result import FloatArray, SimulationResult
from fmu_regression.scene.motion import BodyMotion, body_motions
from fmu_regression.scene.scene_file import ContactPair, Scene
from fmu_regression.scene.signals import pair_signal, point_force_names, point_names


@dataclass(frozen=True)
class PairLoad:
    """The load of one pair; what the result does not tell is None.

    Attributes:
        pair: the pair.
        touching: time in which the pair carries, s.
        mean_force: normal force averaged over that time, N.
        peak_force: largest normal force, N.
        largest_depth: m.
        slid: distance that the two surfaces slide on each other while they carry, m.
    """

    pair: ContactPair
    touching: float
    mean_force: float
    peak_force: float
    largest_depth: float | None
    slid: float | None


def pair_loads(scene: Scene, result: SimulationResult) -> tuple[PairLoad, ...]:
    """Loads of all pairs that ever carry, in the scene's order; pairs without a recorded normal force are left out."""
    motions = {motion.body.name: motion for motion in body_motions(scene, result)}
    loads = (_load(scene, pair, result, motions) for pair in scene.pairs)
    return tuple(load for load in loads if load is not None)


def mean_over_time(time: FloatArray, values: FloatArray) -> float:
    """Mean of a sampled signal by the trapezoidal rule; its value if no time passes."""
    duration = float(time[-1] - time[0])
    return float(np.trapezoid(values, time)) / duration if duration > 0 else float(values[-1])


def _load(scene: Scene, pair: ContactPair, result: SimulationResult, motions: dict[str, BodyMotion]) -> PairLoad | None:
    name = pair_signal(scene, pair, "normalForce")
    if name not in result or not (result[name] > 0).any():
        return None
    force = result[name]
    touching = float(np.trapezoid((force > 0).astype(float), result.time))
    impulse = float(np.trapezoid(force, result.time))
    distance = pair_signal(scene, pair, "distance")
    speed = sliding_speed(scene, pair, result, motions)
    return PairLoad(
        pair,
        touching,
        impulse / touching if touching > 0 else float(force.max()),
        float(force.max()),
        max(0.0, -float(result[distance].min())) if distance in result else None,
        float(np.trapezoid(speed, result.time)) if speed is not None else None,
    )


def sliding_speed(
    scene: Scene, pair: ContactPair, result: SimulationResult, motions: dict[str, BodyMotion]
) -> FloatArray | None:
    """Speed at which the surfaces of a pair slide on each other, averaged over the points by their forces.

    Args:
        scene: the scene.
        pair: one of its pairs.
        result: the simulation.
        motions: of the pair's bodies, by name.

    Returns:
        m/s, shape (n,), 0 where the pair does not carry; None if the result has no contact points.
    """
    first, second = motions[pair.bodies[0]], motions[pair.bodies[1]]
    approach_name = pair_signal(scene, pair, "approachSpeed")
    weighted = np.zeros(result.time.size)
    total = np.zeros(result.time.size)
    slot = 1
    while all(name in result for name in point_names(scene, pair, slot) + point_force_names(scene, pair, slot)):
        point = result.vector(point_names(scene, pair, slot))
        strength = np.linalg.norm(result.vector(point_force_names(scene, pair, slot)), axis=1)
        velocity = _velocity_at(first, point) - _velocity_at(second, point)
        weighted += strength * np.linalg.norm(velocity, axis=1)
        total += strength
        slot += 1
    if slot == 1 or approach_name not in result:
        return None
    speed = np.divide(weighted, total, out=np.zeros_like(total), where=total > 0)
    # What is left of the relative velocity without its part along the normal.
    along = np.where(total > 0, result[approach_name], 0.0)
    sliding: FloatArray = np.sqrt(np.maximum(0.0, speed**2 - along**2))
    return sliding


def _velocity_at(motion: BodyMotion, point: FloatArray) -> FloatArray:
    """Velocity of the body's material at points in world axes, shape (n, 3)."""
    turning = np.einsum("nji,nj->ni", motion.rotation, motion.angular_velocity)
    velocity: FloatArray = motion.velocity + np.cross(turning, point - motion.position)
    return velocity
