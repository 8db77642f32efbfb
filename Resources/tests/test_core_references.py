"""The MultiBody core subset against OpenModelica's trajectories, by rumoca's own simulator.

The FMU builder has its own cases for these models; here nothing of it is in the way.
"""

from __future__ import annotations

import csv

import core_models
import numpy as np
import pytest
import rumoca


def _reference(name):
    with (core_models.REFERENCE / f"{name}.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    return rows[0], np.array(rows[1:], dtype=np.float64)


@pytest.mark.parametrize(
    ("name", "stop"),
    [
        ("TumblingBody", 10.0),
        ("OffsetBody", 2.0),
        ("DoublePendulum", 3.0),
        pytest.param("PlanarFourBar", 3.0, marks=pytest.mark.full),
        ("SlidingBlock", 1.0),
        pytest.param("Hexapod.Walk", 0.03, marks=pytest.mark.full),
    ],
)
def test_trajectory_of_openmodelica(name, stop):
    names, reference = _reference(name)
    interval = float(np.diff(reference[:, 0]).max())
    model = rumoca.Session([str(core_models.CORE)]).load(
        str(core_models.REFERENCE_MODELS), model=f"ReferenceModels.{name}"
    )
    result = model.simulate(t=stop, dt=interval, config=rumoca.SimConfig(rtol=1e-11, atol=1e-13))
    table, found = np.asarray(result.to_numpy()), list(result.names)
    if table.shape[0] == len(found):
        table = table.T
    times = np.asarray(result.time)
    for column, variable in enumerate(names[1:], start=1):
        expected = np.interp(times, reference[:, 0], reference[:, column])
        scale = max(np.ptp(reference[:, column]), 1e-3)
        error = np.max(np.abs(table[:, found.index(variable)] - expected)) / scale
        assert error < 1e-6, f"{variable}: {error:.1e} of its range"


def test_bouncing_ball_hits_the_floor_when_openmodelica_says():
    """Times of the contacts' beginnings; rumoca reports no event times, so from the ball's free flight between them."""
    names, reference = _reference("BouncingBall")
    bounces, height = names.index("bounces"), names.index("ball.r_0[3]")
    rows = np.flatnonzero(np.diff(reference[:, bounces]) > 0)
    first = reference[rows[0], 0]
    gravity = 9.80665
    assert first == pytest.approx(np.sqrt(2 * 1.0 / gravity), abs=1e-9)
    assert reference[rows[0], height] == pytest.approx(0.1, abs=1e-9)
    model = rumoca.Session([str(core_models.CORE)]).load(
        str(core_models.REFERENCE_MODELS), model="ReferenceModels.BouncingBall"
    )
    result = model.simulate(t=0.45, dt=0.01, config=rumoca.SimConfig(rtol=1e-10, atol=1e-12))
    table, found = np.asarray(result.to_numpy()), list(result.names)
    if table.shape[0] == len(found):
        table = table.T
    times = np.asarray(result.time)
    expected = 1.1 - gravity * times**2 / 2
    np.testing.assert_allclose(table[:, found.index("ball.r_0[3]")], expected, atol=1e-9)
