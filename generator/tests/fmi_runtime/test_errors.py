"""What goes wrong inside a model reaches the importer as status and message, and leads nowhere else."""

from __future__ import annotations

import ctypes
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Model, FMU2Slave
from importer import DISCARD, ERROR, WARNING, Importer

LAST_SUCCESSFUL_TIME = 2  # fmi2LastSuccessfulTime


def make_guarded(importer: Importer, fail: int, **reals: float) -> Any:
    instance = importer.make(FMU2Slave)
    instance.setInteger([importer.references["fail"]], [fail])
    importer.initialize(instance, **reals)
    return instance


def expect(status: int, call: Any, *arguments: Any) -> None:
    with pytest.raises(FMICallException) as caught:
        call(*arguments)
    assert caught.value.status == status


@pytest.mark.parametrize(
    ("fail", "text"),
    [
        (1, "is below 0.5 (100%%)"),
        (2, "x is below its limit"),
        (3, "The derivative of x is not finite"),
    ],
)
def test_a_step_that_cannot_be_computed_is_discarded_where_it_ends(
    guarded: Path, tmp_path: Path, fail: int, text: str
) -> None:
    importer = Importer(guarded, tmp_path)
    instance = make_guarded(importer, fail, limit=0.5)
    expect(DISCARD, instance.doStep, 0.0, 2.0)
    reached = instance.getRealStatus(2)
    assert np.log(2.0) - 0.05 < reached <= np.log(2.0) + 1e-6
    x, derivative = importer.reals(instance, "x", "der(x)")
    assert x == pytest.approx(np.exp(-reached), abs=1e-6)
    assert derivative == -x  # values of one point, not of a trial
    assert not instance.getBooleanStatus(3)
    discards = [message for status, _, message in importer.messages if status == DISCARD]
    assert len(discards) == 1
    assert text in discards[0]
    expect(ERROR, instance.doStep, reached, 0.1)  # a failed step must be rewound first
    instance.reset()
    importer.initialize(instance, limit=-1.0)
    instance.doStep(0.0, 2.0)
    assert importer.reals(instance, "x")[0] == pytest.approx(np.exp(-2.0), abs=1e-6)
    instance.freeInstance()


def test_an_indicator_that_cannot_be_computed_discards_the_step(switching: Path, tmp_path: Path) -> None:
    importer = Importer(switching, tmp_path)
    instance = importer.make(FMU2Slave)
    instance.setInteger([importer.references["kind"]], [4])
    importer.initialize(instance)
    expect(DISCARD, instance.doStep, 0.0, 1.0)
    reached = instance.getRealStatus(2)
    assert 0.4 < reached <= 0.5 + 1e-9  # where x is 0.75
    assert importer.reals(instance, "x")[0] == pytest.approx(0.25 + reached, abs=1e-9)
    assert instance.getInteger([importer.references["crossings"]]) == [1]
    assert "the indicator is not known there" in importer.messages[-1][2]
    instance.freeInstance()


def test_a_discarded_step_can_be_rewound(guarded: Path, tmp_path: Path) -> None:
    importer = Importer(guarded, tmp_path)
    instance = make_guarded(importer, 1, limit=0.5)
    saved = instance.getFMUState()
    expect(DISCARD, instance.doStep, 0.0, 2.0)
    instance.setFMUState(saved)
    instance.doStep(0.0, 0.5)
    assert importer.reals(instance, "x")[0] == pytest.approx(np.exp(-0.5), abs=1e-6)
    instance.freeFMUState(saved)
    instance.freeInstance()


@pytest.mark.parametrize("fail", [1, 2, 3])
def test_trial_steps_outside_the_domain_are_repeated_shorter(guarded: Path, tmp_path: Path, fail: int) -> None:
    """x tends to 0.01 from above and the model fails below 0: the integrator's trial steps must not."""
    importer = Importer(guarded, tmp_path)
    instance = make_guarded(importer, fail, limit=0.0, gain=100.0, drift=1.0)
    instance.doStep(0.0, 1.0)
    assert importer.reals(instance, "x")[0] == pytest.approx(0.01, abs=1e-6)
    assert [status for status, _, _ in importer.messages] == [WARNING]
    instance.freeInstance()


def test_an_error_ends_in_the_error_state(guarded: Path, tmp_path: Path) -> None:
    importer = Importer(guarded, tmp_path)
    instance = make_guarded(importer, 5, limit=0.5)
    saved = instance.getFMUState()
    expect(ERROR, instance.doStep, 0.0, 2.0)
    assert "x is below its limit for good" in importer.errors()[-1]
    expect(ERROR, instance.doStep, 0.0, 0.1)
    assert "not permitted in the present state" in importer.errors()[-1]
    assert importer.reals(instance, "limit") == [0.5]
    instance.setFMUState(saved)
    instance.doStep(0.0, 0.1)
    instance.freeFMUState(saved)
    instance.freeInstance()


def test_errors_before_the_start_name_their_cause(guarded: Path, oscillator: Path, tmp_path: Path) -> None:
    importer = Importer(guarded, tmp_path / "guarded")
    instance = importer.make(FMU2Slave)
    instance.setInteger([importer.references["fail"]], [4])
    instance.setupExperiment()
    instance.enterInitializationMode()
    expect(ERROR, instance.exitInitializationMode)
    assert "fmi2ExitInitializationMode: x = -1 is below 0 (100%%)" in importer.errors()
    instance.freeInstance()

    other = Importer(oscillator, tmp_path / "oscillator")
    instance = other.make(FMU2Slave)
    other.set_real(instance, "mass", -1.0)
    instance.setupExperiment()
    instance.enterInitializationMode()
    expect(ERROR, instance.exitInitializationMode)
    assert other.errors() == ["fmi2ExitInitializationMode: the mass is not positive"]
    instance.freeInstance()


def test_model_exchange_hands_discards_on(guarded: Path, tmp_path: Path) -> None:
    importer = Importer(guarded, tmp_path)
    instance = importer.make(FMU2Model)
    importer.initialize(instance, limit=0.5)
    instance.newDiscreteStates()
    instance.enterContinuousTimeMode()
    x, derivative = (ctypes.c_double * 1)(0.25), (ctypes.c_double * 1)()
    instance.setContinuousStates(x, 1)
    expect(DISCARD, instance.getDerivatives, derivative, 1)
    x[0] = 0.75
    instance.setContinuousStates(x, 1)
    instance.getDerivatives(derivative, 1)
    assert derivative[0] == -0.75
    x[0] = np.nan
    expect(DISCARD, instance.setContinuousStates, x, 1)
    instance.freeInstance()


def test_texts_and_warnings_of_external_functions(guarded: Path, tmp_path: Path) -> None:
    importer = Importer(guarded, tmp_path)
    instance = make_guarded(importer, 0, limit=0.125)
    assert instance.getString([importer.references["label"]]) == [b"limit 0.125"]
    assert (WARNING, "logStatusWarning", "made ##1") in importer.messages
    instance.freeInstance()


def test_chattering_is_reported(switching: Path, tmp_path: Path) -> None:
    importer = Importer(switching, tmp_path)
    instance = importer.make(FMU2Slave)
    instance.setInteger([importer.references["kind"]], [1])
    importer.initialize(instance)
    expect(ERROR, instance.doStep, 0.0, 1.0)
    said = importer.errors()[-1]
    assert "The model chatters at time 0.25" in said
    assert "1000 events within" in said
    assert "The relation of event indicator 1 undoes the condition" in said
    instance.freeInstance()


def test_chattering_is_a_warning_in_model_exchange(switching: Path, tmp_path: Path) -> None:
    importer = Importer(switching, tmp_path)
    instance = importer.make(FMU2Model)
    instance.setInteger([importer.references["kind"]], [1])
    importer.initialize(instance, x=0.0)
    instance.newDiscreteStates()
    for event in range(1, 1500):
        instance.enterContinuousTimeMode()
        instance.setTime(1e-9 * event)
        instance.setContinuousStates((ctypes.c_double * 1)(1e-9 if event % 2 else -1e-9), 1)
        instance.enterEventMode()
        instance.newDiscreteStates()
    warnings = [text for status, _, text in importer.messages if status == WARNING]
    assert len(warnings) == 1
    assert "The model chatters at time" in warnings[0]
    assert "event indicator 1 undoes" in warnings[0]
    # Events that come seldom are none.
    importer.messages.clear()
    for event in range(1, 1500):
        instance.enterContinuousTimeMode()
        instance.setTime(1.0 + 1e-6 * event)
        instance.setContinuousStates((ctypes.c_double * 1)(1e-9 if event % 2 else -1e-9), 1)
        instance.enterEventMode()
        instance.newDiscreteStates()
    assert not importer.messages
    instance.freeInstance()


@pytest.mark.parametrize("kind", [FMU2Model, FMU2Slave])
def test_an_event_iteration_without_end_is_reported(switching: Path, tmp_path: Path, kind: Any) -> None:
    importer = Importer(switching, tmp_path)
    instance = importer.make(kind)
    instance.setInteger([importer.references["kind"]], [2])
    if kind is FMU2Slave:
        importer.initialize(instance)
        expect(ERROR, instance.doStep, 0.0, 1.0)
    else:
        importer.initialize(instance, x=0.75)
        expect(ERROR, instance.newDiscreteStates)
    assert "does not settle in 100 iterations (last changed: restless)" in importer.errors()[-1]
    instance.freeInstance()


def test_values_can_be_set_only_when_the_standard_says(oscillator: Path, tmp_path: Path) -> None:
    importer = Importer(oscillator, tmp_path)
    instance = importer.make(FMU2Model)

    def settable(name: str) -> bool:
        try:
            importer.set_real(instance, name, 1.0)
        except FMICallException:
            return False
        return True

    names = ("s", "der(s)", "mass", "damping", "force", "energy", "frequency", "time")
    expected = {
        "instantiated": {"s", "mass", "damping", "force"},
        "initialization": {"s", "mass", "damping", "force"},
        "event": {"damping", "force"},
        "continuous": {"force"},
        "terminated": set(),
    }
    found = {"instantiated": {name for name in names if settable(name)}}
    instance.setupExperiment()
    instance.enterInitializationMode()
    found["initialization"] = {name for name in names if settable(name)}
    instance.exitInitializationMode()
    found["event"] = {name for name in names if settable(name)}
    instance.newDiscreteStates()
    instance.enterContinuousTimeMode()
    found["continuous"] = {name for name in names if settable(name)}
    instance.terminate()
    found["terminated"] = {name for name in names if settable(name)}
    assert found == expected
    assert "fmi2SetReal: Real variable energy cannot be set in event mode" in importer.errors()
    instance.freeInstance()


def test_misuse_is_answered_with_an_error(oscillator: Path, tmp_path: Path) -> None:
    importer = Importer(oscillator, tmp_path)
    instance = importer.make(FMU2Slave)
    expect(ERROR, instance.exitInitializationMode)
    expect(ERROR, instance.doStep, 0.0, 0.1)
    expect(ERROR, instance.getReal, [4711])
    expect(ERROR, instance.setReal, [4711], [1.0])
    expect(ERROR, instance.setReal, [4], [float("nan")])
    expect(ERROR, instance.getInteger, [0])
    expect(ERROR, instance.getBoolean, [0])
    expect(ERROR, instance.getString, [0])
    expect(ERROR, instance.setupExperiment, -1.0)
    importer.initialize(instance)
    expect(ERROR, instance.setupExperiment)
    expect(ERROR, instance.doStep, 0.0, -0.1)
    expect(ERROR, instance.doStep, 0.5, 0.1)
    expect(ERROR, instance.doStep, 0.0, float("nan"))
    expect(ERROR, instance.setReal, [importer.references["cmbSolver.maximumStep"]], [1.0])
    instance.doStep(0.0, 0.1)  # none of this did any harm
    assert importer.reals(instance, "s")[0] == pytest.approx(np.cos(0.2), abs=1e-6)
    instance.freeInstance()


def test_of_several_values_all_are_set_or_none(oscillator: Path, tmp_path: Path) -> None:
    importer = Importer(oscillator, tmp_path)
    instance = importer.make(FMU2Slave)
    references = importer.references
    tolerance, steps = references["cmbSolver.relativeTolerance"], references["cmbSolver.maximumSteps"]
    expect(ERROR, instance.setReal, [references["damping"], tolerance], [0.7, 2.0])
    expect(ERROR, instance.setReal, [tolerance, references["energy"]], [0.5, 1.0])
    expect(ERROR, instance.setInteger, [steps, steps], [5, 0])
    importer.initialize(instance)
    expect(ERROR, instance.setReal, [references["damping"], tolerance], [0.7, 1e-3])
    assert "before initialization ends" in importer.errors()[-1]
    assert importer.reals(instance, "damping") == [0.0]
    assert instance.getReal([tolerance])[0] < 0.5
    assert instance.getInteger([steps]) == [100_000]
    instance.freeInstance()


def test_a_wrong_guid_makes_no_instance(oscillator: Path, tmp_path: Path) -> None:
    importer = Importer(oscillator, tmp_path)
    importer.description.guid = "{other}"
    with pytest.raises(Exception, match="instantiate"):
        importer.make(FMU2Slave)
    assert "GUID" in importer.errors()[0]


def test_logging_follows_the_categories(ball: Path, tmp_path: Path) -> None:
    importer = Importer(ball, tmp_path)
    instance = importer.make(FMU2Slave)
    importer.initialize(instance)
    instance.doStep(0.0, 0.5)
    assert importer.messages == []
    instance.setDebugLogging(True, ["logEvents"])
    instance.doStep(0.5, 1.0)
    assert {category for _, category, _ in importer.messages} == {"logEvents"}
    assert any("event indicator 1, h > 0 becomes negative" in message for _, _, message in importer.messages)
    expect(ERROR, instance.fmi2SetDebugLogging, instance.component, 1, 1, (ctypes.c_char_p * 1)(b"logNothing"))
    importer.messages.clear()
    instance.setDebugLogging(False, [])
    instance.doStep(1.5, 0.5)
    assert importer.messages == []
    instance.freeInstance()


@pytest.mark.parametrize("kind", [0, 1])
def test_a_communication_step_is_given_up_after_so_many_steps_of_the_integrator(
    oscillator: Path, tmp_path: Path, kind: int
) -> None:
    """A step cannot be stopped from outside, so it has a bound; values are those of the time that was reached."""
    importer = Importer(oscillator, tmp_path)
    instance = importer.make(FMU2Slave)
    limit = importer.references["cmbSolver.maximumSteps"]
    assert list(instance.getInteger([limit])) == [100_000]
    for wrong in (0, -5):
        expect(ERROR, instance.setInteger, [limit], [wrong])
    instance.setInteger([limit], [200])
    importer.initialize(instance, **{"cmbSolver.maximumStep": 0.01})
    time = 0.0
    if kind == 1:  # the bound is one of each step: many short ones are no matter
        for _ in range(10):
            instance.doStep(time, 0.3)
            time += 0.3
    expect(DISCARD, instance.doStep, time, 10.0)
    assert any("more than 200 steps" in message and "maximumSteps" in message for _, _, message in importer.messages)
    reached = instance.getRealStatus(LAST_SUCCESSFUL_TIME)
    assert time < reached <= time + 200 * 0.01 + 0.01  # the step before may overshoot by one
    assert importer.reals(instance, "s")[0] == pytest.approx(np.cos(2.0 * reached), abs=1e-5)
    instance.freeInstance()
