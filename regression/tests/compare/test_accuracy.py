"""The accuracy study on an FMU with known motion."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from contact_foundation.errors import InputError
from fmu_regression.compare.accuracy import AccuracyPoint, AccuracyStudy, study_accuracy
from fmu_regression.report.accuracy_report import accuracy_text, write_accuracy
from fmu_regression.results.result import SimulationResult
from lxml import html


def test_errors_fall_with_the_tolerance_and_are_true(bouncing_mass: Path) -> None:
    tolerances = (1e-3, 1e-5, 1e-7)
    study = study_accuracy(bouncing_mass, signals=["h", "v"], stop=0.4, interval=0.02, tolerances=tolerances)
    me = [point for point in study.points if point.mode == "me"]
    cs = [point for point in study.points if point.mode == "cs"]
    assert [point.tolerance for point in me] == list(tolerances)
    assert all(point.failure == "" for point in study.points)
    # The co-simulation of this FMU is exact, so its error is that of the reference.
    assert max(point.error or 0 for point in cs) <= max(study.floor, 1e-9)
    assert all(point.counters is not None and point.counters.steps > 0 for point in me)
    assert me[0].counters.evaluations < me[-1].counters.evaluations  # type: ignore[union-attr]


def test_error_is_measured_against_a_given_reference(bouncing_mass: Path) -> None:
    time = np.linspace(0, 0.4, 21)
    shifted = SimulationResult(time=time, signals={"h": 1.008 - 5 * time**2}, interval=0.02)
    study = study_accuracy(
        bouncing_mass, signals=["h"], stop=0.4, interval=0.02, tolerances=[1e-8], modes=["me"], reference=shifted
    )
    assert study.points[0].error == pytest.approx(0.008 / 0.8, rel=1e-4)
    assert study.points[0].mean_error == pytest.approx(0.008 / 0.8, rel=1e-4)


def test_failures_stay_in_the_table(bouncing_mass: Path, tmp_path: Path) -> None:
    reference = SimulationResult(time=np.linspace(0, 1, 51), signals={"h": np.zeros(51)}, interval=0.02)
    study = study_accuracy(
        bouncing_mass,
        signals=["h"],
        tolerances=[1e-4, 1e-6],
        parameters={"fails_at": 0.5},
        reference=reference,
    )
    assert len(study.points) == 4
    assert all("cannot be computed" in point.failure for point in study.points)
    assert accuracy_text(study).count("failed:") == 4
    write_accuracy(study, tmp_path / "accuracy.html")
    assert len(html.parse(str(tmp_path / "accuracy.html")).xpath("//tbody/tr")) == 4


def made_up(exponent: float) -> AccuracyStudy:
    points = tuple(
        AccuracyPoint("me", 10.0**-k, error=max(3 * 10 ** (-exponent * k), 1e-12), mean_error=1e-9, wall_time=0.1)
        for k in range(3, 12)
    )
    return AccuracyStudy("m", 1.0, 0.1, ("x",), "made up", 1e-12, points, "none", {})


@pytest.mark.parametrize("exponent", [0.5, 0.8, 1.0])
def test_order_is_found(exponent: float) -> None:
    assert made_up(exponent).order("me") == pytest.approx(exponent, abs=1e-9)
    assert made_up(exponent).order("cs") is None


def test_page_has_points_for_every_run(tmp_path: Path) -> None:
    write_accuracy(made_up(0.8), tmp_path / "accuracy.html")
    text = (tmp_path / "accuracy.html").read_text()
    assert "0.80" in text
    assert html.fromstring(text).xpath("//div[@id='error-tolerance']")


def test_wrong_arguments(bouncing_mass: Path) -> None:
    with pytest.raises(InputError, match="tolerances"):
        study_accuracy(bouncing_mass, tolerances=[])
    with pytest.raises(InputError, match="no variable 'x'"):
        study_accuracy(bouncing_mass, signals=["x"])
