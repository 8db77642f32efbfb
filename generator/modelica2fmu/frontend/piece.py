"""What brings an error of the front end about."""

from __future__ import annotations

from dataclasses import dataclass

from modelica2fmu.crosscheck.class_syntax import Extent


@dataclass(frozen=True)
class Piece:
    """An equation, a block of them, a binding or a modifier.

    Attributes:
        extent: where it stands.
        text: of it.
        said: what the front end says of it.
        array: the array of components that a modifier is one of; empty for others.
        counted: the variable of type Integer, Boolean or String that is given a value, with its type; empty for others.
        wanted: the number of elements of the vector that a modifier is of, where that is known.
    """

    extent: Extent
    text: str
    said: str
    array: str = ""
    counted: tuple[str, str] | None = None
    wanted: int | None = None
