"""Which contact manager a mechanism gets: one that shows each pair, or one that grows with the bodies alone."""

from __future__ import annotations

from enum import Enum
from typing import Final

from contact_foundation.errors import InputError, Place

from cad2modelica.mechanism.model import Assembly

MOST_PAIRS: Final = 200
"""Of pairs with variables of their own: 120 make a hand's FMU build three times as long, 1300 cannot be built."""

MANY_PAIRS: Final = 50
"""From here on each pair's variables are most of what a build and a simulation take: a note says so."""


class ManagerChoice(Enum):
    """The contact manager that is asked for; AUTOMATIC: by the number of pairs."""

    AUTOMATIC = "auto"
    PAIRS = "pairs"
    COMPILED = "compiled"


def takes_compiled_manager(
    assembly: Assembly, pairs: int, choice: ManagerChoice, *, clearances: bool
) -> tuple[bool, tuple[str, ...]]:
    """Whether contacts are those of a CompiledContactManager, and notes that say why.

    Args:
        assembly: the mechanism.
        pairs: number of pairs that may touch.
        choice: what is asked for.
        clearances: whether exact distances are, which only pairs have.

    Raises:
        InputError: the CompiledContactManager is asked for, and something that it does not have.
    """
    beyond = _beyond_compiled(assembly, clearances)
    if choice is ManagerChoice.COMPILED and beyond is not None:
        raise InputError(
            f"the CompiledContactManager has no {beyond}",
            place=Place(file=assembly.file),
            remedy="Leave --contact-manager compiled out, or do without.",
        )
    if choice is not ManagerChoice.AUTOMATIC:
        return choice is ManagerChoice.COMPILED, ()
    if pairs < MANY_PAIRS or (pairs <= MOST_PAIRS and beyond is not None):
        return False, ()
    if pairs <= MOST_PAIRS:
        note = (
            f"{pairs} pairs have variables of their own, which take most of the time of building and simulating; "
            "--contact-manager compiled does without: it shows forces on bodies, no distances, and needs no events"
        )
        return False, (note,)
    if beyond is not None:
        note = f"{pairs} pairs have variables of their own, for they have {beyond}: the FMU may take long to build"
        return False, (note,)
    note = (
        f"{pairs} pairs may touch, more than {MOST_PAIRS}: contacts is a CompiledContactManager, which shows the force "
        "on each body instead of each pair, and needs no events; --contact-manager pairs shows each pair"
    )
    return True, (note,)


def _beyond_compiled(assembly: Assembly, clearances: bool) -> str | None:
    if assembly.contacts.friction == "anchored":
        return "anchored friction"
    return "exact clearances" if clearances else None
