"""How many observers find a difference: shares of simulated studies whose interval excludes no difference."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from contact_foundation.errors import InputError
from contact_foundation.progress import Progress, silent

from depth_study.arrays import FloatArray, IntArray
from depth_study.design.factors import Contrast, Design
from depth_study.evaluation.effects import fit_effect, relative_scores
from depth_study.evaluation.levels import fit_levels
from depth_study.evaluation.panel import fit_panel
from depth_study.record.answers import by_constellation
from depth_study.simulation.observers import Population, draw_answers

ENOUGH = 0.8
"""The share that is usually asked for."""
_AT_ONCE = 250


@dataclass(frozen=True)
class Power:
    """Shares of studies that find a difference, with its sign.

    Attributes:
        observers: of each study.
        difference: the true one.
        constellations: between the levels of two constellations.
        edge: by the relative answers over the edge between them.
        factor: by the relative answers over all edges of the contrast.
    """

    observers: int
    difference: float
    constellations: float
    edge: float
    factor: float


@dataclass(frozen=True)
class PowerTable:
    """Power over numbers of observers.

    Attributes:
        contrast: the one whose edges all have the difference.
        edge: names of the two constellations looked at alone.
        rows: by number of observers, ascending.
        without: the same without a difference, with the last sequences: false alarms.
    """

    contrast: Contrast
    edge: tuple[str, str]
    rows: tuple[Power, ...]
    without: Power

    def enough(self, column: str) -> int | None:
        """The least number of observers of the table that finds the difference in 80 % of studies; None if none."""
        return next((row.observers for row in self.rows if getattr(row, column) >= ENOUGH), None)


def study_power(
    design: Design,
    levels: FloatArray,
    sequences: IntArray,
    population: Population,
    *,
    difference: float,
    numbers: Sequence[int],
    studies: int,
    seed: int,
    confidence: float = 0.9,
    progress: Progress = silent,
) -> PowerTable:
    """Simulates studies of several sizes in which one factor's two levels differ by a given amount everywhere.

    Args:
        design: what is studied; the pair of levels with the most edges is taken.
        levels: where the difference starts from; shape (constellations,).
        sequences: as many as the greatest number of observers.
        population: what observers are drawn from.
        difference: the true one, in steps of the scale.
        numbers: of observers, ascending.
        studies: of each size.
        seed: the same seed gives the same studies.
        confidence: of the intervals.
        progress: is told the share done.

    Raises:
        InputError: the difference would lead out of the scale's range for all constellations.
    """
    contrast = max(design.level_contrasts, key=lambda c: len(design.directed_edges(c)))
    edges = design.directed_edges(contrast)
    if not 0 < abs(difference) < 8:
        raise InputError(
            f"the difference {difference:g} is none of a scale from 1 to 9", remedy="Give one such as 0.5."
        )
    middle = min(edges, key=lambda edge: abs(float(levels[edge[0]]) + difference / 2 - 5))
    planted = levels.copy()
    equal = levels.copy()
    for start, end in edges:
        planted[end] = planted[start] + difference
        equal[end] = equal[start]
    rows = []
    for k, observers in enumerate(numbers):
        chance = np.random.default_rng((seed, observers))
        found = _found(planted, sequences[:observers], population, studies, chance, edges, middle, confidence)
        signed = (found == np.sign(difference)).mean(1)
        rows.append(Power(observers, difference, *map(float, signed)))
        progress("power", (k + 1) / (len(numbers) + 1))
    last = numbers[-1]
    chance = np.random.default_rng((seed, last, 0))
    none = (_found(equal, sequences[:last], population, studies, chance, edges, middle, confidence) != 0).mean(1)
    progress("power", 1.0)
    return PowerTable(
        contrast,
        (design.names[middle[0]], design.names[middle[1]]),
        tuple(rows),
        Power(last, 0.0, *map(float, none)),
    )


def _found(
    levels: FloatArray,
    sequences: IntArray,
    population: Population,
    studies: int,
    chance: np.random.Generator,
    edges: tuple[tuple[int, int], ...],
    edge: tuple[int, int],
    confidence: float,
) -> FloatArray:
    """Signs of the differences found, 0 for none: of two levels, one edge, all edges; shape (3, studies)."""
    parts = []
    for done in range(0, studies, _AT_ONCE):
        drawn = draw_answers(levels, sequences, population, min(_AT_ONCE, studies - done), chance)
        panel = fit_panel(by_constellation(sequences, drawn.absolute, levels.size))
        fitted = fit_levels(panel, confidence)
        relative = relative_scores(sequences, drawn.relative, panel)
        one = fit_effect(relative, (edge,), sequences.shape[0], confidence)
        every = fit_effect(relative, edges, sequences.shape[0], confidence)
        start, end = edge
        between = np.hypot(fitted.half_width[:, start], fitted.half_width[:, end])
        parts.append(
            np.stack(
                [
                    _sign(fitted.mean[:, end] - fitted.mean[:, start], between),
                    _sign(one.mean, one.half_width),
                    _sign(every.mean, every.half_width),
                ]
            )
        )
    return np.concatenate(parts, axis=1)


def _sign(mean: FloatArray, half_width: FloatArray) -> FloatArray:
    return np.where(np.abs(mean) > half_width, np.sign(mean), 0.0)
