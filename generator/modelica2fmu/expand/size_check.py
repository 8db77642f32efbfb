"""Whether a model is of a size that can be translated."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Final

from contact_foundation.errors import Place, UnsupportedModelError

from modelica2fmu.frontend import ir
from modelica2fmu.library.source_map import Span

MOST_SCALARS: Final = 150_000
"""Ten thousand states are built in half a minute, and work grows faster than their number."""


def require_tractable(variables: Sequence[ir.Variable], place: Callable[[Span | None, str], Place]) -> None:
    """Refuses models of more scalar variables than can be translated in a time that anybody waits.

    Args:
        variables: arrays count by their elements.
        place: the place of a variable's declaration, with its name.

    Raises:
        UnsupportedModelError: there are more than ``MOST_SCALARS``; the largest array is named.
    """
    total = sum(math.prod(variable.shape) for variable in variables)
    if total <= MOST_SCALARS:
        return
    largest = max(variables, key=lambda variable: math.prod(variable.shape))
    shape = " x ".join(str(length) for length in largest.shape) or "1"
    raise UnsupportedModelError(
        f"the model has {total} scalar variables, of which {MOST_SCALARS} can be translated; the largest array is this "
        f"one of {shape} elements",
        place=place(largest.span, largest.name),
        remedy=_remedy(largest.name, variables),
    )


def _remedy(largest: str, variables: Sequence[ir.Variable]) -> str:
    manager = largest.rpartition(".")[0]
    pairs = next((variable.shape[0] for variable in variables if variable.name == f"{manager}.pairDistance"), 0)
    if not manager or pairs == 0:
        return "Make it smaller; data belong into a table of the Standard Library, which counts as one."
    return (
        f"{manager} watches {pairs} pairs of bodies, each with variables of its own: give it pairs={{{{1,2}},...}}, "
        "those that matter (an assembly's: --exclude A,B, or --no-contacts and --include A,B), or take a "
        "CompiledContactManager, whose variables grow with the bodies alone."
    )
