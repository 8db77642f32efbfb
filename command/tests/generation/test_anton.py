"""The walking robot, from its CAD export to foot forces: statics, kinematics and Newton's law are the references."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from contact_data import checkout
from fmu_regression.fmi.description import read_description
from fmu_regression.results.result import FloatArray, SimulationResult
from fmu_regression.scene.loads import mean_over_time, pair_loads
from fmu_regression.scene.motion import body_motions, center_of_mass
from fmu_regression.scene.scene_file import Scene, load_scene
from fmu_regression.scene.signals import signals_for
from fmu_regression.simulate.simulation import simulate
from program import Cmb

ROOT = checkout()

pytestmark = pytest.mark.full

ANTON = ROOT / "Resources" / "cad" / "anton"
WEIGHT = 7.8 * 9.81
STOP = 4.0
FULL_SPEED = 1.6  # s; from here to the end the gait makes two cycles
PERIOD, DUTY, STRIDE = 1.2, 0.55, 0.08
COXA, FEMUR, TIBIA, REACH, HIP_HEIGHT, FOOT_RADIUS = 0.05, 0.09, 0.135, 0.155, 0.11, 0.012
SHANK_IN_MIDDLE = math.radians(-80.575)  # inclination of the CAD model's shanks
LEGS = {
    "frontLeft": (60.0, 0),
    "middleLeft": (90.0, 1),
    "rearLeft": (120.0, 0),
    "frontRight": (-60.0, 1),
    "middleRight": (-90.0, 0),
    "rearRight": (-120.0, 1),
}  # direction in degrees, group


@dataclass(frozen=True)
class Walk:
    """What the whole pipeline gave."""

    folder: Path
    scene: Scene
    result: SimulationResult
    output: str


@pytest.fixture(scope="module")
def walk(cmb: Cmb, engine: None, tmp_path_factory: pytest.TempPathFactory) -> Walk:  # noqa: ARG001
    """A few steps of ``cmb run``, and the same FMU's references of the servos beside what the report needs."""
    folder = tmp_path_factory.mktemp("walk") / "anton"
    done = cmb("run", ANTON, "--output", folder, "--stop", "0.6")
    assert done.returncode == 0, done.stderr
    scene = load_scene(folder / "model" / "scene.json")
    fmu = folder / "anton.fmu"
    wanted = [f"{leg}.servo[{k}].{name}" for leg in LEGS for k in (1, 2, 3) for name in ("phi_ref", "w_ref")]
    wanted += ["travel", "commandedTravel", "bodyHeight", "totalFootForce"]
    signals = [*signals_for(scene, read_description(fmu)), *wanted]
    result = simulate(fmu, signals=signals, stop=STOP, tolerance=1e-4, interval=0.005)
    return Walk(folder, scene, result, done.stdout)


def window(result: SimulationResult, start: float, stop: float = STOP) -> FloatArray:
    return (result.time >= start - 1e-9) & (result.time <= stop + 1e-9)


def forces(result: SimulationResult) -> FloatArray:
    """Normal forces of the feet in the order of LEGS, shape (6, n)."""
    return np.array([result[f"contacts.normalForce[{k}]"] for k in range(1, 7)])


def place_in_cycle(result: SimulationResult, group: int) -> FloatArray:
    """Where a group of legs is in its cycle, from 0 when it is set down to 1; the formula of a smooth start."""
    ramp = np.clip(result.time - 0.5, 0, 1)
    cycle = (ramp**3 * (1 - ramp / 2) + np.maximum(0, result.time - 1.5)) / PERIOD
    place: FloatArray = (cycle + (DUTY - 0.5) / 2 + group / 2) % 1
    return place


def test_the_pairs_are_the_feet_on_the_floor(walk: Walk) -> None:
    assert [pair.bodies for pair in walk.scene.pairs] == [(f"{leg}Foot", "floorPlane") for leg in LEGS]


def test_mass_and_weight_in_front(walk: Walk) -> None:
    moving = [motion for motion in body_motions(walk.scene, walk.result) if not motion.body.fixed]
    assert sum(motion.body.mass for motion in moving) == pytest.approx(7.8, rel=1e-9)
    center = sum(motion.body.mass * center_of_mass(motion)[0] for motion in moving) / 7.8
    assert 0.015 < center[0] < 0.04
    assert center[1] == pytest.approx(0, abs=2e-3)


def test_it_stands_on_all_feet_until_the_command(walk: Walk) -> None:
    before = window(walk.result, 0.4, 0.5)
    assert (forces(walk.result)[:, before] > 3).all()
    assert walk.result["totalFootForce"][before] == pytest.approx(np.full(before.sum(), WEIGHT), rel=1e-4)


def test_forces_of_whole_cycles_carry_the_weight(walk: Walk) -> None:
    cycles = window(walk.result, FULL_SPEED)
    mean = mean_over_time(walk.result.time[cycles], walk.result["totalFootForce"][cycles])
    assert mean == pytest.approx(WEIGHT, rel=5e-3)


def test_front_and_middle_legs_carry_more_than_rear_legs(walk: Walk) -> None:
    cycles = window(walk.result, FULL_SPEED)
    carried = forces(walk.result)[:, cycles]
    front, middle, rear = (
        np.mean([values[values > 0].mean() for values in carried[[side, 3 + side]]]) for side in (0, 1, 2)
    )
    assert middle > front > rear
    assert front > 1.2 * rear


def test_swinging_feet_carry_nothing(walk: Walk) -> None:
    for k, (_, group) in enumerate(LEGS.values(), start=1):
        place = place_in_cycle(walk.result, group)
        swing = (place > DUTY + 0.2 * (1 - DUTY)) & (place < 1 - 0.2 * (1 - DUTY)) & window(walk.result, FULL_SPEED)
        assert swing.sum() > 50
        assert (walk.result[f"contacts.normalForce[{k}]"][swing] == 0).all()
        assert walk.result[f"contacts.distance[{k}]"][swing].max() == pytest.approx(0.035, abs=2e-3)


def test_three_feet_share_the_weight_as_statics_says(walk: Walk) -> None:
    """While one group swings, sum and moments about the floor's axes give its three normal forces.

    What is left out, the inertia of torso and swinging legs, makes less than a fortieth of the weight.
    """
    result = walk.result
    moving = [motion for motion in body_motions(walk.scene, result) if not motion.body.fixed]
    center = sum(motion.body.mass * center_of_mass(motion) for motion in moving) / 7.8
    for standing in (0, 1):
        place = place_in_cycle(result, 1 - standing)
        single = (place > DUTY + 0.3 * (1 - DUTY)) & (place < 1 - 0.3 * (1 - DUTY)) & window(result, FULL_SPEED)
        assert single.sum() > 50
        feet = [k for k, (_, group) in enumerate(LEGS.values(), start=1) if group == standing]
        for row in np.flatnonzero(single)[::5]:
            x, y = (np.array([result[f"contacts.point[{k},1,{axis}]"][row] for k in feet]) for axis in (1, 2))
            expected = np.linalg.solve(np.array([np.ones(3), x, y]), WEIGHT * np.array([1, *center[row, :2]]))
            found = [result[f"contacts.normalForce[{k}]"][row] for k in feet]
            assert found == pytest.approx(expected, abs=0.025 * WEIGHT)


def test_servos_are_told_a_straight_path(walk: Walk) -> None:
    """Forward kinematics of the wanted angles: where a standing ball touches goes straight back at constant speed.

    The ball rolls with the shank, by its radius times the angle. The gait takes that angle from a foot that does not
    roll, so the share radius/tibia of the rolling way, at most 0.2 mm, is left.
    """
    result = walk.result
    running = window(result, FULL_SPEED)
    for leg, (direction, group) in LEGS.items():
        hip, lift, knee = (result[f"{leg}.servo[{k}].phi_ref"] for k in (1, 2, 3))
        radius = COXA + FEMUR * np.cos(lift) + TIBIA * np.cos(lift + knee)
        up = FEMUR * np.sin(lift) + TIBIA * np.sin(lift + knee)
        angle = hip + math.radians(direction)
        touching = radius + FOOT_RADIUS * (lift + knee - SHANK_IN_MIDDLE)
        forward, sideways = touching * np.cos(angle), touching * np.sin(angle)
        place = place_in_cycle(result, group)
        stands = place < DUTY
        middle = REACH * math.cos(math.radians(direction))
        aside = REACH * math.sin(math.radians(direction))
        np.testing.assert_allclose(sideways[stands], aside, atol=2e-4)
        np.testing.assert_allclose(forward[stands], middle + STRIDE * (0.5 - place[stands] / DUTY), atol=2e-4)
        assert np.ptp(up[stands]) < 1e-9
        assert up[stands][0] == pytest.approx(FOOT_RADIUS - HIP_HEIGHT, abs=2e-4)
        assert up.max() - up.min() == pytest.approx(0.035, abs=1e-4)
        for k, angles in enumerate((hip, lift, knee), start=1):
            rate = np.gradient(angles, result.time)
            assert result[f"{leg}.servo[{k}].w_ref"][running] == pytest.approx(rate[running], abs=0.03)


def test_joints_follow(walk: Walk) -> None:
    for leg in LEGS:
        for k, joint in enumerate(("Hip", "Lift", "Knee"), start=1):
            error = walk.result[f"{leg}{joint}.phi"] - walk.result[f"{leg}.servo[{k}].phi_ref"]
            assert np.abs(error).max() < math.radians(0.6)


def test_it_walks_straight_ahead_as_commanded(walk: Walk) -> None:
    result = walk.result
    cycles = window(result, FULL_SPEED)
    way, commanded = (np.ptp(result[name][cycles]) for name in ("travel", "commandedTravel"))
    assert commanded == pytest.approx(2 * STRIDE / DUTY, rel=1e-9)
    assert way == pytest.approx(commanded, rel=0.006)
    assert abs(result["torso.frame_a.r_0[2]"]).max() < 2e-3
    assert np.ptp(result["bodyHeight"]) < 1e-3
    upright = result["torso.frame_a.R.T[3,3]"]
    assert upright.min() > math.cos(math.radians(0.5))


def test_feet_neither_sink_nor_slip(walk: Walk) -> None:
    loads = pair_loads(walk.scene, walk.result)
    assert len(loads) == 6
    for load in loads:
        assert load.largest_depth is not None
        assert 0.5 * WEIGHT / 6 / 1e5 < load.largest_depth < 0.5e-3
        assert load.slid is not None
        # Three strides have begun: a foot slides less than a fiftieth of each.
        assert load.slid < 0.02 * 3 * STRIDE


def test_no_events(walk: Walk) -> None:
    assert walk.result.counters is not None
    assert walk.result.counters.state_events == 0
    assert walk.result.counters.time_events == 0


def test_co_simulation_walks_the_same_way(walk: Walk) -> None:
    result = simulate(
        walk.folder / "anton.fmu", signals=["travel"], stop=STOP, tolerance=1e-4, interval=0.01, mode="cs"
    )
    assert result["travel"][-1] == pytest.approx(walk.result["travel"][-1], rel=1e-3)


@pytest.mark.parametrize(
    ("parameter", "value"), [("gait.stride", -0.06), ("gait.dutyFactor", 0.7), ("gait.period", 2.0)]
)
def test_other_gaits_walk_too(walk: Walk, parameter: str, value: float) -> None:
    signals = ["travel", "commandedTravel"]
    fmu = walk.folder / "anton.fmu"
    result = simulate(fmu, signals=signals, stop=3, interval=0.01, mode="cs", parameters={parameter: value})
    assert abs(result["commandedTravel"][-1]) > 0.07
    assert result["travel"][-1] == pytest.approx(result["commandedTravel"][-1], rel=0.01)


def test_the_report_shows_the_feet(walk: Walk) -> None:
    page = (walk.folder / "report.html").read_text(encoding="utf-8")
    assert "Foot forces, left side" not in page  # its window begins after the stop
    assert "Sum of the foot forces" in page
    assert "Forward travel" in page
    assert "Slid, mm" in page
    assert "Distance commanded" in walk.output
