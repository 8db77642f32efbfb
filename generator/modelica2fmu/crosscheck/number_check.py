"""Numbers in the user's text that no Real can hold, for which the front end has no place."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

from contact_foundation.errors import InputError, Place

from modelica2fmu.crosscheck.class_syntax import Extent
from modelica2fmu.crosscheck.class_tokens import tokens_of


def check_numbers(text: bytes, file: Path, place: Callable[[Extent], Place]) -> None:
    """Refuses numbers beyond 1.8e308.

    Args:
        text: of the file that holds the model.
        file: its name.
        place: of a piece of text.

    Raises:
        InputError: a number is too large; its line is named.
    """
    for token in tokens_of(text.decode("latin-1")):
        if token.kind == "number" and math.isinf(float(token.text)):
            raise InputError(
                f"the number {token.text[:40]} is larger than any Real",
                place=place(Extent(file, token.start, token.end)),
                remedy="Give a number below 1.8e308; for a bound that is never reached, Modelica.Constants.inf.",
            )
