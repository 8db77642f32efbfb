"""The generated mechatronic model as an FMU: inputs, outputs, and drives on joints of a mechanism."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from assembly_text import joint, part, write_assembly
from cad2modelica import generate
from fmpy import read_model_description, simulate_fmu
from mechanics_simulation import ROOT
from modelica2fmu.build import BuildOptions, build_fmu

ACTUATORS = """
[[actuator]]
joint = "shoulder"
component = "Position"
parameters = { f_crit = 2.0 }
inputs = { phi_ref = 0.7 }
[[actuator]]
joint = "elbow"
component = "CascadeServo"
parameters = { ratio = 50.0, J = 5e-5, J_design = 7e-5 }
[[actuator]]
joint = "elbow"
component = "Sensor"
[[actuator]]
joint = "spindle"
component = "Motor"
parameters = { ratio = 5.0, useInductance = true }
inputs = { u = 6.0 }
[[actuator]]
joint = "rail"
component = "CascadeServo"
"""
OUTPUTS = ["shoulderAngle", "shoulderTorque", "elbowAngle", "elbowTorque", "spindleAngle", "spindleCurrent"]


@pytest.fixture(scope="module")
def fmu(tmp_path_factory: pytest.TempPathFactory, fmu_cache: Path) -> Path:
    """An arm of two links, a nut on a vertical spindle, and a sled; each joint driven in another way."""
    folder = tmp_path_factory.mktemp("mechatronics")
    inertia = (0.02, 0.03, 0.04)
    parts = [
        part("arm", mass=2.0, center=(0.3, 0, 0), inertia=inertia),
        part("hand", position=(0.6, 0, 0), mass=1.0, center=(0.1, 0, 0), inertia=inertia),
        part("nut", position=(0, 1, 0), mass=0.5, inertia=(1e-3, 1e-3, 1e-3)),
        part("sled", position=(0, 2, 0), mass=3.0),
    ]
    joints = [
        joint("shoulder", "revolute", "ground", "arm", axis=(0, -1, 0), start='position="0.2"'),
        joint("elbow", "revolute", "arm", "hand", origin=(0.6, 0, 0), axis=(0, -1, 0)),
        joint("spindle", "screw", "ground", "nut", origin=(0, 1, 0), axis=(0, 0, 1), pitch=0.02),
        joint("rail", "prismatic", "ground", "sled", origin=(0, 2, 0), axis=(1, 0, 0)),
    ]
    file = write_assembly(folder / "robot.xml", parts, joints, name="Robot")
    (folder / "actuators.toml").write_text(ACTUATORS)
    package = generate(file, folder / "out")
    sources, options = [package.root, ROOT / "ContactMultiBody"], BuildOptions(cache=fmu_cache)
    return build_fmu(package.mechatronics, sources, folder / "robot.fmu", options).fmu


@pytest.fixture(scope="module")
def result(fmu: Path) -> Any:
    return simulate_fmu(str(fmu), stop_time=1.0, relative_tolerance=1e-9, output_interval=0.01, output=OUTPUTS)


def test_inputs_and_outputs_of_the_fmu(fmu: Path) -> None:
    variables = read_model_description(str(fmu)).modelVariables
    inputs = {variable.name: variable.start for variable in variables if variable.causality == "input"}
    assert {name: float(start) for name, start in inputs.items()} == {
        "shoulderAngleReference": 0.7,
        "elbowAngleReference": 0.0,
        "spindleVoltage": 6.0,
        "railPositionReference": 0.0,
    }
    outputs = {variable.name for variable in variables if variable.causality == "output"}
    assert outputs >= {*OUTPUTS, "elbowCurrent", "railPosition", "railForce"}


def test_forced_motion_is_the_filter_and_its_torque_carries_the_arm(result: Any) -> None:
    """From the joint's own start to the input's; at the end the torque is that of the weights."""
    time, w = result["time"], 2 * np.pi * 2
    assert result["shoulderAngle"] == pytest.approx(0.7 - 0.5 * (1 + w * time) * np.exp(-w * time), abs=1e-7)
    lever = np.cos(0.7 - 0.2)  # the arm is level at an angle of 0.2
    assert result["shoulderTorque"][-1] == pytest.approx(9.81 * lever * (2 * 0.3 + 0.6 + 0.1), rel=2e-3)


def test_cascade_holds_the_hand_while_the_arm_moves(result: Any) -> None:
    assert np.abs(result["elbowAngle"]).max() < 0.01
    assert result["elbowAngle"][-1] == pytest.approx(0, abs=1e-5)
    assert result["elbowTorque"][-1] == pytest.approx(9.81 * 0.1 * np.cos(0.5), rel=2e-3)


def test_motor_lifts_the_nut(result: Any) -> None:
    """Steady: k i ratio = m g lead, and u = R i + k ratio w."""
    current = 0.5 * 9.81 * 0.02 / (2 * np.pi) / (0.05 * 5)
    time = result["time"]
    speed = (result["spindleAngle"][-1] - result["spindleAngle"][-11]) / (time[-1] - time[-11])
    assert result["spindleCurrent"][-1] == pytest.approx(current, rel=1e-4)
    assert speed == pytest.approx((6 - current) / (0.05 * 5), rel=1e-4)
