"""Intervals cover the truth as often as they say; carry-over breaks that where it is not taken out."""

from __future__ import annotations

import re
import time
from dataclasses import fields

import numpy as np
import pytest
from cmb.main import main
from contact_data import checkout
from contact_foundation.errors import InputError
from depth_study.design.sequences import make_sequences
from depth_study.evaluation.published import load_published
from depth_study.record.database import open_database
from depth_study.simulation.coverage import study_coverage
from depth_study.simulation.observers import Population, draw_answers, load_population
from depth_study.simulation.power import study_power
from depth_study.simulation.simulated_study import write_simulated_study
from small_designs import DESIGN_FILE, PUBLISHED_FILE, thesis

DESIGN = thesis()
DOCUMENT = checkout() / "docs" / "teleoperation.md"
LEVELS = load_published(PUBLISHED_FILE, DESIGN).levels


@pytest.fixture(scope="module")
def sequences():
    return make_sequences(DESIGN, 44, seed=1)


def test_drawn_observers_have_the_population_s_scale_bias_and_noise(sequences):
    drawn = draw_answers(LEVELS, sequences, Population(), 200, np.random.default_rng(1))
    assert drawn.scale.mean() == pytest.approx(1, abs=0.01)
    assert drawn.scale.std() == pytest.approx(0.2, abs=0.01)
    assert drawn.bias.std() == pytest.approx(0.6, abs=0.02)
    assert set(np.unique(drawn.absolute)) <= set(range(1, 10))
    assert np.isnan(drawn.relative[..., 0]).all()
    assert set(np.unique(drawn.relative[..., 1:])) <= set(range(1, 10))
    quiet = Population(0, 0, 0, 0, 0, 0)
    exact = draw_answers(LEVELS, sequences, quiet, 1, np.random.default_rng(1))
    np.testing.assert_array_equal(exact.absolute[0], np.rint(LEVELS[sequences]))
    np.testing.assert_array_equal(exact.relative[0, :, 1:], 5 + np.rint(np.diff(LEVELS[sequences], axis=1)))


def test_carry_over_leans_towards_the_constellation_before(sequences):
    quiet = Population(0, 0, 0, 0, 0, 0.5)
    drawn = draw_answers(LEVELS, sequences, quiet, 1, np.random.default_rng(1))
    shown = LEVELS[sequences]
    np.testing.assert_array_equal(drawn.absolute[0, :, 1:], np.rint((shown[:, 1:] + shown[:, :-1]) / 2))


@pytest.fixture(scope="module")
def coverage(sequences):
    return study_coverage(
        DESIGN, LEVELS, sequences, Population(), studies=400, seed=2, carry_overs=(0.0, 0.2), confidence=0.9
    )


def test_intervals_cover_the_truth_in_88_to_92_per_cent(coverage):
    none = coverage[0]
    # Single constellations: three standard errors of 400 studies (1.5 %) beyond.
    for level in (none.panel, none.population, none.clean):
        assert 0.88 <= level.mean <= 0.92
        assert level.share.min() > 0.88 - 0.045
        assert np.abs(level.bias).max() < 0.1
    for effect in none.effects:
        assert 0.86 <= effect.share <= 0.94
        assert abs(effect.bias) < 0.03
        assert 0.86 <= effect.clean_share <= 0.94
    assert abs(none.carry_over_estimate) < 0.01
    assert 0.86 <= none.carry_over_share <= 0.94


def test_carry_over_breaks_coverage_and_clean_levels_mend_it(coverage):
    strong = coverage[1]
    assert strong.panel.mean < 0.85
    assert strong.panel.share.min() < 0.7
    assert strong.clean.mean > 0.88
    assert strong.clean.share.min() > 0.85
    for effect in strong.effects:
        assert effect.clean_share > 0.85
        assert abs(effect.clean_bias) < max(0.5 * abs(effect.bias), 0.03)
    assert strong.carry_over_estimate == pytest.approx(0.2, abs=0.02)


def test_power_grows_with_observers_and_false_alarms_are_as_rare_as_said(sequences):
    table = study_power(
        DESIGN, LEVELS, sequences, Population(), difference=0.5, numbers=(10, 44), studies=300, seed=1, confidence=0.9
    )
    few, many = table.rows
    assert table.contrast.factor == "scene"
    assert few.constellations < many.constellations
    assert few.edge < many.edge < many.factor
    # Normal approximation of finding 0.5 between two levels: each has a standard error near 1.07 / sqrt(44).
    assert many.constellations == pytest.approx(0.70, abs=0.1)
    for share in (table.without.constellations, table.without.edge, table.without.factor):
        assert share == pytest.approx(0.1, abs=0.055)
    assert table.enough("factor") in (10, 44)
    assert table.enough("edge") is None


def test_a_difference_outside_the_scale_is_refused(sequences):
    with pytest.raises(InputError, match="scale from 1 to 9"):
        study_power(DESIGN, LEVELS, sequences, Population(), difference=float("nan"), numbers=(10,), studies=1, seed=1)


def test_the_population_file_holds_the_defaults():
    assert load_population(DESIGN_FILE.parent / "population.toml") == Population()


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("scale = nan", "scale: is nan, no number"),
        ("noise = -1", "noise: is -1"),
        ('bias = "big"', "bias: is 'big', no number"),
        ("carry_over = 1.0", "carry_over: is 1"),
        ("fear = 1", "fear: is not known"),
        ("scale =", "is no TOML"),
    ],
)
def test_populations_that_cannot_be_drawn_are_refused(tmp_path, text, told):
    path = tmp_path / "population.toml"
    path.write_text(text)
    with pytest.raises(InputError) as error:
        load_population(path)
    assert told in str(error.value)
    assert len(fields(Population)) == 6


def test_equal_seeds_give_equal_studies(tmp_path, sequences):
    tables = []
    for name, seed in (("a.db", 1), ("b.db", 1), ("c.db", 2)):
        write_simulated_study(tmp_path / name, DESIGN_FILE, sequences[:5], LEVELS, Population(), seed)
        time.sleep(1.1 * (name == "a.db"))  # the file holds whole seconds
        database = open_database(tmp_path / name)
        tables.append(database.answers())
        database.close()
    assert (tmp_path / "a.db").read_bytes() == (tmp_path / "b.db").read_bytes()
    np.testing.assert_array_equal(tables[0].absolute, tables[1].absolute)
    np.testing.assert_array_equal(tables[0].relative, tables[1].relative)
    assert not np.array_equal(tables[0].absolute, tables[2].absolute)
    assert not np.isnan(tables[0].absolute).any()


def test_the_documented_table_is_what_simulate_and_evaluate_print(tmp_path, sequences, capsys):
    """docs/teleoperation.md: a study of seed 1 beside the published levels."""
    study = tmp_path / "simulated.db"
    write_simulated_study(study, DESIGN_FILE, sequences, LEVELS, Population(), 1)
    assert main(["depth-study", "evaluate", str(study)]) == 0
    printed = dict(line.split(maxsplit=1) for line in capsys.readouterr().out.splitlines() if "/" in line.split(" ")[0])
    documented = re.findall(r"^\| (\w+/\w+/\w+) \| (.+) \|$", DOCUMENT.read_text(), re.MULTILINE)
    assert len(documented) == len(DESIGN.names)
    for name, cells in documented:
        level, near, all_of_them, mixed, published, off = cells.replace(" `*`", "").split(" | ")
        _, *rest = printed[name].rstrip("*").split()
        told = [rest[k] for k in (0, 1, 2, 8, 9)]
        assert [level, near, all_of_them, published, off] == told, name
        # Another version of statsmodels may stop its iteration a little elsewhere.
        assert float(mixed.split()[0]) == pytest.approx(float(rest[6]), abs=0.02)
