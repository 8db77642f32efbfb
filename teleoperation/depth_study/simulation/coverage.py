"""Simulated studies: how often the evaluation's intervals cover what the observers were drawn from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from contact_foundation.progress import Progress, silent

from depth_study.arrays import BoolArray, FloatArray, IntArray
from depth_study.design.factors import Contrast, Design
from depth_study.evaluation.carry_over import fit_carry_over
from depth_study.evaluation.effects import fit_effect, mean_difference, relative_scores
from depth_study.evaluation.levels import fit_levels
from depth_study.evaluation.panel import fit_panel
from depth_study.record.answers import by_constellation
from depth_study.simulation.observers import Population, draw_answers

_AT_ONCE = 250
"""Studies in memory at a time."""


@dataclass(frozen=True)
class LevelCoverage:
    """Shares of studies whose interval covers the true level of a constellation, and the mean errors.

    Attributes:
        share: shape (constellations,).
        bias: mean of estimate less truth; shape (constellations,).
        half_width: mean half width; shape (constellations,).
    """

    share: FloatArray
    bias: FloatArray
    half_width: FloatArray

    @property
    def mean(self) -> float:
        """Mean share over constellations."""
        return float(self.share.mean())


@dataclass(frozen=True)
class EffectCoverage:
    """The same of a contrast, against the true difference in the panel's scale.

    Attributes:
        contrast: the difference.
        share, bias: of the effect from relative answers.
        clean_share, clean_bias: of the difference of levels without carry-over.
    """

    contrast: Contrast
    share: float
    bias: float
    clean_share: float
    clean_bias: float


@dataclass(frozen=True)
class Coverage:
    """What was found with one carry-over.

    Attributes:
        carry_over: of the observers drawn.
        panel: of levels in the panel's scale.
        population: of levels of all observers.
        clean: of levels without carry-over, in the panel's scale.
        carry_over_estimate: mean of its estimates.
        carry_over_share: how often its interval covers it.
        effects: of the design's contrasts.
    """

    carry_over: float
    panel: LevelCoverage
    population: LevelCoverage
    clean: LevelCoverage
    carry_over_estimate: float
    carry_over_share: float
    effects: tuple[EffectCoverage, ...]


def study_coverage(
    design: Design,
    levels: FloatArray,
    sequences: IntArray,
    population: Population,
    *,
    studies: int,
    seed: int,
    carry_overs: Sequence[float],
    confidence: float = 0.9,
    progress: Progress = silent,
) -> tuple[Coverage, ...]:
    """Evaluates simulated studies, as many for each carry-over.

    Args:
        design: what is studied.
        levels: true ones; shape (constellations,).
        sequences: of the observers; shape (observers, positions).
        population: what observers are drawn from, but for the carry-over.
        studies: how many.
        seed: the same seed gives the same studies.
        carry_overs: shares, one a result.
        confidence: of the intervals.
        progress: is told the share done.
    """
    found = []
    for k, carry_over in enumerate(carry_overs):
        chance = np.random.default_rng((seed, k))
        drawn = replace(population, carry_over=carry_over)
        parts = []
        for done in range(0, studies, _AT_ONCE):
            count = min(_AT_ONCE, studies - done)
            parts.append(_part(design, levels, sequences, drawn, count, chance, confidence))
            progress("simulated studies", (k + (done + count) / studies) / len(carry_overs))
        found.append(_joined(design, carry_over, parts))
    return tuple(found)


@dataclass(frozen=True)
class _Part:
    """Errors and half widths by kind, of some studies."""

    levels: dict[str, tuple[FloatArray, FloatArray]]
    carry_over: tuple[FloatArray, FloatArray]
    effects: list[tuple[FloatArray, FloatArray]]
    clean_effects: list[tuple[FloatArray, FloatArray]]


def _part(
    design: Design,
    levels: FloatArray,
    sequences: IntArray,
    population: Population,
    studies: int,
    chance: np.random.Generator,
    confidence: float,
) -> _Part:
    drawn = draw_answers(levels, sequences, population, studies, chance)
    truth = drawn.panel_levels(levels)
    panel = fit_panel(by_constellation(sequences, drawn.absolute, levels.size))
    fitted = fit_levels(panel, confidence)
    carried = fit_carry_over(sequences, panel, fitted)
    relative = relative_scores(sequences, drawn.relative, panel)
    effects, clean_effects = [], []
    for contrast in design.contrasts:
        edges = design.directed_edges(contrast)
        true_difference = mean_difference(truth, edges)
        effect = fit_effect(relative, edges, sequences.shape[0], confidence)
        effects.append((effect.mean - true_difference, effect.half_width))
        clean, half = carried.difference(edges)
        clean_effects.append((clean - true_difference, half))
    return _Part(
        {
            "panel": (fitted.mean - truth, fitted.half_width),
            "population": (fitted.mean - levels, fitted.population_half_width),
            "clean": (carried.levels - truth, carried.level_half_width),
        },
        (carried.share - population.carry_over, carried.half_width),
        effects,
        clean_effects,
    )


def _joined(design: Design, carry_over: float, parts: list[_Part]) -> Coverage:
    def level(kind: str) -> LevelCoverage:
        error = np.concatenate([part.levels[kind][0] for part in parts])
        half = np.concatenate([part.levels[kind][1] for part in parts])
        return LevelCoverage(_covers(error, half).mean(0), error.mean(0), half.mean(0))

    share, bias = _share_and_bias([part.carry_over for part in parts])
    effects = []
    for k, contrast in enumerate(design.contrasts):
        relative = _share_and_bias([part.effects[k] for part in parts])
        clean = _share_and_bias([part.clean_effects[k] for part in parts])
        effects.append(EffectCoverage(contrast, *relative, *clean))
    return Coverage(
        carry_over, level("panel"), level("population"), level("clean"), carry_over + bias, share, tuple(effects)
    )


def _share_and_bias(parts: list[tuple[FloatArray, FloatArray]]) -> tuple[float, float]:
    error, half = (np.concatenate([part[k] for part in parts]) for k in range(2))
    return float(_covers(error, half).mean()), float(error.mean())


def _covers(error: FloatArray, half_width: FloatArray) -> BoolArray:
    return np.asarray(np.abs(error) <= half_width)
