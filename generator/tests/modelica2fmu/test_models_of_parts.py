"""Free bodies that the integrator follows each with steps of its own while they are out of each other's reach."""

from __future__ import annotations

import zipfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fmpy import simulate_fmu
from fmu_regression.fmi.fmu import Instance, open_fmu

THROWN = """model Thrown "Spheres thrown on a floor"
  constant Integer n = 16;
  ContactMultiBody.Parts.FreeBodies bodies(
    bodyCount = n,
    bodyGeometry = ContactMultiBody.Shapes.{geometry},
    bodyMass = 0.5,
    bodyInertia = {{5e-4, 6e-4, 7e-4}},
    material(each restitution = 0.3, each muStatic = 0.5),
    stiffnessChoice = ContactMultiBody.Types.StiffnessChoice.Given,
    bodyStiffness = 2e4,
    regularisationSpeed = 0.02,
    r_start = {{{{0.12*mod(i - 1, 4), 0.12*div(i - 1, 4), 0.06 + 0.03*mod(7*i, 11)}} for i in 1:n}},
    v_start = {{{{sin(1.7*i), cos(2.3*i), 0}} for i in 1:n}});
  Real energy = bodies.energy;
  {more}
  annotation(experiment(StopTime = 0.5, Tolerance = 1e-5, Interval = 0.05));
end Thrown;
"""
SPHERES = THROWN.format(geometry="sphere(0.05)", more="")
BOXES = THROWN.format(geometry="box({0.1, 0.09, 0.08})", more="")

# The first ball runs into a row of balls at rest, in which the impact goes on; it passes its own length in 0.4 ms.
ROW = """model Row
  constant Integer n = 10;
  ContactMultiBody.Parts.FreeBodies bodies(
    bodyCount = n,
    bodyGeometry = ContactMultiBody.Shapes.sphere(0.01),
    bodyMass = 0.03,
    bodyInertia = fill(1.2e-6, 3),
    material(each restitution = 0.9),
    stiffnessChoice = ContactMultiBody.Types.StiffnessChoice.Given,
    bodyStiffness = 1e7,
    useFriction = false,
    gravity = zeros(3),
    r_start = {{if i == 1 then -1 else 0.03*i, 0, 1} for i in 1:n},
    v_start = {{if i == 1 then 50 else 0, 0, 0} for i in 1:n});
  Real last = bodies.v[10, 1];
  Real momentum = sum(bodies.v[:, 1]);
end Row;
"""


@pytest.fixture(scope="module")
def simulate(built_with_library: Callable[[str], Path]) -> Callable[..., Any]:
    def run(
        text: str, outputs: list[str], stop: float, tolerance: float, interval: float, kind: str = "ModelExchange"
    ) -> Any:
        return simulate_fmu(
            str(built_with_library(text)),
            fmi_type=kind,
            output=outputs,
            stop_time=stop,
            relative_tolerance=tolerance,
            output_interval=interval,
        )

    return run


def source(fmu: Path) -> str:
    with zipfile.ZipFile(fmu) as archive:
        return archive.read("sources/model.c").decode()


@contextmanager
def started(fmu: Path, tolerance: float = 1e-5, **start: float) -> Iterator[Instance]:
    with open_fmu(fmu) as opened, opened.instantiate("cs") as instance:
        instance.set_start_values(start)
        instance.functions.enter_initialization(tolerance, 0.0, None)
        instance.functions.exit_initialization()
        yield instance


def places(count: int = 16) -> list[str]:
    return [f"bodies.r[{i},{k}]" for i in range(1, count + 1) for k in (1, 2, 3)]


def matrix(result: np.ndarray, names: list[str]) -> np.ndarray:
    return np.stack([result[name] for name in names], axis=1)


def test_free_bodies_are_parts_of_one_kind(built_with_library):
    text = source(built_with_library(SPHERES))
    assert ".part_count = 16" in text
    assert text.count("fmurt_kind_") == 2
    assert "static const int fixed_body[] = {16};" in text


@pytest.mark.full
@pytest.mark.parametrize(
    "more",
    [
        "Real x(start = 0, fixed = true); equation der(x) = bodies.r[1, 1] + bodies.r[2, 1];",  # unites two
        "Real x(start = 0, fixed = true), y(start = 0, fixed = true); equation der(x) = time; der(y) = x;",
        "discrete Real x(start = 0, fixed = true); equation when bodies.r[1, 3] < 0.05 then x = time; end when;",
    ],
    ids=["state of two bodies", "time", "events"],
)
def test_what_depends_on_more_is_no_part_of_its_own(built_with_library, more):
    text = source(built_with_library(THROWN.format(geometry="sphere(0.05)", more=more)))
    assert ".part_count = 15" in text or ".parts = NULL" in text


@pytest.mark.parametrize(
    ("model", "tolerance"),
    [
        pytest.param(SPHERES, 1e-3, id="spheres-0.001"),
        pytest.param(SPHERES, 1e-5, id="spheres-1e-05", marks=pytest.mark.full),
        pytest.param(BOXES, 1e-3, id="boxes-0.001", marks=pytest.mark.full),
        pytest.param(BOXES, 1e-5, id="boxes-1e-05", marks=pytest.mark.full),
    ],
)
def test_bodies_go_where_another_integrator_has_them_go(simulate, model, tolerance):
    """CVODE of the importer at a much smaller tolerance, before the collisions are chaos."""
    found = simulate(model, places(), stop=0.3, tolerance=tolerance, interval=0.02, kind="CoSimulation")
    other = simulate(model, places(), stop=0.3, tolerance=1e-8, interval=0.001)[::20]
    error = np.abs(matrix(found, places()) - matrix(other, places())).max()
    assert error < 5 * tolerance


@pytest.mark.parametrize("model", [SPHERES, pytest.param(BOXES, marks=pytest.mark.full)], ids=["spheres", "boxes"])
def test_energy_does_not_rise(simulate, model):
    for tolerance in (1e-2, 1e-3, 1e-4):
        energy = simulate(model, ["energy"], stop=0.5, tolerance=tolerance, interval=0.005, kind="CoSimulation")[
            "energy"
        ]
        assert np.diff(energy).max() < 0.2 * tolerance * energy[0]
        assert energy[-1] < 0.8 * energy[0]


@pytest.mark.full
@pytest.mark.parametrize("interval", [1e-3, 0.1])
def test_a_fast_ball_meets_what_is_in_its_way(simulate, interval):
    found = simulate(ROW, ["last", "momentum"], stop=0.1, tolerance=1e-6, interval=interval, kind="CoSimulation")
    assert found["momentum"] == pytest.approx(50.0, abs=1e-9)
    assert found["last"][-1] == pytest.approx(50 * 0.95**9, rel=1e-3)  # each but the last keeps (1 - e)/2 of its speed


def test_parameters_are_those_that_were_set(built_with_library):
    """Balls of twice the mass on the same spring: the floor gives way by more."""

    def depth(**start: float) -> float:
        with started(built_with_library(SPHERES), **start) as instance:
            variables = instance.description.variables
            read = instance.functions.reader("Real", [variables["bodies.r[1,3]"].reference])
            for step in range(60):
                instance.functions.do_step(0.02 * step, 0.02)
            return 0.05 - float(read()[0])

    assert depth(**{"bodies.bodyMass": 1.0}) == pytest.approx(2 * depth(), rel=0.05)


def test_going_on_from_a_saved_state_repeats_to_the_bit(built_with_library):
    with started(built_with_library(SPHERES)) as instance:
        functions, variables = instance.functions, instance.description.variables
        read = functions.reader("Real", [variables[name].reference for name in places()])

        def run(begin: float, steps: int) -> list[list[float]]:
            samples = []
            for step in range(steps):
                functions.do_step(begin + 0.02 * step, 0.02)
                samples.append(read().tolist())
            return samples

        run(0.0, 5)
        saved = functions.save_state()
        first = run(0.1, 20)
        functions.restore_state(saved)
        assert run(0.1, 20) == first
        functions.free_state(saved)


def test_steps_of_their_own_save_evaluations(simulate):
    """Those of a few parts count as their share: common steps take three times as many (9 800)."""
    found = simulate(SPHERES, ["cmbSolver.evaluations"], stop=0.5, tolerance=1e-5, interval=0.05, kind="CoSimulation")
    assert 500 < found["cmbSolver.evaluations"][-1] < 6000
