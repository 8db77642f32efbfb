"""What is asked of a run, and the verdict on it."""

from __future__ import annotations

import math
import re
from dataclasses import asdict, dataclass, replace
from enum import StrEnum
from typing import Any, Final

import numpy as np
from contact_foundation.errors import CmbError
from fmu_regression.results.result import FloatArray, SimulationResult

from hard_cases.bodies import GRAVITY, has_gravity, pairs, shapes
from hard_cases.expectation import Expectation
from hard_cases.knobs import HardCase

SPREAD: Final = 100.0
"""How many tolerances energy and momentum may be off ..."""
MOST: Final = 0.3
"""... but never by more than this share."""
DEEP: Final = 0.5
"""Penetration by the least extent of a body from which on contact means little: it has passed the middle."""
_DRIFT = 0.01
_LEAST_FRICTION = 0.1
_SLOW = 1e-3
"""Kinetic energy of impacts by that of a fall through the size, below which bodies come to rest where they are."""
_RESTITUTION_ERROR = 5e-3
_REST_SPEEDS = 0.1
_LEAST_RESTITUTION = 0.05
_KNOBS: Final = {
    "stiffness": r"stiffness|penetrat",
    "tolerance": r"tolerance",
    "step": r"maximumStep|communication steps?|longest step|max_step",
    "steps": r"maximumSteps",
    "size": r"\bsize|extent|radius|length",
    "mass": r"\bmass",
    "friction": r"friction|regularisationSpeed|limitSpeed",
    "restitution": r"restitution|restSpeed",
}


class Kind(StrEnum):
    """Verdicts, from the best to the worst."""

    RIGHT = "right"
    STOPPED = "stopped with a message that names a knob"
    WARNED = "deep or wrong, with a warning that names a knob"
    UNNAMED = "stopped with a message that names none"
    SLOW = "slow"
    DEEP = "deep without a message"
    CRASHED = "crashed"
    WRONG = "wrong without a message"


@dataclass(frozen=True)
class Verdict:
    """A verdict; what could not be measured is NaN.

    Attributes:
        kind: which.
        cause: what is wrong, or the message.
        knobs: that the message names, separated by blanks.
        energy_gain: largest rise of all energy by that of `Expectation` and the elastic one at the start.
        momentum_error: largest change of the momentum by that at the start, without gravity.
        drift: of the bodies across the floor by the size, where they should come to rest.
        depth: deepest penetration by the least extent of a body.
        restitution_error: delivered minus asked for, of one impact of a ball.
        steps: of the solver, -1 if unknown.
        cpu_time: s.
        reached: time that was simulated by that to be simulated.
        warnings: of the FMU.
    """

    kind: Kind
    cause: str = ""
    knobs: str = ""
    energy_gain: float = math.nan
    momentum_error: float = math.nan
    drift: float = math.nan
    depth: float = math.nan
    restitution_error: float = math.nan
    steps: int = -1
    cpu_time: float = math.nan
    reached: float = 1.0
    warnings: str = ""

    def as_dict(self) -> dict[str, Any]:
        """All of it, as JSON takes it."""
        return {**asdict(self), "kind": self.kind.value}


def judge(case: HardCase, expected: Expectation, result: SimulationResult) -> Verdict:
    """The verdict on a run that came to its end."""
    columns = [np.asarray(result[name]) for name in result.signals]
    steps = result.counters.steps if result.counters else -1
    if not all(bool(np.isfinite(column).all()) for column in columns):
        return Verdict(Kind.WRONG, "a value is no number", steps=steps, cpu_time=result.cpu_time or math.nan)
    return classified(
        case,
        expected,
        Verdict(
            Kind.RIGHT,
            energy_gain=_energy_gain(expected, result),
            momentum_error=_momentum_error(case, result),
            drift=_drift(case, result),
            depth=_depth(case, expected, result),
            restitution_error=_restitution_error(case, result),
            steps=steps,
            cpu_time=result.cpu_time or math.nan,
            warnings=_shortened(" ".join(result.log)),
        ),
    )


def classified(case: HardCase, expected: Expectation, found: Verdict) -> Verdict:
    """The verdict that the figures of a run that came to its end ask for."""
    allowed = min(SPREAD * case.tolerance, MOST)
    wrong = []
    if found.energy_gain > allowed:
        wrong.append(f"energy gained: {found.energy_gain:.2g}, {allowed:.2g} allowed")
    if found.momentum_error > allowed:
        wrong.append(f"momentum: {found.momentum_error:.2g}, {allowed:.2g} allowed")
    if found.drift > _DRIFT and case.structure.friction != "None" and case.mu > _LEAST_FRICTION:
        wrong.append(f"drift: {found.drift:.2g} of the size")
    bound = expected.relative_depth * (1.01 + allowed)
    if case.structure.kind == "ball" and found.depth > bound:
        wrong.append(f"penetration: {found.depth:.3g} of the thickness, {bound:.3g} possible")
    if abs(found.restitution_error) > _RESTITUTION_ERROR + allowed:
        wrong.append(f"restitution: {found.restitution_error:+.2g}")
    kind, cause, knobs = Kind.RIGHT, "", ""
    if wrong:
        kind, cause = Kind.WRONG, "; ".join(wrong)
    elif found.depth > DEEP:
        kind, cause = Kind.DEEP, f"penetration: {found.depth:.2g} of the thickness"
    if kind is not Kind.RIGHT and (knobs := named_knobs(found.warnings)):
        kind = Kind.WARNED
    return replace(found, kind=kind, cause=cause, knobs=knobs)


def stopped(error: CmbError, stop: float) -> Verdict:
    """The verdict on a run that did not come to its end."""
    text = " ".join(str(error).split())
    time = re.search(r"(?:t =|time) ([0-9.e+-]+[0-9])", text)
    reached = float(time[1]) / stop if time else 0.0
    if "crashed" in text:
        return Verdict(Kind.CRASHED, _shortened(text), reached=reached)
    if "given up after" in text:
        return Verdict(Kind.SLOW, _shortened(text), reached=reached)
    knobs = named_knobs(text)
    return Verdict(Kind.STOPPED if knobs else Kind.UNNAMED, _shortened(text), knobs, reached=reached)


def named_knobs(text: str) -> str:
    """The knobs that a message names, separated by blanks."""
    return " ".join(name for name, pattern in _KNOBS.items() if re.search(pattern, text, re.IGNORECASE))


def _energy_gain(expected: Expectation, result: SimulationResult) -> float:
    total = result["kinetic"] + result["potential"] + result["elastic"]
    scale = expected.energy + float(result["elastic"][0])
    return float(np.max(total - np.minimum.accumulate(total))) / scale


def _momentum_error(case: HardCase, result: SimulationResult) -> float:
    if has_gravity(case.structure):
        return math.nan
    momentum = np.column_stack([result[f"momentum[{i}]"] for i in (1, 2, 3)])
    scale = float(np.linalg.norm(momentum[0]))
    return float(np.linalg.norm(momentum - momentum[0], axis=1).max()) / scale


def _drift(case: HardCase, result: SimulationResult) -> float:
    """Known only for what falls gently on its flat: a stack, prisms."""
    structure = case.structure
    gentle = case.speed**2 / 2 < _SLOW * GRAVITY * structure.size
    if structure.kind not in ("stack", "hulls") or not gentle:
        return math.nan
    moves: list[FloatArray] = []
    for k in range(1, len(shapes(structure)) + 1):
        across = [result[f"body{k}.r_0[{i}]"] for i in (1, 2)]
        moves.append(np.hypot(*(column - column[0] for column in across)))
    return float(np.max(moves)) / structure.size


def _depth(case: HardCase, expected: Expectation, result: SimulationResult) -> float:
    names = [f"contacts.distance[{k + 1}]" for k in range(len(pairs(case.structure)))]
    return max(0.0, -min(float(result[name].min()) for name in names)) / expected.thickness


def _restitution_error(case: HardCase, result: SimulationResult) -> float:
    """Of the first impact of a ball without friction whose weight is of no account, where it is known."""
    structure = case.structure
    if structure.kind != "ball" or structure.friction != "None" or structure.law != "Exact":
        return math.nan
    if structure.restitution == "None" or case.restitution < _LEAST_RESTITUTION or case.speed < _REST_SPEEDS:
        return math.nan
    contact_time = math.pi * math.sqrt(case.mass / case.stiffness)
    leaves = case.restitution * case.speed
    flight_ends = 2 * leaves / GRAVITY
    last = result["kinetic"].shape[0] - 1
    within = np.nonzero((result.time < 0.9 * flight_ends) & (result["elastic"] == 0))[0]
    if GRAVITY * contact_time / case.speed > 1e-3 or not within.size or result.time[within[-1]] < 20 * contact_time:
        return math.nan
    last = int(within[-1])
    energy = float(result["kinetic"][last] + result["potential"][last])
    at_touch = case.mass * GRAVITY * structure.size / 2
    start = float(result["kinetic"][0] + result["potential"][0])
    return math.sqrt(max(energy - at_touch, 0.0) / (start - at_touch)) - case.restitution


def _shortened(text: str) -> str:
    return text[:400]
