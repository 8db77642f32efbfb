"""Reads tables from the files that the Standard Library's tables may name: its text format, comma-separated values."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Final

import numpy as np
from contact_foundation.errors import InputError, Place, UnsupportedModelError

_LARGEST: Final = 64 << 20  # bytes
_HEAD: Final = re.compile(r"\s*(?:double|float)\s+(\w+)\s*\(\s*(\d+)\s*,\s*(\d+)\s*\)\s*(.*)", re.DOTALL)
_SEPARATOR: Final = re.compile(r"[\s,;]+")


def read_table(file: Path, name: str, delimiter: str = ",", header_lines: int = 0) -> np.ndarray:
    """The table ``name`` of a file, rows by columns.

    Text files begin with ``#1``; each table follows a line ``double name(rows, columns)``, and ``#`` begins comments
    (documentation of ``Modelica.Blocks.Sources.CombiTimeTable``). Files that end in ``.csv`` hold one table.

    Raises:
        InputError: the file is missing, too large or no such file, or has no such table.
        UnsupportedModelError: a file of MATLAB.
    """
    if not file.is_file():
        raise InputError("there is no such file for a table", place=Place(file=file))
    if file.stat().st_size > _LARGEST:
        raise InputError(f"a file for a table is larger than {_LARGEST >> 20} MB", place=Place(file=file))
    if file.suffix.lower() == ".mat":
        raise UnsupportedModelError(
            "tables in files of MATLAB are not translated",
            place=Place(file=file),
            remedy="write the table to a text file",
        )
    lines = file.read_text(encoding="utf-8", errors="replace").splitlines()
    if file.suffix.lower() == ".csv":
        return _comma_separated(file, lines, delimiter, header_lines)
    return _named(file, lines, name)


def _comma_separated(file: Path, lines: list[str], delimiter: str, header_lines: int) -> np.ndarray:
    rows = []
    for number, line in enumerate(lines[header_lines:], start=header_lines + 1):
        if line.strip():
            rows.append(_numbers(file, number, line.split(delimiter)))
    if not rows or any(len(row) != len(rows[0]) for row in rows):
        raise InputError("a file for a table has no rows or rows of unequal length", place=Place(file=file))
    return np.array(rows)


def _named(file: Path, lines: list[str], name: str) -> np.ndarray:
    if not lines or lines[0].strip() != "#1":
        raise InputError("a text file with tables begins with the line #1", place=Place(file=file, line=1))
    found = iter(_without_comments(lines))
    for number, line in found:
        head = _HEAD.fullmatch(line)
        if head is None or head[1] != name:
            continue
        rows, columns = int(head[2]), int(head[3])
        wanted = rows * columns
        if wanted * 2 > _LARGEST:
            raise InputError("a table is too large", place=Place(file=file, line=number))
        items = _numbers(file, number, [word for word in _SEPARATOR.split(head[4]) if word])
        while len(items) < wanted:
            number, line = next(found, (0, ""))
            if number == 0 or _HEAD.fullmatch(line):
                break
            items += _numbers(file, number, [word for word in _SEPARATOR.split(line) if word])
        if len(items) != wanted:
            raise InputError(
                f"the table {name} has {len(items)} numbers instead of {rows} times {columns}", place=Place(file=file)
            )
        return np.array(items).reshape(rows, columns)
    raise InputError(f"this file has no table {name}", place=Place(file=file))


def _without_comments(lines: list[str]) -> Iterator[tuple[int, str]]:
    for number, line in enumerate(lines, start=1):
        text = line.split("#", 1)[0].strip()
        if text:
            yield number, text


def _numbers(file: Path, line: int, words: list[str]) -> list[float]:
    try:
        numbers = [float(word.replace("d", "e").replace("D", "e")) for word in words]
    except ValueError as error:
        raise InputError(f"a number is needed here: {error}", place=Place(file=file, line=line)) from error
    if not np.isfinite(numbers).all():
        raise InputError("a table has a number that is not finite", place=Place(file=file, line=line))
    return numbers
