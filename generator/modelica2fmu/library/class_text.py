"""Finds the text of a class in Modelica files, for annotations that the front end's flattened form does not carry."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

COMMENTS_AND_STRINGS: Final = re.compile(r'"(?:\\.|[^"\\])*"|//[^\n]*|/\*.*?\*/', re.DOTALL)
_CLASS: Final = r"\b(?:model|block|class|package|connector|record)\s+"


@dataclass(frozen=True)
class ClassText:
    """The text of a class from its head to its ``end``.

    Attributes:
        text: as it is.
        plain: the same with strings and comments blanked; places are the same.
    """

    text: str
    plain: str


def without_comments_and_strings(text: str) -> str:
    """The text with comments and strings blanked: all else keeps its line and column."""
    return COMMENTS_AND_STRINGS.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text)


def class_texts(name: str, sources: Sequence[Path]) -> Iterator[ClassText]:
    """Texts that may be that of the class: its own file in a folder structure first, then those of enclosing packages.

    Args:
        name: full name of the class.
        sources: Modelica files, package folders, and folders that contain packages.
    """
    last = name.rsplit(".", 1)[-1]
    for file in _candidates(name, sources):
        text = file.read_text(encoding="utf-8", errors="replace")
        plain = without_comments_and_strings(text)
        head = re.search(rf"{_CLASS}{re.escape(last)}\b", plain)
        if head is None:
            continue
        end = re.compile(rf"\bend\s+{re.escape(last)}\s*;").search(plain, head.end())
        stop = end.start() if end else len(plain)
        yield ClassText(text[head.start() : stop], plain[head.start() : stop])


def _candidates(name: str, sources: Sequence[Path]) -> list[Path]:
    """Files that may hold the class: its own in a folder structure, those of its enclosing packages."""
    parts = name.split(".")
    files: list[Path] = []
    for source in sources:
        path = source.parent if source.name == "package.mo" else source
        if path.is_file():
            files.append(path)
            continue
        for base in (path, path.parent) if path.name == parts[0] else (path,):
            for depth in range(len(parts), 0, -1):
                folder = base.joinpath(*parts[:depth])
                files.extend(file for file in (folder.with_suffix(".mo"), folder / "package.mo") if file.is_file())
    return list(dict.fromkeys(files))
