"""The experiment annotation of a model, which the front end's flattened form does not carry."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from modelica2fmu.library.class_text import class_texts

_NUMBER: Final = r"([-+]?[0-9.]+(?:[eE][-+]?[0-9]+)?)"


@dataclass(frozen=True)
class DefaultExperiment:
    """The model's experiment annotation; ``None`` where it does not say."""

    start: float | None = None
    stop: float | None = None
    tolerance: float | None = None
    interval: float | None = None


def read_experiment(model: str, sources: Sequence[Path]) -> DefaultExperiment:
    """The experiment annotation of ``model`` as its file states it; empty where none is found."""
    for found in class_texts(model, sources):
        match = re.search(r"\bexperiment\s*\(([^()]*)\)", found.plain)
        if match is not None:
            return _parse(match[1])
    return DefaultExperiment()


def _parse(text: str) -> DefaultExperiment:
    def value(name: str) -> float | None:
        match = re.search(rf"\b{name}\s*=\s*{_NUMBER}", text)
        return float(match[1]) if match else None

    return DefaultExperiment(value("StartTime"), value("StopTime"), value("Tolerance"), value("Interval"))
