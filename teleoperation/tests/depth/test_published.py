"""The published summary is computed from the published levels, and what deviates is named."""

from __future__ import annotations

import numpy as np
import pytest
from contact_foundation.errors import InputError
from depth_study.evaluation.published import load_published
from small_designs import PUBLISHED_FILE, thesis

TEXT = PUBLISHED_FILE.read_text()


def figure(name):
    return next(f for f in load_published(PUBLISHED_FILE, thesis()).figures if f.contrast.name == name)


def test_figures_are_those_of_the_levels():
    motion = np.array([2.15, 1.58, 1.53, 2.67, 1.49, 1.34, 1.51, 0.69, 1.46])
    found = figure("motion, other pictures")
    assert found.difference == pytest.approx(motion.mean())
    assert found.spread == pytest.approx(1.6448536 * motion.std(ddof=1))
    assert (found.least, found.greatest) == pytest.approx((0.69, 2.67))
    assert figure("motion, plain picture").difference == pytest.approx(1.82)
    assert figure("parallel against central").difference == pytest.approx(11.2 / 6)
    assert figure("mere goggles").difference == pytest.approx(3.59 / 6)


def test_deviations_from_the_words_are_named():
    assert figure("motion, plain picture").deviations == ()
    assert figure("motion, other pictures").deviations == ("the levels give +1.60, the words say +1.8",)
    assert figure("parallel against central").deviations == (
        "the levels give +1.87, the words say +2.5",
        "the levels give ± 1.49, the words say ± 1.2",
    )
    assert figure("mere goggles").deviations == ("the levels give +0.60, the words say +0.4",)


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("score = 3.08", "score = nan", "has the score nan"),
        ("score = 3.08", "score = 9.5", "has the score 9.5"),
        ('technique = "anaglyph", camera = "central", scene = "still"', 'technique = "x"', "is no constellation"),
        (
            "score = 4.24",
            'score = 4.24 }, { technique = "plain", camera = "central", scene = "still", score = 3',
            "second",
        ),
        ('contrast = "mere goggles"', 'contrast = "goggles"', "names the contrast 'goggles'"),
        ("levels = [", "levels = [ 3", "is no TOML"),
        ("difference = 0.4", "difference = inf", "no number"),
    ],
)
def test_levels_that_do_not_fit_are_refused(tmp_path, old, new, told):
    assert old in TEXT
    path = tmp_path / "published.toml"
    path.write_text(TEXT.replace(old, new, 1))
    with pytest.raises(InputError) as error:
        load_published(path, thesis())
    assert told in str(error.value)
    assert "published.toml" in str(error.value)


def test_levels_that_are_left_out_are_named(tmp_path):
    path = tmp_path / "published.toml"
    path.write_text("\n".join(line for line in TEXT.splitlines() if "8.10" not in line))
    with pytest.raises(InputError, match="leaves out polarised/parallel/moving"):
        load_published(path, thesis())
