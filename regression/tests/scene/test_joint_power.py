"""Power through joints against a closed form, and what the report says of it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from fmu_regression.report.simulation_report import report_html
from fmu_regression.results.result import SimulationResult
from fmu_regression.scene.joint_power import joint_power
from fmu_regression.scene.scene_file import Scene, load_scene
from synthetic import body, pose_signals, scene, write_scene

JOINTS = [
    {"name": "hinge", "type": "revolute", "variable": "hinge.phi", "rate": "hinge.w", "unit": "rad"},
    {"name": "slide", "type": "prismatic", "variable": "slide.s", "rate": "slide.v", "unit": "m"},
]


def driven(tmp_path: Path) -> tuple[Scene, SimulationResult]:
    """A hinge that is pushed and braked over one period, and a slide that is braked evenly."""
    time = np.linspace(0, 2 * np.pi, 4001)
    still = np.zeros((time.size, 3))
    signals = pose_signals("b", still, np.broadcast_to(np.eye(3), (time.size, 3, 3)))
    signals |= {"hinge.tau": 3 * np.sin(time), "hinge.w": np.full_like(time, 2.0), "hinge.phi": 2 * time}
    signals |= {"slide.f": np.full_like(time, -5.0), "slide.v": np.full_like(time, 0.1), "slide.s": 0.1 * time}
    content = scene("Driven", [body("b", mass=1.0)]) | {"joints": JOINTS}
    loaded = load_scene(write_scene(content, tmp_path / "scene.json"))
    return loaded, SimulationResult(time=time, signals=signals)


def test_power_in_and_out_is_that_of_all_axes(tmp_path: Path) -> None:
    loaded, result = driven(tmp_path)
    power = joint_power(loaded, result)
    assert power is not None
    # The hinge takes in 12 J in half a turn and gives them back; the slide gives out half a watt all the time.
    assert np.trapezoid(power.supplied, power.time) == pytest.approx(12, rel=1e-6)
    assert np.trapezoid(power.taken, power.time) == pytest.approx(12 + np.pi, rel=1e-6)
    assert power.work[-1] == pytest.approx(-np.pi, rel=1e-6)
    assert power.work[2000] == pytest.approx(12 - np.pi / 2, rel=1e-6)
    assert "Power through the joints" in report_html(result, loaded)


def test_joints_without_torque_have_no_power(tmp_path: Path) -> None:
    loaded, result = driven(tmp_path)
    signals = {name: values for name, values in result.signals.items() if not name.endswith((".tau", ".f"))}
    bare = SimulationResult(time=result.time, signals=signals)
    assert joint_power(loaded, bare) is None
    assert "Power through the joints" not in report_html(bare, loaded)
