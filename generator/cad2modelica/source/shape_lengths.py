"""Which lengths a box, sphere, cylinder or capsule can have."""

from __future__ import annotations

import numpy as np
from contact_foundation.errors import InputError, Place
from numpy.typing import ArrayLike


class ImpossibleShape(InputError):
    """A shape that is given and cannot be: it is refused, and not left out with a note."""


def require_lengths(kind: str, lengths: ArrayLike, place: Place) -> None:
    """Refuses lengths that no shape has.

    Args:
        kind: the shape.
        lengths: all that it needs, m; NaN if one is not given.
        place: where it stands.

    Raises:
        ImpossibleShape: one of them is not positive.
        InputError: all are zero, as where robot descriptions mean that there is no shape.
    """
    values = np.atleast_1d(np.asarray(lengths, dtype=np.float64))
    if (values > 0).all():
        return
    if not values.any():
        raise InputError(f"the {kind} has no extent", place=place, remedy="Correct it, or take it out.")
    raise ImpossibleShape(f"a {kind} needs positive lengths", place=place, remedy="Correct them.")
