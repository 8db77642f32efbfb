"""Effects of factors: what the relative answers say over the edges on which one factor changes.

The difference over one edge is the mean of the relative answers of those who walked it, in either direction; that of
a contrast is the mean over its edges, each counting equally. Before, each observer's bias (a tendency to say "deeper")
and scale (known from the absolute answers, which use the same numbers) are removed; ends of the scale count as for
levels. Intervals come from the spread among observers, whose answers belong together (cluster-robust variance:
K.-Y. Liang and S. L. Zeger, Biometrika 73, 1986).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import stats

from depth_study.arrays import BoolArray, FloatArray, IntArray
from depth_study.evaluation.censored_normal import mean_beyond
from depth_study.evaluation.panel import Panel
from depth_study.record.answers import GREATEST, LEAST, SAME

_ITERATIONS = 8


@dataclass(frozen=True)
class RelativeScores:
    """Relative answers without scale and bias, 0 for "the same".

    Attributes:
        scores: NaN where there is none; shape (..., steps).
        observer: row of the observer of each step; shape (steps,).
        start, end: constellations' numbers of each step; shape (steps,).
    """

    scores: FloatArray
    observer: IntArray
    start: IntArray
    end: IntArray


@dataclass(frozen=True)
class Effect:
    """A difference in the panel's scale; leading axes of many studies come first in all shapes.

    Attributes:
        mean: NaN where no edge was walked; shape ().
        half_width: half the confidence interval; NaN where too few walked; shape ().
        edge_means: of each of the contrast's edges; NaN where nobody walked it; shape (edges,).
        edge_counts: answers of each edge; shape (edges,).
        edges: the constellations' numbers (from, to).
    """

    mean: FloatArray
    half_width: FloatArray
    edge_means: FloatArray
    edge_counts: IntArray
    edges: tuple[tuple[int, int], ...]


def relative_scores(sequences: IntArray, relative: FloatArray, panel: Panel, *, ends: bool = True) -> RelativeScores:
    """Removes observers' bias and scale from relative answers.

    Args:
        sequences: shape (observers, positions), -1 where none was shown.
        relative: 1 to 9, NaN where missing; shape (..., observers, positions).
        panel: of the same observers' absolute answers.
        ends: whether 1 and 9 stand for everything beyond them; if not, they are numbers like all others.
    """
    rows, after = np.nonzero((sequences[:, 1:] >= 0) & (sequences[:, :-1] >= 0))
    start, end = sequences[rows, after], sequences[rows, after + 1]
    given = np.full((*relative.shape[:-1], sequences.shape[1] - 1), np.nan)
    expected = given.copy()
    given[..., rows, after] = relative[..., rows, after + 1] - SAME
    expected[..., rows, after] = panel.levels[..., end] - panel.levels[..., start]
    there = np.isfinite(given) & np.isfinite(expected) & panel.used[..., None]
    given, expected = np.where(there, given, 0.0), np.where(there, expected, 0.0)
    scale = np.where(panel.used, panel.scale, 1.0)
    scores = _without_ends(given, expected, there, scale, ends=ends)
    scores = np.where(there, scores, np.nan)
    return RelativeScores(scores[..., rows, after], rows, start, end)


def _without_ends(
    given: FloatArray, expected: FloatArray, there: BoolArray, scale: FloatArray, *, ends: bool
) -> FloatArray:
    """Scores in the panel's scale; where an end was answered, the expected value beyond it.

    Args:
        given: relative answers, 0 for the same; shape (..., n, positions - 1).
        expected: differences of levels; same shape.
        there: where an answer counts; same shape.
        scale: of observers; shape (..., n).
        ends: whether the ends stand for everything beyond them.
    """
    count = np.maximum(there.sum(-1), 1)
    top, bottom = there & (given >= GREATEST - SAME) & ends, there & (given <= LEAST - SAME) & ends
    expected_mean = expected.sum(-1) / count
    about = (expected - expected_mean[..., None]) * there
    square = _no_zero((scale[..., None] * about**2).sum((-2, -1)))
    free = np.maximum(there.sum((-2, -1)) - there.any(-1).sum(-1) - 1, 1)
    values = given.copy()
    hidden = np.zeros_like(given)
    for _ in range(_ITERATIONS):
        # How far relative answers spread against differences of levels, and each observer's tendency.
        slope = (values * about).sum((-2, -1)) / square
        bias = values.sum(-1) / count - slope[..., None] * scale * expected_mean
        fitted = bias[..., None] + slope[..., None, None] * scale[..., None] * expected
        residual = ((((values - fitted) ** 2 + hidden) / scale[..., None] ** 2) * there).sum((-2, -1))
        deviation = np.sqrt(residual / free)[..., None, None] * scale[..., None] * np.ones_like(given)
        for mask, sign, border in ((top, 1.0, GREATEST - SAME - 0.5), (bottom, -1.0, LEAST - SAME + 0.5)):
            values[mask], hidden[mask] = mean_beyond(fitted[mask], deviation[mask], border, sign)
    slope = (values * about).sum((-2, -1)) / square
    bias = values.sum(-1) / count - slope[..., None] * scale * expected_mean
    scores = ((values - bias[..., None]) / scale[..., None]) * there
    # Dividing by scales that are not exactly known lengthens; the mean observer's answers shall keep their slope.
    weight = (about**2).sum(-1)
    observers = np.maximum((weight > 0).sum(-1), 1)
    mean_scale = (scale * (weight > 0)).sum(-1) / observers * weight.sum(-1) / _no_zero((scale * weight).sum(-1))
    unit = (values * about).sum((-2, -1)) / _no_zero((scores * about).sum((-2, -1))) * mean_scale
    return np.asarray(scores * np.where(unit > 0, unit, 1.0)[..., None, None])


def _no_zero(values: FloatArray) -> FloatArray:
    return np.where(values != 0, values, np.inf)


def fit_effect(
    relative: RelativeScores, edges: tuple[tuple[int, int], ...], observers: int, confidence: float = 0.9
) -> Effect:
    """The mean difference over edges.

    Args:
        relative: scores of all steps.
        edges: constellations' numbers (from, to).
        observers: how many rows of observers there are.
        confidence: of the interval.
    """
    steps, walks, signs = _walked(relative, edges)
    scores = relative.scores[..., steps] * signs
    there = np.isfinite(scores)
    scores = np.where(there, scores, 0.0)
    on_edge = np.zeros((steps.size, len(edges)))
    on_edge[np.arange(steps.size), walks] = 1.0
    of_observer = np.zeros((steps.size, observers))
    of_observer[np.arange(steps.size), relative.observer[steps]] = 1.0
    count = np.rint(there.astype(np.float64) @ on_edge).astype(np.intp)
    walked = count > 0
    with np.errstate(invalid="ignore", divide="ignore"):
        edge_means = np.where(walked, (scores @ on_edge) / count, np.nan)
        weight = 1 / (np.maximum(walked.sum(-1, keepdims=True), 1) * np.maximum(count, 1))
        mean = np.where(walked.any(-1), np.nansum(np.where(walked, edge_means, 0.0), -1) / walked.sum(-1), np.nan)
        # What an edge's own mean takes out of the residuals; an edge with one answer has no spread.
        spread = np.sqrt(count / (count - 1.0)) * weight
        residual = np.where(there, (scores - edge_means[..., walks]) * spread[..., walks], 0.0)
        variance = ((residual @ of_observer) ** 2).sum(-1)
        taking_part = (there.astype(np.float64) @ of_observer > 0).sum(-1)
        student = stats.t.ppf(0.5 + confidence / 2, np.maximum(taking_part - 1, 1))
        half = np.where((count != 1).all(-1) & (taking_part > 1), student * np.sqrt(variance), np.nan)
    return Effect(np.asarray(mean), np.asarray(half), edge_means, count, edges)


def mean_difference(levels: FloatArray, edges: tuple[tuple[int, int], ...]) -> FloatArray:
    """The same difference from levels: the mean over edges; shape (...,) of levels of shape (..., constellations)."""
    start, end = np.array(edges, dtype=np.intp).reshape(-1, 2).T
    return np.asarray((levels[..., end] - levels[..., start]).mean(-1))


def _walked(relative: RelativeScores, edges: tuple[tuple[int, int], ...]) -> tuple[IntArray, IntArray, FloatArray]:
    """The steps that walk one of the edges: their numbers, the edges' and 1 or -1 for the direction."""
    steps, walks, signs = [], [], []
    numbers = {edge: k for k, edge in enumerate(edges)}
    for step, (start, end) in enumerate(zip(relative.start.tolist(), relative.end.tolist(), strict=True)):
        for walk, sign in ((numbers.get((start, end)), 1.0), (numbers.get((end, start)), -1.0)):
            if walk is not None:
                steps.append(step)
                walks.append(walk)
                signs.append(sign)
    return np.array(steps, dtype=np.intp), np.array(walks, dtype=np.intp), np.array(signs)
