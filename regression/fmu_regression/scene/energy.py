"""Mechanical energy of a scene over time, from masses and motions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fmu_regression.results.result import FloatArray, SimulationResult
from fmu_regression.scene.motion import BodyMotion, body_motions, center_of_mass
from fmu_regression.scene.scene_file import Scene
from fmu_regression.scene.signals import elastic_energy_name


@dataclass(frozen=True)
class EnergyBalance:
    """Energies of all moving bodies together, each of shape (n,), J.

    Attributes:
        time: s.
        kinetic: of translation and rotation.
        potential: of gravity; zero at the world's origin.
        elastic: stored in the contacts, or None if the result does not have it.
        notes: what was missing in the result and how it was replaced.
    """

    time: FloatArray
    kinetic: FloatArray
    potential: FloatArray
    elastic: FloatArray | None
    notes: tuple[str, ...]

    @property
    def total(self) -> FloatArray:
        """Kinetic, potential and, where known, elastic energy together."""
        total: FloatArray = self.kinetic + self.potential
        return total if self.elastic is None else total + self.elastic

    @property
    def change(self) -> float:
        """Total energy at the end less that at the start, J; positive if the simulation gained energy."""
        return float(self.total[-1] - self.total[0])

    @property
    def largest_rise(self) -> float:
        """Largest rise of the total energy above an earlier value, J; 0 if it never rises."""
        return float(np.max(self.total - np.minimum.accumulate(self.total)))


def energy_balance(scene: Scene, result: SimulationResult) -> EnergyBalance:
    """Computes the energies of a scene along a result."""
    motions = [motion for motion in body_motions(scene, result) if not motion.body.fixed]
    kinetic = np.zeros(result.time.size)
    potential = np.zeros(result.time.size)
    for motion in motions:
        kinetic += kinetic_energy(motion)
        potential -= motion.body.mass * (center_of_mass(motion) @ scene.gravity)
    notes = [note for motion in motions for note in motion.notes]
    elastic = None
    if scene.pairs or scene.colliders:
        name = elastic_energy_name(scene)
        if name in result:
            elastic = result[name]
        else:
            notes.append(f"elastic energy of the contacts ({name}) not recorded, left out of the total")
    return EnergyBalance(result.time, kinetic, potential, elastic, tuple(notes))


def kinetic_energy(motion: BodyMotion) -> FloatArray:
    """Kinetic energy of a body, shape (n,), J: m v_cm^2 / 2 + w' I w / 2 with v_cm = v + T' (w x r_cm)."""
    body = motion.body
    around = np.cross(motion.angular_velocity, body.center_of_mass)
    speed = motion.velocity + np.einsum("nji,nj->ni", motion.rotation, around)
    spin = np.einsum("ni,ij,nj->n", motion.angular_velocity, body.inertia, motion.angular_velocity)
    energy: FloatArray = (body.mass * np.einsum("ni,ni->n", speed, speed) + spin) / 2
    return energy
