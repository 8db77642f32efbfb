"""Plots and numbers of the modeller's choice: read, checked, computed and shown."""

from __future__ import annotations

import tomllib
from pathlib import Path

import numpy as np
import pytest
from contact_foundation.errors import InputError, Place
from fmu_regression.report.figures import ChosenNumber, Figures, Taken, read_figures
from fmu_regression.report.simulation_report import report_html
from fmu_regression.results.result import SimulationResult

FILE = Path("experiment.toml")
TEXT = """
model = "Some.Model"

[[plot]]
title = "Heights"
label = "height in m"
window = [0.5, 1]
signals = { "left foot" = "z[1]", "right foot" = "z[2]" }

[[number]]
title = "Way"
signal = "x"
taken = "last"
unit = "m"

[[number]]
title = "Mean speed"
signal = "v"
taken = "mean"
window = [0.25, 0.75]
"""


def result() -> SimulationResult:
    time = np.linspace(0, 1, 101)
    return SimulationResult(
        time=time, signals={"x": time**2, "v": 2 * time, "z[1]": np.sin(time), "z[2]": np.cos(time)}, model="M"
    )


def test_what_a_file_says() -> None:
    figures = read_figures(tomllib.loads(TEXT), FILE)
    assert figures.signals == ("z[1]", "z[2]", "x", "v")
    assert figures.plots[0].signals == (("left foot", "z[1]"), ("right foot", "z[2]"))
    assert figures.lines(result()) == ["  Way: 1 m", "  Mean speed: 1"]


@pytest.mark.parametrize(
    ("taken", "expected"),
    [(Taken.LAST, 1.5), (Taken.MEAN, 1.0), (Taken.LEAST, 0.5), (Taken.GREATEST, 1.5)],
)
def test_numbers_of_a_window(taken: Taken, expected: float) -> None:
    assert ChosenNumber("n", "v", taken, window=(0.25, 0.75)).value(result()) == pytest.approx(expected)


def test_the_report_shows_them_and_leaves_out_what_is_not_there() -> None:
    figures = read_figures(tomllib.loads(TEXT), FILE)
    page = report_html(result(), None, figures)
    assert "Heights" in page
    assert "left foot" in page
    assert "Mean speed" in page
    short = SimulationResult(time=np.linspace(0, 0.4, 5), signals={"x": np.ones(5), "v": np.ones(5)}, model="M")
    page = report_html(short, None, figures)
    assert "Heights" not in page
    assert "Mean speed" not in page
    assert "Way" in page


def test_unknown_variables_are_named() -> None:
    figures = read_figures(tomllib.loads(TEXT), FILE)
    with pytest.raises(InputError, match=r"z\[2\]"):
        figures.require({"x", "v", "z[1]"}, Place(file=FILE))
    figures.require({"x", "v", "z[1]", "z[2]"}, Place(file=FILE))


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('title = "Heights"\n', "", "title is missing"),
        ('taken = "last"', 'taken = "middle"', "none of last, mean, least, greatest"),
        ("window = [0.5, 1]", "window = [1, 0.5]", "window is not"),
        ("window = [0.5, 1]", "window = [1]", "window is not"),
        ("window = [0.5, 1]", "window = [0.5, true]", "window is not"),
        ("window = [0.5, 1]", "windows = 3", "windows has no meaning"),
        ('unit = "m"', "unit = 3", "unit is not a text"),
        ('signals = { "left foot" = "z[1]", "right foot" = "z[2]" }', 'signals = ["z[1]"]', "signals is not a table"),
        ("[[plot]]", "[plot]", "not a list of tables"),
    ],
)
def test_wrong_tables(old: str, new: str, message: str) -> None:
    text = TEXT.replace(old, new, 1)
    assert text != TEXT
    with pytest.raises(InputError, match=message) as caught:
        read_figures(tomllib.loads(text), FILE)
    assert caught.value.place.file == FILE


def test_nothing_chosen() -> None:
    assert read_figures({}, FILE) == Figures()
    assert report_html(result(), None, Figures()) == report_html(result(), None)


def test_a_window_without_rows() -> None:
    with pytest.raises(InputError, match="nothing was simulated"):
        ChosenNumber("n", "v", Taken.MEAN, window=(2, 3)).value(result())
