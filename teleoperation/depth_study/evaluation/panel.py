"""Removing each observer's scale and bias from absolute answers: what is left are scores in the panel's scale.

Observers use the numbers 1 to 9 differently: one gives all constellations more than others do (bias), one spreads them
farther (scale). Scores have each observer's mean and spread replaced by those of the panel on the same constellations.
The panel's scale is that of its mean observer: the mean of the biases and scales of those who answered.

1 and 9 stand for everything beyond them. Where such ends are answered, the score is the expected value of the fitted
normal distribution beyond the end, and its variance is accounted for (expectation-maximisation for censored normal
distributions: A. P. Dempster, N. M. Laird, D. B. Rubin, J. R. Stat. Soc. B 39, 1977, section 4.2).

All arrays may have leading axes: of many studies at once.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from depth_study.arrays import BoolArray, FloatArray
from depth_study.evaluation.censored_normal import mean_beyond
from depth_study.record.answers import GREATEST, LEAST

MIN_ANSWERS = 6
"""Observers with fewer answers have no spread that can be told from noise."""
_ITERATIONS = 14
_BEYOND = 0.5
_FARTHEST = 1.0


@dataclass(frozen=True)
class Panel:
    """Scores in the panel's scale; leading axes of many studies come first in all shapes.

    Attributes:
        scores: answers without scale and bias; NaN where there is none or the observer is left out; shape (n, p).
        score_variance: variance of scores at the ends of the scale, where an answer says "that much or more"; else 0;
            shape (n, p).
        answers: the answers themselves, with expected values at the ends; shape (n, p).
        answer_variance: as score_variance, in the answers' units; shape (n, p).
        levels: mean score of each constellation; shape (p,).
        deviation: standard deviation of scores about their levels; shape ().
        scale: spread of each observer's answers against the panel's; NaN where left out; shape (n,).
        bias: mean of each observer's answers less the mean of the levels answered; shape (n,).
        leverage: share of a score's variance that removing scale and bias took out; shape (p,).
        used: whether an observer counts; those do not who gave fewer than six answers or all the same; shape (n,).
    """

    scores: FloatArray
    score_variance: FloatArray
    answers: FloatArray
    answer_variance: FloatArray
    levels: FloatArray
    deviation: FloatArray
    scale: FloatArray
    bias: FloatArray
    leverage: FloatArray
    used: BoolArray


def fit_panel(answers: FloatArray, *, ends: bool = True) -> Panel:
    """Removes scale and bias.

    Args:
        answers: absolute answers by constellation, NaN where missing; shape (..., observers, constellations).
        ends: whether 1 and 9 stand for everything beyond them; if not, they are numbers like all others.
    """
    used = _usable(answers)
    there = np.isfinite(answers) & used[..., None]
    given = np.where(there, answers, 0.0)
    expected, variance = given.copy(), np.zeros_like(given)
    top, bottom = there & (given >= GREATEST) & ends, there & (given <= LEAST) & ends
    fit = _Fit(there, _over(given, there, -2))
    fit.update(expected, variance)
    # One round is enough for complete answers without ends; they converge by the share of what is missing.
    for _ in range(_ITERATIONS if (top | bottom).any() or not (there | ~used[..., None]).all() else 1):
        for mask, sign, border in ((top, 1.0, GREATEST - _BEYOND), (bottom, -1.0, LEAST + _BEYOND)):
            fit.expect_beyond(expected, variance, mask, sign, border)
        fit.update(expected, variance)
    missing = np.where(there, 1.0, np.nan)
    gone = np.where(used, 1.0, np.nan)
    with np.errstate(invalid="ignore", divide="ignore"):
        return Panel(
            scores=fit.scores * missing,
            score_variance=variance * (fit.gain**2)[..., None] * missing,
            answers=expected * missing,
            answer_variance=variance * missing,
            levels=np.where(there.any(-2), fit.levels, np.nan),
            deviation=fit.deviation,
            scale=gone / fit.gain,
            bias=(fit.means - _over(np.broadcast_to(fit.levels[..., None, :], there.shape), there, -1)) * gone,
            leverage=fit.leverage(),
            used=used,
        )


def _usable(answers: FloatArray) -> BoolArray:
    there = np.isfinite(answers)
    least = np.where(there, answers, np.inf).min(-1, initial=np.inf)
    most = np.where(there, answers, -np.inf).max(-1, initial=-np.inf)
    return np.asarray((there.sum(-1) >= MIN_ANSWERS) & (most > least))


def _over(values: FloatArray, there: BoolArray, axis: int) -> FloatArray:
    """Mean of what is there over an axis; 0 where nothing is."""
    return np.asarray((values * there).sum(axis) / np.maximum(there.sum(axis), 1), dtype=np.float64)


class _Fit:
    """The panel's levels and each observer's line from answers to scores."""

    def __init__(self, there: BoolArray, levels: FloatArray) -> None:
        self._there = there
        self.levels = levels
        self.deviation = np.zeros(levels.shape[:-1])
        self.scores = np.zeros(there.shape)
        self.means = np.zeros(there.shape[:-1])
        self.gain = np.ones(there.shape[:-1])

    def update(self, answers: FloatArray, variance: FloatArray) -> None:
        """Fits lines, scores and levels to answers and the variances that these have at the ends."""
        there = self._there
        self.means = _over(answers, there, -1)
        about = (answers - self.means[..., None]) * there
        spread = np.sqrt(_over(about**2 + variance, there, -1))
        mean, level_about = self._levels_about()
        wanted = np.sqrt(_over(level_about**2, there, -1) + self.deviation[..., None] ** 2)
        gain = wanted / np.where(spread > 0, spread, np.inf)
        scores = mean[..., None] + gain[..., None] * about
        levels = _over(scores, there, -2)
        # The panel's scale: answers rise with levels by one on average, and have the levels' mean on average.
        of_observer = _over(np.broadcast_to(levels[..., None, :], there.shape), there, -1)
        centred = (levels[..., None, :] - of_observer[..., None]) * there
        square = (centred**2).sum((-2, -1))
        slope = np.where(square > 0, (about * centred).sum((-2, -1)) / np.where(square > 0, square, 1.0), 1.0)
        observers = np.maximum(there.any(-1).sum(-1), 1)
        middle = of_observer.sum(-1) / observers
        offset = self.means.sum(-1) / observers
        self.levels = offset[..., None] + slope[..., None] * (levels - middle[..., None])
        self.scores = offset[..., None, None] + slope[..., None, None] * (scores - middle[..., None, None])
        self.gain = slope[..., None] * gain
        residual = (self.scores - self.levels[..., None, :]) ** 2 + variance * (self.gain**2)[..., None]
        count = there.sum((-2, -1))
        free = count - 2 * there.any(-1).sum(-1) - there.any(-2).sum(-1) + 2
        self.deviation = np.sqrt((residual * there).sum((-2, -1)) / np.maximum(free, 1))

    def expect_beyond(
        self, answers: FloatArray, variance: FloatArray, mask: BoolArray, sign: float, border: float
    ) -> None:
        """Puts expected answers and variances where an end was answered: a normal distribution beyond the border."""
        where = np.nonzero(mask)
        if not where[0].size:
            return
        study, observer = where[:-2], where[:-1]
        mean, _ = self._levels_about()
        middle, gain, line = self.means[observer], self.gain[observer], mean[observer]
        level = middle + (self.levels[(*study, where[-1])] - line) / gain
        deviation = np.minimum(self.deviation[study] / gain, (GREATEST - LEAST) / 2)
        # Where all answered the end, any level beyond it would do: it is sought up to a step beyond.
        level = np.clip(level, LEAST - _FARTHEST, GREATEST + _FARTHEST)
        answers[where], variance[where] = mean_beyond(level, deviation, border, sign)

    def leverage(self) -> FloatArray:
        """Of each constellation, the mean share of a score's variance taken out with two parameters an observer."""
        _, about = self._levels_about()
        count = np.maximum(self._there.sum(-1, keepdims=True), 1)
        square = (about**2).sum(-1, keepdims=True)
        share = 1 / count + about**2 / np.where(square > 0, square, np.inf)
        return _over(np.minimum(share, 1.0), self._there, -2)

    def _levels_about(self) -> tuple[FloatArray, FloatArray]:
        """For each observer the mean of the levels answered, and the levels about it."""
        levels = np.broadcast_to(self.levels[..., None, :], self._there.shape)
        mean = _over(levels, self._there, -1)
        return mean, (levels - mean[..., None]) * self._there
