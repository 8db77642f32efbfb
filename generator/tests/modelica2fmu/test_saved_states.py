"""Going on from a saved state repeats what came after it to the last bit, in whichever instance it is restored.

``CMB_STATES=200`` takes so many random walks through the states of each example.
"""

from __future__ import annotations

import os
import random
from pathlib import Path
from typing import Any

import pytest
from contact_data import checkout
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave
from modelica2fmu.build import BuildOptions, build_fmu

FEW = 6
MANY = int(os.environ.get("CMB_STATES", "20"))
STEPS = 12
STOP = 1.5

SPRING_WITH_STOP = """model SpringWithStop
  Real x(start = 0.9, fixed = true), v(start = 0, fixed = true), y(start = 0, fixed = true);
  Integer impacts(start = 0, fixed = true);
equation
  der(x) = v;
  der(v) = -40*x - 0.3*v;
  der(y) = -200*(y - x);
  when x < -0.4 then
    reinit(v, -0.8*pre(v));
    impacts = pre(impacts) + 1;
  end when;
end SpringWithStop;
"""
EXAMPLES = (
    "BallOnFloor",
    "BoxOnIncline",
    "NewtonCradle",
    "RollingSphere",
    "SpheresInBox",
    "SpheresOnFloor",
    "StackOfBoxes",
    "TumblingShapes",
)


class Walk:
    """Two instances that go through the same random steps, in part from saved states."""

    def __init__(self, fmu: Path, folder: Path, seed: int) -> None:
        self._choose = random.Random(seed)
        self._folder = extract(str(fmu), str(folder))
        self._description = read_model_description(str(fmu))
        variables = self._description.modelVariables
        self._reals = [item.valueReference for item in variables if item.type == "Real"]
        self._integers = [item.valueReference for item in variables if item.type in ("Integer", "Enumeration")]
        self._tolerance = 10 ** self._choose.uniform(-6, -2)
        inside = sorted(self._choose.uniform(0, STOP) for _ in range(STEPS - 1))
        self._times = [0.0, *inside, STOP]
        self._is_saved = [True, *(self._choose.random() < 0.6 for _ in inside)]

    def different(self) -> list[str]:
        """What is not repeated."""
        instances = [self._make(name) for name in ("first", "second")]
        saved: dict[int, bytes] = {}
        values: list[Any] = []
        for number in range(STEPS):
            if self._is_saved[number]:
                saved[number] = self._save(instances[0])
            values.append(self._step(instances[0], number))
        wrong = [text for _ in range(8) if (text := self._again(self._choose.choice(instances), saved, values))]
        for instance in instances:
            instance.freeInstance()
        return wrong

    def _again(self, instance: Any, saved: dict[int, bytes], values: list[Any]) -> str:
        begin = self._choose.choice(list(saved))
        if self._choose.random() < 0.3:
            instance.reset()
            self._initialize(instance)
        state = instance.deserializeFMUState(saved[begin])
        instance.setFMUState(state)
        instance.freeFMUState(state)
        for number in range(begin, self._choose.randint(begin + 1, STEPS)):
            if number > begin and self._is_saved[number]:
                self._save(instance)
            if self._step(instance, number) != values[number]:
                return f"from step {begin}, step {number} of {instance.instanceName} at {self._tolerance}"
        return ""

    def _make(self, name: str) -> Any:
        instance = FMU2Slave(
            guid=self._description.guid,
            unzipDirectory=self._folder,
            modelIdentifier=self._description.coSimulation.modelIdentifier,
            instanceName=name,
        )
        instance.instantiate()
        self._initialize(instance)
        return instance

    def _initialize(self, instance: Any) -> None:
        instance.setupExperiment(startTime=0.0, tolerance=self._tolerance)
        instance.enterInitializationMode()
        instance.exitInitializationMode()

    def _save(self, instance: Any) -> bytes:
        state = instance.getFMUState()
        data: bytes = instance.serializeFMUState(state)
        instance.freeFMUState(state)
        return data

    def _step(self, instance: Any, number: int) -> list[float]:
        begin, end = self._times[number : number + 2]
        instance.doStep(begin, end - begin)
        integers = instance.getInteger(self._integers) if self._integers else []
        return [*instance.getReal(self._reals), *integers]


def test_a_spring_with_a_stop(build, tmp_path):
    fmu = build(SPRING_WITH_STOP).fmu
    wrong = [text for seed in range(FEW) for text in Walk(fmu, tmp_path / str(seed), seed).different()]
    assert not wrong, "\n".join(wrong)


@pytest.mark.full
@pytest.mark.parametrize("example", EXAMPLES)
def test_examples_of_the_library(example, fmu_cache, tmp_path):
    fmu = tmp_path / f"{example}.fmu"
    sources = [checkout() / "ContactMultiBody"]
    build_fmu(f"ContactMultiBody.Examples.{example}", sources, fmu, BuildOptions(cache=fmu_cache))
    wrong = [text for seed in range(MANY) for text in Walk(fmu, tmp_path / str(seed), seed).different()]
    assert not wrong, "\n".join(wrong)
