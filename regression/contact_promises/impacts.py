"""Free impacts over wide ranges of speed, stiffness and exponent: is the restitution asked for delivered?"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from random import Random
from typing import Final

from fmu_regression.fmi.binding import Mode
from fmu_regression.simulate.simulation import simulate

MODES: Final[tuple[Mode, ...]] = ("me", "cs")
RESTITUTION = (0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0)
SPEED = (0.01, 0.1, 1.0, 10.0)
STIFFNESS = (1e4, 1e6, 1e8, 1e9)
EXPONENT = (1.0, 1.5)
MASS = 0.5
"""kg; mass of the ball of the model ContactMultiBodyTest.Impacts.FreeImpact."""
SLOWEST_PARTING = 0.01 / 20
"""m/s; up to this speed, a twentieth of the model's rest speed, bodies may part that should stay together.

The library's NormalForce.dampingRate says why."""
_APPROACH = 1e-3
"""Time in s from the start to the touch in that model."""
_CONTACT_TIMES = 12
"""How many durations of a elastic impact, roughly, are simulated; e near 0 parts slowly."""


@dataclass(frozen=True)
class Impact:
    """One impact: restitution asked for, speed in m/s, stiffness in N/m^exponent, exponent of the depth."""

    restitution: float
    speed: float
    stiffness: float
    exponent: float

    @property
    def stop(self) -> float:
        """When the ball has parted again, s."""
        n = self.exponent
        depth = float((MASS * self.speed**2 * (n + 1) / (2 * self.stiffness)) ** (1 / (n + 1)))
        return _APPROACH + _CONTACT_TIMES * 4 * depth / self.speed

    def error(self, found: float) -> float:
        """How far what came out is from what is promised: the restitution asked for, or parting at SLOWEST_PARTING."""
        most = max(self.restitution, SLOWEST_PARTING / self.speed)
        return max(self.restitution - found, found - most, 0.0)


def all_impacts() -> tuple[Impact, ...]:
    """Every combination of the values above."""
    return tuple(itertools.starmap(Impact, itertools.product(RESTITUTION, SPEED, STIFFNESS, EXPONENT)))


def some_impacts() -> tuple[Impact, ...]:
    """An eighth of them: every restitution with every speed; stiffness and exponent take turns."""
    return tuple(
        Impact(e, v, STIFFNESS[(i + k) % len(STIFFNESS)], EXPONENT[(i + k // 2) % len(EXPONENT)])
        for i, e in enumerate(RESTITUTION)
        for k, v in enumerate(SPEED)
    )


def random_impacts(count: int, seed: int) -> tuple[Impact, ...]:
    """Impacts between those of the grid: the same ranges, exponents up to 2, speed and stiffness logarithmic."""
    draw = Random(seed)
    return tuple(
        Impact(
            draw.uniform(RESTITUTION[0], RESTITUTION[-1]),
            SPEED[0] * (SPEED[-1] / SPEED[0]) ** draw.random(),
            STIFFNESS[0] * (STIFFNESS[-1] / STIFFNESS[0]) ** draw.random(),
            draw.uniform(1.0, 2.0),
        )
        for _ in range(count)
    )


def delivered(fmu: Path, impact: Impact, tolerance: float, mode: Mode) -> float:
    """Speed after the impact by the speed before it.

    Args:
        fmu: of ContactMultiBodyTest.Impacts.FreeImpact or a model that extends it.
        impact: what is asked for.
        tolerance: relative tolerance of the integration.
        mode: who integrates.

    Raises:
        SimulationError: the simulation failed.
    """
    result = simulate(
        fmu,
        signals=["delivered"],
        start=0.0,
        stop=impact.stop,
        tolerance=tolerance,
        mode=mode,
        interval=impact.stop / 40,
        parameters={
            "e": impact.restitution,
            "speed": impact.speed,
            "stiffness": impact.stiffness,
            "exponent": impact.exponent,
        },
    )
    return float(result["delivered"][-1])


def errors(fmu: Path, impacts: Sequence[Impact], tolerance: float) -> tuple[float, ...]:
    """How far what is delivered is from what is promised, impact by impact; the worse of both modes."""
    return tuple(max(impact.error(delivered(fmu, impact, tolerance, mode)) for mode in MODES) for impact in impacts)
