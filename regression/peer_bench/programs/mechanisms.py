"""The walking robot in figures, as Resources/reference/ReferenceModels.mo has it: six legs of three servo joints."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from peer_bench.scenes import FloatArray, Vector

HEXAPOD_STIFFNESS: Final = 200.0
HEXAPOD_DAMPING: Final = 4.0
TORSO_MASS: Final = 3.6
TORSO_INERTIA: Final[Vector] = (0.03, 0.05, 0.06)
TORSO_HEIGHT: Final = 0.149
HIP_OFFSET: Final = 0.1
FOOT_OFFSET: Final = 0.15
FOOT_RADIUS: Final = 1e-4
FOOT_STIFFNESS: Final = 2e4
FOOT_DISSIPATION: Final = 0.5
FOOT_FRICTION: Final = 0.7


@dataclass(frozen=True)
class Link:
    """A body of a leg and the joint that bears it; lengths along the leg's side are multiplied by it.

    Attributes:
        axis: of the joint.
        origin: of the joint in the body before, m.
        centre: of mass, m.
        mass: kg.
        inertia: about the centre, kg.m2.
    """

    axis: Vector
    origin: Vector
    centre: Vector
    mass: float
    inertia: Vector


@dataclass(frozen=True)
class Leg:
    """A leg: where along the torso, on which side (1, -1), and when it steps, rad."""

    along: float
    side: int
    phase: float

    @property
    def links(self) -> tuple[Link, Link, Link]:
        """Coxa, femur and tibia."""
        s = self.side
        return (
            Link((0, 0, 1), (self.along, HIP_OFFSET * s, 0), (0, 0.025 * s, 0), 0.2, (1e-4, 1e-4, 1e-4)),
            Link((1, 0, 0), (0, 0.05 * s, 0), (0, 0.05 * s, 0), 0.3, (4e-4, 1e-4, 4e-4)),
            Link((1, 0, 0), (0, 0.1 * s, 0), (0, 0, -0.07), 0.2, (4e-4, 4e-4, 1e-4)),
        )


LEGS: Final = (
    Leg(0.2, 1, 0.0),
    Leg(0.0, 1, math.pi),
    Leg(-0.2, 1, 0.0),
    Leg(0.2, -1, math.pi),
    Leg(0.0, -1, 0.0),
    Leg(-0.2, -1, math.pi),
)
_SIDES: Final = np.array([leg.side for leg in LEGS], dtype=float)
_PHASES: Final = np.array([leg.phase for leg in LEGS])


def servo_targets(time: float) -> FloatArray:
    """The targets of all joints at a time, rad, leg after leg, shape (18,)."""
    found = np.zeros((len(LEGS), 3))
    swing = 6 * time + _PHASES
    grown = (1 - math.exp(-2 * time)) * 0.2 * _SIDES
    found[:, 0] = grown * np.sin(swing)
    found[:, 1] = grown * (1 + np.cos(swing))
    return found.ravel()
