"""Saving, restoring and serializing the state of an FMU; several instances at once."""

from __future__ import annotations

import ctypes
import threading
from pathlib import Path
from typing import Any

import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Model, FMU2Slave
from importer import Importer

Samples = list[tuple[float, ...]]


def run(importer: Importer, instance: Any, begin: float, steps: int, size: float = 0.05) -> Samples:
    samples = []
    for step in range(steps):
        instance.doStep(begin + size * step, size)
        samples.append((*importer.reals(instance, "h", "v", "impactSpeed"), *instance.getInteger([0])))
    return samples


def test_going_on_from_a_saved_state_repeats_exactly(ball: Path, tmp_path: Path) -> None:
    importer = Importer(ball, tmp_path)
    instance = importer.make(FMU2Slave)
    importer.initialize(instance)
    run(importer, instance, 0.0, 8)
    saved = instance.getFMUState()
    first = run(importer, instance, 0.4, 30)
    for _ in range(2):
        instance.setFMUState(saved)
        assert run(importer, instance, 0.4, 30) == first
    instance.freeFMUState(saved)
    instance.freeInstance()


def test_saving_does_not_change_the_trajectory_beyond_the_tolerance(ball: Path, tmp_path: Path) -> None:
    importer = Importer(ball, tmp_path)
    plain, saving = importer.make(FMU2Slave, "plain"), importer.make(FMU2Slave, "saving")
    for instance in (plain, saving):
        importer.initialize(instance, tolerance=1e-10)
    for step in range(20):
        plain.doStep(0.05 * step, 0.05)
        state = saving.getFMUState()
        saving.doStep(0.05 * step, 0.05)
        saving.freeFMUState(state)
    assert importer.reals(plain, "h") == pytest.approx(importer.reals(saving, "h"), abs=1e-7)
    for instance in (plain, saving):
        instance.freeInstance()


def test_serialized_states_go_to_another_instance(ball: Path, tmp_path: Path) -> None:
    importer = Importer(ball, tmp_path)
    source, target = importer.make(FMU2Slave, "source"), importer.make(FMU2Slave, "target")
    for instance in (source, target):
        importer.initialize(instance)
    run(importer, source, 0.0, 10)
    saved = source.getFMUState()
    data = source.serializeFMUState(saved)
    copied = target.deserializeFMUState(data)
    assert target.serializeFMUState(copied) == data
    target.setFMUState(copied)
    assert run(importer, target, 0.5, 30) == run(importer, source, 0.5, 30)
    for instance, state in ((source, saved), (target, copied)):
        instance.freeFMUState(state)
        instance.freeInstance()


def test_states_of_instances_for_another_use_are_refused(ball: Path, tmp_path: Path) -> None:
    """Their phases are others: an instance would be stuck in one that it cannot leave."""
    importer = Importer(ball, tmp_path)
    instances = [importer.make(kind) for kind in (FMU2Slave, FMU2Model)]
    for instance in instances:
        importer.initialize(instance)
    states = [instance.getFMUState() for instance in instances]
    for instance, foreign in zip(instances, reversed(states), strict=True):
        with pytest.raises(FMICallException):
            instance.setFMUState(foreign)
        assert "another use" in importer.errors()[-1]
    instances[0].doStep(0.0, 0.1)
    instances[1].newDiscreteStates()
    instances[1].enterContinuousTimeMode()
    for instance, state in zip(instances, states, strict=True):
        instance.freeFMUState(state)
        instance.freeInstance()


@pytest.mark.parametrize("damage", ["short", "long", "bit", "empty", "other"])
def test_damaged_states_are_refused(ball: Path, oscillator: Path, tmp_path: Path, damage: str) -> None:
    importer = Importer(ball, tmp_path / "ball")
    instance = importer.make(FMU2Slave)
    importer.initialize(instance)
    saved = instance.getFMUState()
    data = bytearray(instance.serializeFMUState(saved))
    if damage == "short":
        del data[-1]
    elif damage == "long":
        data += b"\0"
    elif damage == "bit":
        data[len(data) // 2] ^= 1
    elif damage == "empty":
        data = bytearray()
    else:
        other = Importer(oscillator, tmp_path / "other")
        foreign = other.make(FMU2Slave)
        state = foreign.getFMUState()
        data = bytearray(foreign.serializeFMUState(state))
        foreign.freeFMUState(state)
        foreign.freeInstance()
    with pytest.raises(FMICallException):
        instance.deserializeFMUState(bytes(data))
    assert importer.errors() == ["fmi2DeSerializeFMUstate: these bytes are not a state of this FMU"]
    instance.doStep(0.0, 0.1)
    instance.freeFMUState(saved)
    instance.freeInstance()


def test_texts_and_start_values_belong_to_the_state(schedule: Path, tmp_path: Path) -> None:
    importer = Importer(schedule, tmp_path)
    instance = importer.make(FMU2Slave)
    instance.setupExperiment()
    title = importer.references["title"]
    instance.setString([title], ["first"])
    importer.set_real(instance, "base", 7.0)
    saved = instance.getFMUState()
    instance.setString([title], ["second, longer than the first"])
    importer.set_real(instance, "base", 8.0)
    instance.enterInitializationMode()
    instance.exitInitializationMode()
    instance.doStep(0.0, 1.0)
    instance.setFMUState(saved)
    assert instance.getString([title]) == [b"first"]
    instance.enterInitializationMode()
    instance.exitInitializationMode()
    assert importer.reals(instance, "x") == [14.0]
    instance.freeFMUState(saved)
    instance.freeInstance()


def test_model_exchange_states_are_restored(ball: Path, tmp_path: Path) -> None:
    importer = Importer(ball, tmp_path)
    instance = importer.make(FMU2Model)
    importer.initialize(instance)
    instance.newDiscreteStates()
    instance.enterContinuousTimeMode()
    saved = instance.getFMUState()
    instance.setTime(1.0)
    instance.setContinuousStates((ctypes.c_double * 2)(-1.0, -5.0), 2)
    instance.enterEventMode()
    instance.newDiscreteStates()
    assert instance.getInteger([0]) == [1]
    instance.setFMUState(saved)
    assert instance.getInteger([0]) == [0]
    assert importer.reals(instance, "h", "v") == [1.0, 0.0]
    instance.setTime(0.1)  # continuous-time mode again
    instance.freeFMUState(saved)
    instance.freeInstance()


def test_reset_leads_back_to_the_beginning(ball: Path, tmp_path: Path) -> None:
    importer = Importer(ball, tmp_path)
    instance = importer.make(FMU2Slave)
    importer.initialize(instance, e=0.2)
    slow = run(importer, instance, 0.0, 30)
    instance.reset()
    importer.initialize(instance)
    lively = run(importer, instance, 0.0, 30)
    instance.reset()
    importer.initialize(instance, e=0.2)
    assert run(importer, instance, 0.0, 30) == slow != lively
    instance.freeInstance()


def test_instances_in_threads_do_not_disturb_each_other(ball: Path, tmp_path: Path) -> None:
    importer = Importer(ball, tmp_path / "ball")
    heights = [1.0, 0.5, 2.0, 1.5]

    def simulate(height: float, results: dict[float, Samples]) -> None:
        instance = importer.make(FMU2Slave, f"from {height}")
        importer.initialize(instance, h=height)
        results[height] = run(importer, instance, 0.0, 300, 0.01)
        instance.freeInstance()

    alone: dict[float, Samples] = {}
    for height in heights:
        simulate(height, alone)
    together: dict[float, Samples] = {}
    threads = [threading.Thread(target=simulate, args=(height, together)) for height in heights]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert together == alone


def test_external_errors_in_threads_reach_their_own_instance(guarded: Path, tmp_path: Path) -> None:
    importers = [Importer(guarded, tmp_path / str(number)) for number in range(4)]

    def fail_often(importer: Importer, limit: float) -> None:
        for _ in range(50):
            instance = importer.make(FMU2Slave)
            importer.initialize(instance, limit=limit)
            with pytest.raises(FMICallException):
                instance.doStep(0.0, 10.0)
            instance.freeInstance()

    limits = [0.1, 0.2, 0.3, 0.4]
    threads = [threading.Thread(target=fail_often, args=pair) for pair in zip(importers, limits, strict=True)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for importer, limit in zip(importers, limits, strict=True):
        discards = [message for status, _, message in importer.messages if status == 2]
        assert len(discards) == 50
        assert all(f"is below {limit:g} (100%%)" in message for message in discards)
