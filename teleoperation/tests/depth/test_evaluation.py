"""Scale, bias, ends of the scale, carry-over and effects: exact without noise, against references with it."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from contact_foundation.errors import InputError
from depth_study.design.sequences import make_sequences
from depth_study.evaluation.carry_over import fit_carry_over
from depth_study.evaluation.censored_normal import mean_beyond
from depth_study.evaluation.effects import fit_effect, relative_scores
from depth_study.evaluation.levels import fit_levels
from depth_study.evaluation.mixed_model import fit_mixed_model
from depth_study.evaluation.panel import fit_panel
from depth_study.evaluation.published import load_published
from depth_study.evaluation.study import evaluate
from depth_study.record.answers import Answers, by_constellation
from depth_study.report.evaluation_report import evaluation_text, write_evaluation
from scipy import stats
from small_designs import PUBLISHED_FILE, thesis

DESIGN = thesis()
LEVELS = load_published(PUBLISHED_FILE, DESIGN).levels
SEQUENCES = make_sequences(DESIGN, 12, seed=4)
SCALE = np.linspace(0.7, 1.3, 12)
BIAS = np.linspace(-0.9, 0.9, 12)[::-1]


def exact_answers(carry_over: float = 0.0, noise: float = 0.0) -> Answers:
    """Answers that are no whole numbers and know no ends."""
    chance = np.random.default_rng(2)
    shown = LEVELS[SEQUENCES]
    before = np.concatenate([shown[:, :1], shown[:, :-1]], axis=1)
    seen = shown + carry_over * (before - shown)
    seen = seen + noise * chance.standard_normal(seen.shape)
    absolute = 5 + BIAS[:, None] + SCALE[:, None] * (seen - 5)
    relative = np.full(seen.shape, np.nan)
    relative[:, 1:] = 5 + 0.5 * BIAS[:, None] + SCALE[:, None] * np.diff(seen, axis=1)
    return Answers(DESIGN, tuple(range(1, 13)), SEQUENCES, absolute, relative)


def panel_of(answers: Answers):
    return fit_panel(answers.by_constellation, ends=False)


def test_scale_and_bias_are_removed_exactly():
    panel = panel_of(exact_answers())
    np.testing.assert_allclose(panel.levels, LEVELS, atol=1e-12)
    np.testing.assert_allclose(panel.scale, SCALE, rtol=1e-12)
    np.testing.assert_allclose(panel.scores, np.broadcast_to(LEVELS, (12, 20)), atol=1e-12)
    np.testing.assert_allclose(panel.bias, BIAS + (SCALE - 1) * (LEVELS.mean() - 5), atol=1e-12)
    assert panel.deviation < 1e-12


def test_scale_and_bias_are_removed_where_answers_are_missing():
    table = exact_answers().by_constellation
    table[np.random.default_rng(1).random(table.shape) < 0.3] = np.nan
    panel = fit_panel(table, ends=False)
    # Levels are known up to the scale of those who answered.
    slope, offset = np.polyfit(LEVELS, panel.levels, 1)
    np.testing.assert_allclose(panel.levels, offset + slope * LEVELS, atol=2e-3)
    np.testing.assert_allclose(slope, 1, atol=0.02)


def test_observers_without_spread_are_left_out():
    table = exact_answers().by_constellation
    table[3] = 4.0
    table[5, 2:] = np.nan
    panel = fit_panel(table, ends=False)
    assert np.flatnonzero(~panel.used).tolist() == [3, 5]
    assert np.isnan(panel.scores[[3, 5]]).all()
    np.testing.assert_allclose(np.delete(panel.scores, [3, 5], 0).std(0), 0, atol=1e-9)


def test_several_studies_at_once_give_what_each_gives_alone():
    chance = np.random.default_rng(7)
    tables = np.clip(np.rint(LEVELS + chance.normal(0, 1.5, (3, 12, 20))), 1, 9)
    tables[1, 4, 3] = np.nan
    together = fit_levels(fit_panel(tables))
    for k, table in enumerate(tables):
        alone = fit_levels(fit_panel(table))
        np.testing.assert_allclose(together.mean[k], alone.mean, atol=2e-3)
        np.testing.assert_allclose(together.half_width[k], alone.half_width, rtol=2e-2)


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("border", [-3.0, 0.0, 0.4, 2.0, 30.0])
def test_values_beyond_a_border_have_the_mean_and_variance_of_a_truncated_normal(sign, border):
    mean, variance = mean_beyond(np.array([0.3]), np.array([1.7]), sign * border, sign)
    alpha = sign * (sign * border - 0.3) / 1.7
    known = stats.truncnorm(alpha, np.inf)
    np.testing.assert_allclose(mean, 0.3 + sign * 1.7 * known.mean(), rtol=1e-9)
    np.testing.assert_allclose(variance, 1.7**2 * known.var(), rtol=1e-4)


def test_far_beyond_nothing_overflows():
    mean, variance = mean_beyond(np.array([0.0, 0.0]), np.array([1e-9, 1.0]), np.array([5.0, -1e5]), 1.0)
    assert np.isfinite(mean).all()
    assert np.isfinite(variance).all()
    assert mean[0] == pytest.approx(5.0)
    assert mean[1] == pytest.approx(0.0)


def test_a_level_near_the_end_of_the_scale_is_found_beyond_the_answers():
    """The means of answers fall short of a level of 8.1, as 9 is the greatest answer."""
    chance = np.random.default_rng(5)
    levels = np.concatenate([np.linspace(3, 7, 19), [8.1]])
    answers = np.clip(np.rint(levels + chance.normal(0, 1.2, (200, 44, 20))), 1, 9)
    short = answers[..., -1].mean() - 8.1
    off = fit_panel(answers).levels[:, -1].mean() - 8.1
    assert short < -0.15
    assert abs(off) < 0.5 * abs(short)


@pytest.mark.parametrize("end", [1.0, 9.0])
def test_a_constellation_for_which_all_answered_the_end_is_at_most_a_step_beyond(end):
    """Of such answers any level beyond the end is as likely; before, expectation-maximisation ran away."""
    table = np.clip(np.rint(LEVELS + np.random.default_rng(3).normal(0, 0.7, (6, 20))), 2, 8)
    table[:, 4] = end
    panel = fit_panel(table)
    assert 0.4 < abs(panel.levels[4] - 5) - 3 < 2.5
    assert np.isfinite(fit_levels(panel).half_width).all()


def test_any_answers_of_few_observers_are_evaluated_or_refused(tmp_path):
    """Random, constant, extreme and unfinished answers: tables and page without warnings."""
    chance = np.random.default_rng(0)
    published = load_published(PUBLISHED_FILE, DESIGN)
    evaluated = 0
    for trial in range(24):
        count = int(chance.integers(0, 7))
        absolute, relative = chance.integers(1, 10, (2, count, 20)).astype(float)
        kind = trial % 6
        if kind == 1:
            absolute[:] = 9
        elif kind == 2:
            absolute = np.where(absolute > 5, 9.0, 1.0)
        elif kind == 3:
            absolute, relative[:] = np.where(absolute > 1, 9.0, 8.0), 9
        elif kind == 4:
            relative[:] = 5
        relative[:, 0] = np.nan
        for row in range(count):
            end = int(chance.integers(1, 21))
            absolute[row, end:] = relative[row, end:] = np.nan
        answers = Answers(DESIGN, tuple(range(1, count + 1)), SEQUENCES[:count], absolute, relative)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            try:
                evaluation = evaluate(answers)
            except InputError:
                continue
            assert evaluation_text(evaluation, published)
            write_evaluation(evaluation, published, tmp_path / "study.html")
        evaluated += 1
    assert evaluated > 8


def test_intervals_are_students_for_one_answer_each():
    """Without scale and bias to remove, the population's interval is that of Student's t."""
    table = exact_answers(noise=0.5).by_constellation
    levels = fit_levels(fit_panel(table, ends=False), confidence=0.95)
    for k in range(20):
        known = stats.t.interval(0.95, 11, loc=table[:, k].mean(), scale=stats.sem(table[:, k]))
        assert levels.population_half_width[k] == pytest.approx((known[1] - known[0]) / 2)


def test_effects_are_exact_without_noise():
    answers = exact_answers()
    relative = relative_scores(SEQUENCES, answers.relative, panel_of(answers), ends=False)
    for contrast in DESIGN.contrasts + DESIGN.level_contrasts:
        edges = DESIGN.directed_edges(contrast)
        effect = fit_effect(relative, edges, 12)
        truth = np.array([LEVELS[b] - LEVELS[a] for a, b in edges])
        np.testing.assert_allclose(effect.edge_means[effect.edge_counts > 0], truth[effect.edge_counts > 0], atol=1e-9)


def test_an_effect_of_one_edge_has_students_interval():
    answers = exact_answers(noise=0.4)
    relative = relative_scores(SEQUENCES, answers.relative, panel_of(answers), ends=False)
    edge = DESIGN.directed_edges(DESIGN.contrasts[0])
    effect = fit_effect(relative, edge, 12)
    walked = [
        sign * score
        for score, *step in zip(relative.scores, relative.start, relative.end, strict=True)
        for sign, way in ((1, edge[0]), (-1, edge[0][::-1]))
        if tuple(step) == way
    ]
    assert len(walked) == effect.edge_counts[0] > 2
    assert effect.mean == pytest.approx(np.mean(walked))
    assert effect.half_width == pytest.approx(stats.t.ppf(0.95, len(walked) - 1) * stats.sem(walked))


def test_an_edge_that_nobody_walked_says_nothing():
    answers = exact_answers()
    relative = relative_scores(SEQUENCES[:2], answers.relative[:2], fit_panel(answers.by_constellation[:2], ends=False))
    walked = {frozenset(step) for step in zip(relative.start.tolist(), relative.end.tolist(), strict=True)}
    edge = next(e for e in DESIGN.edges if frozenset((e.first, e.second)) not in walked)
    effect = fit_effect(relative, ((edge.first, edge.second),), 2)
    assert np.isnan(effect.mean)
    assert np.isnan(effect.half_width)


def test_carry_over_is_found_and_taken_out():
    answers = exact_answers(carry_over=0.15)
    panel = panel_of(answers)
    found = fit_carry_over(SEQUENCES, panel, fit_levels(panel))
    assert found.share == pytest.approx(0.15, abs=0.01)
    before = np.abs(panel.levels - LEVELS).max()
    assert before > 0.15
    assert np.abs(found.levels - LEVELS).max() < 0.15 * before


def test_the_mixed_model_of_complete_answers_has_the_raw_means():
    pytest.importorskip("statsmodels", reason="statsmodels is not installed (extra `study`)")
    answers = exact_answers(noise=1.0)
    model = fit_mixed_model(answers)
    assert not model.failure
    table = answers.by_constellation
    np.testing.assert_allclose(model.levels, table.mean(0), atol=1e-6)
    # Analysis of variance of a balanced table: residual and observer mean squares.
    residual = table - table.mean(0) - table.mean(1, keepdims=True) + table.mean()
    error = (residual**2).sum() / (11 * 19)
    between = 20 * table.mean(1).var(ddof=1)
    assert model.residual_deviation == pytest.approx(np.sqrt(error), rel=1e-4)
    assert model.observer_deviation == pytest.approx(np.sqrt((between - error) / 20), rel=1e-3)
    mean, half = model.difference(((0, 1),))
    assert mean == pytest.approx(table[:, 1].mean() - table[:, 0].mean())
    assert half == pytest.approx(stats.norm.ppf(0.95) * np.sqrt(2 * error / 12), rel=1e-3)


def test_too_few_observers_are_told():
    whole = exact_answers()
    one = Answers(DESIGN, (1,), SEQUENCES[:1], whole.absolute[:1], whole.relative[:1])
    with pytest.raises(InputError, match="need two such observers"):
        evaluate(one)
    with pytest.raises(InputError, match="not between 0 and 1"):
        evaluate(whole, confidence=1.0)


def test_sorting_by_constellation_keeps_each_answer_with_its_constellation():
    values = np.arange(12 * 20, dtype=float).reshape(12, 20)
    table = by_constellation(SEQUENCES, values, 20)
    for row in range(12):
        for position in range(20):
            assert table[row, SEQUENCES[row, position]] == values[row, position]
