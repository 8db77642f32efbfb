"""Brackets and what is between commas, in Modelica without what comments and Strings say."""

from __future__ import annotations

from typing import Final

_OPENING: Final = {"(": ")", "{": "}", "[": "]"}


def end_of_bracket(code: str, start: int) -> int:
    """Where the bracket that opens at ``start`` is closed: the place after it, or the end of the text."""
    depth: list[str] = []
    for position in range(start, len(code)):
        letter = code[position]
        if letter in _OPENING:
            depth.append(_OPENING[letter])
        elif depth and letter == depth[-1]:
            depth.pop()
            if not depth:
                return position + 1
    return len(code)


def parts_between_commas(code: str, start: int, end: int) -> list[tuple[int, int]]:
    """Ranges between the commas that stand in no bracket of their own."""
    parts, first, position = [], start, start
    while position < end:
        if code[position] in _OPENING:
            position = end_of_bracket(code, position)
            continue
        if code[position] == ",":
            parts.append((first, position))
            first = position + 1
        position += 1
    return [*parts, (first, end)]
