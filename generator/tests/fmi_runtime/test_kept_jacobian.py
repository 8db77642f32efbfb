"""The Jacobian is computed once for all directions at a point, and is never that of another point."""

from __future__ import annotations

import ctypes
from pathlib import Path
from typing import Any

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Model
from modelica2fmu.build import BuildOptions, build_fmu

BENT = """model Bent
  parameter Real gain = 1 annotation (Evaluate=false);
  Real x(start=2, fixed=true), y(start=3, fixed=true);
equation
  der(x) = gain*x^3 + y^2/2;
  der(y) = time*x + x*y;
end Bent;
"""


def opened(text: str, name: str, folder: Path, cache: Path) -> tuple[FMU2Model, list[int], list[int]]:
    """An instance in continuous-time mode, and the references of derivatives and states."""
    source = folder / f"{name}.mo"
    source.write_text(text)
    fmu = build_fmu(name, [source], folder / f"{name}.fmu", BuildOptions(cache=cache)).fmu
    extract(str(fmu), str(folder / name))
    description = read_model_description(str(folder / name))
    instance = FMU2Model(
        guid=description.guid,
        modelIdentifier=description.modelExchange.modelIdentifier,
        unzipDirectory=str(folder / name),
        instanceName="instance",
    )
    instance.instantiate()
    instance.setupExperiment()
    instance.enterInitializationMode()
    instance.exitInitializationMode()
    instance.newDiscreteStates()
    instance.enterContinuousTimeMode()
    derivatives = [unknown.variable for unknown in description.derivatives]
    return instance, [v.valueReference for v in derivatives], [v.derivative.valueReference for v in derivatives]


def move(instance: FMU2Model, *states: float) -> None:
    instance.setContinuousStates((ctypes.c_double * len(states))(*states), len(states))


def jacobian(instance: Any, unknown: list[int], known: list[int]) -> list[list[float]]:
    return [instance.getDirectionalDerivative(unknown, [state], [1.0]) for state in known]


def test_each_point_has_its_own(tmp_path: Path, fmu_cache: Path) -> None:
    instance, unknown, known = opened(BENT, "Bent", tmp_path, fmu_cache)

    def check(time: float, x: float, y: float) -> None:
        for _ in range(2):
            assert jacobian(instance, unknown, known) == [[3 * x**2, time + y], [y, x]]

    for now, x, y in ((0.0, 2.0, 3.0), (0.5, 2.0, 3.0), (0.5, -1.0, 3.0), (0.5, -1.0, 0.5)):
        instance.setTime(now)
        move(instance, x, y)
        check(now, x, y)
    saved = instance.getFMUState()
    move(instance, 4.0, 5.0)
    check(0.5, 4.0, 5.0)
    instance.setFMUState(saved)
    check(0.5, -1.0, 0.5)
    instance.freeFMUState(saved)
    instance.freeInstance()
