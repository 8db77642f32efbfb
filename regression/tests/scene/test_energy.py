"""Energies against closed forms."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from fmu_regression.results.result import SimulationResult
from fmu_regression.scene.energy import energy_balance
from fmu_regression.scene.motion import angular_velocity_of, derivative
from fmu_regression.scene.scene_file import Scene, load_scene
from scipy.spatial.transform import Rotation
from synthetic import G, body, bouncing_ball, hammer, pose_signals, scene, write_scene

INERTIA = [[0.02, 0.002, -0.001], [0.002, 0.03, 0.003], [-0.001, 0.003, 0.04]]
OFFSET = [0.1, -0.05, 0.2]
MASS = 1.5


def spinning(tmp_path: Path, rows: int = 2001) -> tuple[Scene, SimulationResult, np.ndarray, np.ndarray]:
    """A body turning evenly about a fixed axis while its frame flies a parabola; velocities and spins as well."""
    time = np.linspace(0, 1, rows)
    axis, rate = np.array([2.0, -1.0, 2.0]) / 3, 5.0
    turn = Rotation.from_rotvec(np.outer(rate * time, axis)).as_matrix()  # body to world
    position = np.stack([time, 2 * time - G * time**2 / 2, np.sin(time)], axis=1)
    velocity = np.stack([np.ones_like(time), 2 - G * time, np.cos(time)], axis=1)
    spin = np.broadcast_to(rate * axis, (rows, 3))  # the axis is the same in body and world
    signals = pose_signals("b", position, np.swapaxes(turn, 1, 2))
    content = scene("Spin", [body("b", mass=MASS, centerOfMass=OFFSET, inertia=INERTIA)])
    loaded = load_scene(write_scene(content, tmp_path / "scene.json"))
    return loaded, SimulationResult(time=time, signals=signals), velocity, spin


def closed_form(result: SimulationResult, velocity: np.ndarray, spin: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    kinetic, potential = [], []
    for k in range(result.time.size):
        turn = np.array([[result[f"b.frame_a.R.T[{i},{j}]"][k] for i in (1, 2, 3)] for j in (1, 2, 3)])
        speed = velocity[k] + np.cross(turn @ spin[k], turn @ OFFSET)
        kinetic.append(MASS * speed @ speed / 2 + spin[k] @ np.array(INERTIA) @ spin[k] / 2)
        potential.append(MASS * G * (result["b.frame_a.r_0[3]"][k] + (turn @ OFFSET)[2]))
    return np.array(kinetic), np.array(potential)


def test_recorded_speeds_give_the_exact_energy(tmp_path: Path) -> None:
    loaded, poses, velocity, spin = spinning(tmp_path)
    signals = dict(poses.signals)
    for i in range(3):
        signals[f"b.v_0[{i + 1}]"] = velocity[:, i].copy()
        signals[f"b.w_a[{i + 1}]"] = spin[:, i].copy()
    result = SimulationResult(time=poses.time, signals=signals)
    kinetic, potential = closed_form(result, velocity, spin)
    energy = energy_balance(loaded, result)
    assert energy.kinetic == pytest.approx(kinetic, rel=1e-12)
    assert energy.potential == pytest.approx(potential, rel=1e-12)
    assert energy.elastic is None
    assert energy.notes == ()


def test_missing_speeds_are_differentiated_and_said(tmp_path: Path) -> None:
    loaded, result, velocity, spin = spinning(tmp_path)
    kinetic, _ = closed_form(result, velocity, spin)
    energy = energy_balance(loaded, result)
    assert np.abs(energy.kinetic - kinetic).max() < 1e-4 * kinetic.max()
    assert [note.split(": ")[1] for note in energy.notes] == [
        "velocity differentiated from the position",
        "angular velocity differentiated from the rotation",
    ]


def test_missing_pose_is_said(tmp_path: Path) -> None:
    loaded, result, _, _ = spinning(tmp_path)
    signals = {name: values for name, values in result.signals.items() if "r_0" not in name}
    notes = energy_balance(loaded, SimulationResult(time=result.time, signals=signals)).notes
    assert any("position not recorded" in note for note in notes)


def test_derivative_does_not_reach_across_events() -> None:
    time = np.array([0.0, 0.5, 1.0, 1.0, 1.5, 2.0])
    values = np.array([0.0, 0.5, 1.0, 5.0, 4.0, 3.0])
    assert derivative(time, values) == pytest.approx([1, 1, 1, -2, -2, -2])


def test_angular_velocity_in_body_axes() -> None:
    time = np.linspace(0, 0.1, 201)
    first = Rotation.from_euler("x", 0.7)
    turn = first * Rotation.from_rotvec(np.outer(time, [1.0, 2.0, 3.0]))
    spin = angular_velocity_of(time, np.swapaxes(turn.as_matrix(), 1, 2))
    assert spin == pytest.approx(np.broadcast_to([1.0, 2.0, 3.0], spin.shape), abs=1e-4)


@pytest.mark.full
def test_pendulum_keeps_its_energy_and_hammer_never_gains(tmp_path: Path) -> None:
    content, result = hammer()
    energy = energy_balance(load_scene(write_scene(content, tmp_path / "scene.json")), result)
    assert energy.elastic is not None
    flight = result.time < result.time[np.argmax(result["contacts.touches[1]"] > 0)]
    assert np.ptp(energy.total[flight]) < 1e-7
    assert energy.largest_rise < 1e-6
    assert energy.change < -1


def test_ball_loses_what_restitution_takes(tmp_path: Path) -> None:
    content, result, impacts = bouncing_ball(0.5, drops=2)
    energy = energy_balance(load_scene(write_scene(content, tmp_path / "scene.json")), result)
    before = energy.total[0] - G * 0.1
    after = energy.total[np.searchsorted(result.time, (impacts[0] + impacts[1]) / 2)] - G * 0.1
    assert after / before == pytest.approx(0.25, rel=1e-9)
    assert math.isclose(before, G, rel_tol=1e-12)
