"""The knobs of a study: what each is called, which values it takes and whose error it belongs to."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import Enum
from typing import Final

KnobValue = float | int | str

AS_MODELLED: Final = "as modelled"
"""The value of any knob that leaves the scene's own choice."""
PARAMETER: Final = "parameter."
"""Knobs of this beginning are start values of variables of the FMU: ``parameter.mu``."""
SOLVERS: Final = ("me", "cs")
LAWS: Final = (
    "Exact",
    "Juhasz",
    "HuntCrossley",
    "HerbertMcWhannell",
    "LeeWang",
    "LankaraniNikravesh",
    "Gonthier",
    "Flores",
    "HuGuo",
    "SpringDamper",
)
FRICTIONS: Final = ("None", "Regularised", "Anchored")
RESTITUTIONS: Final = ("ImpactSpeed", "Memoryless", "None")
BACKENDS: Final = ("Automatic", "Analytic", "Libccd", "Fcl", "Coal")
_TESSELLATION: Final = re.compile(r"(hull|mesh) (\d+)|(pieces) (\d*\.?\d+(?:e-?\d+)?)")
_SEGMENTS: Final = range(4, 257)


class Part(Enum):
    """What a knob belongs to: the solver, the geometry, or the model, which is all else."""

    SOLVER = "solver"
    GEOMETRY = "geometry"
    MODEL = "model"


@dataclass(frozen=True)
class Knob:
    """A knob.

    Attributes:
        part: whose error it belongs to.
        label: in sentences.
        problem: what is wrong with a value, or "".
    """

    part: Part
    label: str
    problem: Callable[[KnobValue], str]


def knob(name: str) -> Knob | None:
    """The knob of a name, or None if there is none."""
    if name.startswith(PARAMETER) and len(name) > len(PARAMETER):
        return Knob(Part.MODEL, name.removeprefix(PARAMETER), _number(-math.inf))
    return KNOBS.get(name)


def part_of(name: str) -> Part:
    """Whose error a knob belongs to; ``name`` is one of a study that was read."""
    found = knob(name)
    assert found is not None, f"{name} is no knob"
    return found.part


def _is_number(value: KnobValue) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def _number(above: float, below: float = math.inf) -> Callable[[KnobValue], str]:
    def problem(value: KnobValue) -> str:
        if not _is_number(value):
            return "is not a number"
        return "" if above < float(value) < below else f"must lie between {above:g} and {below:g}"

    return problem


def _exponent(value: KnobValue) -> str:
    return _number(0)(value) or ("" if float(value) >= 1 else "must be 1 at least")


def _count(value: KnobValue) -> str:
    return "" if isinstance(value, int) and not isinstance(value, bool) and value >= 1 else "is not a count from 1"


def _word(words: tuple[str, ...]) -> Callable[[KnobValue], str]:
    return lambda value: "" if value in words else f"is none of {', '.join(words)}"


def _geometry(value: KnobValue) -> str:
    found = _TESSELLATION.fullmatch(value) if isinstance(value, str) else None
    if found is None:
        return f'is none of "{AS_MODELLED}", "hull N", "mesh N" and "pieces ERROR"'
    if found[3]:
        return "" if float(found[4]) > 0 else "must have an error above 0"
    least, most = _SEGMENTS[0], _SEGMENTS[-1]
    return "" if int(found[2]) in _SEGMENTS else f"must have {least} to {most} segments"


def tessellation(value: str) -> tuple[str, float]:
    """Kind of a value of the knob geometry, and segments around ("hull", "mesh") or error in m ("pieces")."""
    kind, fineness = value.split()
    return kind, float(fineness)


KNOBS: Final[Mapping[str, Knob]] = {
    "tolerance": Knob(Part.SOLVER, "tolerance", _number(0, 1)),
    "solver": Knob(Part.SOLVER, "solver", _word(SOLVERS)),
    "max_step": Knob(Part.SOLVER, "longest step", _number(0)),
    "stiffness": Knob(Part.MODEL, "stiffness", _number(0)),
    "exponent": Knob(Part.MODEL, "exponent of the depth", _exponent),
    "law": Knob(Part.MODEL, "law of the normal force", _word(LAWS)),
    "friction": Knob(Part.MODEL, "law of friction", _word(FRICTIONS)),
    "restitution": Knob(Part.MODEL, "method of restitution", _word(RESTITUTIONS)),
    "points": Knob(Part.GEOMETRY, "number of points a pair", _count),
    "geometry": Knob(Part.GEOMETRY, "tessellation", _geometry),
    "backend": Knob(Part.GEOMETRY, "back end", _word(BACKENDS)),
}
"""Every knob but those of PARAMETER."""
