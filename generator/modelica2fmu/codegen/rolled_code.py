"""C statements that differ by their indices alone, as loops.

A call with arrays of thousands of elements copies each of them. Written out, a compiler needs time that grows with the
square of their number.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Final

_INDEX: Final = re.compile(r"\[(\d+)\]")
_PERIODS: Final = (1, 2, 3, 4, 6, 9)
_SHORTEST: Final = 16
_VARIABLE: Final = "rolled"

_Form = tuple[str, tuple[int, ...]]


def rolled(statements: Sequence[str]) -> list[str]:
    """The same statements in the same order, regular stretches of them as loops.

    Args:
        statements: one line each; constant indices are numbers in square brackets. A stretch is regular if every p-th
            statement has the same text but for indices, which grow by the same number each time.
    """
    forms = [_form(statement) for statement in statements]
    result: list[str] = []
    position = 0
    while position < len(statements):
        period, repetitions = max(
            ((p, _repetitions(forms, position, p)) for p in _PERIODS), key=lambda found: found[0] * found[1]
        )
        if period * repetitions < _SHORTEST or repetitions < _SHORTEST // 4:
            result.append(statements[position])
            position += 1
            continue
        result.append(f"for (size_t {_VARIABLE} = 0; {_VARIABLE} < {repetitions}; ++{_VARIABLE}) {{")
        for offset in range(position, position + period):
            result.append("  " + _with_variable(forms[offset], forms[offset + period]))
        result.append("}")
        position += period * repetitions
    return result


def _form(statement: str) -> _Form:
    """The text without its indices, and these."""
    return _INDEX.sub("[]", statement), tuple(int(index) for index in _INDEX.findall(statement))


def _repetitions(forms: Sequence[_Form], start: int, period: int) -> int:
    """How often the ``period`` statements from ``start`` on come, their indices growing evenly; 0 if once only."""
    if start + 2 * period > len(forms):
        return 0
    strides = []
    for offset in range(start, start + period):
        (text, first), (next_text, second) = forms[offset], forms[offset + period]
        if text != next_text:
            return 0
        strides.append(tuple(b - a for a, b in zip(first, second, strict=True)))
    position = start + 2 * period
    while position < len(forms):
        (text, before), (next_text, now) = forms[position - period], forms[position]
        stride = strides[(position - start) % period]
        if text != next_text or any(b - a != s for a, b, s in zip(before, now, stride, strict=True)):
            break
        position += 1
    return (position - start) // period


def _with_variable(first: _Form, second: _Form) -> str:
    """A statement of the loop's body, from its first two occurrences."""
    text, indices = first
    parts = text.split("[]")
    written = [parts[0]]
    for base, following, part in zip(indices, second[1], parts[1:], strict=True):
        stride = following - base
        sign, size = ("+", stride) if stride > 0 else ("-", -stride)
        index = f"{base}" if stride == 0 else f"{base} {sign} {size} * {_VARIABLE}"
        written.append(f"[{index}]{part}")
    return "".join(written)
