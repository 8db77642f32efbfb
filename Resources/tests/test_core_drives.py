"""Drives, signal blocks and controllers of the MultiBody core subset against closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

TOLERANCE = 1e-8


def _oscillator(t):
    """0.2 x'' = -20 (x - 0.1) - 0.5 x' + 5 (-x - 0.2) - 0.3 x', x(0) = 0.3, at rest."""
    stiffness, damping, inertia, rest = 25.0, 0.8, 0.2, (20 * 0.1 - 5 * 0.2) / 25.0
    decay = damping / inertia / 2
    omega = np.sqrt(stiffness / inertia - decay**2)
    a = 0.3 - rest
    return rest + np.exp(-decay * t) * (a * np.cos(omega * t) + decay * a / omega * np.sin(omega * t))


@pytest.mark.full
def test_rotational_drive_trains(simulate):
    result = simulate("RotationalDrives")
    t = result["time"]
    np.testing.assert_allclose(result["motor.phi"], 1.5 * t**2, atol=TOLERANCE)
    np.testing.assert_allclose(result["load.phi"], 1.5 * t**2 / 4, atol=TOLERANCE)
    np.testing.assert_allclose(result["angleSensor.phi"], 1.5 * t**2 / 4, atol=TOLERANCE)
    np.testing.assert_allclose(result["speedSensor.w"], 0.75 * t, atol=TOLERANCE)
    np.testing.assert_allclose(result["accSensor.a"], 0.75, atol=TOLERANCE)
    np.testing.assert_allclose(result["torqueSensor.tau"], 6.0, atol=TOLERANCE)
    np.testing.assert_allclose(result["powerSensor.power"], 6 * 0.75 * t, atol=TOLERANCE)
    np.testing.assert_allclose(result["oscillator.phi"], _oscillator(t), atol=1e-7)
    damper = 0.3 * result["oscillator.w"] ** 2
    np.testing.assert_allclose(result["damper.lossPower"], damper, atol=TOLERANCE)
    late = np.clip(t - 0.2, 0, 0.5)
    after = np.clip(t - 0.7, 0, None)
    # Torque 4 (t - 0.2) up to 2, inertia 2: the angle is its second integral.
    expected = late**3 / 3 + late**2 * after + after**2 / 2
    np.testing.assert_allclose(result["driven.phi"], expected, atol=TOLERANCE)


@pytest.mark.full
def test_translational_drive_trains(simulate):
    result = simulate("TranslationalDrives")
    t = result["time"]
    a = 3 / 8.5
    np.testing.assert_allclose(result["slider.s"], a * t**2 / 2, atol=TOLERANCE)
    np.testing.assert_allclose(result["positionSensor.s"], 0.3 + a * t**2 / 2, atol=TOLERANCE)
    np.testing.assert_allclose(result["speedSensor.v"], a * t, atol=TOLERANCE)
    np.testing.assert_allclose(result["accSensor.a"], a, atol=TOLERANCE)
    np.testing.assert_allclose(result["forceSensor.f"], 8 * a, atol=TOLERANCE)
    np.testing.assert_allclose(result["powerSensor.power"], 8 * a * a * t, atol=TOLERANCE)
    np.testing.assert_allclose(result["oscillator.s"], _oscillator(t), atol=1e-7)
    np.testing.assert_allclose(result["driven.s"], np.clip(t - 0.2, 0, None) ** 2 / 2, atol=TOLERANCE)


def _bessel(t, reference):
    """Second-order Bessel filter at 20 Hz that starts at rest at the reference."""
    w = 2 * np.pi * 20

    def right(time, state):
        return [state[1], ((reference(time) - state[0]) * w - 1.3617 * state[1]) * w / 0.618]

    return solve_ivp(right, (0, t[-1]), [reference(0), 0], t_eval=t, rtol=1e-11, atol=1e-13, method="Radau").y


@pytest.mark.full
def test_prescribed_rotations(simulate):
    result = simulate("RotationalMotions")
    t = result["time"]
    np.testing.assert_allclose(result["inertia[1].phi"], 0.2 * np.sin(3 * t), atol=TOLERANCE)
    np.testing.assert_allclose(result["inertia[1].a"], -1.8 * np.sin(3 * t), atol=TOLERANCE)
    np.testing.assert_allclose(result["exact.flange.tau"], 0.3 * 1.8 * np.sin(3 * t), atol=TOLERANCE)
    filtered = _bessel(t, lambda time: 0.4 * np.sin(2 * np.pi * time + 0.5))
    np.testing.assert_allclose(result["inertia[2].phi"], filtered[0], atol=1e-7)
    np.testing.assert_allclose(result["inertia[2].w"], filtered[1], atol=1e-5)
    np.testing.assert_allclose(result["inertia[3].phi"], 3 * t, atol=TOLERANCE)
    np.testing.assert_allclose(result["inertia[4].phi"], t + t**2 / 2, atol=TOLERANCE)
    np.testing.assert_allclose(result["inertia[5].phi"], 0.1 + 2 * t, atol=TOLERANCE)


@pytest.mark.full
def test_prescribed_translations(simulate):
    result = simulate("TranslationalMotions")
    t = result["time"]
    np.testing.assert_allclose(result["mass[1].s"], 0.2 * np.sin(3 * t), atol=TOLERANCE)
    filtered = _bessel(t, lambda time: 0.4 * np.cos(2 * np.pi * time + 0.5))
    np.testing.assert_allclose(result["mass[2].s"], filtered[0], atol=1e-7)
    np.testing.assert_allclose(result["mass[3].s"], 3 * t, atol=TOLERANCE)
    np.testing.assert_allclose(result["mass[4].s"], 0.1 + 2 * t, atol=TOLERANCE)


@pytest.mark.full
def test_housing_takes_the_reaction(simulate):
    result = simulate("RotationalSupports", stop=0.5, interval=0.01)
    t, housing = result["time"], result["housing.phi"]
    energy = 0.05 * result["rotor.w"] ** 2 + 0.5 * result["housing.w"] ** 2 + result["slide.v"] ** 2 + 5 * housing**2
    np.testing.assert_allclose(energy, 2 * (result["rotor.phi"] - housing), atol=TOLERANCE)
    # Angular momentum grows by the torque of the mount alone; Simpson's rule for its integral.
    momentum = 0.1 * result["rotor.w"] + result["housing.w"]
    impulse = -10 * np.array([0.01 / 3 * (housing[i] + 4 * housing[i + 1] + housing[i + 2]) for i in range(len(t) - 2)])
    np.testing.assert_allclose(momentum[2:] - momentum[:-2], impulse, atol=1e-7)
    turned = -(result["rotor.phi"] - housing) / 3 - 0 * housing
    np.testing.assert_allclose(result["pinion.flangeR.phi"] - housing, turned, atol=TOLERANCE)
    np.testing.assert_allclose(20 * result["slide.s"], result["pinion.flangeR.phi"] - housing, atol=TOLERANCE)


def test_signals(simulate):
    result = simulate("Signals", interval=0.03)
    t = result["time"]
    sine = 0.1 + np.where(t < 0.1, 0, 2 * np.sin(3 * np.pi * (t - 0.1) + 0.3))
    cosine = 2 * np.cos(3 * np.pi * t)
    ramp = 0.5 - 2 * np.clip((t - 0.2) / 0.4, 0, 1)
    step = 1 + 3 * (t >= 0.3)
    clock = np.clip(t - 0.25, 0, None)
    # At the instant of a jump itself either side is right.
    smooth = np.min(np.abs(t[:, None] - [0.1, 0.3]), axis=1) > 1e-9
    expected = {
        "sine.y": sine,
        "cosine.y": cosine,
        "ramp.y": ramp,
        "step.y": step,
        "clock.y": clock,
        "expression.y": t**2,
        "gain.y": 3 * sine,
        "add.y": sine - 2 * cosine,
        "add3.y": sine + cosine + 0.5 * ramp,
        "feedback.y": step - ramp,
        "product.y": sine * clock,
        "sum.y": sine - 2,
        "abs.y": np.abs(sine),
        "limiter.y": np.clip(sine, -0.5, 1),
        "deadZone.y": np.sign(sine) * np.clip(np.abs(sine) - 0.5, 0, None),
    }
    for name, values in expected.items():
        np.testing.assert_allclose(result[name][smooth], values[smooth], atol=1e-12, err_msg=name)


@pytest.mark.full
def test_filters(simulate):
    result = simulate("Filters")
    t = result["time"]
    np.testing.assert_allclose(result["integrator.y"], 0.5 + 2 * t, atol=TOLERANCE)
    np.testing.assert_allclose(result["firstOrder.y"], 2 + (0.1 - 2) * np.exp(-t / 0.3), atol=TOLERANCE)
    decay, omega = 4.0, 10 * np.sqrt(1 - 0.4**2)
    second = 2 - 2 * np.exp(-decay * t) * (np.cos(omega * t) + decay / omega * np.sin(omega * t))
    np.testing.assert_allclose(result["secondOrder.y"], second, atol=1e-7)
    np.testing.assert_allclose(result["pi.y"], 3 * (1 + t / 0.5), atol=TOLERANCE)
    lag, w = 0.05, 2 * np.pi
    # x' = (sin(w t) - x)/lag from x = 0
    x = (np.sin(w * t) - w * lag * np.cos(w * t) + w * lag * np.exp(-t / lag)) / (1 + (w * lag) ** 2)
    np.testing.assert_allclose(result["derivative.y"], 2 * (np.sin(w * t) - x) / lag, atol=1e-6)
    np.testing.assert_allclose(result["der1.y"], w * np.cos(w * t), atol=1e-9)
    pid = 3 * (1 + t / 0.5 + 10 * np.exp(-t / 0.01))
    np.testing.assert_allclose(result["pid.y"], pid, atol=1e-7)


@pytest.mark.parametrize("kind", [*(pytest.param(kind, marks=pytest.mark.full) for kind in ("P", "PI")), "PD"])
def test_controllers_with_feed_forward(simulate, kind):
    result = simulate(f"Controller{kind}")
    t = result["time"]

    def right(time, state):
        plant, integral, lagged = state
        error = np.sin(np.pi * time) - plant
        # The derivative acts on the measurement alone (wd = 0), filtered with Td/Nd = 0.02 s.
        derivative = 0.2 * (-plant - lagged) / 0.02 if kind == "PD" else 0.0
        control = 5 * (error + (integral if kind == "PI" else 0.0) + derivative) + 0.2
        limited = np.clip(control, -4, 4)
        windup = (limited - control) / (5 * 0.9)
        return [(limited - plant) / 0.3, (error + windup) / 0.5, (-plant - lagged) / 0.02]

    expected = solve_ivp(right, (0, t[-1]), [0, 0, 0], t_eval=t, rtol=1e-10, atol=1e-12, method="Radau").y
    np.testing.assert_allclose(result["plant.y"], expected[0], atol=1e-6)


@pytest.mark.full
def test_limited_controller_reaches_the_angle(simulate):
    result = simulate("Controller", stop=2.0)
    assert np.max(np.abs(result["motor.tau"])) == pytest.approx(4.0)
    assert result["inertia.phi"][0] == 0
    assert result["angle.phi"][-1] == pytest.approx(1.0, abs=0.1)


@pytest.mark.full
def test_integrator_is_set_at_the_event(simulate):
    result = simulate("IntegratorReset", interval=0.03)
    t = result["time"]
    np.testing.assert_allclose(result["integrator.y"], np.where(t < 0.5, t, 0.25 + (t - 0.5)), atol=TOLERANCE)
