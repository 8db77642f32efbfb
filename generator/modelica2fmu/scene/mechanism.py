"""Bodies and contact managers of a model, known by the names of their variables."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from typing import Final

_BODY: Final = re.compile(r"(.+)\.frame_a\.r_0\[1\]")
_MASS_POINTS: Final = ("m", "r_CM[1]", "I[1,1]")
_MOTION: Final = ("v_0[1]", "w_a[1]", "frame_a.R.T[1,1]")
_PAIR_MANAGER: Final = re.compile(r"(.+)\.pairDistance\[1\]")
_COMPILED_MANAGER: Final = re.compile(r"(.+)\.contactCount")
_THICKNESS: Final = re.compile(r"(.+)\.thickness\[\d+\]")
_FREE_BODIES: Final = re.compile(r"(.+)\.bodyKineticEnergy\[1\]")


@dataclass(frozen=True)
class Mechanism:
    """Names of components.

    Attributes:
        bodies: with a mass and a motion, as Modelica.Mechanics.MultiBody.Parts.Body has them.
        managers: of contacts.
        free_bodies: many bodies in one component, as ContactMultiBody.Parts.FreeBodies.
    """

    bodies: tuple[str, ...]
    managers: tuple[str, ...]
    free_bodies: tuple[str, ...]


def find_mechanism(names: Collection[str]) -> Mechanism:
    """The components of a model whose scalar variables have these names, in their order."""
    bodies = (
        name
        for name in _components(_BODY, names)
        if all(f"{name}.{part}" in names for part in (*_MASS_POINTS, *_MOTION))
    )
    managers = dict.fromkeys((*_components(_PAIR_MANAGER, names), *_components(_COMPILED_MANAGER, names)))
    return Mechanism(tuple(bodies), tuple(managers), tuple(_components(_FREE_BODIES, names)))


def pair_thicknesses(names: Collection[str]) -> list[str]:
    """The variables of contact managers that hold the thickness of the thinner body of each pair."""
    managers = find_mechanism(names).managers
    return [name for name in names if (found := _THICKNESS.fullmatch(name)) is not None and found[1] in managers]


def _components(pattern: re.Pattern[str], names: Collection[str]) -> Iterator[str]:
    for name in names:
        found = pattern.fullmatch(name)
        if found is not None:
            yield found[1]
