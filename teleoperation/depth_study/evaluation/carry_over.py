"""Carry-over: the share by which an answer leans towards the constellation shown before.

An observer who sees constellation b after a may answer about the level (1 - k) b + k a. The share k is the slope of
scores on the level before, within each constellation, so that it is told apart from the levels by the different
constellations that come before the same one in different sequences.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import stats

from depth_study.arrays import FloatArray, IntArray
from depth_study.evaluation.levels import Levels
from depth_study.evaluation.panel import Panel

_ITERATIONS = 6


@dataclass(frozen=True)
class CarryOver:
    """Leading axes of many studies come first in all shapes.

    Attributes:
        share: the estimate of k; 0 none, 1 the answer is about the constellation before; shape ().
        half_width: half its confidence interval; NaN where it cannot be told; shape ().
        levels: levels without carry-over; shape (p,).
        level_half_width: half their confidence intervals in the panel's scale; shape (p,).
        spread: products of half widths with correlations, as covariances are of standard deviations; shape (p, p).
    """

    share: FloatArray
    half_width: FloatArray
    levels: FloatArray
    level_half_width: FloatArray
    spread: FloatArray

    def difference(self, edges: tuple[tuple[int, int], ...]) -> tuple[FloatArray, FloatArray]:
        """Mean difference of levels over edges (from, to), and half its confidence interval; shape () each."""
        weights = np.zeros(self.levels.shape[-1])
        for start, end in edges:
            weights[end] += 1 / len(edges)
            weights[start] -= 1 / len(edges)
        used = np.flatnonzero(weights)
        part = weights[used]
        square = np.einsum("i,...ij,j->...", part, self.spread[..., used[:, None], used], part)
        return np.asarray(self.levels[..., used] @ part), np.sqrt(np.maximum(square, 0.0))


def fit_carry_over(sequences: IntArray, panel: Panel, levels: Levels) -> CarryOver:
    """Estimates the carry-over and takes it out of the levels.

    Args:
        sequences: shape (observers, positions), -1 where none was shown.
        panel: scores.
        levels: fitted to them.
    """
    observers, count = sequences.shape[0], panel.scores.shape[-1]
    before = np.full((observers, count), -1, dtype=np.intp)
    rows, after = np.nonzero((sequences[:, 1:] >= 0) & (sequences[:, :-1] >= 0))
    before[rows, sequences[rows, after + 1]] = sequences[rows, after]
    there = np.isfinite(panel.scores)
    followed = there & (before >= 0)
    mixing = _mixing(before, there)
    scores = np.where(there, panel.scores, 0.0)
    clean = np.where(np.isfinite(levels.mean), levels.mean, 0.0)
    student = stats.t.ppf(0.5 + levels.confidence / 2, np.maximum(panel.used.sum(-1) - 1, 1))
    share = np.zeros(clean.shape[:-1])
    square, about = share, scores
    for _ in range(_ITERATIONS):
        # Score less (1 - k) b - k a: slope on a - b, within each constellation.
        previous = (clean[..., np.maximum(before, 0)] - clean[..., None, :]) * followed
        about = (previous - _mean(previous, there)[..., None, :]) * there
        square = (about**2).sum((-2, -1))
        share = (scores * about).sum((-2, -1)) / np.where(square > 0, square, np.inf)
        matrix = np.eye(count) + share[..., None, None] * mixing
        clean = np.linalg.solve(matrix, np.where(np.isfinite(levels.mean), levels.mean, 0.0)[..., None])[..., 0]
    fitted = levels.mean[..., None, :] + share[..., None, None] * about
    residual = np.where(there, scores - fitted, 0.0)
    with np.errstate(invalid="ignore", divide="ignore"):
        half = student * np.sqrt(((residual * about).sum(-1) ** 2).sum(-1)) / np.where(square > 0, square, np.nan)
        inverse = np.linalg.inv(matrix)
        slope = (inverse @ (mixing @ clean[..., None]))[..., 0]
        known = np.where(np.isfinite(levels.half_width), levels.half_width, 0.0)
        shift = slope * half[..., None]
        spread = (inverse * (known**2)[..., None, :]) @ inverse.swapaxes(-1, -2)
        spread = spread + shift[..., :, None] * shift[..., None, :]
        seen = np.isfinite(levels.half_width)
        level_half = np.where(seen, np.sqrt(np.diagonal(spread, axis1=-2, axis2=-1)), np.nan)
        spread = np.where(seen[..., :, None] & seen[..., None, :], spread, np.nan)
    return CarryOver(share, half, np.where(np.isfinite(levels.mean), clean, np.nan), level_half, spread)


def _mixing(before: IntArray, there: FloatArray | np.ndarray) -> FloatArray:
    """Levels with carry-over are (I + k M) levels: M has the shares of those before, less that of the constellation."""
    count = before.shape[1]
    follows = np.zeros((*before.shape, count))
    rows, columns = np.nonzero(before >= 0)
    follows[rows, columns, before[rows, columns]] = 1.0
    follows[rows, columns, columns] -= 1.0
    if there.ndim == 2:
        total = np.einsum("oc,ocb->cb", there.astype(np.float64), follows)
    elif there.all():
        total = np.broadcast_to(follows.sum(0), (*there.shape[:-2], count, count))
    else:
        total = np.einsum("...oc,ocb->...cb", there.astype(np.float64), follows, optimize=True)
    return np.asarray(total / np.maximum(there.sum(-2), 1)[..., None])


def _mean(values: FloatArray, there: FloatArray | np.ndarray) -> FloatArray:
    return np.asarray((values * there).sum(-2) / np.maximum(there.sum(-2), 1))
