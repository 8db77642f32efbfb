"""The experiment annotation of a model, which the front end's flattened form does not carry."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Final

from modelica2fmu.description import DefaultExperiment

_NUMBER: Final = r"([-+]?[0-9.]+(?:[eE][-+]?[0-9]+)?)"
_COMMENTS_AND_STRINGS: Final = re.compile(r'"(?:\\.|[^"\\])*"|//[^\n]*|/\*.*?\*/', re.DOTALL)


def read_experiment(model: str, sources: Sequence[Path]) -> DefaultExperiment:
    """The experiment annotation of ``model`` as its file states it; empty where none is found."""
    for file in _candidates(model, sources):
        text = _class_text(_plain(file), model.rsplit(".", 1)[-1])
        if text is None:
            continue
        match = re.search(r"\bexperiment\s*\(([^()]*)\)", text)
        if match is not None:
            return _parse(match[1])
    return DefaultExperiment()


def _candidates(model: str, sources: Sequence[Path]) -> list[Path]:
    """Files that may hold the class: its own in a folder structure, those of its enclosing packages."""
    parts = model.split(".")
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


def _plain(file: Path) -> str:
    """The text with strings and comments blanked."""
    text = file.read_text(encoding="utf-8", errors="replace")
    return _COMMENTS_AND_STRINGS.sub(lambda match: " " * len(match[0]), text)


def _class_text(text: str, name: str) -> str | None:
    """The text of the class ``name``, from its head to its ``end``."""
    head = re.search(rf"\b(?:model|block|class|package)\s+{re.escape(name)}\b", text)
    if head is None:
        return None
    end = re.compile(rf"\bend\s+{re.escape(name)}\s*;").search(text, head.end())
    return text[head.start() : end.start() if end else len(text)]


def _parse(text: str) -> DefaultExperiment:
    def value(name: str) -> float | None:
        match = re.search(rf"\b{name}\s*=\s*{_NUMBER}", text)
        return float(match[1]) if match else None

    return DefaultExperiment(value("StartTime"), value("StopTime"), value("Tolerance"), value("Interval"))
