"""Sizes of what variables of functions are given, where the front end has not checked them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from modelica2fmu.interpreter.arrays import ShapeError, Value


def require_sizes(name: str, wanted: Sequence[int | None], value: Value) -> None:
    """Raises ShapeError where a value does not have the sizes that a variable has.

    Args:
        name: of the variable.
        wanted: its sizes; None where any will do.
        value: that it is given.
    """
    given = value.shape if isinstance(value, np.ndarray) else ()
    fits = len(given) == len(wanted) and all(size in (None, other) for size, other in zip(wanted, given, strict=True))
    if not fits:
        raise ShapeError(f"{name} has {_described(wanted)}, and what it is given has {_described(given)}")


def _described(sizes: Sequence[int | None]) -> str:
    if not sizes:
        return "no dimensions"
    shown = " x ".join(":" if size is None else str(size) for size in sizes)
    return f"{shown} element{'' if list(sizes) == [1] else 's'}"
