"""A machine against the closed form of its motion: x' = v, v' = force - damping v."""

from __future__ import annotations

import math

import pytest
from contact_foundation.errors import InputError, SimulationError
from fmu_regression.fmi.fmu import open_fmu
from interactive_drive.machine.machine import Machine

SIGNALS = ("v", "x", "force")


@pytest.fixture
def machine(pushed_mass):
    with open_fmu(pushed_mass) as fmu, Machine(fmu, SIGNALS, 0.01) as machine:
        yield machine


def test_steps_follow_the_inputs(machine):
    assert machine.row() == pytest.approx([0, 0, 0])
    machine.set({"force": 2.0})
    for _ in range(50):
        machine.step()
    machine.set({"force": 0.0, "damping": 4.0})
    for _ in range(25):
        machine.step()
    v = 2 * (1 - math.exp(-0.5)) * math.exp(-1.0)
    assert machine.time == pytest.approx(0.75)
    assert machine.row()[0] == pytest.approx(v)


def test_a_saved_state_is_gone_back_to(machine):
    machine.set({"force": 1.0})
    for _ in range(10):
        machine.step()
    moment, row = machine.save(), machine.row()
    for _ in range(10):
        machine.step()
    later = machine.row()
    machine.restore(moment)
    assert machine.time == pytest.approx(0.1)
    assert machine.row() == pytest.approx(row)
    for _ in range(10):
        machine.step()
    assert machine.row() == pytest.approx(later)
    machine.free(moment)


def test_starting_anew(machine):
    machine.set({"force": 1.0})
    machine.step()
    machine.start_anew()
    assert machine.time == 0
    assert machine.row() == pytest.approx([0, 0, 0])


def test_what_the_fmu_says_when_it_stops_is_told(machine):
    machine.step()
    machine.set({"force": 95.0})
    with pytest.raises(SimulationError, match=r"stopped after t = 0.01 s(?s:.*)the rope is torn by 95 N at t = 0.01"):
        machine.step()
    assert machine.time == pytest.approx(0.01)


def test_a_nan_is_an_error_that_names_the_signal(machine):
    machine.set({"force": -95.0})
    machine.step()
    with pytest.raises(SimulationError, match="x is not a number"):
        machine.row()


def test_unknown_signals_are_refused(pushed_mass):
    with open_fmu(pushed_mass) as fmu, pytest.raises(InputError, match="no variable 'speed'"):
        Machine(fmu, ["speed"], 0.01)
