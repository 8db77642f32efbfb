"""The knobs of hard cases, and one choice of all of them, drawn from a seed."""

from __future__ import annotations

import random
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from fmu_regression.fmi.binding import Mode

RUNS_PER_STRUCTURE: Final = 25
"""Runs that share an FMU: seeds from a multiple of this on."""
KINDS: Final = ("ball", "box", "rod", "stack", "overlap", "hulls", "chain")
"""Kinds of scenes: `scene_text` says what each is."""
LAWS: Final = ("Exact", "Juhasz", "HuntCrossley", "LeeWang", "LankaraniNikravesh", "Flores", "HuGuo", "SpringDamper")
FRICTIONS: Final = ("None", "Regularised", "Anchored")
RESTITUTIONS: Final = ("ImpactSpeed", "Memoryless", "None")


@dataclass(frozen=True)
class Range:
    """A knob that is a number: from, to; drawn evenly, or evenly in its logarithm."""

    unit: str
    low: float
    high: float
    logarithmic: bool = True

    def draw(self, source: random.Random) -> float:
        """A value."""
        if self.logarithmic:
            return float(f"{self.low * (self.high / self.low) ** source.random():.6g}")
        return round(source.uniform(self.low, self.high), 6)


STRUCTURAL: Final[Mapping[str, Range]] = {
    "size": Range("m", 1e-4, 1e3),
    "slenderness": Range("1", 1.0, 1e3),
}
"""Numbers that are part of an FMU."""
SETTABLE: Final[Mapping[str, Range]] = {
    "stiffness": Range("N/m", 1e3, 1e10),
    "mass": Range("kg", 1e-6, 1e4),
    "mass_ratio": Range("1", 1.0, 1e6),
    "speed": Range("m/s", 1e-3, 300.0),
    "tolerance": Range("1", 1e-9, 1e-2),
    "step": Range("1", 1e-4, 0.3),
    "restitution": Range("1", 0.0, 1.0, logarithmic=False),
    "mu": Range("1", 0.0, 2.0, logarithmic=False),
}
"""Numbers that are set for a run; the importer's step is a share of the time that is simulated."""
NUMBERS: Final[Mapping[str, Range]] = {**SETTABLE, **STRUCTURAL}
_LEAST_STEP_ME = 1e-3
_MOST_STEP_ME = 0.1
_SHARE_ME = 0.25
_EXTREME = 0.1
"""Share of the draws that take one of the ends of a linear range: restitution and friction of 0, and their most."""


@dataclass(frozen=True)
class Structure:
    """What is part of an FMU.

    Attributes:
        number: from which all else follows.
        kind: of the scene.
        size: largest extent of a body, m.
        slenderness: largest by smallest extent, where the kind has one.
        count: bodies of a stack or a chain.
        law, friction, restitution: literals of ContactMultiBody.Types, and "None".
    """

    number: int
    kind: str
    size: float
    slenderness: float
    count: int
    law: str
    friction: str
    restitution: str


@dataclass(frozen=True)
class HardCase:
    """One run: a structure and what is set on its FMU; numbers as in `SETTABLE`.

    Attributes:
        seed: from which all else follows.
        mode: of the simulation.
        heavy_first: whether the first body of two is the heavier one.
        detail: numbers from 0 to 1 for what is no knob, as the turn of a box.
    """

    seed: int
    structure: Structure
    mode: Mode
    stiffness: float
    mass: float
    mass_ratio: float
    speed: float
    tolerance: float
    step: float
    restitution: float
    mu: float
    heavy_first: bool
    detail: tuple[float, float, float]

    def number(self, knob: str) -> float:
        """The value of a knob of `NUMBERS`."""
        value: float = getattr(self.structure if knob in STRUCTURAL else self, knob)
        return value


def structure_of(number: int) -> Structure:
    """The structure of a number; kinds follow each other, all else is drawn."""
    source = random.Random(f"structure {number}")
    kind = KINDS[number % len(KINDS)]
    size = STRUCTURAL["size"].draw(source)
    slenderness = STRUCTURAL["slenderness"].draw(source)
    return Structure(
        number=number,
        kind=kind,
        size=size,
        slenderness=1.0 if kind in ("ball", "chain") else slenderness,
        count=source.randint(2, 6) if kind in ("stack", "chain") else 2 if kind in ("overlap", "hulls") else 1,
        law=source.choice(LAWS),
        friction=source.choice(FRICTIONS),
        restitution=source.choice(RESTITUTIONS),
    )


def hard_case(seed: int) -> HardCase:
    """The run of a seed; the same on every machine."""
    source = random.Random(f"run {seed}")
    structure = structure_of(seed // RUNS_PER_STRUCTURE)
    values = {}
    for name, knob in SETTABLE.items():
        values[name] = knob.draw(source)
        if not knob.logarithmic and (extreme := source.random()) < _EXTREME:
            values[name] = knob.low if extreme < _EXTREME / 2 else knob.high
    if structure.count == 1:
        values["mass_ratio"] = 1.0
    mode: Mode = "me" if source.random() < _SHARE_ME else "cs"
    if mode == "me":
        values["step"] = min(max(values["step"], _LEAST_STEP_ME), _MOST_STEP_ME)
    detail = (source.random(), source.random(), source.random())
    return HardCase(seed, structure, mode, heavy_first=source.random() < 0.5, detail=detail, **values)
