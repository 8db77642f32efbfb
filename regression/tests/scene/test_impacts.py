"""The table of impacts against a ball whose bounces are known."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from fmu_regression.report.summarise import summarise
from fmu_regression.results.result import SimulationResult
from fmu_regression.scene.impacts import find_impacts
from fmu_regression.scene.scene_file import Scene, load_scene
from synthetic import G, bouncing_ball, hammer, write_scene

SPEED = math.sqrt(2 * G)
PUSH = 2e-3


def ball(tmp_path: Path, e: float, events: bool = True) -> tuple[Scene, SimulationResult, list[float]]:
    content, result, times = bouncing_ball(e, drops=4, events=events)
    return load_scene(write_scene(content, tmp_path / "scene.json")), result, times


@pytest.mark.parametrize("e", [0.3, 0.7, 0.95])
def test_events_give_exact_speeds_and_times(tmp_path: Path, e: float) -> None:
    scene, result, times = ball(tmp_path, e)
    impacts = find_impacts(scene, result)
    assert [impact.start for impact in impacts] == pytest.approx(times)
    for k, impact in enumerate(impacts[:-1]):
        assert impact.located
        assert impact.speed_before == pytest.approx(SPEED * e**k, rel=1e-9)
        assert impact.restitution == pytest.approx(e, rel=1e-9)
        assert impact.end is not None
        assert impact.end - impact.start == pytest.approx(PUSH, rel=1e-9)
        assert impact.impulse == pytest.approx((1 + e) * SPEED * e**k, rel=1e-3)
        assert impact.peak_force == pytest.approx((1 + e) * SPEED * e**k * math.pi / (2 * PUSH), rel=1e-9)
        assert impact.peak_time == pytest.approx(impact.start + PUSH / 2)


def test_contact_that_lasts_to_the_end_has_no_speed_after(tmp_path: Path) -> None:
    scene, result, _ = ball(tmp_path, 0.5)
    last = find_impacts(scene, result)[-1]
    assert last.end is None
    assert last.speed_after is None
    assert last.restitution is None
    assert last.peak_force is not None


def test_contact_that_begins_at_rest_is_no_impact(tmp_path: Path) -> None:
    scene, result, times = ball(tmp_path, 0.5)
    slow = {name: values * (1e-5 if "approachSpeed" in name else 1) for name, values in result.signals.items()}
    impacts = find_impacts(scene, SimulationResult(time=result.time, signals=slow))
    assert len(impacts) == len(times)
    assert impacts[0].speed_before == pytest.approx(SPEED * 1e-5)
    assert all(impact.restitution is None for impact in impacts)


def test_without_event_rows_speeds_are_extrapolated(tmp_path: Path) -> None:
    scene, result, times = ball(tmp_path, 0.7, events=False)
    for k, impact in enumerate(find_impacts(scene, result)[:-1]):
        assert not impact.located
        assert impact.start == pytest.approx(times[k], abs=3e-3)
        assert impact.speed_before == pytest.approx(SPEED * 0.7**k, rel=0.02)
        assert impact.restitution == pytest.approx(0.7, rel=0.02)


@pytest.mark.parametrize("missing", ["touches", "touches distance"])
def test_contact_is_found_from_what_there_is(tmp_path: Path, missing: str) -> None:
    scene, result, times = ball(tmp_path, 0.7)
    left = {name: v for name, v in result.signals.items() if not any(f".{word}[" in name for word in missing.split())}
    impacts = find_impacts(scene, SimulationResult(time=result.time, signals=left))
    assert [impact.start for impact in impacts] == pytest.approx(times, abs=1e-4)


def test_nothing_recorded_gives_no_impacts(tmp_path: Path) -> None:
    scene, result, _ = ball(tmp_path, 0.7)
    assert find_impacts(scene, SimulationResult(time=result.time, signals={})) == ()


def test_hammer_delivers_less_than_asked_because_its_weight_acts(tmp_path: Path) -> None:
    content, result = hammer()
    impacts = find_impacts(load_scene(write_scene(content, tmp_path / "scene.json")), result)
    assert len(impacts) >= 3
    # The damping factor 1.433 delivers e = 0.5 in a free impact (design figure); gravity takes a little more.
    assert impacts[0].restitution == pytest.approx(0.5, abs=0.01)
    assert all(np.diff([impact.start for impact in impacts]) > 0)


def test_summary_tells_impacts_and_energy(tmp_path: Path) -> None:
    scene, result, times = ball(tmp_path, 0.7)
    text = summarise(result, scene)
    assert f"4 contacts, the first impact at {times[0]:.6g} s" in text
    assert "restitution 0.700 (asked for 0.7)" in text
    assert "energy 10.791 J at the start" in text
    assert "no contact" in summarise(SimulationResult(time=result.time, signals={}), scene)


def test_feet_that_stood_deliver_no_restitution(tmp_path: Path) -> None:
    """Set down at 0.1 m/s, at rest for most of a second, lifted at 0.05 m/s: the lifting is no rebound."""
    content, _, _ = bouncing_ball(0.5)
    time = np.linspace(0, 1, 1001)
    speed = np.select([time < 0.12, time < 0.88], [np.minimum(0.1, 5 * (0.12 - time)), 0.0], -0.05)
    touching = (time >= 0.1) & (time < 0.9)
    signals = {
        "contacts.distance[1]": np.where(touching, -1e-4, 1e-3),
        "contacts.normalForce[1]": np.where(touching, 10.0, 0.0),
        "contacts.approachSpeed[1]": speed,
    }
    scene = load_scene(write_scene(content, tmp_path / "scene.json"))
    (stance,) = find_impacts(scene, SimulationResult(time=time, signals=signals))
    assert stance.meets
    assert stance.speed_before == pytest.approx(0.1)
    assert stance.speed_after == pytest.approx(0.05)
    assert stance.rests
    assert stance.restitution is None
