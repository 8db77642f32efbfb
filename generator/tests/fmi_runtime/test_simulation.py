"""Hand-written models in FMPy, model exchange and co-simulation, against closed forms."""

from __future__ import annotations

import ctypes
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fmpy import simulate_fmu
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Model, FMU2Slave
from fmpy.validation import validate_fmu
from importer import Importer
from numpy.typing import NDArray

KINDS = ("ModelExchange", "CoSimulation")

Array = NDArray[np.float64]


def simulate(fmu: Path, kind: str, stop: float, interval: float, output: list[str], **more: Any) -> Any:
    return simulate_fmu(
        str(fmu), fmi_type=kind, stop_time=stop, output_interval=interval, output=output,
        **{"relative_tolerance": 1e-9, "record_events": False, **more},
    )  # fmt: skip


def bouncing_height(time: Array, height: float, restitution: float, gravity: float) -> Array:
    """Height of a ball dropped at time 0: parabolas between impacts, 0 after the last."""
    result = np.zeros_like(time)
    begin, speed = -np.sqrt(2.0 * height / gravity), np.sqrt(2.0 * gravity * height)
    for _ in range(200):
        end = begin + 2.0 * speed / gravity
        inside = (time >= begin) & (time < end)
        local = time[inside] - begin
        result[inside] = speed * local - 0.5 * gravity * local**2
        begin, speed = end, restitution * speed
    return result


@pytest.mark.parametrize("name", ["oscillator", "ball", "schedule", "guarded", "switching"])
def test_fmpy_finds_nothing_wrong(name: str, request: pytest.FixtureRequest) -> None:
    assert validate_fmu(str(request.getfixturevalue(name))) == []


@pytest.mark.parametrize("kind", KINDS)
def test_oscillator_follows_the_cosine(oscillator: Path, kind: str) -> None:
    result = simulate(oscillator, kind, 10.0, 0.1, ["s", "energy", "frequency"])
    assert np.allclose(result["s"], np.cos(2.0 * result["time"]), atol=2e-7)
    assert np.allclose(result["energy"], 2.0, atol=1e-6)
    assert np.all(result["frequency"] == 2.0)


@pytest.mark.parametrize("kind", KINDS)
def test_oscillator_follows_damping_and_a_force(oscillator: Path, kind: str) -> None:
    start = {"mass": 2.0, "stiffness": 50.0, "damping": 4.0, "force": 10.0, "s": 0.0}
    result = simulate(oscillator, kind, 4.0, 0.05, ["s", "frequency"], start_values=start)
    decay, omega = 1.0, np.sqrt(24.0)
    time = result["time"]
    exact = 0.2 * (1.0 - np.exp(-decay * time) * (np.cos(omega * time) + decay / omega * np.sin(omega * time)))
    assert np.allclose(result["s"], exact, atol=1e-7)
    assert np.all(result["frequency"] == 5.0)


@pytest.mark.parametrize("kind", KINDS)
def test_tighter_tolerance_is_more_accurate(oscillator: Path, kind: str) -> None:
    def error(tolerance: float) -> float:
        result = simulate(oscillator, kind, 10.0, 0.1, ["s"], relative_tolerance=tolerance)
        return float(np.max(np.abs(result["s"] - np.cos(2.0 * result["time"]))))

    coarse, middle, fine = error(1e-4), error(1e-7), error(1e-10)
    assert coarse > 10.0 * middle > 100.0 * fine
    assert fine < 1e-7


@pytest.mark.parametrize("kind", KINDS)
def test_ball_bounces_on_parabolas_and_comes_to_rest(ball: Path, kind: str) -> None:
    result = simulate(ball, kind, 3.0, 0.01, ["h", "v", "bounces", "impactSpeed"])
    exact = bouncing_height(result["time"], 1.0, 0.7, 9.81)
    assert np.max(np.abs(result["h"] - exact)) < 2e-7
    assert result["bounces"][0] == 0
    assert result["bounces"][-1] == 24  # first n with 0.7^n sqrt(2 g) <= 1e-3 m/s
    assert result["v"][-1] == 0.0
    assert result["impactSpeed"][120] == pytest.approx(0.7 * np.sqrt(2.0 * 9.81), abs=1e-6)


@pytest.mark.parametrize("kind", KINDS)
def test_time_events_come_at_their_times(schedule: Path, kind: str) -> None:
    result = simulate(schedule, kind, 2.0, 0.02, ["x", "level", "ticks", "late", "remark"])
    time = result["time"]
    after = np.floor((time - 0.1) / 0.25 + 1.0)
    at_event = np.abs((time - 0.1) / 0.25 - np.round((time - 0.1) / 0.25)) < 1e-9
    assert np.array_equal(result["ticks"][~at_event], after[~at_event])
    assert np.array_equal(result["level"], result["ticks"])
    exact = np.full_like(time, 3.0) * np.exp(-time / 0.5)
    for tick in 0.1 + 0.25 * np.arange(8):
        exact += np.where(time > tick, 1.0 - np.exp(-(time - tick) / 0.5), 0.0)
    assert np.max(np.abs(result["x"] - exact)) < 1e-7
    assert np.array_equal(result["late"], result["ticks"] > 2)


@pytest.mark.parametrize("kind", KINDS)
def test_parameters_of_every_type_are_heard(schedule: Path, kind: str) -> None:
    start = {"base": 2.5, "mode": 2, "title": "Zeit ä #%s", "step": 2, "first": 0.3}
    result = simulate(schedule, kind, 0.5, 0.1, ["x", "twice", "level", "ticks"], start_values=start)
    assert result["twice"][0] == 5.0
    assert result["x"][0] == 5.0
    assert result["level"][-1] == -1.0
    assert result["ticks"][-1] == 2
    disabled = simulate(schedule, kind, 1.0, 0.1, ["ticks"], start_values={"enabled": False})
    assert np.all(disabled["ticks"] == 0)


def test_texts_come_back_as_they_were_set(schedule: Path, tmp_path: Path) -> None:
    importer = Importer(schedule, tmp_path)
    instance = importer.make(FMU2Slave)
    title, remark = importer.references["title"], importer.references["remark"]
    instance.setupExperiment()
    text = "Zeit ä #%s"
    instance.setString([title], [text])
    instance.enterInitializationMode()
    assert instance.getString([title, remark]) == [text.encode(), b"before"]
    instance.exitInitializationMode()
    assert instance.getString([title, remark]) == [text.encode(), text.encode()]
    instance.doStep(0.0, 1.0)
    assert instance.getString([remark]) == [b"late"]
    instance.freeInstance()


def test_a_model_that_terminates_ends_the_step_early(schedule: Path, tmp_path: Path) -> None:
    importer = Importer(schedule, tmp_path)
    instance = importer.make(FMU2Slave)
    instance.setInteger([importer.references["step"]], [60])
    importer.initialize(instance)
    instance.doStep(0.0, 0.2)
    with pytest.raises(Exception, match=r"status 2|Discard|discard"):
        instance.doStep(0.2, 1.0)
    assert instance.getBooleanStatus(3)  # fmi2Terminated
    assert instance.getRealStatus(2) == pytest.approx(0.35, abs=1e-12)  # fmi2LastSuccessfulTime
    assert instance.getString([importer.references["remark"]]) == [b"late"]
    instance.terminate()
    assert instance.getString([importer.references["remark"]]) == [b"over"]  # the event of terminal()
    instance.freeInstance()


def test_model_exchange_reports_termination(schedule: Path, tmp_path: Path) -> None:
    importer = Importer(schedule, tmp_path)
    instance = importer.make(FMU2Model)
    instance.setInteger([importer.references["step"]], [120])
    importer.initialize(instance)
    _, terminate, _, _, next_defined, next_time = instance.newDiscreteStates()
    assert not terminate
    assert next_defined
    assert next_time == 0.1
    instance.enterContinuousTimeMode()
    instance.setTime(next_time)
    instance.enterEventMode()
    assert instance.newDiscreteStates()[1]
    instance.freeInstance()


def test_a_time_event_met_within_rounding_is_carried_out(schedule: Path, tmp_path: Path) -> None:
    importer = Importer(schedule, tmp_path)
    instance = importer.make(FMU2Model)
    importer.initialize(instance)
    instance.newDiscreteStates()
    instance.enterContinuousTimeMode()
    instance.setTime(0.1 - 1e-15)
    instance.enterEventMode()
    *_, next_time = instance.newDiscreteStates()
    assert next_time == 0.35
    assert instance.getInteger([importer.references["ticks"]]) == [1]
    instance.freeInstance()


def test_an_event_that_changes_nothing_is_found_once(switching: Path, tmp_path: Path) -> None:
    importer = Importer(switching, tmp_path)
    instance = importer.make(FMU2Slave)
    importer.initialize(instance)
    instance.doStep(0.0, 1.0)
    assert instance.getInteger([importer.references["crossings"]]) == [1]
    assert instance.getInteger([importer.references["cmbSolver.stateEvents"]]) == [1]
    assert importer.reals(instance, "crossingTime") == [pytest.approx(0.25, abs=1e-9)]
    x, tie, total, root = importer.reals(instance, "x", "tie", "sum", "root")
    assert (tie, total) == (pytest.approx(x, abs=1e-15), pytest.approx(2.0 * x, abs=1e-15))
    assert root**3 + root == pytest.approx(x, abs=1e-12)
    instance.freeInstance()


def test_indicators_are_never_zero_after_an_event(switching: Path, tmp_path: Path) -> None:
    importer = Importer(switching, tmp_path)
    instance = importer.make(FMU2Model)
    importer.initialize(instance, x=0.5)
    instance.newDiscreteStates()
    instance.enterContinuousTimeMode()
    count = importer.description.numberOfEventIndicators

    def indicator() -> float:
        value = (ctypes.c_double * count)()
        instance.getEventIndicators(value, count)
        return float(value[0])

    def set_state(value: float) -> None:
        instance.setContinuousStates((ctypes.c_double * 1)(value), 1)

    def event() -> None:
        instance.enterEventMode()
        instance.newDiscreteStates()
        instance.enterContinuousTimeMode()

    assert indicator() < 0.0  # exactly at the threshold the relation x > 0.5 is false
    set_state(0.5 + 0.5e-10)
    assert indicator() < 0.0  # noise below the hysteresis is no event
    set_state(0.5 + 1e-10)
    assert indicator() >= -1e-16
    set_state(0.5 + 1.1e-10)
    assert indicator() > 0.0
    event()
    assert indicator() > 1e-10
    set_state(0.5)
    assert indicator() > 0.0
    set_state(0.5 - 1.1e-10)
    assert indicator() < 0.0
    event()
    assert indicator() < -1e-10
    instance.freeInstance()


def test_communication_points_are_hit_exactly(oscillator: Path, tmp_path: Path) -> None:
    importer = Importer(oscillator, tmp_path)
    instance = importer.make(FMU2Slave)
    importer.initialize(instance, tolerance=1e-9)
    time = 0.0
    for step in (0.1, 1e-9, 0.3, 1.0 / 3.0, 1e-13, 2.0):
        instance.doStep(time, step)
        time += step
        assert importer.reals(instance, "time") == [time]
        assert importer.reals(instance, "s")[0] == pytest.approx(np.cos(2.0 * time), abs=1e-7)
    instance.freeInstance()


def test_steps_end_at_the_stop_time_up_to_rounding(oscillator: Path, tmp_path: Path) -> None:
    importer = Importer(oscillator, tmp_path)
    instance = importer.make(FMU2Slave)
    instance.setupExperiment(startTime=0.0, stopTime=1000.0)
    instance.enterInitializationMode()
    instance.exitInitializationMode()
    step = 1e-3
    time = 1000.0 - step + 2e-8  # what a million additions of such a step may come to
    instance.doStep(0.0, time)
    with pytest.raises(FMICallException):
        instance.doStep(time, 1.1 * step)
    assert importer.errors() == ["fmi2DoStep: the step ends after the stop time"]
    instance.doStep(time, step)
    instance.freeInstance()


def test_inputs_and_tunable_parameters_act_from_their_communication_point_on(oscillator: Path, tmp_path: Path) -> None:
    importer = Importer(oscillator, tmp_path)
    instance = importer.make(FMU2Slave)
    importer.initialize(instance, tolerance=1e-9, s=0.0)
    for step in range(10):
        instance.doStep(0.1 * step, 0.1)
    assert importer.reals(instance, "s") == [0.0]
    importer.set_real(instance, "force", 4.0)
    assert importer.reals(instance, "der(v)") == [4.0]
    for step in range(10, 20):
        instance.doStep(0.1 * step, 0.1)
    assert importer.reals(instance, "s")[0] == pytest.approx(1.0 - np.cos(2.0), abs=1e-7)
    importer.set_real(instance, "damping", 1e6)  # stops it where it is
    before = importer.reals(instance, "s")[0]
    for step in range(20, 30):
        instance.doStep(0.1 * step, 0.1)
    assert importer.reals(instance, "s")[0] == pytest.approx(before, abs=1e-4)
    instance.freeInstance()


def test_integrator_options_and_counters(oscillator: Path, tmp_path: Path) -> None:
    importer = Importer(oscillator, tmp_path)

    def steps(**options: float) -> list[int]:
        instance = importer.make(FMU2Slave)
        importer.initialize(instance, **{f"cmbSolver.{name}": value for name, value in options.items()})
        instance.doStep(0.0, 10.0)
        counters = [importer.references[f"cmbSolver.{name}"] for name in ("steps", "evaluations", "jacobians")]
        values = list(instance.getInteger(counters))
        instance.freeInstance()
        return values

    loose, tight = steps(relativeTolerance=1e-3), steps(relativeTolerance=1e-9)
    assert 10 < loose[0] < tight[0] < 10 * tight[2] * 50
    assert loose[1] > loose[0]
    assert steps(relativeTolerance=1e-3, maximumStep=1e-3)[0] >= 10_000
    assert steps(relativeTolerance=1e-3, absoluteTolerance=0.1)[0] < loose[0]
