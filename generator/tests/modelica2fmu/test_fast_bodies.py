"""Bodies that move farther than they are thick between two steps: they meet, or an error says that they did not."""

from __future__ import annotations

import pytest
from fmpy import simulate_fmu
from fmpy.fmi1 import FMICallException
from fmu_regression.simulate.simulation import simulate

# A ball of 20 mm flies at another one, or at a plate of 5 mm; both masses are alike, so that the elastic impact
# exchanges velocities.
BALLS = """model {name}
  inner Modelica.Mechanics.MultiBody.World world(
    gravityType = Modelica.Mechanics.MultiBody.Types.GravityTypes.NoGravity, enableAnimation = false);
  parameter Real speed = 50, gap = 0.5;
  ContactMultiBody.Parts.FreeBody one(
    m = 0.03, r_CM = {{0, 0, 0}}, I_11 = 1e-6, I_22 = 1e-6, I_33 = 1e-6, animation = false,
    geometry = ContactMultiBody.Shapes.sphere(0.01), material = ContactMultiBody.Materials.Steel(restitution = 1),
    r_0(start = {{-gap, 0, 0}}, each fixed = true), v_0(start = {{speed, 0, 0}}, each fixed = true),
    angles_fixed = true, w_0_fixed = true);
  ContactMultiBody.Parts.FreeBody other(
    m = 0.03, r_CM = {{0, 0, 0}}, I_11 = 1e-3, I_22 = 1e-3, I_33 = 1e-3, animation = false,
    geometry = {geometry}, material = ContactMultiBody.Materials.Steel(restitution = 1),
    r_0(start = {{0, 0, 0}}, each fixed = true), v_0(start = {{0, 0, 0}}, each fixed = true),
    angles_fixed = true, w_0_fixed = true);
  ContactMultiBody.{manager};
equation
  connect(one.frame_a, contacts.frame[1]);
  connect(other.frame_a, contacts.frame[2]);
end {name};
"""
COMMON = (
    "contacts(n = 2, collider = {one.collider, other.collider}, "
    "stiffnessChoice = ContactMultiBody.Types.StiffnessChoice.Given, "
)
COMPILED = f"CompiledContactManager {COMMON} stiffness = {{2e9, 2e9}}, useFriction = false)"
PAIRS = (
    f"ContactManager {COMMON} stiffness = {{1e9}}, friction = ContactMultiBody.Types.Friction.None, "
    "restitutionMethod = ContactMultiBody.Types.RestitutionMethod.Memoryless)"
)
BALL, PLATE = "ContactMultiBody.Shapes.sphere(0.01)", "ContactMultiBody.Shapes.box({0.005, 0.3, 0.3})"
MODELS = {
    "CompiledBalls": BALLS.format(name="CompiledBalls", geometry=BALL, manager=COMPILED),
    "PairOfBalls": BALLS.format(name="PairOfBalls", geometry=BALL, manager=PAIRS),
    "CompiledPlate": BALLS.format(name="CompiledPlate", geometry=PLATE, manager=COMPILED),
}
# The others are of another manager or shape alone.
SOME_MODELS = [pytest.param(name, marks=() if name == "CompiledBalls" else pytest.mark.full) for name in MODELS]
SIGNALS = ["one.r_0[1]", "one.v_0[1]", "other.r_0[1]", "other.v_0[1]"]

# A rod of 10 mm turns about its end and sweeps a ball of 10 mm on a rail, which it meets at a right angle to itself.
ROD = """model Rod
  inner Modelica.Mechanics.MultiBody.World world(
    gravityType = Modelica.Mechanics.MultiBody.Types.GravityTypes.NoGravity, enableAnimation = false);
  parameter Real rate = 50, gap = 0.5;
  Modelica.Mechanics.MultiBody.Joints.Revolute joint(
    n = {0, 0, 1}, phi(start = -gap, fixed = true), w(start = rate, fixed = true), animation = false);
  ContactMultiBody.Parts.Body rod(
    m = 1, r_CM = {0.5, 0, 0}, I_11 = 1e-4, I_22 = 0.08, I_33 = 0.08, animation = false,
    geometry = ContactMultiBody.Shapes.capsule(
      0.005, 1, position = {0.5, 0, 0}, rotation = {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}),
    material = ContactMultiBody.Materials.Steel(restitution = 1));
  Modelica.Mechanics.MultiBody.Parts.FixedTranslation place(r = {0.9, 0, 0}, animation = false);
  Modelica.Mechanics.MultiBody.Joints.Prismatic rail(
    n = {0, 1, 0}, s(start = 0, fixed = true), v(start = 0, fixed = true), animation = false);
  ContactMultiBody.Parts.Body ball(
    m = 0.05, r_CM = {0, 0, 0}, I_11 = 1e-5, I_22 = 1e-5, I_33 = 1e-5, animation = false,
    geometry = ContactMultiBody.Shapes.sphere(0.005), material = ContactMultiBody.Materials.Steel(restitution = 1));
  ContactMultiBody.CompiledContactManager contacts(
    n = 2, collider = {rod.collider, ball.collider}, useFriction = false,
    stiffnessChoice = ContactMultiBody.Types.StiffnessChoice.Given, stiffness = {2e9, 2e9});
equation
  connect(world.frame_b, joint.frame_a);
  connect(joint.frame_b, rod.frame_a);
  connect(world.frame_b, place.frame_a);
  connect(place.frame_b, rail.frame_a);
  connect(rail.frame_b, ball.frame_a);
  connect(rod.frame_a, contacts.frame[1]);
  connect(ball.frame_a, contacts.frame[2]);
end Rod;
"""

# Free plates of 5 mm in a row, each followed by steps of its own: the first flies flat at the others.
PLATES = """model Plates
  parameter Real speed = 50;
  ContactMultiBody.Parts.FreeBodies bodies(
    bodyCount = 10, bodyGeometry = ContactMultiBody.Shapes.box({0.005, 0.4, 0.4}), bodyMass = 0.1,
    bodyInertia = {1e-3, 1e-3, 1e-3}, surroundings = "", gravity = {0, 0, 0}, material(each restitution = 1),
    stiffnessChoice = ContactMultiBody.Types.StiffnessChoice.Given, bodyStiffness = 2e9, useFriction = false,
    r_start = {{0.3*(i - 1), 0, 0} for i in 1:10}, v_start = {{if i == 1 then speed else 0, 0, 0} for i in 1:10});
end Plates;
"""


@pytest.mark.parametrize(
    "tolerance", [pytest.param(1e-2, marks=pytest.mark.full), 1e-4, pytest.param(1e-6, marks=pytest.mark.full)]
)
@pytest.mark.parametrize("mode", ["cs", "me"])
@pytest.mark.parametrize("model", SOME_MODELS)
def test_balls_exchange_their_velocities_at_any_speed(built_with_library, model, mode, tolerance):
    """The communication step is as long as the flight: free flight needs no step in it."""
    for speed in (3.0, 50.0, 200.0):
        result = simulate(
            built_with_library(MODELS[model]),
            signals=SIGNALS,
            stop=1.0 / speed,
            interval=1.0 / speed,
            tolerance=tolerance,
            mode=mode,
            parameters={"speed": speed},
        )
        first, last = result.signals["one.v_0[1]"][-1], result.signals["other.v_0[1]"][-1]
        assert result.signals["one.r_0[1]"][-1] < result.signals["other.r_0[1]"][-1]
        assert (first, last) == pytest.approx((0.0, speed), abs=0.03 * speed)


@pytest.mark.full
@pytest.mark.parametrize("mode", ["cs", "me"])
def test_a_step_that_cannot_be_looked_through_is_told(built_with_library, mode):
    """An assertion fails in the midst of the flight, where no integrator looks but the search for the meeting does."""
    model = MODELS["CompiledBalls"].replace("CompiledBalls", "Guarded")
    guarded = model.replace("equation\n", 'equation\n  assert(abs(one.r_0[1]) > 0.03, "one is too near");\n', 1)
    result = simulate(
        built_with_library(guarded),
        signals=SIGNALS,
        stop=1.0 / 50,
        interval=1.0 / 50,
        tolerance=1e-4,
        mode=mode,
    )
    told = [str(each) for each in result.log if "may have passed through each other" in each]
    assert len(told) == 1
    assert "one is too near" in told[0]


@pytest.mark.parametrize("part", [0.5, 0.505])
@pytest.mark.parametrize("model", SOME_MODELS)
def test_a_communication_point_at_which_bodies_lie_in_each_other_hides_nothing(built_with_library, model, part):
    """There the ball is in the middle of the other one, or a little beyond it, while the integrator's step goes on."""
    result = simulate(
        built_with_library(MODELS[model]), signals=SIGNALS, stop=1.0 / 50, interval=part / 50, tolerance=1e-4, mode="cs"
    )
    first, last = result.signals["one.v_0[1]"][-1], result.signals["other.v_0[1]"][-1]
    assert (first, last) == pytest.approx((0.0, 50.0), abs=0.5)


@pytest.mark.parametrize("mode", ["cs", "me"])
def test_a_rod_that_turns_fast_does_not_sweep_through_a_ball(built_with_library, mode):
    """Energy and the angular momentum about the joint stay."""
    for rate in (5.0, 200.0):
        names = ["joint.w", "rail.v", "rail.s"]
        flight = 1.0 / rate
        result = simulate(
            built_with_library(ROD),
            signals=names,
            stop=flight,
            interval=flight,
            tolerance=1e-4,
            mode=mode,
            parameters={"rate": rate},
        )
        w, v = result.signals["joint.w"][-1], result.signals["rail.v"][-1]
        inertia, arm, mass = 0.08 + 0.25, 0.9, 0.05
        # Of an elastic impact at the arm.
        expected = 2 * rate * arm * inertia / (inertia + mass * arm**2)
        assert v == pytest.approx(expected, rel=0.03)
        assert inertia * w**2 + mass * v**2 == pytest.approx(inertia * rate**2, rel=0.01)


@pytest.mark.full
@pytest.mark.parametrize("mode", ["cs", "me"])
def test_thin_plates_with_steps_of_their_own_stay_in_their_order(built_with_library, mode):
    names = [f"bodies.r[{i},1]" for i in range(1, 11)] + ["bodies.v[10,1]"]
    for speed in (10.0, 200.0):
        stop = 3.0 / speed
        result = simulate(
            built_with_library(PLATES),
            signals=names,
            stop=stop,
            interval=stop,
            tolerance=1e-5,
            mode=mode,
            parameters={"speed": speed},
        )
        places = [result.signals[name][-1] for name in names[:10]]
        assert places == sorted(places)
        assert result.signals["bodies.v[10,1]"][-1] == pytest.approx(speed, rel=0.05)


def test_another_importer_that_locates_events_goes_back_to_where_bodies_meet(built_with_library):
    result = simulate_fmu(
        str(built_with_library(MODELS["CompiledBalls"])),
        fmi_type="ModelExchange",
        output=SIGNALS,
        stop_time=0.02,
        output_interval=0.02,
        relative_tolerance=1e-5,
    )
    assert result["one.r_0[1]"][-1] < result["other.r_0[1]"][-1]
    assert result["other.v_0[1]"][-1] == pytest.approx(50, rel=0.02)


def test_an_importer_that_steps_over_a_meeting_is_told_of_it(built_with_library):
    """Steps of a fixed length, without a search for events: 50 mm each."""
    messages: list[str] = []
    with pytest.raises(FMICallException):
        simulate_fmu(
            str(built_with_library(MODELS["CompiledBalls"])),
            fmi_type="ModelExchange",
            solver="Euler",
            step_size=1e-3,
            output=SIGNALS,
            stop_time=0.02,
            output_interval=1e-3,
            logger=lambda *arguments: messages.append(str(arguments[-1])),
        )
    assert any("bodies 1 and 2 of contacts pass through each other" in message for message in messages)


def test_flights_that_miss_are_not_stopped(built_with_library):
    """The second body is out of the way: the step is as long as the flight."""
    result = simulate(
        built_with_library(MODELS["CompiledBalls"]),
        signals=["one.r_0[1]", "one.v_0[1]"],
        stop=0.02,
        interval=0.02,
        tolerance=1e-4,
        mode="cs",
        parameters={"other.r_0[2]": 0.0201},
    )
    assert result.signals["one.r_0[1]"][-1] == pytest.approx(0.5, abs=1e-6)
    assert result.counters.state_events == 0
