"""The structural choices of a ContactManager, and changes of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum

EFFECTS = ("friction", "restitution", "turning", "points", "pairs")
"""What can be switched on and off."""


class Friction(Enum):
    """Laws of friction; the value is the literal of ContactMultiBody.Types.Friction."""

    NONE = "None"
    REGULARISED = "Regularised"
    ANCHORED = "Anchored"


class Restitution(Enum):
    """How restitution is delivered."""

    BY_EVENT = "by event"
    MEMORYLESS = "memoryless"
    NONE = "none"


@dataclass(frozen=True)
class Change:
    """What is changed about a manager; what is None or empty stays as it is.

    Attributes:
        friction: law of friction.
        restitution: how restitution is delivered.
        turning: whether torques act against spin and rolling.
        point_capacity: largest number of points of a pair.
        kept_pairs: the pairs that are still looked at, counted from 0 in the manager's order.
        values: numbers by the name of a parameter of pairs, one for each of the manager's own pairs.
        law: law of the normal force, a literal of ContactMultiBody.Types.NormalLaw.
        exponent: of the depth.
        backend: algorithm that finds the contacts, a literal of ContactMultiBody.Types.Backend.
        geometry: descriptor of each body.
    """

    friction: Friction | None = None
    restitution: Restitution | None = None
    turning: bool | None = None
    point_capacity: int | None = None
    kept_pairs: tuple[int, ...] | None = None
    values: Mapping[str, tuple[float, ...]] = field(default_factory=dict)
    law: str | None = None
    exponent: float | None = None
    backend: str | None = None
    geometry: tuple[str, ...] | None = None

    def with_(self, other: Change) -> Change:
        """Both changes; where they disagree the other one counts."""
        return Change(
            friction=self.friction if other.friction is None else other.friction,
            restitution=self.restitution if other.restitution is None else other.restitution,
            turning=self.turning if other.turning is None else other.turning,
            point_capacity=self.point_capacity if other.point_capacity is None else other.point_capacity,
            kept_pairs=self.kept_pairs if other.kept_pairs is None else other.kept_pairs,
            values={**self.values, **other.values},
            law=self.law if other.law is None else other.law,
            exponent=self.exponent if other.exponent is None else other.exponent,
            backend=self.backend if other.backend is None else other.backend,
            geometry=self.geometry if other.geometry is None else other.geometry,
        )
