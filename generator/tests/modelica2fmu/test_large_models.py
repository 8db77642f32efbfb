"""Models of so many states that the integrator solves Newton's systems without a Jacobian."""

from __future__ import annotations

import math

import numpy as np
import pytest

# A standing wave on a chain of masses between walls: x_i = sin(i k) cos(omega t), omega = 2 sqrt(c) sin(k/2).
CHAIN = """model Chain "Equal masses and springs between two walls"
  constant Integer n = {n};
  constant Real c = 25 "Stiffness by mass";
  constant Real k = {waves}*3.141592653589793/(n + 1) "Wave number";
  Real x[n](start = {{sin(i*k) for i in 1:n}}, each fixed = true);
  Real v[n](each start = 0, each fixed = true);
  Real a[n] "Accelerations";
equation
  der(x) = v;
  der(v) = a;
  a[1] = c*(x[2] - 2*x[1]);
  for i in 2:n - 1 loop
    a[i] = c*(x[i - 1] - 2*x[i] + x[i + 1]);
  end for;
  a[n] = c*(x[n - 1] - 2*x[n]);
  annotation(experiment(StopTime = 1, Tolerance = 1e-8, Interval = 0.1));
end Chain;
"""


@pytest.mark.parametrize("masses", [pytest.param(240, marks=pytest.mark.full), 260])
def test_a_long_chain_swings_as_its_closed_form_says(simulate, masses):
    """Its steps are short beside its fastest oscillation, so that no step needs a linear system."""
    waves = 30
    wave_number = waves * math.pi / (masses + 1)
    names = [
        "x[1]",
        f"x[{masses // 3}]",
        f"x[{masses}]",
        "cmbSolver.jacobians",
        "cmbSolver.evaluations",
        "cmbSolver.steps",
    ]
    result = simulate(CHAIN.format(n=masses, waves=waves), names, stop=1.0, fmi_type="CoSimulation")
    omega = 2 * 5 * math.sin(wave_number / 2)
    for number in (1, masses // 3, masses):
        expected = math.sin(number * wave_number) * np.cos(omega * result["time"])
        assert result[f"x[{number}]"] == pytest.approx(expected, abs=2e-6)
    assert result["cmbSolver.jacobians"][-1] == 0
    assert result["cmbSolver.evaluations"][-1] > result["cmbSolver.steps"][-1] > 0


ROD = """model Rod "Conducts heat; its fastest mode decays 20 000 times as quickly as that which it starts with"
  constant Integer n = 240;
  parameter Real c = 1000;
  Real x[n](start = {sin(i*3.14159265358979324/(n + 1)) for i in 1:n}, each fixed = true), r[n];
equation
  der(x) = r;
  r[1] = c*(x[2] - 2*x[1]);
  for i in 2:n - 1 loop
    r[i] = c*(x[i - 1] - 2*x[i] + x[i + 1]);
  end for;
  r[n] = c*(x[n - 1] - 2*x[n]);
  annotation(experiment(StopTime = 5, Tolerance = 1e-7, Interval = 0.5));
end Rod;
"""


@pytest.mark.full
def test_a_stiff_rod_cools_as_its_closed_form_says(simulate):
    """Its steps are long beside its fastest mode: they need Jacobians, which are factorized."""
    names = ["x[1]", "x[120]", "cmbSolver.jacobians", "cmbSolver.steps"]
    result = simulate(ROD, names, stop=5.0, fmi_type="CoSimulation")
    wave_number = math.pi / 241
    rate = 4 * 1000 * math.sin(wave_number / 2) ** 2
    for number in (1, 120):
        expected = math.sin(number * wave_number) * np.exp(-rate * result["time"])
        assert result[f"x[{number}]"] == pytest.approx(expected, abs=2e-6)
    assert 0 < result["cmbSolver.jacobians"][-1] < result["cmbSolver.steps"][-1] < 400
