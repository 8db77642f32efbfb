"""Published levels of a study, and what their summary in words should have said.

The spread of a figure, where more than one edge has it, is that of 90 % of a normal distribution fitted to the edges'
differences.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeGuard

import numpy as np
from contact_foundation.errors import InputError, Place, ProblemList
from contact_foundation.toml_text import read_toml
from scipy import stats

from depth_study.arrays import FloatArray
from depth_study.design.factors import Contrast, Design
from depth_study.record.answers import GREATEST, LEAST

_SHARE = 0.9
_ROUNDING = 0.05 + 1e-9
"""Words give one decimal."""


@dataclass(frozen=True)
class Figure:
    """A difference that was published in words, beside what the published levels give.

    Attributes:
        contrast: of the design.
        published, published_spread: as in words; None where nothing is said.
        difference: mean over the contrast's edges.
        spread: half the interval of 90 % of the fitted normal distribution; None with one edge.
        least, greatest: of the edges' differences.
        edges: how many.
    """

    contrast: Contrast
    published: float
    published_spread: float | None
    difference: float
    spread: float | None
    least: float
    greatest: float
    edges: int

    @property
    def deviations(self) -> tuple[str, ...]:
        """What differs by more than the rounding of the words."""
        texts = []
        if abs(self.difference - self.published) > _ROUNDING:
            texts.append(f"the levels give {self.difference:+.2f}, the words say {self.published:+.1f}")
        if self.published_spread is not None:
            if self.spread is None:
                texts.append(f"the words say ± {self.published_spread:.1f}, but there is one edge")
            elif abs(self.spread - self.published_spread) > _ROUNDING:
                texts.append(f"the levels give ± {self.spread:.2f}, the words say ± {self.published_spread:.1f}")
        return tuple(texts)


@dataclass(frozen=True)
class Published:
    """Published levels of a design's constellations.

    Attributes:
        source: where they were published.
        observers: how many took part; None if it is not said.
        levels: by constellation; shape (constellations,).
        figures: what was published in words.
    """

    source: str
    observers: int | None
    levels: FloatArray
    figures: tuple[Figure, ...]


def load_published(path: Path, design: Design) -> Published:
    """The published levels that a TOML file holds.

    Raises:
        InputError: the file cannot be read or is no TOML; ProblemList where it does not fit the design.
    """
    data = read_toml(path)
    problems: list[InputError] = []

    def problem(component: str, message: str, remedy: str) -> None:
        problems.append(InputError(message, place=Place(file=path, component=component), remedy=remedy))

    levels = np.full(len(design.constellations), np.nan)
    numbers = {levels_of: k for k, levels_of in enumerate(design.constellations)}
    for k, entry in enumerate(_tables(data, "levels")):
        place = f"levels[{k + 1}]"
        number = numbers.get(tuple(str(entry.get(factor.name)) for factor in design.factors))
        score = entry.get("score")
        if number is None:
            problem(place, "is no constellation of the design", "Give a level of each factor.")
        elif not _is_number(score) or not LEAST <= score <= GREATEST:
            problem(place, f"has the score {score!r}", f"Give a number from {LEAST} to {GREATEST}.")
        elif not math.isnan(levels[number]):
            problem(place, f"gives {design.names[number]} a second time", "Remove one of them.")
        else:
            levels[number] = score
    missing = [design.names[k] for k in np.flatnonzero(np.isnan(levels))]
    if missing and not problems:
        problem("levels", f"leaves out {', '.join(missing)}", "Give a score for each constellation.")
    contrasts = {contrast.name: contrast for contrast in design.contrasts}
    chosen = []
    for k, entry in enumerate(_tables(data, "figure")):
        contrast = contrasts.get(str(entry.get("contrast")))
        difference, spread = entry.get("difference"), entry.get("spread")
        if contrast is None:
            known = ", ".join(contrasts) or "none"
            problem(f"figure[{k + 1}]", f"names the contrast {entry.get('contrast')!r}", f"The design has: {known}.")
        elif not _is_number(difference) or not (spread is None or _is_number(spread)):
            problem(f"figure[{k + 1}]", "has no number as difference or spread", "Give finite numbers.")
        else:
            chosen.append((contrast, float(difference), None if spread is None else float(spread)))
    if problems:
        raise ProblemList(f"{path}: these published levels do not fit the design", problems)
    observers = data.get("observers")
    return Published(
        str(data.get("source", path.stem)),
        observers if isinstance(observers, int) else None,
        levels,
        tuple(_figure(design, levels, *entry) for entry in chosen),
    )


def _figure(design: Design, levels: FloatArray, contrast: Contrast, published: float, spread: float | None) -> Figure:
    differences = np.array([levels[end] - levels[start] for start, end in design.directed_edges(contrast)])
    half = None
    if differences.size > 1:
        half = float(stats.norm.ppf(0.5 + _SHARE / 2) * differences.std(ddof=1))
    return Figure(
        contrast,
        published,
        spread,
        float(differences.mean()),
        half,
        float(differences.min()),
        float(differences.max()),
        differences.size,
    )


def _tables(data: Mapping[str, Any], key: str) -> list[Mapping[str, Any]]:
    entries = data.get(key, [])
    return [entry for entry in entries if isinstance(entry, dict)] if isinstance(entries, list) else []


def _is_number(value: object) -> TypeGuard[float]:
    return not isinstance(value, bool) and isinstance(value, int | float) and math.isfinite(value)
