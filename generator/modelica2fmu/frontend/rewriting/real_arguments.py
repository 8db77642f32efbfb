"""Writes whole numbers as Reals where the front end wants Reals.

rumoca 0.10 refuses ``cross({0, 0, 1}, r)`` and ``skew({0, 0, 1})``, whose Integer elements the language converts.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Final

from modelica2fmu.frontend.rewriting.code_text import CodeText
from modelica2fmu.frontend.rewriting.for_loops import Edit
from modelica2fmu.library.brackets import end_of_bracket, parts_between_commas

_CALL: Final = re.compile(r"(?<![\w.])(?:cross|skew)\s*\(")
_LIST: Final = re.compile(r"\s*-?\s*\{")
_WHOLE: Final = re.compile(r"\s*[-+]?\s*(?P<digits>\d+)\s*")
_NAME: Final = re.compile(r"\s*(?P<name>[A-Za-z_]\w*)\s*")
_INTEGER: Final = r"\bInteger\s*(?:\[[^\]]*\]\s*{name}\b|{name}\s*\[)"


def real_argument_edits(source: CodeText) -> Iterator[tuple[int, int, str]]:
    """Insertions that make the arguments of ``cross`` and ``skew`` Real."""
    code = source.code
    for call in _CALL.finditer(code):
        end = end_of_bracket(code, call.end() - 1) - 1
        for part in parts_between_commas(code, call.end(), end):
            yield from _real(code, *part)


def _real(code: str, start: int, end: int) -> Iterator[Edit]:
    opened = _LIST.match(code, start, end)
    if opened is not None:
        parts = parts_between_commas(code, opened.end(), end_of_bracket(code, opened.end() - 1) - 1)
        numbers = [_WHOLE.fullmatch(code, *part) for part in parts]
        if numbers[0] is not None and all(numbers):
            place = numbers[0].end("digits")
            yield place, place, ".0"
        return
    name = _NAME.fullmatch(code, start, end)
    if name is not None and re.search(_INTEGER.format(name=name["name"]), code):
        yield *name.span("name"), f"(1.0*{name['name']})"
