"""The level of each constellation: a normal distribution fitted to its scores, with intervals of its mean."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import stats

from depth_study.arrays import FloatArray, IntArray
from depth_study.evaluation.panel import Panel


@dataclass(frozen=True)
class Levels:
    """Fitted normal distributions; leading axes of many studies come first in all shapes.

    Attributes:
        mean: level of each constellation; shape (p,).
        deviation: standard deviation of the scores; shape (p,).
        half_width: half the confidence interval of the level in the panel's scale, that is for these observers: what
            constellations are compared by; shape (p,).
        population_half_width: the same for all observers like these, whose mean scale and bias are not known; (p,).
        count: answers; shape (p,).
        confidence: of the intervals, such as 0.9.
    """

    mean: FloatArray
    deviation: FloatArray
    half_width: FloatArray
    population_half_width: FloatArray
    count: IntArray
    confidence: float


def fit_levels(panel: Panel, confidence: float = 0.9) -> Levels:
    """Levels of a panel's constellations.

    The interval is Student's of the mean, widened by what removing scale and bias took out of the scores' variance, and
    by the share of it that answers at the ends of the scale do not show.
    """
    there = np.isfinite(panel.scores)
    count = there.sum(-2)
    scores, hidden = np.where(there, panel.scores, 0.0), np.where(there, panel.score_variance, 0.0)
    shown, deviation = _deviations(scores, hidden, count, there, panel.levels)
    answers, answers_hidden = np.where(there, panel.answers, 0.0), np.where(there, panel.answer_variance, 0.0)
    with np.errstate(invalid="ignore", divide="ignore"):
        means = answers.sum(-2) / count
        raw, _ = _deviations(answers, answers_hidden, count, there, means)
        student = np.where(count > 1, stats.t.ppf(0.5 + confidence / 2, np.maximum(count - 1, 1)), np.nan)
        unit = student / np.sqrt(count)
        kept = np.maximum(1 - panel.leverage, 1e-9)
        deviation = deviation / np.sqrt(kept)
        return Levels(panel.levels, deviation, unit * shown / np.sqrt(kept), unit * raw, count, confidence)


def _deviations(
    values: FloatArray, hidden: FloatArray, count: IntArray, there: FloatArray | np.ndarray, mean: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Two deviations of values about their mean: for its error, without what is hidden; of the fitted distribution.

    The first is the sandwich of scores and information of a censored normal distribution: its information is smaller by
    the hidden share of the variance.
    """
    with np.errstate(invalid="ignore", divide="ignore"):
        square = (((values - mean[..., None, :]) * there) ** 2).sum(-2) / (count - 1)
        variance = hidden.sum(-2) / count
        share = np.where(variance > 0, variance / (square + variance), 0.0)
        return np.sqrt(square) / (1 - share), np.sqrt(square + variance)
