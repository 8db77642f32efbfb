"""Examples of the Modelica Standard Library run, and as rumoca simulates them, where the library is on this machine."""

from __future__ import annotations

import os

import msl_examples as examples
import numpy as np
import pytest
from fmpy import simulate_fmu
from modelica2fmu.build import BuildOptions, build_fmu

LIBRARY = examples.library_folder()
pytestmark = pytest.mark.skipif(
    LIBRARY is None, reason="needs the complete Modelica Standard Library (MODELICAPATH names none)"
)

MULTIBODY = "Modelica.Mechanics.MultiBody.Examples"
ROTATIONAL = "Modelica.Mechanics.Rotational.Examples"
TRANSLATIONAL = "Modelica.Mechanics.Translational.Examples"
BLOCKS = "Modelica.Blocks.Examples"
WHOLE = os.environ.get("MSL_EXAMPLES") == "all"  # make test-msl


def names(package: str, text: str) -> list[str]:
    return [f"{package}.{name}" for name in text.split()]


# Examples that rumoca simulates too: states are compared.
COMPARED = [
    *names(f"{MULTIBODY}.Elementary", "DoublePendulum FreeBody ForceAndTorque LineForceWithTwoMasses"),
    *names(ROTATIONAL, "First ElasticBearing"),
    *names(TRANSLATIONAL, "Accelerate Damper"),
    *names(BLOCKS, "PID_Controller FilterWithRiseTime SinCosEncoder"),
]
COMPARED_TOO = [
    *names(f"{MULTIBODY}.Elementary", "DoublePendulumInitTip HeatLosses InitSpringConstant Pendulum SpringMassSystem"),
    *names(ROTATIONAL, "FirstGrounded EddyCurrentBrake RollingWheel Backlash CompareBrakingTorque"),
    *names(TRANSLATIONAL, "CompareBrakingForce EddyCurrentBrake ElastoGap"),
    *names(BLOCKS, "InverseModel Modulation SlewRateLimiter DemoSignalCharacteristic"),
]
# Examples that rumoca does not simulate, or whose states it does not have: they run to their end.
RUNNING = [
    *names(ROTATIONAL, "CoupledClutches LossyGearDemo1"),
    *names(TRANSLATIONAL, "Brake Vehicle"),
    *names(BLOCKS, "LogicalNetwork1"),
]
RUNNING_TOO = [
    *names(
        f"{MULTIBODY}.Elementary",
        "PendulumWithSpringDamper PointGravity PointGravityWithPointMasses PointGravityWithPointMasses2 RollingWheel"
        " SpringDamperSystem SpringWithMass ThreeSprings UserDefinedGravityField",
    ),
    *names(
        f"{MULTIBODY}.Loops", "Engine1a Engine1b Engine1b_analytic Fourbar1 Fourbar2 Fourbar_analytic PlanarFourbar"
    ),
    *names(f"{MULTIBODY}.Constraints", "SphericalConstraint UniversalConstraint"),
    *names(
        f"{MULTIBODY}.Rotational3DEffects",
        "ActuatedDrive BevelGear1D GearConstraint GyroscopicEffects MovingActuatedDrive",
    ),
    *names(
        ROTATIONAL,
        "Friction LossyGearDemo3 OneWayClutch OneWayClutchDisengaged SimpleGearShift",
    ),
    *names(TRANSLATIONAL, "Friction InitialConditions Oscillator PreLoad Sensors SignConvention WhyArrows"),
    *names(BLOCKS, "ShowLogicalSources RealNetwork1 CompareSincExpSine"),
]


@pytest.mark.parametrize("model", [*COMPARED, *(COMPARED_TOO if WHOLE else [])])
def test_example_runs_as_the_front_end_simulates_it(model, tmp_path, fmu_cache):
    outcome = examples.attempt(model, LIBRARY, tmp_path, fmu_cache)
    assert (outcome.result, outcome.reason) == ("runs", "")
    assert outcome.deviation is not None, outcome.remark
    assert outcome.deviation < 1e-4


@pytest.mark.parametrize("model", [*RUNNING, *(RUNNING_TOO if WHOLE else [])])
def test_example_runs_to_its_end(model, tmp_path, fmu_cache):
    outcome = examples.attempt(model, LIBRARY, tmp_path, fmu_cache)
    assert (outcome.result, outcome.reason) == ("runs", "")
    assert outcome.deviation is None or outcome.deviation < 1e-4


@pytest.fixture(scope="module")
def braked(tmp_path_factory, fmu_cache):
    """A wheel of inertia 2 kg.m2 with 5 rad/s, slowed by a bearing's friction of 10 N.m, and pushed from 4 s on."""
    folder = tmp_path_factory.mktemp("braked")
    (folder / "Braked.mo").write_text(
        """
model Braked
  Modelica.Mechanics.Rotational.Components.Inertia wheel(J = 2, w(start = 5, fixed = true), phi(fixed = true));
  Modelica.Mechanics.Rotational.Components.BearingFriction bearing(tau_pos = [0, 10; 100, 10], peak = 1.5);
  Modelica.Mechanics.Rotational.Sources.Torque push;
  Modelica.Blocks.Sources.Ramp ramp(height = 40, duration = 4, startTime = 4);
equation
  connect(ramp.y, push.tau);
  connect(push.flange, wheel.flange_a);
  connect(wheel.flange_b, bearing.flange_a);
end Braked;
"""
    )
    build_fmu("Braked", [folder / "Braked.mo"], folder / "m.fmu", BuildOptions(msl=LIBRARY, cache=fmu_cache))
    return folder / "m.fmu"


@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
def test_dry_friction_stops_sticks_and_lets_go(braked, kind):
    result = simulate_fmu(
        str(braked), fmi_type=kind, stop_time=7.0, relative_tolerance=1e-8, output_interval=0.01,
        output=["wheel.w", "wheel.phi", "bearing.mode"],
    )  # fmt: skip
    time, speed = result["time"], result["wheel.w"]
    stop, free = 1.0, 4.0 + 15.0 / 10.0  # it lets go where the push exceeds the peak of 15 N.m
    slowing, stuck, pushed = time < stop, (time > stop + 0.01) & (time < free), time > free + 0.01
    since = time[pushed] - free
    assert speed[slowing] == pytest.approx(5 - 5 * time[slowing], abs=1e-6)
    assert np.abs(speed[stuck]).max() < 1e-8
    assert set(result["bearing.mode"][stuck]) == {0}
    assert result["wheel.phi"][stuck] == pytest.approx(2.5, abs=1e-6)
    assert speed[pushed] == pytest.approx((5 * since + 5 * since**2) / 2, abs=1e-5)  # (15 + 10 since - 10)/2


def test_linear_part_of_backlash_has_its_closed_form(tmp_path, fmu_cache):
    fmu = tmp_path / "m.fmu"
    build_fmu(f"{ROTATIONAL}.Backlash", [LIBRARY / "Modelica"], fmu, BuildOptions(msl=LIBRARY, cache=fmu_cache))
    result = simulate_fmu(
        str(fmu), fmi_type="CoSimulation", stop_time=1.0, relative_tolerance=1e-8, output=["springDamper.phi_rel"]
    )
    time, angle = result["time"], result["springDamper.phi_rel"]
    damping, frequency = 50 / 5 / 2, np.sqrt(20e3 / 5 - (50 / 5 / 2) ** 2)
    closed = np.exp(-damping * time) * (np.cos(frequency * time) + damping / frequency * np.sin(frequency * time))
    assert angle == pytest.approx(np.pi / 2 * closed, abs=1e-5)


def test_tables_over_time_jump_and_repeat(tmp_path, fmu_cache):
    (tmp_path / "Saw.mo").write_text(
        """
model Saw
  Modelica.Blocks.Sources.CombiTimeTable saw(table = [0, 0, 0; 0.5, 1, 0; 0.5, 0, 2; 0.75, 2, 2],
    extrapolation = Modelica.Blocks.Types.Extrapolation.Periodic, offset = {10, 0}, startTime = 0.25);
  Modelica.Blocks.Tables.CombiTable1Ds square(table = [0, 0; 1, 1; 2, 4; 3, 9; 4, 16]);
  Real area(start = 0, fixed = true);
equation
  square.u = time;
  der(area) = saw.y[1];
end Saw;
"""
    )
    build_fmu("Saw", [tmp_path / "Saw.mo"], tmp_path / "m.fmu", BuildOptions(msl=LIBRARY, cache=fmu_cache))
    names = ["saw.y[1]", "saw.y[2]", "square.y[1]", "area"]
    result = simulate_fmu(
        str(tmp_path / "m.fmu"), fmi_type="CoSimulation", stop_time=2.5, relative_tolerance=1e-11, output_interval=0.02,
        output=names,
    )  # fmt: skip
    time = result["time"]
    away = np.abs((time - 0.25) % 0.25 - 0.125) < 0.12  # of the jumps
    phase = np.where(time > 0.25, (time - 0.25) % 0.75, 0)
    rising = np.where(phase < 0.5, 2 * phase, 8 * (phase - 0.5))
    assert result["saw.y[1]"][away] == pytest.approx(np.where(time > 0.25, 10 + rising, 10)[away], abs=1e-8)
    assert result["saw.y[2]"][away] == pytest.approx(np.where(phase < 0.5, 0, 2)[away], abs=1e-8)
    assert result["square.y[1]"] == pytest.approx(np.interp(time, range(5), np.arange(5) ** 2), abs=1e-8)
    assert result["area"][-1] == pytest.approx(10 * 2.5 + 3 * (0.25 + 0.25), abs=1e-7)  # three whole periods
