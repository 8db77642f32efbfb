"""The Standard Library's external functions on Strings, for Strings that are known at translation.

What they do is stated in the documentation of ``Modelica.Utilities.Strings``; indices count from 1.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final

_LESS, _EQUAL, _GREATER = 1, 2, 3  # Modelica.Utilities.Types.Compare


def _substring(text: str, start: int, end: int) -> str:
    first = min(max(start, 1), len(text) or 1)
    return text[first - 1 : max(first, min(end, len(text)))]


def _compare(first: str, second: str, is_case_sensitive: bool) -> int:
    if not is_case_sensitive:
        first, second = first.lower(), second.lower()
    if first == second:
        return _EQUAL
    return _LESS if first < second else _GREATER


def _skip_white_space(text: str, start: int) -> int:
    rest = text[max(start, 1) - 1 :]
    return max(start, 1) + len(rest) - len(rest.lstrip())


STRING_FUNCTIONS: Final[dict[str, Callable[..., Any]]] = {
    "ModelicaStrings_length": len,
    "ModelicaStrings_substring": _substring,
    "ModelicaStrings_compare": _compare,
    "ModelicaStrings_skipWhiteSpace": _skip_white_space,
}
