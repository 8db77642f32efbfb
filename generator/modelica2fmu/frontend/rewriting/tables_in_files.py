"""Writes tables that stand in files into the model, as ``table=[0, 1; 10, 2]``.

rumoca 0.10 refuses ``tableOnFile=true`` of the Standard Library's tables. What such a table is made of is fixed at
translation all the same. The file has to be named where ``tableOnFile`` is, by a String or a call of ``loadResource``.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Final

import numpy as np

from modelica2fmu.frontend.rewriting.code_text import CodeText
from modelica2fmu.frontend.rewriting.for_loops import Edit
from modelica2fmu.library.brackets import end_of_bracket, parts_between_commas
from modelica2fmu.library.table_files import read_table

_ON_FILE: Final = re.compile(r"\btableOnFile\s*=\s*true\b")
_TABLE: Final = re.compile(r"\b(?:CombiTimeTable|CombiTable1D[sv]|(?P<surface>CombiTable2D[sv]))\b")
_MODIFIER: Final = re.compile(r"\s*(?:each\s+)?(?P<name>[A-Za-z_]\w*)\s*=\s*")
_STRING: Final = re.compile(r'"(?P<text>[^"\\]*)"')
_NAMED: Final = re.compile(r'(?:(?:[A-Za-z_]\w*\s*\.\s*)*loadResource\s*\(\s*)?"(?P<text>[^"\\]*)"\s*\)?')
_WHOLE: Final = re.compile(r"\d+")

Span = tuple[int, int]


def table_edits(source: CodeText, is_used: Callable[[int], bool], find_file: Callable[[str], Path]) -> Iterator[Edit]:
    """Replacements that give tables the rows of their files, in as many lines.

    Args:
        source: the text.
        is_used: = true, if a place belongs to the model: no other files are read.
        find_file: the file that a name in a model means.

    Raises:
        InputError: a file is missing or wrong.
        UnsupportedModelError: a file of MATLAB.
    """
    for found in _ON_FILE.finditer(source.code):
        opened = _opening(source.code, found.start())
        if opened is None or not is_used(opened):
            continue
        kind = _TABLE.search(source.code, source.code.rfind(";", 0, opened) + 1, opened)
        if kind is None:
            continue
        modifiers = dict(_modifiers(source.code, opened))
        rows = None if "table" in modifiers else _rows(source, modifiers, find_file)
        if rows is None:
            continue
        yield *modifiers["tableOnFile"], "false"
        start, end = modifiers["fileName"]
        name = source.code.rindex("fileName", 0, start)
        has_columns = "columns" in modifiers or kind["surface"] is not None
        default = "" if has_columns else ", columns={2}"  # that of a table without rows
        lines = "\n" * source.code.count("\n", name, end)
        yield name, end, f"table={rows}{default}{lines}"


def _opening(code: str, place: int) -> int | None:
    """The bracket that is open at a place."""
    depth = 0
    for at in range(place - 1, -1, -1):
        if code[at] == ")":
            depth += 1
        elif code[at] == "(":
            depth -= 1
        elif code[at] == ";":
            return None
        if depth < 0:
            return at
    return None


def _modifiers(code: str, opened: int) -> Iterator[tuple[str, Span]]:
    """Names of modifiers in a bracket, and where their values are."""
    for start, end in parts_between_commas(code, opened + 1, end_of_bracket(code, opened) - 1):
        found = _MODIFIER.match(code, start, end)
        if found is not None:
            yield found["name"], (found.end(), found.end() + len(code[found.end() : end].rstrip()))


def _rows(source: CodeText, modifiers: dict[str, Span], find_file: Callable[[str], Path]) -> str | None:
    """The rows of a table, as Modelica; None where it is not known which these are."""
    file = _text(source, modifiers.get("fileName"), _NAMED)
    table = _text(source, modifiers.get("tableName"), _STRING) if "tableName" in modifiers else ""
    delimiter = _text(source, modifiers.get("delimiter"), _STRING) if "delimiter" in modifiers else ","
    header = "0"
    if "nHeaderLines" in modifiers:
        start, end = modifiers["nHeaderLines"]
        header = source.plain[start:end]
    if file is None or table is None or delimiter is None or _WHOLE.fullmatch(header) is None:
        return None
    return _matrix(read_table(find_file(file), table, delimiter, int(header)))


def _text(source: CodeText, span: Span | None, pattern: re.Pattern[str]) -> str | None:
    found = None if span is None else pattern.fullmatch(source.plain, *span)
    return None if found is None else found["text"]


def _matrix(rows: np.ndarray) -> str:
    return f"[{'; '.join(', '.join(map(repr, row)) for row in rows.tolist())}]"
