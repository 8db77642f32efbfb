"""The actuators of the Modelica library through the FMU builder, against closed forms and independent integrations."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fmpy import simulate_fmu
from mechanics_simulation import ROOT
from modelica2fmu.build import BuildOptions, build_fmu
from scipy.integrate import solve_ivp
from scipy.linalg import expm

PI = np.pi

# One rotating and one sliding bench of drives that know nothing of each other, so that each is built once.
ROTATING = """model RotatingBench "Drives on flywheels"
  model Wheel = Modelica.Mechanics.Rotational.Components.Inertia(phi(fixed=true), w(fixed=true));
  ContactMultiBody.Actuators.Rotational.Position position(f_crit=2, phi_ref=1);
  Wheel positioned(J=0.3);
  ContactMultiBody.Actuators.Rotational.Torque torque(tau_max=2, tau_ref=-5);
  Wheel turned(J=0.4);
  ContactMultiBody.Actuators.Rotational.Servo servo(c=40, d=2, phi_ref=0.5);
  Wheel held(J=0.1);
  ContactMultiBody.Actuators.Rotational.Servo weak(c=40, d=2, tau_max=3, phi_ref=0.5);
  Wheel weakly(J=0.1);
  ContactMultiBody.Actuators.Rotational.Servo tracking(c=40, d=2, useSpeedReference=true, phi_ref=3*time, w_ref=3);
  Wheel tracked(J=0.1, w(start=3));
  ContactMultiBody.Actuators.Rotational.Motor free(R=0.5, k=0.05, J=2e-5, ratio=20, u_max=24, u=30);
  Wheel spun(J=0.2);
  ContactMultiBody.Actuators.Rotational.Motor limited(R=0.5, k=0.05, J=2e-5, ratio=20, i_max=8, u=24);
  Wheel started(J=0.2);
  ContactMultiBody.Actuators.Rotational.Motor rubbing(R=0.5, k=0.05, J=2e-5, ratio=20, d=1e-3, tau_dry=0.02, u=24);
  Wheel rubbed(J=0.002);
  ContactMultiBody.Actuators.Rotational.Motor stalled(
    R=0.5, k=0.05, J=2e-5, ratio=20, useInductance=true, L=0.05, u=3);
  Modelica.Mechanics.Rotational.Components.Fixed wall(phi0=0.4);
  ContactMultiBody.Actuators.Rotational.Motor cut(
    R=0.5, k=0.05, J=2e-5, ratio=20, useInductance=true, L=0.05, i_max=4, u=-3);
  Modelica.Mechanics.Rotational.Components.Fixed cutWall;
  ContactMultiBody.Actuators.Rotational.CascadeServo cascade(ratio=20, J=2e-5, J_design=5.2e-4, phi_ref=1e-3);
  Wheel steered(J=0.2);
  ContactMultiBody.Actuators.Rotational.SpringDamper spring(c=8, d=0.4, phi_rest=0.25);
  Wheel sprung(J=0.1);
  ContactMultiBody.Actuators.Rotational.Friction viscous(d=0.5);
  Wheel slowed(J=0.25, w(start=4));
  ContactMultiBody.Actuators.Rotational.Friction dry(tau_dry=0.6, w_small=1e-3);
  Wheel braked(J=0.3, w(start=4));
  Wheel housing(J=2, w(start=1.5));
  ContactMultiBody.Actuators.Rotational.Torque inner_drive(useSupport=true, tau_ref=0.7);
  ContactMultiBody.Actuators.Rotational.Sensor sensor(useSupport=true);
  Wheel rotor(J=0.5, phi(start=0.2));
equation
  connect(position.flange, positioned.flange_a);
  connect(torque.flange, turned.flange_a);
  connect(servo.flange, held.flange_a);
  connect(weak.flange, weakly.flange_a);
  connect(tracking.flange, tracked.flange_a);
  connect(free.flange, spun.flange_a);
  connect(limited.flange, started.flange_a);
  connect(rubbing.flange, rubbed.flange_a);
  connect(stalled.flange, wall.flange);
  connect(cut.flange, cutWall.flange);
  connect(cascade.flange, steered.flange_a);
  connect(spring.flange, sprung.flange_a);
  connect(viscous.flange, slowed.flange_a);
  connect(dry.flange, braked.flange_a);
  connect(inner_drive.flange, sensor.flange_a);
  connect(sensor.flange_b, rotor.flange_a);
  connect(inner_drive.support, housing.flange_a);
  connect(sensor.support, housing.flange_a);
end RotatingBench;
"""

SLIDING = """model SlidingBench "Drives on slides"
  model Slide = Modelica.Mechanics.Translational.Components.Mass(s(fixed=true), v(fixed=true));
  ContactMultiBody.Actuators.Translational.Position position(f_crit=2, D=0.5, s_ref=0.1);
  Slide positioned(m=3);
  ContactMultiBody.Actuators.Translational.Force force(f_max=2, f_ref=5);
  Slide pushed(m=4);
  ContactMultiBody.Actuators.Translational.Servo servo(c=400, d=20, s_ref=0.05);
  Slide held(m=1);
  ContactMultiBody.Actuators.Translational.SpindleMotor stalled(R=0.5, k=0.05, pitch=0.01, i_max=4, u=24);
  Modelica.Mechanics.Translational.Components.Fixed wall(s0=0.3);
  ContactMultiBody.Actuators.Translational.SpindleMotor free(R=0.5, k=0.05, J=2e-5, pitch=0.01, u=24);
  Slide spun(m=2);
  ContactMultiBody.Actuators.Translational.CascadeServo cascade(pitch=0.01, J=2e-5, J_design=3e-5, s_ref=1e-4);
  Slide steered(m=2);
  ContactMultiBody.Actuators.Translational.EndStop elastic(s_min=-1, s_max=0.2, c=1000);
  Slide bouncing(m=0.5, v(start=2));
  ContactMultiBody.Actuators.Translational.EndStop lossy(s_min=-0.2, c=1000, damping=0.3);
  Slide damped(m=0.5, v(start=-2));
  ContactMultiBody.Actuators.Translational.Friction dry(f_dry=0.5, d=0.2, v_small=1e-3);
  Slide braked(m=0.8, v(start=1));
  ContactMultiBody.Actuators.Translational.SpringDamper spring(c=8, d=0.4, s_rest=0.25);
  Slide sprung(m=0.1);
  ContactMultiBody.Actuators.Translational.Force driving(f_ref=3);
  ContactMultiBody.Actuators.Translational.Sensor sensor;
  Slide measured(m=2);
equation
  connect(position.flange, positioned.flange_a);
  connect(force.flange, pushed.flange_a);
  connect(servo.flange, held.flange_a);
  connect(stalled.flange, wall.flange);
  connect(free.flange, spun.flange_a);
  connect(cascade.flange, steered.flange_a);
  connect(elastic.flange, bouncing.flange_a);
  connect(lossy.flange, damped.flange_a);
  connect(dry.flange, braked.flange_a);
  connect(spring.flange, sprung.flange_a);
  connect(driving.flange, sensor.flange_a);
  connect(sensor.flange_b, measured.flange_a);
end SlidingBench;
"""


def run(text: str, folder: Path, cache: Path, names: tuple[str, ...]) -> Any:
    name = text.split()[1]
    file = folder / f"{name}.mo"
    file.write_text(text)
    sources, options = [file, ROOT / "ContactMultiBody"], BuildOptions(cache=cache)
    report = build_fmu(name, sources, folder / f"{name}.fmu", options)
    return simulate_fmu(
        str(report.fmu), stop_time=1.0, relative_tolerance=1e-10, output_interval=0.005, output=list(names)
    )


@pytest.fixture(scope="module")
def rotating(tmp_path_factory: pytest.TempPathFactory, fmu_cache: Path) -> Any:
    wheels = ("positioned", "turned", "held", "weakly", "tracked", "spun", "started", "rubbed", "steered", "sprung")
    names = [
        f"{wheel}.{value}" for wheel in (*wheels, "slowed", "braked", "rotor", "housing") for value in ("phi", "w")
    ]
    drives = (
        "position",
        "torque",
        "servo",
        "weak",
        "free",
        "limited",
        "rubbing",
        "stalled",
        "cut",
        "inner_drive",
        "sensor",
    )
    names += [f"{drive}.{value}" for drive in drives for value in ("phi", "w", "tau")]
    names += [f"{motor}.i" for motor in ("free", "limited", "rubbing", "stalled", "cut")]
    return run(ROTATING, tmp_path_factory.mktemp("rotating"), fmu_cache, tuple(names))


@pytest.fixture(scope="module")
def sliding(tmp_path_factory: pytest.TempPathFactory, fmu_cache: Path) -> Any:
    slides = ("positioned", "pushed", "held", "spun", "steered", "bouncing", "damped", "braked", "sprung", "measured")
    names = [f"{slide}.{value}" for slide in slides for value in ("s", "v")]
    names += ["stalled.f", "stalled.i", "stalled.s", "elastic.depth", "force.f", "sensor.s", "sensor.v", "sensor.f"]
    return run(SLIDING, tmp_path_factory.mktemp("sliding"), fmu_cache, tuple(names))


def oscillation(time: np.ndarray, frequency: float, ratio: float) -> np.ndarray:
    """Unit step response of a second-order lag."""
    damped = frequency * np.sqrt(1 - ratio**2)
    wave = np.cos(damped * time) + ratio / np.sqrt(1 - ratio**2) * np.sin(damped * time)
    return 1 - np.exp(-ratio * frequency * time) * wave


def test_position_is_a_filter(rotating: Any, sliding: Any) -> None:
    w, time = 2 * PI * 2, rotating["time"]
    assert rotating["positioned.phi"] == pytest.approx(1 - (1 + w * time) * np.exp(-w * time), abs=1e-7)
    acceleration = w**2 * (1 - w * time) * np.exp(-w * time)
    assert rotating["position.tau"] == pytest.approx(0.3 * acceleration, abs=1e-5)
    assert sliding["positioned.s"] == pytest.approx(0.1 * oscillation(sliding["time"], w, 0.5), abs=1e-8)


def test_torque_and_force_are_limited(rotating: Any, sliding: Any) -> None:
    assert rotating["turned.phi"] == pytest.approx(-2 / 0.4 * rotating["time"] ** 2 / 2, abs=1e-8)
    assert rotating["torque.tau"] == pytest.approx(-2)
    assert sliding["pushed.s"] == pytest.approx(2 / 4 * sliding["time"] ** 2 / 2, abs=1e-8)
    assert sliding["force.f"] == pytest.approx(2)


def test_servo_is_an_oscillator(rotating: Any, sliding: Any) -> None:
    assert rotating["held.phi"] == pytest.approx(0.5 * oscillation(rotating["time"], 20, 0.5), abs=1e-7)
    assert rotating["servo.phi"] == pytest.approx(rotating["held.phi"])
    assert sliding["held.s"] == pytest.approx(0.05 * oscillation(sliding["time"], 20, 0.5), abs=1e-8)


def test_servo_holds_its_limit(rotating: Any) -> None:
    """Constant acceleration while the limit is reached: 40 (0.5 - phi) - 2 w > 3 until about 0.09 s."""
    time = rotating["time"]
    start = time <= 0.08
    assert rotating["weakly.phi"][start] == pytest.approx(3 / 0.1 * time[start] ** 2 / 2, abs=1e-8)
    assert np.abs(rotating["weak.tau"]).max() == pytest.approx(3)
    assert rotating["weakly.phi"][-1] == pytest.approx(0.5, abs=1e-3)


def test_servo_follows_with_the_speed_reference(rotating: Any) -> None:
    """Without an input of the speed it would lag by d w/c."""
    assert rotating["tracked.phi"] == pytest.approx(3 * rotating["time"], abs=1e-8)


def test_motor_runs_up(rotating: Any, sliding: Any) -> None:
    """Against the induced voltage, with the voltage cut at 24 V: a first-order lag."""
    time, inertia = rotating["time"], 0.2 + 20**2 * 2e-5
    lag = 0.5 * inertia / (20 * 0.05) ** 2
    assert rotating["spun.w"] == pytest.approx(24 / (20 * 0.05) * (1 - np.exp(-time / lag)), abs=1e-6)
    assert rotating["free.i"] == pytest.approx(24 / 0.5 * np.exp(-time / lag), abs=1e-5)
    assert rotating["free.tau"] == pytest.approx(0.2 * 24 / lag * np.exp(-time / lag), abs=1e-4)
    ratio = 2 * PI / 0.01
    lag = 0.5 * (2 / ratio**2 + 2e-5) / 0.05**2
    expected = 24 / (ratio * 0.05) * (1 - np.exp(-sliding["time"] / lag))
    assert sliding["spun.v"] == pytest.approx(expected, abs=1e-7)


def test_motor_starts_at_its_current_limit(rotating: Any) -> None:
    """8 A until the induced voltage is 24 - 0.5*8 = 20 V; then the lag of the free motor."""
    time, inertia = rotating["time"], 0.2 + 20**2 * 2e-5
    acceleration = 20 * 0.05 * 8 / inertia
    leaves = 20 / (20 * 0.05) / acceleration
    assert 0.3 < leaves < 0.7
    lag = 0.5 * inertia / (20 * 0.05) ** 2
    after = 24 - 4 * np.exp(-(time - leaves) / lag)
    assert rotating["started.w"] == pytest.approx(np.where(time < leaves, acceleration * time, after), abs=1e-5)
    assert rotating["limited.i"].max() == pytest.approx(8)


def test_motor_with_friction_ends_at_its_steady_speed(rotating: Any) -> None:
    """k (u - k w)/R = d w + tau_dry."""
    steady = (0.05 * 24 / 0.5 - 0.02) / (0.05**2 / 0.5 + 1e-3)
    assert rotating["rubbed.w"][-1] == pytest.approx(steady / 20, rel=1e-6)
    assert rotating["rubbing.i"][-1] == pytest.approx((24 - 0.05 * steady) / 0.5, rel=1e-5)


def test_stall_torque(rotating: Any, sliding: Any) -> None:
    time = rotating["time"]
    assert rotating["stalled.i"] == pytest.approx(6 * (1 - np.exp(-time * 0.5 / 0.05)), abs=1e-7)
    assert rotating["stalled.tau"] == pytest.approx(20 * 0.05 * rotating["stalled.i"])
    assert rotating["stalled.phi"] == pytest.approx(0.4)
    assert rotating["cut.i"] == pytest.approx(-4 * (1 - np.exp(-time * 0.5 / 0.05)), abs=1e-7)
    assert sliding["stalled.i"] == pytest.approx(4)
    assert sliding["stalled.f"] == pytest.approx(2 * PI / 0.01 * 0.05 * 4)


def cascade_response(time: np.ndarray, inertia: float, design: float) -> np.ndarray:
    """Unit step of the rotor's angle in the linear cascade, by the matrix exponential.

    States: angle, speed, current, integral parts of the speed and of the current loop; motor data as in the library's
    defaults (R = 1, L = 1e-3, k = 0.05).
    """
    resistance, inductance, k = 1.0, 1e-3, 0.05
    position, speed, current = (2 * PI * f for f in (4, 20, 200))
    gain = design * speed / k
    wanted_speed = np.array([-position, -1, 0, 0, 0, position])  # deviation of the speed; last: reference
    wanted = gain * wanted_speed + np.array([0, 0, -1, 1, 0, 0])  # deviation of the current
    voltage = inductance * current * wanted + np.array([0, 0, 0, 0, 1, 0])  # beside the induced voltage
    rows = [
        np.array([0, 1, 0, 0, 0, 0]),
        np.array([0, 0, k / inertia, 0, 0, 0]),
        (voltage - np.array([0, 0, resistance, 0, 0, 0])) / inductance,
        gain * speed / 4 * wanted_speed,
        resistance * current * wanted,
        np.zeros(6),
    ]
    return np.array([(expm(np.array(rows) * t) @ np.array([0, 0, 0, 0, 0, 1.0]))[0] for t in time])


def test_cascade_is_linear_for_small_steps(rotating: Any, sliding: Any) -> None:
    expected = 1e-3 * cascade_response(rotating["time"], 0.2 / 20**2 + 2e-5, 5.2e-4)
    assert rotating["steered.phi"] == pytest.approx(expected, abs=1e-8)
    assert rotating["steered.phi"][-1] == pytest.approx(1e-3, rel=1e-3)
    expected = 1e-4 * cascade_response(sliding["time"], 2 * (0.01 / (2 * PI)) ** 2 + 2e-5, 3e-5)
    assert sliding["steered.s"] == pytest.approx(expected, abs=1e-9)


def test_spring_and_damper(rotating: Any, sliding: Any) -> None:
    frequency = np.sqrt(8 / 0.1)
    expected = 0.25 * oscillation(rotating["time"], frequency, 0.4 / (2 * np.sqrt(8 * 0.1)))
    assert rotating["sprung.phi"] == pytest.approx(expected, abs=1e-7)
    assert sliding["sprung.s"] == pytest.approx(expected, abs=1e-7)


def test_friction(rotating: Any, sliding: Any) -> None:
    time = rotating["time"]
    assert rotating["slowed.w"] == pytest.approx(4 * np.exp(-0.5 / 0.25 * time), abs=1e-7)
    assert rotating["braked.w"] == pytest.approx(4 - 0.6 / 0.3 * time, abs=1e-6)
    # f_dry and d together: v + f/d decays; at rest from then on
    stop = 0.8 / 0.2 * np.log((1 + 2.5) / 2.5)
    moving = time < stop - 0.01
    expected = 3.5 * np.exp(-0.2 / 0.8 * time[moving]) - 2.5
    assert 0 < stop < 1.4
    assert sliding["braked.v"][moving] == pytest.approx(expected, abs=1e-5)


def test_end_stop_without_damping_gives_the_speed_back(sliding: Any) -> None:
    """Free to 0.2 m at 2 m/s, half an oscillation in the stop, back with the same speed."""
    time, frequency = sliding["time"], np.sqrt(1000 / 0.5)
    inside = np.clip(time - 0.1, 0, PI / frequency)
    expected = np.minimum(2 * time, 0.2) + 2 / frequency * np.sin(frequency * inside)
    expected -= 2 * np.maximum(0, time - 0.1 - PI / frequency)
    before_other_end = time < 0.7
    assert sliding["bouncing.s"][before_other_end] == pytest.approx(expected[before_other_end], abs=1e-6)
    assert sliding["bouncing.v"][-1] == pytest.approx(2, abs=1e-6)
    assert sliding["elastic.depth"].max() == pytest.approx(2 / frequency, rel=1e-2)


def test_end_stop_with_damping_against_an_independent_integration(sliding: Any) -> None:
    def rates(_time: float, state: np.ndarray) -> list[float]:
        depth, speed = state
        return [speed, -1000 * depth * max(0.0, 1 + 0.3 * speed) / 0.5]

    def leaves(_time: float, state: np.ndarray) -> float:
        return float(state[0])

    leaves.terminal, leaves.direction = True, -1  # type: ignore[attr-defined]
    blow = solve_ivp(rates, (0, 1), [0.0, 2.0], events=leaves, rtol=1e-11, atol=1e-13)
    assert 0.5 < -blow.y[1, -1] < 1.6
    assert sliding["damped.v"][-1] == pytest.approx(-blow.y[1, -1], abs=1e-6)


def test_sensor_and_reaction_of_the_housing(rotating: Any, sliding: Any) -> None:
    """Drive and housing turn against each other: the sensor sees the difference, the housing the reaction."""
    time = rotating["time"]
    assert rotating["housing.w"] == pytest.approx(1.5 - 0.7 / 2 * time, abs=1e-8)
    assert rotating["sensor.w"] == pytest.approx(0.7 / 0.5 * time - 1.5 + 0.35 * time, abs=1e-8)
    assert rotating["sensor.phi"] == pytest.approx(0.2 - 1.5 * time + 1.75 * time**2 / 2, abs=1e-8)
    assert rotating["sensor.tau"] == pytest.approx(0.7)
    assert sliding["sensor.f"] == pytest.approx(3)
    assert sliding["sensor.s"] == pytest.approx(1.5 * time**2 / 2, abs=1e-8)
