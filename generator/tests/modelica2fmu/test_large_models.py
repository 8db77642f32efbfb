"""Models of so many states that explicit steps race with CVODE's, or that Newton needs no Jacobian."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmu_regression.fmi.fmu import Instance, open_fmu

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


@pytest.mark.full
@pytest.mark.parametrize("masses", [240, 260])
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
    """Explicit steps, which its fastest mode holds short, give way to long ones by Jacobians, which are factorized."""
    names = ["x[1]", "x[120]", "cmbSolver.jacobians", "cmbSolver.steps"]
    result = simulate(ROD, names, stop=5.0, fmi_type="CoSimulation")
    wave_number = math.pi / 241
    rate = 4 * 1000 * math.sin(wave_number / 2) ** 2
    for number in (1, 120):
        expected = math.sin(number * wave_number) * np.exp(-rate * result["time"])
        assert result[f"x[{number}]"] == pytest.approx(expected, abs=2e-6)
    steps = result["cmbSolver.steps"]
    assert steps[1] > 100
    assert 0 < result["cmbSolver.jacobians"][-1] < steps[-1] - steps[2] < 400


# Each mass bounces on a floor of its own, between springs, from heights of its own; damping brings all to rest.
HEAP = """model Heap "Masses that bounce and come to rest, one after the other"
  constant Integer n = 60;
  parameter Real k = 1e4, d = 20, g = 9.81;
  Real x[n](start = {0.1 + 0.05*sin(7*i) for i in 1:n}, each fixed = true), v[n](each start = 0, each fixed = true);
  Real f[n] "Forces of the floor by the mass";
equation
  der(x) = v;
  der(v) = f - fill(g, n);
  for i in 1:n loop
    f[i] = noEvent(if x[i] < 0 then max(0, -k*x[i] - d*v[i]*min(1, -1e3*x[i])) else 0);
  end for;
  annotation(experiment(StopTime = 1, Tolerance = 1e-5, Interval = 0.05));
end Heap;
"""
SOME = ["x[1]", "x[30]", "x[60]", "cmbSolver.steps", "cmbSolver.evaluations", "cmbSolver.jacobians"]


@pytest.mark.full
def test_explicit_steps_follow_bounces_as_another_integrator_does(simulate):
    """While masses bounce explicit steps go on; the importer's CVODE agrees within ten tolerances."""
    found = simulate(HEAP, SOME, stop=0.5, tolerance=1e-5, interval=0.002, fmi_type="CoSimulation")
    other = simulate(HEAP, SOME[:3], stop=0.5, tolerance=1e-8, interval=0.002)
    for name in SOME[:3]:
        assert found[name] == pytest.approx(other[name], abs=1e-4)
    assert found["cmbSolver.evaluations"][-1] > 2 * found["cmbSolver.steps"][-1] > 0


def test_masses_at_rest_are_left_to_long_implicit_steps(simulate):
    """They rest from 3 s on: 40 s more cost less than the bounces did."""
    found = simulate(HEAP, SOME, stop=43.0, tolerance=1e-5, interval=1.0, fmi_type="CoSimulation")
    for name in SOME[:3]:
        assert found[name][-1] == pytest.approx(-9.81e-4, abs=1e-8)
    evaluations = found["cmbSolver.evaluations"]
    assert found["cmbSolver.jacobians"][-1] > 0
    assert evaluations[-1] - evaluations[3] < evaluations[3]


@contextmanager
def started(fmu: Path, maximum_steps: int = 100_000) -> Iterator[Instance]:
    with open_fmu(fmu) as opened, opened.instantiate("cs") as instance:
        instance.set_start_values({"cmbSolver.maximumSteps": maximum_steps})
        instance.functions.enter_initialization(1e-5, 0.0, None)
        instance.functions.exit_initialization()
        yield instance


def test_going_on_from_a_saved_state_repeats_a_race_to_the_bit(build):
    """Which integrator goes on, and how long until the other one is tried, belong to the state."""
    with started(build(HEAP).fmu) as instance:
        functions, variables = instance.functions, instance.description.variables
        read = functions.reader("Real", [variables[name].reference for name in ("x[1]", "x[30]", "v[60]")])

        def run(begin: float, steps: int) -> list[list[float]]:
            samples = []
            for step in range(steps):
                functions.do_step(begin + 0.05 * step, 0.05)
                samples.append(read().tolist())
            return samples

        run(0.0, 5)
        saved = functions.save_state()
        first = run(0.25, 40)
        for _ in range(2):
            functions.restore_state(saved)
            assert run(0.25, 40) == first
        functions.free_state(saved)


def test_a_step_that_needs_too_many_explicit_steps_ends_where_it_has_come_to(build):
    with started(build(HEAP).fmu, maximum_steps=100) as instance:
        functions, variables = instance.functions, instance.description.variables
        read = functions.reader("Real", [variables[name].reference for name in ("x[1]", "v[1]")])
        with pytest.raises(FMICallException):
            functions.do_step(0.0, 1.0)
        assert any("more than 100 steps" in message for message in instance.told())
        x, v = read()
        assert v < -0.1
        assert x > 0  # it still falls
        assert x == pytest.approx(0.1 + 0.05 * math.sin(7) - v**2 / (2 * 9.81), abs=1e-6)


# The root ends where a mass would fall through: trial points beyond cannot be evaluated.
EDGE = """model Edge
  constant Integer n = 60;
  Real x[n](start = {1 + 0.01*i for i in 1:n}, each fixed = true), v[n](each start = -1, each fixed = true), a[n];
equation
  der(x) = v;
  der(v) = a;
  for i in 1:n loop
    a[i] = 1/sqrt(x[i])^4;
  end for;
  annotation(experiment(StopTime = 3, Tolerance = 1e-6, Interval = 0.1));
end Edge;
"""


@pytest.mark.parametrize("interval", [0.1, 5e-4])  # the race changes hands within steps, and at their ends
def test_explicit_steps_shorten_where_a_trial_point_cannot_be_evaluated(simulate, interval):
    """Each mass turns round where v^2/2 + 1/x is what it was: the energy stays."""
    names = [f"{name}[{i}]" for i in (1, 60) for name in "xv"]
    found = simulate(EDGE, names, stop=3.0, tolerance=1e-6, interval=interval, fmi_type="CoSimulation")
    for i in (1, 60):
        energy = 0.5 * found[f"v[{i}]"] ** 2 + 1 / found[f"x[{i}]"]
        assert energy == pytest.approx(energy[0], rel=2e-5)
