"""Loads of contacts against closed forms: a ball that slides until it rolls, and pushes of known impulse."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from fmu_regression.report.simulation_report import report_html
from fmu_regression.results.result import SimulationResult
from fmu_regression.scene.loads import mean_over_time, pair_loads
from fmu_regression.scene.scene_file import Scene, load_scene
from synthetic import G, body, bouncing_ball, pose_signals, scene, write_scene

RADIUS, MASS, MU, SPEED = 0.1, 2.0, 0.3, 2.0
ROLLS = 2 * SPEED / (7 * MU * G)
END = 2 * ROLLS


def sliding_ball(tmp_path: Path) -> tuple[Scene, SimulationResult]:
    """Along x on the floor: friction brakes the centre and spins the ball up until it rolls."""
    time = np.linspace(0, END, 4001)
    braked = np.minimum(time, ROLLS)
    velocity, spin = SPEED - MU * G * braked, 2.5 * MU * G * braked / RADIUS
    x = SPEED * braked - MU * G * braked**2 / 2 + velocity * (time - braked)
    angle = 1.25 * MU * G * braked**2 / RADIUS + spin * (time - braked)
    still, one = np.zeros_like(time), np.ones_like(time)
    rotation = np.array(
        [[np.cos(angle), still, -np.sin(angle)], [still, one, still], [np.sin(angle), still, np.cos(angle)]]
    )
    position = np.stack([x, still, RADIUS * one], axis=1)
    friction = np.where(time < ROLLS, -MU * MASS * G, 0.0)
    signals = pose_signals("ball", position, rotation.transpose(2, 0, 1))
    signals |= {"ball.v_0[1]": velocity, "ball.v_0[2]": still.copy(), "ball.v_0[3]": still.copy()}
    signals |= {"ball.w_a[1]": still.copy(), "ball.w_a[2]": spin, "ball.w_a[3]": still.copy()}
    signals |= {
        "contacts.distance[1]": -1e-4 * one,
        "contacts.normalForce[1]": MASS * G * one,
        "contacts.approachSpeed[1]": still.copy(),
    }
    for axis, (point, force) in enumerate(((x, friction), (still, still), (still, MASS * G * one)), start=1):
        signals |= {f"contacts.point[1,1,{axis}]": point.copy(), f"contacts.pointForce[1,1,{axis}]": force.copy()}
    content = scene(
        "Sliding ball",
        [body("ball", mass=MASS), body("floor", fixed=True)],
        contacts={"manager": "contacts", "pairs": [{"index": 1, "bodies": ["ball", "floor"]}]},
    )
    result = SimulationResult(time=time, signals=signals)
    return load_scene(write_scene(content, tmp_path / "scene.json")), result


def test_a_ball_slides_until_it_rolls(tmp_path: Path) -> None:
    made, result = sliding_ball(tmp_path)
    (load,) = pair_loads(made, result)
    assert load.slid == pytest.approx(SPEED**2 / (7 * MU * G), rel=1e-6)
    assert load.touching == pytest.approx(END)
    assert load.mean_force == pytest.approx(MASS * G)
    assert load.peak_force == pytest.approx(MASS * G)
    assert load.largest_depth == pytest.approx(1e-4)


def test_motion_along_the_normal_is_no_sliding(tmp_path: Path) -> None:
    made, result = sliding_ball(tmp_path)
    speed = 0.7
    changed = dict(result.signals)
    changed["ball.v_0[3]"] = np.full(result.time.size, -speed)
    changed["contacts.approachSpeed[1]"] = np.full(result.time.size, speed)
    (load,) = pair_loads(made, replace(result, signals=changed))
    assert load.slid == pytest.approx(SPEED**2 / (7 * MU * G), rel=1e-6)


def test_without_contact_points_the_sliding_is_unknown(tmp_path: Path) -> None:
    made, result = sliding_ball(tmp_path)
    known = {name: values for name, values in result.signals.items() if ".point" not in name}
    (load,) = pair_loads(made, replace(result, signals=known))
    assert load.slid is None


def test_pushes_of_known_impulse(tmp_path: Path) -> None:
    e = 0.5
    content, result, impacts = bouncing_ball(e, drops=3)
    made = load_scene(write_scene(content, tmp_path / "scene.json"))
    (load,) = pair_loads(made, result)
    impulse = sum((1 + e) * math.sqrt(2 * G) * e**k for k in range(len(impacts)))
    assert load.mean_force * load.touching == pytest.approx(impulse, rel=1e-3)
    assert load.touching == pytest.approx(3 * 2e-3, rel=0.05)  # a force counts from its first sample


def test_mean_over_uneven_samples() -> None:
    time = np.array([0.0, 0.1, 0.1, 1.0])
    assert mean_over_time(time, np.array([0.0, 0.0, 1.0, 1.0])) == pytest.approx(0.9)


def test_the_report_lists_the_loads(tmp_path: Path) -> None:
    made, result = sliding_ball(tmp_path)
    page = report_html(result, made)
    assert "Slid, mm" in page
    assert f"{1000 * SPEED**2 / (7 * MU * G):.4g}" in page
