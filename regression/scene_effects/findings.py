"""Which effects a scene needs, judged by its parameters and by what its pairs did with every effect on."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

from scene_effects.choices import Change, Friction, Restitution
from scene_effects.manager import Manager, Parameters
from scene_effects.observation import PairObservation
from scene_effects.variants import without_restitution

_NO_TANGENTIAL_FORCE = 1e-3
"""Tangential forces below this share of the normal forces do nothing worth an equation."""
_NEAR = 10
"""Pairs that come nearer than this multiple of the difference that does not matter stay."""
_ROUND = {"sphere", "capsule", "ellipsoid"}
_STRENGTH = (Friction.NONE, Friction.REGULARISED, Friction.ANCHORED)
_NAMED = 6


class Verdict(Enum):
    """What is to be said about an effect."""

    FITS = "fits"
    UNNEEDED = "not needed"
    MISSING = "missing"


@dataclass(frozen=True)
class Finding:
    """What was found out about one effect.

    Attributes:
        effect: "friction", "restitution", "turning", "points" or "pairs".
        verdict: whether the present choice fits.
        reason: why, with figures; sentences.
        change: what to change, or None where nothing is or numbers are the user's.
    """

    effect: str
    verdict: Verdict
    reason: str
    change: Change | None = None


def find(
    manager: Manager, parameters: Parameters, observations: Sequence[PairObservation], allowed: float
) -> tuple[Finding, ...]:
    """Judges every effect.

    Args:
        manager: as the model has it.
        parameters: its numbers.
        observations: one for each pair, from a simulation with every effect on.
        allowed: m, a difference of positions that does not matter.
    """
    touching = [k for k, pair in enumerate(observations) if pair.touches]
    if not touching:
        return (_no_contact(manager, parameters, observations),)
    return (
        _friction(manager, parameters, observations, touching, allowed),
        _restitution(manager, parameters, observations, touching),
        _turning(manager, parameters, observations, touching),
        _points(manager, observations, touching),
        _pairs(manager, observations, allowed),
    )


def _no_contact(manager: Manager, parameters: Parameters, observations: Sequence[PairObservation]) -> Finding:
    nearest = min(range(len(observations)), key=lambda k: observations[k].smallest_distance)
    change = Change(friction=Friction.NONE, point_capacity=1)
    if manager.regards_restitution:
        change = change.with_(without_restitution(manager, parameters))
    return Finding(
        "contact",
        Verdict.UNNEEDED,
        f"In this time no two bodies touch; the nearest are {manager.pair_label(nearest)}, "
        f"{_mm(observations[nearest].smallest_distance)} apart. The manager can be left out, or be as small as this.",
        change,
    )


def _friction(
    manager: Manager,
    parameters: Parameters,
    observations: Sequence[PairObservation],
    touching: Sequence[int],
    allowed: float,
) -> Finding:
    mu = max(max(parameters.pair["muStatic"][k], parameters.pair["muDynamic"][k]) for k in touching)
    share = max(observations[k].tangential_share for k in touching)
    creeping = max(touching, key=lambda k: observations[k].creep)
    pair = observations[creeping]
    sticks = (
        f"{manager.pair_label(creeping)} sticks for {pair.sticking_time:.3g} s under up to "
        f"{100 * pair.largest_share:.3g} % of its friction; regularised friction would let it creep by about "
        f"{_mm(pair.creep)}"
    )
    if mu == 0:
        needed, reason = Friction.NONE, "All pairs that touch have coefficients of friction of 0."
    elif share < _NO_TANGENTIAL_FORCE:
        needed = Friction.NONE
        reason = f"Tangential forces stay below {100 * share:.2g} % of the largest normal force."
    elif pair.creep > allowed:
        needed, reason = Friction.ANCHORED, f"Friction has to hold: {sticks}."
        reason += f" It would stay below {_mm(allowed)} with regularisationSpeed="
        reason += f"{_one_digit_below(parameters.regularisation_speed * allowed / pair.creep)}."
    else:
        needed = Friction.REGULARISED
        reason = f"Tangential forces reach {100 * share:.3g} % of the largest normal force, "
        reason += f"and what creeps is little: {sticks}." if pair.sticking_time > 0 else "and all contacts slide."
    now, wanted = _STRENGTH.index(manager.friction), _STRENGTH.index(needed)
    verdict = Verdict.FITS if now == wanted else Verdict.UNNEEDED if now > wanted else Verdict.MISSING
    return Finding("friction", verdict, reason, None if now == wanted else Change(friction=needed))


def _restitution(
    manager: Manager, parameters: Parameters, observations: Sequence[PairObservation], touching: Sequence[int]
) -> Finding:
    if not manager.regards_restitution:
        return Finding("restitution", Verdict.FITS, "The law SpringDamper does not regard it.")
    count = sum(observations[k].impacts for k in touching)
    fastest = max(touching, key=lambda k: observations[k].fastest_impact)
    speed = observations[fastest].fastest_impact
    rest = parameters.rest_speed
    hitting = [k for k in touching if observations[k].fastest_impact >= rest]
    largest = max((parameters.pair["restitution"][k] for k in hitting), default=0.0)
    if not count:
        reason, needed = "No contact starts after the start of the simulation.", False
    elif not hitting:
        reason = f"{_impacts(count)}; the fastest, {manager.pair_label(fastest)}, at {speed:.3g} m/s, is slower than "
        reason, needed = reason + f"restSpeed = {rest:g} m/s.", False
    elif largest == 0:
        reason = f"{_impacts(count)} of up to {speed:.3g} m/s, all of pairs whose coefficient of restitution is 0."
        needed = False
    else:
        reason = f"{_impacts(count)}, the fastest at {speed:.3g} m/s ({manager.pair_label(fastest)}); "
        reason, needed = reason + f"coefficients of restitution are up to {largest:.3g}.", True
    on = manager.restitution is not Restitution.NONE
    if on == needed:
        return Finding("restitution", Verdict.FITS, reason)
    if on:
        return Finding("restitution", Verdict.UNNEEDED, reason, without_restitution(manager, parameters))
    return Finding("restitution", Verdict.MISSING, reason, Change(restitution=Restitution.BY_EVENT))


def _turning(
    manager: Manager, parameters: Parameters, observations: Sequence[PairObservation], touching: Sequence[int]
) -> Finding:
    radii = max(max(parameters.pair["spinRadius"][k], parameters.pair["rollingLever"][k]) for k in touching)
    if manager.turning and radii == 0:
        reason = "spinRadius and rollingLever of all pairs that touch are 0."
        return Finding("turning", Verdict.UNNEEDED, reason, Change(turning=False))
    if manager.turning:
        return Finding("turning", Verdict.FITS, f"spinRadius and rollingLever are up to {_mm(radii)}.")
    round_ones = [k for k in touching if any(_ROUND & set(manager.bodies[b - 1].shapes) for b in manager.pairs[k])]
    fastest = max(round_ones, key=lambda k: observations[k].turning_at_end, default=None)
    if fastest is None or observations[fastest].turning_at_end <= parameters.turning_regularisation_speed:
        return Finding("turning", Verdict.FITS, "No round body spins or rolls at the end.")
    reason = (
        f"{manager.pair_label(fastest)} still turns at {observations[fastest].turning_at_end:.3g} rad/s at the "
        "end, and no torque acts against it"
    )
    if radii > 0:
        return Finding("turning", Verdict.MISSING, f"{reason}.", Change(turning=True))
    reason += "; where it shall come to rest, set useTurningFriction=true with your rollingLever or spinRadius."
    return Finding("turning", Verdict.MISSING, reason)


def _points(manager: Manager, observations: Sequence[PairObservation], touching: Sequence[int]) -> Finding:
    most = max(touching, key=lambda k: observations[k].most_points)
    count = max(1, observations[most].most_points)
    carry = "points carry" if count > 1 else "point carries"
    reason = f"At most {count} {carry} at the same time ({manager.pair_label(most)}), {manager.point_capacity} "
    reason += "are provided." if manager.point_capacity > 1 else "is provided."
    if count == manager.point_capacity:
        return Finding("points", Verdict.FITS, reason)
    verdict = Verdict.UNNEEDED if count < manager.point_capacity else Verdict.MISSING
    return Finding("points", verdict, reason, Change(point_capacity=count))


def _pairs(manager: Manager, observations: Sequence[PairObservation], allowed: float) -> Finding:
    kept = [k for k, pair in enumerate(observations) if pair.touches or pair.smallest_distance < _NEAR * allowed]
    left = [k for k in range(len(observations)) if k not in kept]
    if not left:
        return Finding("pairs", Verdict.FITS, "All pairs touch or come near each other.")
    described = [
        f"{manager.pair_label(k)} ({'held at' if observations[k].is_held_apart else 'never nearer than'} "
        f"{_mm(observations[k].smallest_distance)})"
        for k in sorted(left, key=lambda k: -observations[k].smallest_distance)
    ]
    more = f" and {len(left) - _NAMED} more" if len(left) > _NAMED else ""
    reason = f"{len(left)} of {len(observations)} pairs stay apart in this time: {', '.join(described[:_NAMED])}{more}."
    in_use = {body for k in kept for body in manager.pairs[k]}
    idle = [manager.bodies[b - 1].name for b in sorted({b for k in left for b in manager.pairs[k]} - in_use)]
    if idle:
        reason += f" Then without any contact: {', '.join(idle)}."
    return Finding("pairs", Verdict.UNNEEDED, reason, Change(kept_pairs=tuple(kept)))


def _impacts(count: int) -> str:
    return f"{count} contact{'s start' if count > 1 else ' starts'} in this time"


def _one_digit_below(value: float) -> str:
    """A positive number with one digit, not greater than ``value``."""
    rounded = value * (1 + 1e-9)  # 2e-4 that came out a rounding error smaller is 2e-4
    exponent = math.floor(math.log10(rounded))
    return f"{math.floor(rounded / 10.0**exponent)}e{exponent}"


def _mm(length: float) -> str:
    return f"{1000 * length:.3g} mm"
