"""The documented operating range: within it no run fails."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

from hard_cases.run import Row


@dataclass(frozen=True)
class Limit:
    """A limit of the operating range.

    Attributes:
        name: of the quantity.
        meaning: in words.
        value: of a run.
        low, high: between which it must lie.
        change: what to change where it does not.
    """

    name: str
    meaning: str
    value: Callable[[Row], float]
    low: float
    high: float
    change: str


LIMITS: Final = (
    Limit(
        "relative depth",
        "deepest penetration m v²/2 + m g x = K x²/2, all bodies together, by the least extent of a body",
        lambda row: row.expected.relative_depth,
        0.0,
        0.1,
        "stiffness up, or speed or mass down",
    ),
    Limit(
        "resolution",
        "tolerance times size, which is what positions may err by, by that penetration",
        lambda row: row.case.tolerance * row.case.structure.size / row.expected.depth,
        0.0,
        1.0,
        "tolerance down",
    ),
    Limit(
        "contact times",
        "time that is simulated by π √(m/K) of the lightest body",
        lambda row: row.expected.contact_times,
        0.0,
        1e4,
        "stiffness down, mass up, or a shorter time",
    ),
    Limit("tolerance", "of the solver", lambda row: row.case.tolerance, 1e-9, 1e-3, "tolerance"),
)
"""Beside the ranges of the knobs themselves."""


def inside(row: Row) -> bool:
    """Whether a run lies in the operating range."""
    return not outside(row)


def outside(row: Row) -> tuple[Limit, ...]:
    """The limits that a run exceeds."""
    return tuple(limit for limit in LIMITS if not limit.low <= limit.value(row) <= limit.high)
