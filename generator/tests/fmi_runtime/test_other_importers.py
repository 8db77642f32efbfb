"""Importers that share nothing with FMPy: libcosim (FMI Library inside), Ecos (fmi4c inside), fmi-sim (Rust)."""

from __future__ import annotations

import csv
import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Mapping, Sequence
from importlib import util
from pathlib import Path

import fixture_models as models
import numpy as np
import pytest

Importer = Callable[[Path, Sequence[str], float, Mapping[str, float]], list[float]]

FALL = np.sqrt(2.0 / 9.81)


def height_after_one_bounce(time: float, height: float = 1.0, restitution: float = 0.7) -> float:
    """Height of the ball dropped at time 0 between its first and its second impact."""
    fall = np.sqrt(2.0 * height / 9.81)
    flight = time - fall
    return float(restitution * 9.81 * fall * flight - 0.5 * 9.81 * flight**2)


# Each in a process of its own: the libraries log to standard output, keep threads and stay loaded.
def run(command: Sequence[str | Path], **environment: str) -> str:
    done = subprocess.run(
        [str(word) for word in command],
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
        env={**os.environ, **environment},
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


LIBCOSIM = """
import sys
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
from libcosimpy.CosimManipulator import CosimManipulator
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave

log_output_level(CosimLogLevel.FATAL)
execution = CosimExecution.from_step_size(step_size=10_000_000)
slave = execution.add_local_slave(CosimLocalSlave(fmu_path=sys.argv[1], instance_name="driven"))
observer = CosimObserver.create_last_value()
execution.add_observer(observer)
manipulator = CosimManipulator.create_override()
execution.add_manipulator(manipulator)
for reference, value in eval(sys.argv[4]).items():
    manipulator.slave_real_values(slave, [reference], [value])
assert execution.simulate_until(target_time=int(sys.argv[3]))
print("numbers", *observer.last_real_values(slave, eval(sys.argv[2])))
"""

ECOS = """
import sys
from ecospy import EcosLib, EcosSimulation, EcosSimulationStructure

EcosLib.set_log_level("off")
with EcosSimulationStructure() as structure:
    structure.add_model("driven", sys.argv[1])
    with EcosSimulation(structure=structure, step_size=1 / 128) as simulation:
        simulation.init()
        for name, value in eval(sys.argv[4]).items():
            simulation.set_real("driven::" + name, value)
        simulation.step(round(128 * float(sys.argv[3])))
        print("numbers", *(simulation.get_real("driven::" + name) for name in eval(sys.argv[2])))
        simulation.terminate()
"""


def printed_numbers(output: str) -> list[float]:
    # Ecos writes lines of its own, where and when its buffers are emptied.
    (line,) = (line for line in output.splitlines() if line.startswith("numbers "))
    return [float(number) for number in line.split()[1:]]


@pytest.fixture
def libcosim() -> Importer:
    if util.find_spec("libcosimpy") is None:
        pytest.skip("libcosimpy is not installed: it has no wheel for this platform")

    def simulate(fmu: Path, signals: Sequence[str], stop: float, inputs: Mapping[str, float]) -> list[float]:
        references = {variable.name: variable.value_reference for variable in models.by_file_name(fmu.stem).variables}
        reals = [references[name] for name in signals]
        set_reals = {references[name]: value for name, value in inputs.items()}
        return printed_numbers(
            run([sys.executable, "-c", LIBCOSIM, fmu, repr(reals), str(round(stop * 1e9)), repr(set_reals)])
        )

    return simulate


@pytest.fixture
def ecos() -> Importer:
    if util.find_spec("ecospy") is None:
        pytest.skip("ecospy is not installed: it has no wheel for this platform")
    if shutil.which("unzip") is None:
        pytest.skip("the program unzip, which Ecos unpacks FMUs by, is not installed")

    def simulate(fmu: Path, signals: Sequence[str], stop: float, inputs: Mapping[str, float]) -> list[float]:
        # The wheel of Intel's TBB, which Ecos needs, puts its libraries where no loader looks.
        libraries = os.pathsep.join([str(Path(sys.prefix) / "lib"), os.environ.get("LD_LIBRARY_PATH", "")])
        command = [sys.executable, "-c", ECOS, fmu, repr(list(signals)), repr(stop), repr(dict(inputs))]
        return printed_numbers(run(command, LD_LIBRARY_PATH=libraries))

    return simulate


@pytest.fixture
def importer(request: pytest.FixtureRequest) -> Importer:
    """The importer whose fixture a test is parametrized with."""
    found: Importer = request.getfixturevalue(request.param)
    return found


@pytest.mark.parametrize(
    ("importer", "fmu"),
    [("libcosim", "oscillator"), ("ecos", "oscillator"), ("ecos", "oscillator3")],
    indirect=["importer"],
)
def test_the_oscillator_follows_a_force(importer: Importer, fmu: str, request: pytest.FixtureRequest) -> None:
    path = request.getfixturevalue(fmu)
    position, energy = importer(path, ["s", "energy"], 2.0, {"force": 4.0})
    # A constant force shifts the rest position from 0 to 1, where it starts.
    assert position == pytest.approx(1.0, abs=1e-6)
    assert energy == pytest.approx(2.0, abs=1e-6)
    (free,) = importer(path, ["s"], 2.0, {})
    assert free == pytest.approx(np.cos(4.0), abs=1e-6)


@pytest.mark.parametrize(
    ("importer", "fmu"), [("libcosim", "ball"), ("ecos", "ball"), ("ecos", "ball3")], indirect=["importer"]
)
def test_the_ball_bounces(importer: Importer, fmu: str, request: pytest.FixtureRequest) -> None:
    height, impact_speed = importer(request.getfixturevalue(fmu), ["h", "impactSpeed"], 1.0, {})
    assert height == pytest.approx(height_after_one_bounce(1.0), abs=1e-6)
    assert impact_speed == pytest.approx(9.81 * FALL, abs=1e-6)


@pytest.mark.parametrize("fmu", ["ball", "ball3"])
def test_model_exchange_by_an_importer_with_eulers_method(
    fmu: str, tmp_path: Path, request: pytest.FixtureRequest
) -> None:
    """fmi-sim integrates with the explicit Euler method, which has a closed form for the free fall."""
    program = shutil.which("fmi-sim")
    if program is None:
        pytest.skip("fmi-sim is not installed: cargo install fmi-sim --locked, and put it on PATH")
    model = request.getfixturevalue(fmu)
    step, stop = 1e-3, 0.6
    output = tmp_path / "result.csv"
    times = ["--step", repr(step), "--output-interval", repr(step), "-f", repr(stop)]
    run([program, "--model", model, "-o", output, "model-exchange", *times])
    with output.open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert float(rows[-1]["time"]) == pytest.approx(stop)
    early = [row for row in rows if 0.1 < float(row["time"]) < 0.4]
    assert len(early) > 100
    for row in early:
        time = float(row["time"])
        assert float(row["v"]) == pytest.approx(-9.81 * time, abs=1e-9)
        assert float(row["h"]) == pytest.approx(1.0 - 0.5 * 9.81 * time * (time - step), abs=1e-9)
    assert int(rows[-1]["bounces"]) == 1
    assert float(rows[-1]["v"]) == pytest.approx(0.7 * 9.81 * FALL - 9.81 * (stop - FALL), abs=3 * 9.81 * step)
