"""libcosim (with Modelon's FMI Library inside), an importer that shares nothing with FMPy."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("libcosimpy", reason="libcosimpy has no wheel for this platform")

# In a process of its own: the library logs to standard output and keeps threads.
_SCRIPT = """
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
reals, integers, end = eval(sys.argv[2]), eval(sys.argv[3]), int(sys.argv[4])
for reference, value in eval(sys.argv[5]).items():
    manipulator.slave_real_values(slave, [reference], [value])
assert execution.simulate_until(target_time=end)
print(*observer.last_real_values(slave, reals), *(observer.last_integer_values(slave, integers) if integers else []))
"""


def simulate(fmu: Path, reals: list[int], integers: list[int], stop: float, inputs: dict[int, float]) -> list[float]:
    arguments = [str(fmu), repr(reals), repr(integers), str(round(stop * 1e9)), repr(inputs)]
    command = [sys.executable, "-c", _SCRIPT, *arguments]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=60)
    assert done.returncode == 0, done.stdout + done.stderr
    return [float(number) for number in done.stdout.splitlines()[-1].split()]


def test_the_oscillator_follows_a_force(oscillator: Path) -> None:
    position, energy = simulate(oscillator, [0, 8], [], 2.0, {7: 4.0})
    # a constant force shifts the rest position from 0 to 1, where it starts; libcosim applies it from time 0 on
    assert position == pytest.approx(1.0, abs=1e-6)
    assert energy == pytest.approx(2.0, abs=1e-6)
    (free,) = simulate(oscillator, [0], [], 2.0, {})
    assert free == pytest.approx(np.cos(4.0), abs=1e-6)


def test_the_ball_bounces(ball: Path) -> None:
    height, bounces = simulate(ball, [0], [0], 1.0, {})
    fall = np.sqrt(2.0 / 9.81)
    flight = 1.0 - fall
    assert height == pytest.approx(0.7 * 9.81 * fall * flight - 0.5 * 9.81 * flight**2, abs=1e-6)
    assert bounces == 1
