"""NAME=VALUE arguments."""

from __future__ import annotations

from collections.abc import Sequence

from contact_foundation.errors import InputError


def parse_assignments(words: Sequence[str]) -> dict[str, str]:
    """Start values as texts by variable name.

    Raises:
        InputError: a word has no ``=`` or no name, or a name is given twice.
    """
    values: dict[str, str] = {}
    for word in words:
        name, equals, text = word.partition("=")
        if not equals or not name:
            raise InputError(f"{word!r} does not read as NAME=VALUE")
        if name in values:
            raise InputError(f"{name} is set twice")
        values[name] = text
    return values
