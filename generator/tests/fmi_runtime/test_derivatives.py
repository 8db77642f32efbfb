"""Directional derivatives against the derivatives of the formulas."""

from __future__ import annotations

from pathlib import Path

import pytest
from fmpy.fmi2 import FMU2Model, FMU2Slave
from importer import Importer


def test_in_continuous_time_mode(oscillator: Path, tmp_path: Path) -> None:
    importer = Importer(oscillator, tmp_path)
    instance = importer.make(FMU2Model)
    importer.initialize(instance, mass=2.0, stiffness=50.0, damping=4.0, v=0.25)
    instance.newDiscreteStates()
    instance.enterContinuousTimeMode()
    before = importer.reals(instance, *(name for name in importer.references if "cmb" not in name and name != "time"))
    refs = importer.references
    unknown = [refs["der(s)"], refs["der(v)"], refs["energy"]]
    columns = {"s": [0.0, -25.0, 50.0], "v": [1.0, -2.0, 0.5], "force": [0.0, 0.5, 0.0]}
    for name, column in columns.items():
        assert instance.getDirectionalDerivative(unknown, [refs[name]], [1.0]) == pytest.approx(column, abs=1e-8)
    seed = [3.0, -2.0, 10.0]
    combined = instance.getDirectionalDerivative(unknown, [refs[name] for name in columns], seed)
    expected = [sum(w * columns[n][i] for w, n in zip(seed, columns, strict=True)) for i in range(3)]
    assert combined == pytest.approx(expected, rel=1e-8)
    assert instance.getDirectionalDerivative(unknown, [refs["s"]], [0.0]) == [0.0, 0.0, 0.0]
    after = importer.reals(instance, *(name for name in importer.references if "cmb" not in name and name != "time"))
    assert after == before
    instance.freeInstance()


def test_the_models_jacobian_is_used(oscillator: Path, tmp_path: Path) -> None:
    importer = Importer(oscillator, tmp_path)
    instance = importer.make(FMU2Slave)
    importer.initialize(instance, mass=3.0, stiffness=50.0, damping=4.0, tolerance=1e-8)
    refs = importer.references
    unknown, known = [refs["der(v)"], refs["der(s)"]], [refs["v"], refs["s"]]
    exact = [-4.0 / 3.0 * 2.0 + -50.0 / 3.0 * 5.0, 2.0]
    assert instance.getDirectionalDerivative(unknown, known, [2.0, 5.0]) == exact  # to the last bit
    instance.doStep(0.0, 1.0)
    counters = [refs[f"cmbSolver.{name}"] for name in ("evaluations", "jacobians", "steps")]
    evaluations, jacobians, steps = instance.getInteger(counters)
    assert jacobians > 0
    assert evaluations < 2.5 * steps  # differences would take two more for each Jacobian
    instance.freeInstance()


def test_in_initialization_mode(schedule: Path, tmp_path: Path) -> None:
    importer = Importer(schedule, tmp_path)
    instance = importer.make(FMU2Slave)
    instance.setupExperiment()
    instance.enterInitializationMode()
    refs = importer.references
    unknown = [refs["twice"], refs["x"], refs["der(x)"]]
    assert instance.getDirectionalDerivative(unknown, [refs["base"]], [1.0]) == pytest.approx([2.0, 2.0, -4.0])
    assert importer.reals(instance, "base", "x") == [1.5, 3.0]
    instance.exitInitializationMode()
    assert importer.reals(instance, "x") == [3.0]
    instance.freeInstance()


def test_beside_a_point_that_cannot_be_computed(guarded: Path, tmp_path: Path) -> None:
    importer = Importer(guarded, tmp_path)
    instance = importer.make(FMU2Model)
    importer.initialize(instance, limit=1.0, gain=3.0)  # x starts at the limit
    instance.newDiscreteStates()
    instance.enterContinuousTimeMode()
    refs = importer.references
    assert instance.getDirectionalDerivative([refs["der(x)"]], [refs["x"]], [1.0]) == pytest.approx([-3.0])
    assert importer.reals(instance, "x", "der(x)") == [1.0, -3.0]
    instance.freeInstance()
