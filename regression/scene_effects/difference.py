"""How far the bodies of two results are from each other."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from fmu_regression.results.result import SimulationResult

from scene_effects.manager import Manager


@dataclass(frozen=True)
class Difference:
    """The largest differences of two motions at the output times.

    Attributes:
        position: m, between origins of one body.
        body: the body of ``position``, counted from 0.
        time: s, when.
        angle: rad, between orientations of one body.
    """

    position: float
    body: int
    time: float
    angle: float


def motion_difference(manager: Manager, result: SimulationResult, reference: SimulationResult) -> Difference:
    """Compares the motion of a manager's bodies at the times that both results have.

    Args:
        manager: its ``motion_signals`` must have been recorded.
        result: the one.
        reference: the other.
    """
    times, rows, wanted = np.intersect1d(result.time, reference.time, return_indices=True)
    position, body, when, angle = 0.0, 0, float(times[0]), 0.0
    for number in range(len(manager.bodies)):
        names = manager.position(number)
        gaps = np.linalg.norm(result.vector(names)[rows] - reference.vector(names)[wanted], axis=1)
        worst = int(np.argmax(gaps))
        if gaps[worst] > position:
            position, body, when = float(gaps[worst]), number, float(times[worst])
        names = manager.rotation(number)
        # |T1 - T2| = 2 sqrt(2) sin(angle/2) in the Frobenius norm: exact for small angles too.
        turns = np.linalg.norm(result.vector(names)[rows] - reference.vector(names)[wanted], axis=1)
        angle = max(angle, 2 * math.asin(min(1.0, float(turns.max()) / math.sqrt(8))))
    return Difference(position, body, when, angle)
