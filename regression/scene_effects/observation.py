"""What a simulation shows about the contacts of a scene."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from fmu_regression.fmi.description import ModelDescription
from fmu_regression.results.result import FloatArray, SimulationResult
from numpy.typing import NDArray

from scene_effects.manager import Manager, Parameters

_HELD = 1e-9
"""A distance that varies less, in m, is held by joints or by bodies that do not move."""
_SLIDING = 2
"""Sliding faster than this multiple of the regularisation speed counts as sliding, not creeping."""

_INFINITE_LENGTH = 1e60
"""m; what the Standard Library writes for infinity."""


@dataclass(frozen=True)
class PairObservation:
    """What a pair of bodies did.

    Attributes:
        smallest_distance: m, negative when they penetrated.
        distance_range: m, largest less smallest distance.
        contact_time: s in which they pressed on each other.
        fastest_impact: m/s, largest approach speed at the start of a contact; 0 if none started in the time.
        impacts: contacts that started in the time.
        tangential_share: largest tangential force by the largest normal force.
        sticking_time: s in contact at a sliding speed of creeping.
        largest_share: largest share of the force of friction that holds while sticking, 0 to 1.
        creep: m by which regularised friction would let the pair creep while sticking.
        most_points: largest number of points that carried at the same time.
        turning_at_end: rad/s, relative angular velocity at the end if the pair then touches, else 0.
    """

    smallest_distance: float
    distance_range: float
    contact_time: float
    fastest_impact: float
    impacts: int
    tangential_share: float
    sticking_time: float
    largest_share: float
    creep: float
    most_points: int
    turning_at_end: float

    @property
    def touches(self) -> bool:
        """Whether the bodies pressed on each other."""
        return self.contact_time > 0 or self.smallest_distance < 0

    @property
    def is_held_apart(self) -> bool:
        """Whether their distance never changes."""
        return not self.touches and self.distance_range < _HELD


def pair_signals(manager: Manager, description: ModelDescription) -> list[str]:
    """Names of what ``observe`` looks at, as far as the FMU has it."""
    name = manager.name
    wanted: list[str] = []
    for i in range(1, len(manager.pairs) + 1):
        wanted += [f"{name}.{quantity}[{i}]" for quantity in ("distance", "normalForce", "approachSpeed", "touches")]
        for k in (1, 2, 3):
            wanted += [f"{name}.{quantity}[{i},{k}]" for quantity in ("force",)]
        for quantity in ("pointNormalForce", "normal", "pointVelocity"):
            wanted += _in_order(description, f"{name}.{quantity}[{i},")
    wanted += [f"{name}.w_0[{b},{k}]" for b in range(1, len(manager.bodies) + 1) for k in (1, 2, 3)]
    return [signal for signal in dict.fromkeys(wanted) if signal in description.variables]


def exact_distances(manager: Manager, description: ModelDescription) -> dict[str, float]:
    """The start value that makes the manager's distances exact where its model asks for bounds of those far apart.

    How near bodies came, and whether their distance changes, cannot be seen from bounds. Empty where the FMU does not
    let it be set.
    """
    name = f"{manager.name}.exactWithin"
    variable = description.variables.get(name)
    return {name: _INFINITE_LENGTH} if variable is not None and variable.settable else {}


def observe(manager: Manager, parameters: Parameters, result: SimulationResult) -> tuple[PairObservation, ...]:
    """What each pair did in a simulation with anchored friction.

    Args:
        manager: of the simulated scene.
        parameters: its numbers.
        result: with the signals of ``pair_signals``.

    Raises:
        InputError: a signal was not recorded.
    """
    return tuple(_observe(manager, parameters, result, i) for i in range(len(manager.pairs)))


def _observe(manager: Manager, parameters: Parameters, result: SimulationResult, pair: int) -> PairObservation:
    name, number, time = manager.name, pair + 1, result.time
    distance = result[f"{name}.distance[{number}]"]
    pressing = result[f"{name}.normalForce[{number}]"]
    force = result.vector([f"{name}.force[{number},{k}]" for k in (1, 2, 3)])
    touching = pressing > 0
    if (flag := f"{name}.touches[{number}]") in result:
        # A contact shorter than the output interval shows at its two events only, where the force is zero.
        touching |= result[flag] > 0
    points = result.vector([s for s in result.signals if s.startswith(f"{name}.pointNormalForce[{number},")])
    normal, sliding_speed = _patch_means(name, number, result, points)
    tangential = np.sqrt(np.maximum(0.0, (force**2).sum(axis=1) - (force * normal).sum(axis=1) ** 2))
    sticks = touching & (sliding_speed < _SLIDING * parameters.regularisation_speed)
    mu = parameters.pair["muDynamic"][pair]
    holding = np.zeros(time.size)
    if mu > 0:
        np.divide(tangential, mu * pressing, out=holding, where=sticks & (pressing > 0))
    # Regularised friction holds the share q of its largest force at q/sqrt(1 - q^2) of the regularisation speed.
    bounded = np.minimum(holding, 0.999)
    creep = parameters.regularisation_speed * bounded / np.sqrt(1 - bounded**2)
    starts = np.flatnonzero(~touching[:-1] & touching[1:])
    speeds = result[f"{name}.approachSpeed[{number}]"]
    impact_speeds = np.maximum(speeds[starts], speeds[starts + 1])
    a, b = manager.pairs[pair]
    turning = result.vector([f"{name}.w_0[{a},{k}]" for k in (1, 2, 3)]) - result.vector(
        [f"{name}.w_0[{b},{k}]" for k in (1, 2, 3)]
    )
    peak = float(pressing.max())
    return PairObservation(
        smallest_distance=float(distance.min()),
        distance_range=float(np.ptp(distance)),
        contact_time=_time_of(touching, time),
        fastest_impact=float(impact_speeds.max(initial=0.0)),
        impacts=int(starts.size),
        tangential_share=float(tangential.max()) / peak if peak > 0 else 0.0,
        sticking_time=_time_of(sticks, time),
        largest_share=float(np.minimum(holding, 1.0).max(initial=0.0)),
        creep=float(np.trapezoid(np.where(sticks, creep, 0.0), time)),
        most_points=int((points > 0).sum(axis=1).max(initial=0)),
        turning_at_end=float(np.linalg.norm(turning[-1])) if touching[-1] else 0.0,
    )


def _patch_means(name: str, number: int, result: SimulationResult, points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Unit normal, shape (n, 3), and sliding speed, shape (n,), m/s, of a pair as a whole.

    Args:
        name: of the manager.
        number: of the pair, from 1.
        result: with the signals of ``pair_signals``.
        points: normal force of each point, shape (n, capacity), N, which weighs it; the first slot counts while nothing
            presses.
    """
    total = points.sum(axis=1, keepdims=True)
    share = np.divide(points, total, out=np.zeros_like(points), where=total > 0)
    share[total[:, 0] <= 0, 0] = 1.0
    normal, velocity = (
        sum(
            (
                share[:, slot, np.newaxis]
                * result.vector([f"{name}.{quantity}[{number},{slot + 1},{k}]" for k in (1, 2, 3)])
                for slot in range(points.shape[1])
            ),
            start=np.zeros((points.shape[0], 3)),
        )
        for quantity in ("normal", "pointVelocity")
    )
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), np.finfo(float).tiny)
    sliding = velocity - (velocity * normal).sum(axis=1, keepdims=True) * normal
    return normal, np.linalg.norm(sliding, axis=1)


def _time_of(true: NDArray[np.bool_], time: FloatArray) -> float:
    """Time in s in which both ends of a step hold."""
    return float(np.diff(time)[true[:-1] & true[1:]].sum())


def _in_order(description: ModelDescription, beginning: str) -> list[str]:
    return [name for name in description.variables if name.startswith(beginning)]
