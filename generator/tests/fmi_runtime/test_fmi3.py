"""FMUs of FMI 3.0: the same models, the same results, and what only this version has."""

from __future__ import annotations

import subprocess
import zipfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import fixture_models as models
import numpy as np
import pytest
from fmpy import extract, read_model_description, simulate_fmu
from fmpy.fmi1 import FMICallException
from fmpy.fmi3 import FMU3Model, FMU3Slave
from fmpy.validation import validate_fmu
from modelica2fmu.description.model_description import Causality, ModelDescription
from test_simulation import bouncing_height


class Session:
    """One instance with what it logs."""

    def __init__(self, fmu: Path, folder: Path, kind: Any = FMU3Slave, **options: bool) -> None:
        extract(str(fmu), str(folder))
        self.description = read_model_description(str(folder))
        self.references = {v.name: v.valueReference for v in self.description.modelVariables}
        self.messages: list[tuple[int, str, str]] = []
        part = self.description.coSimulation if kind is FMU3Slave else self.description.modelExchange
        self.instance = kind(
            guid=self.description.guid,
            modelIdentifier=part.modelIdentifier,
            unzipDirectory=str(folder),
            instanceName="i",
        )
        self.instance.instantiate(logMessage=self._log, **options)

    def _log(self, _env: Any, status: int, category: bytes, message: bytes) -> None:
        self.messages.append((status, category.decode(), message.decode()))

    def floats(self, *names: str) -> list[float]:
        return list(self.instance.getFloat64([self.references[name] for name in names]))

    def initialize(self, **floats: float) -> None:
        for name, value in floats.items():
            self.instance.setFloat64([self.references[name]], [value])
        self.instance.enterInitializationMode(tolerance=1e-9)
        self.instance.exitInitializationMode()


@pytest.mark.parametrize("name", ["oscillator3", "ball3", "schedule3"])
def test_fmpy_finds_nothing_wrong(name: str, request: pytest.FixtureRequest) -> None:
    assert validate_fmu(str(request.getfixturevalue(name))) == []


@pytest.mark.parametrize(
    "options", [{}, {"use_event_mode": True}, {"use_event_mode": True, "early_return_allowed": True}]
)
@pytest.mark.parametrize("kind", ["ModelExchange", "CoSimulation"])
def test_the_ball_bounces_on_parabolas(ball3: Path, kind: str, options: dict[str, bool]) -> None:
    result = simulate_fmu(
        str(ball3), fmi_type=kind, stop_time=3.0, output_interval=0.01, relative_tolerance=1e-9,
        output=["h", "bounces"], record_events=False, **options,
    )  # fmt: skip
    assert np.max(np.abs(result["h"] - bouncing_height(result["time"], 1.0, 0.7, 9.81))) < 2e-7
    assert result["bounces"][-1] == 24


@pytest.mark.parametrize("kind", ["ModelExchange", "CoSimulation"])
def test_values_of_every_type(schedule3: Path, kind: str) -> None:
    start = {"base": 2.5, "mode": 2, "title": "Zeit ä #%s", "step": 2, "first": 0.3}
    names = ["x", "twice", "level", "ticks", "late", "remark", "cmbSolver.timeEvents", "time"]
    result = simulate_fmu(
        str(schedule3), fmi_type=kind, stop_time=0.5, output_interval=0.1, start_values=start, output=names[:-1]
    )
    assert result["twice"][0] == 5.0
    assert result["level"][-1] == -1.0
    assert result["ticks"][-1] == 2
    assert not result["late"][-1]


def test_texts_and_enumerations(schedule3: Path, tmp_path: Path) -> None:
    session = Session(schedule3, tmp_path)
    refs, instance = session.references, session.instance
    instance.setString([refs["title"]], ["100 % #1"])
    instance.setInt64([refs["mode"]], [2])
    instance.setBoolean([refs["enabled"]], [False])
    session.initialize()
    assert instance.getString([refs["remark"]]) == ["100 % #1"]
    assert instance.getInt64([refs["mode"]]) == [2]
    assert instance.getBoolean([refs["enabled"], refs["late"]]) == [False, False]
    instance.doStep(0.0, 1.0)
    assert session.floats("time", "level") == [1.0, 0.0]
    instance.freeInstance()


def test_a_step_returns_early_at_an_event_and_goes_on_after_it(ball3: Path, tmp_path: Path) -> None:
    session = Session(ball3, tmp_path, eventModeUsed=True, earlyReturnAllowed=True)
    instance = session.instance
    session.initialize()
    assert instance.updateDiscreteStates()[:2] == (False, False)
    instance.enterStepMode()
    event, terminate, early, time = instance.doStep(0.0, 1.0)
    assert (event, terminate, early) == (True, False, True)
    assert time == pytest.approx(np.sqrt(2.0 / 9.81), abs=1e-8)
    assert session.floats("h")[0] == pytest.approx(0.0, abs=1e-8)
    assert session.floats("v")[0] < 0.0  # before the event
    instance.enterEventMode()
    _, _, _, states_changed, _, _ = instance.updateDiscreteStates()
    assert states_changed
    assert session.floats("v")[0] == pytest.approx(0.7 * np.sqrt(2.0 * 9.81), abs=1e-7)
    instance.enterStepMode()
    event, _, early, left = instance.doStep(time, 0.5)
    assert (event, early) == (True, True)  # the relation h > 0 becomes true again
    assert left == pytest.approx(time, abs=1e-9)
    instance.enterEventMode()
    assert not instance.updateDiscreteStates()[3]
    instance.enterStepMode()
    event, _, early, reached = instance.doStep(left, 0.5)
    assert (event, early, reached) == (False, False, left + 0.5)
    instance.freeInstance()


def test_an_event_that_nobody_handled_is_carried_out_by_the_next_step(ball3: Path, tmp_path: Path) -> None:
    session = Session(ball3, tmp_path, eventModeUsed=True, earlyReturnAllowed=True)
    session.initialize()
    session.instance.updateDiscreteStates()
    session.instance.enterStepMode()
    *_, time = session.instance.doStep(0.0, 1.0)
    session.instance.doStep(time, 0.25)
    assert session.floats("h")[0] > 0.0
    assert session.instance.getInt32([session.references["bounces"]]) == [1]
    session.instance.freeInstance()


def test_without_event_mode_no_step_returns_early(ball3: Path, tmp_path: Path) -> None:
    session = Session(ball3, tmp_path)
    session.initialize()
    assert session.instance.doStep(0.0, 2.0) == (False, False, False, 2.0)
    with pytest.raises(FMICallException):
        session.instance.enterEventMode()
    assert "this instance handles its events itself" in session.messages[-1][2]
    session.instance.freeInstance()


def test_a_model_that_terminates_says_so(schedule3: Path, tmp_path: Path) -> None:
    session = Session(schedule3, tmp_path)
    session.instance.setInt32([session.references["step"]], [60])
    session.initialize()
    event, terminate, early, time = session.instance.doStep(0.0, 1.0)
    assert (event, terminate, early) == (False, True, True)
    assert time == pytest.approx(0.35, abs=1e-12)
    session.instance.freeInstance()


def test_states_and_derivatives(oscillator3: Path, tmp_path: Path) -> None:
    session = Session(oscillator3, tmp_path)
    session.initialize(mass=2.0)
    instance, refs = session.instance, session.references
    instance.doStep(0.0, 0.5)
    state = instance.getFMUState()
    data = instance.serializeFMUState(state)
    instance.doStep(0.5, 0.5)
    first = session.floats("s", "v", "energy")
    instance.setFMUState(state)
    assert session.floats("time") == [0.5]
    instance.doStep(0.5, 0.5)
    assert session.floats("s", "v", "energy") == first
    restored = instance.deserializeFMUState(data)
    instance.setFMUState(restored)
    instance.doStep(0.5, 0.5)
    assert session.floats("s", "v", "energy") == first
    assert instance.getDirectionalDerivative([refs["der(v)"]], [refs["s"], refs["force"]], [1.0, 4.0]) == pytest.approx(
        [-2.0 + 2.0]
    )
    for saved in (state, restored):
        instance.freeFMUState(saved)
    instance.freeInstance()


def test_what_the_model_does_not_have_is_refused(ball3: Path, tmp_path: Path) -> None:
    session = Session(ball3, tmp_path)
    instance = session.instance
    calls: list[Callable[[], Any]] = [
        lambda: instance.getFloat32([0]),
        lambda: instance.setUInt16([0], [1]),
        lambda: instance.getClock([0]),
        lambda: instance.getFloat64([session.references["bounces"]]),
        lambda: instance.getInt32([session.references["h"]]),
        lambda: instance.getBoolean([session.references["h"]]),
        lambda: instance.getString([session.references["h"]]),
        lambda: instance.getFloat64([0x6000_0001]),
        lambda: instance.setFloat64([session.references["time"]], [1.0]),
        lambda: instance.setFloat64([session.references["cmbIndicator[1]"]], [1.0]),
        lambda: instance.getFloat64([0], nValues=2),
        lambda: instance.setInt64([session.references["bounces"]], [2**40]),
        lambda: instance.enterConfigurationMode(),
        lambda: instance.doStep(0.0, 0.1),
    ]
    for call in calls:
        before = len(session.messages)
        with pytest.raises(FMICallException) as caught:
            call()
        assert caught.value.status == 3
        assert len(session.messages) == before + 1
    session.initialize()
    instance.doStep(0.0, 0.1)
    indicator, height = session.floats("cmbIndicator[1]", "h")
    assert indicator == pytest.approx(height, abs=2e-10)
    instance.freeInstance()


def test_messages_name_the_reference_that_was_given(ball3: Path, tmp_path: Path) -> None:
    session = Session(ball3, tmp_path)
    instance = session.instance
    for reference in (123456789, 4711, session.references["bounces"], session.references["time"] + 1, 0x4000_0009):
        for call in (
            lambda: instance.getFloat64([0, reference]),  # noqa: B023
            lambda: instance.setFloat64([0, reference], [1.0, 1.0]),  # noqa: B023
        ):
            with pytest.raises(FMICallException):
                call()
            assert f"value reference {reference} " in session.messages[-1][2]
    instance.freeInstance()


def test_scheduled_execution_is_refused(ball3: Path, tmp_path: Path) -> None:
    from fmpy.fmi3 import FMU3ScheduledExecution

    extract(str(ball3), str(tmp_path))
    description = read_model_description(str(tmp_path))
    fmu = FMU3ScheduledExecution(
        guid=description.guid, modelIdentifier="Ball", unzipDirectory=str(tmp_path), instanceName="i"
    )
    with pytest.raises(Exception, match="instantiate"):
        fmu.instantiate(logMessage=lambda *_: None)


def test_only_fmi3_functions_are_visible(ball3: Path, tmp_path: Path) -> None:
    extract(str(ball3), str(tmp_path))
    library = tmp_path / "binaries" / "x86_64-linux" / "Ball.so"
    listed = subprocess.run(["nm", "-D", "--defined-only", library], capture_output=True, text=True, check=True)
    symbols = {line.split()[-1] for line in listed.stdout.splitlines()}
    assert len(symbols) == 75  # as many as fmi3Functions.h declares
    assert all(symbol.startswith("fmi3") for symbol in symbols)


def test_variables_of_one_slot_become_aliases(
    package3: Callable[[ModelDescription, str], Path], tmp_path: Path
) -> None:
    """speed is v and der(s) too; roles, start values and derivatives must not get lost."""
    variables = []
    for variable in models.OSCILLATOR.variables:
        if variable.name == "der(s)":
            variables.append(replace(variable, value_reference=1, description="Derivative"))
            variables.append(models.local("speed", 1, Causality.OUTPUT, unit="m/s", description="Speed"))
        else:
            variables.append(variable)
    description = replace(models.OSCILLATOR, variables=tuple(variables), outputs=("s", "energy", "speed"))
    fmu = package3(description, "oscillator")
    assert validate_fmu(str(fmu)) == []
    session = Session(fmu, tmp_path, FMU3Model)
    by_name = {variable.name: variable for variable in session.description.modelVariables}
    assert by_name["v"].derivative is by_name["s"]
    assert {alias.name for alias in by_name["v"].aliases} == {"der(s)"}
    assert [unknown.variable.name for unknown in session.description.derivatives] == ["v", "der(v)"]
    assert {unknown.variable.name for unknown in session.description.outputs} == {"s", "energy", "speed"}
    session.initialize(v=0.25)
    assert session.floats("v", "der(s)", "speed") == [0.25, 0.25, 0.25]
    refs = session.references
    sensitivity = session.instance.getDirectionalDerivative(
        [refs["speed"], refs["der(v)"]], [refs["v"], refs["s"]], [1.0, 2.0]
    )
    assert sensitivity == pytest.approx([1.0, -8.0])
    session.instance.freeInstance()


def test_shared_calculated_parameters_pass_the_checker(package3: Callable[[ModelDescription, str], Path]) -> None:
    variables = (*models.OSCILLATOR.variables, models.calculated("omega", 9), models.calculated("omega2", 9))
    assert validate_fmu(str(package3(replace(models.OSCILLATOR, variables=variables), "oscillator"))) == []


def test_the_files_of_fmi3(schedule3: Path) -> None:
    with zipfile.ZipFile(schedule3) as archive:
        names = set(archive.namelist())
    assert {"terminalsAndIcons/terminalsAndIcons.xml", "terminalsAndIcons/icon.png"} <= names
    assert {"sources/buildDescription.xml", "sources/fmi3_functions.c"} <= names
    assert not [name for name in names if name.startswith("sources/fmi2_")]
    (configuration,) = read_model_description(str(schedule3)).buildConfigurations
    (files,) = configuration.sourceFileSets
    assert {f"sources/{name}" for name in files.sourceFiles} <= names
