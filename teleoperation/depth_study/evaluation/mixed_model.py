"""A linear mixed model of the absolute answers: constellations fixed, observers random. A check by other means.

It knows neither scales nor the ends of the scale, takes the answers as they are, and is fitted by statsmodels.
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy import stats

from depth_study.arrays import FloatArray
from depth_study.record.answers import Answers


@dataclass(frozen=True)
class MixedModel:
    """A fitted model, or why there is none.

    Attributes:
        failure: why no model was fitted; empty if one was.
        levels: of the constellations; NaN where nobody answered; shape (p,).
        covariance: of the levels; shape (p, p).
        observer_deviation: standard deviation of the observers' biases.
        residual_deviation: standard deviation of what is left.
        confidence: of intervals.
    """

    failure: str
    levels: FloatArray
    covariance: FloatArray
    observer_deviation: float = float("nan")
    residual_deviation: float = float("nan")
    confidence: float = 0.9

    def half_widths(self) -> FloatArray:
        """Half the confidence interval of each level; shape (p,)."""
        return self._student * np.sqrt(np.diag(self.covariance))

    def difference(self, edges: tuple[tuple[int, int], ...]) -> tuple[float, float]:
        """Mean difference over edges and half its confidence interval."""
        weights = np.zeros(self.levels.size)
        for start, end in edges:
            weights[end] += 1 / len(edges)
            weights[start] -= 1 / len(edges)
        used = weights != 0
        mean = float(weights[used] @ self.levels[used])
        variance = float(weights[used] @ self.covariance[np.ix_(used, used)] @ weights[used])
        return mean, self._student * float(np.sqrt(max(variance, 0.0)))

    @property
    def _student(self) -> float:
        return float(stats.norm.ppf(0.5 + self.confidence / 2))


def fit_mixed_model(answers: Answers, confidence: float = 0.9) -> MixedModel:
    """Fits the model by restricted maximum likelihood."""
    table = answers.by_constellation
    count = table.shape[1]
    nothing = np.full(count, np.nan), np.full((count, count), np.nan)
    try:
        from statsmodels.regression.mixed_linear_model import MixedLM
    except ImportError:
        reason = "statsmodels is not installed (pip install 'contactmultibody[study]')"
        return MixedModel(reason, *nothing)
    observers, constellations = np.nonzero(np.isfinite(table))
    seen = np.unique(constellations)
    if np.unique(observers).size < 2 or observers.size <= seen.size + 1:
        return MixedModel("too few answers", *nothing)
    design = (constellations[:, None] == seen).astype(np.float64)
    with warnings.catch_warnings(record=True):
        warnings.simplefilter("always")
        try:
            fit: Any = MixedLM(table[observers, constellations], design, groups=observers).fit(reml=True)
        except (np.linalg.LinAlgError, ValueError) as error:
            return MixedModel(f"the fit failed: {error}", *nothing)
    known = np.asarray(fit.cov_params())[: seen.size, : seen.size]
    if not fit.converged or not np.isfinite(known).all() or (np.diag(known) < 0).any():
        return MixedModel("the fit did not converge", *nothing)
    levels, covariance = nothing
    levels[seen] = np.asarray(fit.fe_params)
    covariance[np.ix_(seen, seen)] = known
    bias = float(np.sqrt(max(float(np.asarray(fit.cov_re)[0, 0]), 0.0)))
    return MixedModel("", levels, covariance, bias, float(np.sqrt(fit.scale)), confidence)
