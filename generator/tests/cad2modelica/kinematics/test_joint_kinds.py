"""Screws, end stops, friction, and flexible instances: motion by closed forms, and wrong descriptions."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from assembly_text import joint, part, write_assembly
from cad2modelica import generate, read_assembly
from cad2modelica.modelica.text import number
from contact_foundation.errors import InputError
from mechanics_simulation import Trajectory, simulate
from scipy.integrate import solve_ivp

LEAD = 0.05 / (2 * np.pi)


@pytest.fixture(scope="module")
def moved(tmp_path_factory: pytest.TempPathFactory) -> Trajectory:
    """A nut on a vertical spindle, the same the other way round, a sled between stops, wheels with friction."""
    folder = tmp_path_factory.mktemp("kinds")
    turn = ((0.0, 0.6, 0.8), 0.7)
    round_body = {"mass": 0.5, "inertia": (2e-4, 2e-4, 2e-4)}
    parts = [
        part("nut", position=(1, 0, 2), turn=turn, **round_body),
        part("bolt", position=(2, 0, 2), turn=turn, **round_body),
        part("carrier", position=(2, 0, 1.5), mass=3.0),
        part("sled", position=(0, 3, 0), mass=2.0),
        part("wheel", position=(0, 5, 0)),
        part("disc", position=(0, 6, 0)),
    ]
    steep = (0, 0, 1)
    joints = [
        joint("spindle", "screw", "ground", "nut", origin=(1, 0, 1), axis=steep, pitch=0.05, start='position="0.4"'),
        joint("lift", "prismatic", "ground", "carrier", origin=(2, 0, 0), axis=(1, 0, 0), start='speed="0.5"'),
        joint("thread", "screw", "carrier", "bolt", origin=(2, 0, 2), axis=steep, pitch=-0.05, start='speed="2"'),
        joint(
            "rail",
            "prismatic",
            "ground",
            "sled",
            axis=(1, 0, 0),
            start='speed="2"',
            extra='<limits upper="0.3" lower="-1" stiffness="800" damping="0"/>',
        ),
        joint(
            "axle", "revolute", "ground", "wheel", axis=(0, 1, 0), start='speed="3"', extra='<friction viscous="0.02"/>'
        ),
        joint("pin", "revolute", "ground", "disc", axis=(0, 1, 0), start='speed="3"', extra='<friction dry="0.005"/>'),
    ]
    package = generate(write_assembly(folder / "kinds.xml", parts, joints), folder / "out")
    return simulate(folder / "out", package.mechanics, 0.8, 0.02, tolerance=1e-9)


def test_screw_falls_as_its_lead_says(moved: Trajectory) -> None:
    """(J + m lead^2) phi'' = -m g lead, and the way along the axis is lead phi."""
    acceleration = -0.5 * 9.81 * LEAD / (2e-4 + 0.5 * LEAD**2)
    expected = 0.4 + acceleration * moved.time**2 / 2
    np.testing.assert_allclose(moved.columns["spindle.phi"], expected, atol=1e-6)
    height = 2 + LEAD * (expected - 0.4)
    position = moved.vector("nut.frame_a.r_0")
    np.testing.assert_allclose(position[:, 2], height, atol=1e-8)
    np.testing.assert_allclose(position[:, :2], np.tile([1, 0], (len(height), 1)), atol=1e-9)


def test_left_hand_screw_on_a_moving_part(moved: Trajectory) -> None:
    acceleration = 0.5 * 9.81 * LEAD / (2e-4 + 0.5 * LEAD**2)
    expected = 2 * moved.time + acceleration * moved.time**2 / 2
    np.testing.assert_allclose(moved.columns["thread.phi"], expected, atol=1e-6)
    position = moved.vector("bolt.frame_a.r_0")
    np.testing.assert_allclose(position[:, 2], 2 - LEAD * expected, atol=1e-8)
    np.testing.assert_allclose(position[:, 0], 2 + 0.5 * moved.time, atol=1e-7)


def test_sled_comes_back_from_its_stop(moved: Trajectory) -> None:
    """At 0.3 m after 0.15 s; half an oscillation later back with -2 m/s."""
    frequency = np.sqrt(800 / 2.0)
    leaves = 0.15 + np.pi / frequency
    after = moved.time > leaves + 0.01
    np.testing.assert_allclose(moved.columns["rail.s"][after], 0.3 - 2 * (moved.time[after] - leaves), atol=1e-4)
    assert moved.columns["rail.s"].max() == pytest.approx(0.3 + 2 / frequency, abs=2e-3)


def test_friction_slows_down(moved: Trajectory) -> None:
    np.testing.assert_allclose(moved.columns["axle.w"], 3 * np.exp(-0.02 / 0.01 * moved.time), atol=1e-6)
    np.testing.assert_allclose(moved.columns["pin.w"], 3 - 0.005 / 0.01 * moved.time, atol=1e-5)


def test_stop_without_numbers_is_laid_out_for_what_it_stops(tmp_path: Path) -> None:
    """20 Hz of everything behind the joint, and a blow that gives back about half of 1 rad/s."""
    parts = [part("arm", mass=2.0), part("hand", position=(0.5, 0, 0), mass=1.0)]
    joints = [
        joint("elbow", "revolute", "ground", "arm", axis=(0, 0, 1), extra='<limits upper="1.5"/>'),
        joint("wrist", "revolute", "arm", "hand", origin=(0.5, 0, 0), axis=(0, 0, 1)),
    ]
    text = (
        generate(write_assembly(tmp_path / "arm.xml", parts, joints), tmp_path / "out").root / "Mechanics.mo"
    ).read_text()
    inertia = 0.01 + 0.01 + 1.0 * 0.5**2
    stiffness = float(f"{inertia * (2 * np.pi * 20) ** 2:.3g}")
    assert f"c={number(stiffness)}," in text
    assert "phi_max=1.5" in text
    assert "phi_min" not in text

    def blow(_time: float, state: np.ndarray) -> list[float]:
        return [state[1], -stiffness / inertia * max(state[0], 0) * (1 + 0.75 * state[1])]

    end = solve_ivp(blow, (0, 0.026), [0.0, 1.0], rtol=1e-10, atol=1e-12).y[1, -1]
    assert 0.4 < -end < 0.75


def flexible(folder: Path, instance: str, frame: str = "assembly") -> Path:
    """A definition of two links at a joint in the definition's coordinates, and one instance of it."""
    links = part("upper") + part("lower", position=(0.4, 0, 0))
    hinge = joint("hinge", "revolute", "upper", "lower", origin=(0.4, 0, 0), axis=(0, 0, 1))
    hinge = hinge.replace("<origin>", f'<origin frame="{frame}">')
    file = folder / "flexible.xml"
    file.write_text(
        f"""<assembly xmlns="urn:contactmultibody:assembly:1" name="Flexible">
        <units length="m" mass="kg" angle="deg"/><gravity>0 0 0</gravity>
        <definitions><definition name="chain"><parts>{links}</parts><joints>{hinge}</joints></definition></definitions>
        <instances>{instance}</instances></assembly>"""
    )
    return file


QUARTER = '<axisAngle axis="0 0 1" angle="90"/>'


def test_flexible_instance_moves_joints_with_their_parent(tmp_path: Path) -> None:
    """The instance turned by 90 degrees; in it the upper link lifted, the lower one bent by 90 degrees."""
    instance = f"""<instance name="left" of="chain">
        <pose><position>1 0 0</position>{QUARTER}</pose>
        <placement part="upper"><pose><position>0 0 2</position></pose></placement>
        <placement part="lower"><pose><position>0.4 0 2</position>{QUARTER}</pose></placement>
        <jointStart joint="hinge" position="90" speed="10"/></instance>"""
    assembly = read_assembly(flexible(tmp_path, instance))
    np.testing.assert_allclose(assembly.part("left/upper").pose.position, [1, 0, 2], atol=1e-12)
    np.testing.assert_allclose(assembly.part("left/lower").pose.position, [1, 0.4, 2], atol=1e-12)
    np.testing.assert_allclose(assembly.part("left/lower").pose.rotation, np.diag([-1.0, -1.0, 1.0]), atol=1e-12)
    hinge = assembly.joints[0]
    np.testing.assert_allclose(hinge.origin, [1, 0.4, 2], atol=1e-12)
    assert hinge.position == pytest.approx(np.pi / 2)
    assert hinge.speed == pytest.approx(np.radians(10))


def test_same_definition_stiff_and_flexible(tmp_path: Path) -> None:
    instance = """<instance name="a" of="chain"/>
        <instance name="b" of="chain"><pose><position>0 5 0</position></pose>
        <placement part="lower"><pose><position>0.4 0 0</position></pose></placement></instance>"""
    assembly = read_assembly(flexible(tmp_path, instance))
    shift = assembly.part("b/lower").pose.position - assembly.part("a/lower").pose.position
    np.testing.assert_allclose(shift, [0, 5, 0], atol=1e-12)
    np.testing.assert_allclose(assembly.joints[1].origin - assembly.joints[0].origin, [0, 5, 0], atol=1e-12)


def test_joint_beside_a_flexible_instance_stays_where_it_is_said_to_be(tmp_path: Path) -> None:
    """What lists the instance knows where it has placed the part; its own coordinates do not move."""
    instance = f"""<instance name="a" of="chain">
        <placement part="upper"><pose><position>0 0 2</position>{QUARTER}</pose></placement></instance>"""
    file = flexible(tmp_path, instance)
    outside = joint("pin", "revolute", "a/upper", "a/lower", origin=(0.1, 0.2, 2), axis=(1, 0, 0))
    file.write_text(
        file.read_text().replace("</instances></assembly>", f"</instances><joints>{outside}</joints></assembly>")
    )
    pin = next(item for item in read_assembly(file).joints if item.name == "pin")
    np.testing.assert_allclose(pin.origin, [0.1, 0.2, 2], atol=1e-12)
    assert pin.axis is not None
    np.testing.assert_allclose(pin.axis, [1, 0, 0], atol=1e-12)


def test_joint_knows_the_placements_of_its_own_definition_only(tmp_path: Path) -> None:
    """The outer assembly places the upper link again; the middle one's joint is where that one had put the link."""
    placement = '<placement part="a/upper"><pose><position>0 0 9</position></pose></placement>'
    instance = f'<instance name="outer" of="middle">{placement}</instance>'
    file = flexible(tmp_path, instance)
    bolt = joint("bolt", "revolute", "a/upper", "a/lower", origin=(0.1, 0, 2.5), axis=(1, 0, 0))
    middle = f"""<definition name="middle"><instances><instance name="a" of="chain"><placement part="upper">
        <pose><position>0 0 2</position></pose></placement></instance></instances>
        <joints>{bolt}</joints></definition>"""
    file.write_text(file.read_text().replace("</definitions>", f"{middle}</definitions>"))
    origins = {item.name: item.origin for item in read_assembly(file).joints}
    np.testing.assert_allclose(origins["outer/bolt"], [0.1, 0, 9.5], atol=1e-12)
    np.testing.assert_allclose(origins["outer/a/hinge"], [0.4, 0, 9], atol=1e-12)


def test_placed_part_stays_the_body_that_it_is(tmp_path: Path) -> None:
    """Its inertia in the definition's axes is meant with the definition's pose, and so is a spin at a joint."""
    instances = f"""<instance name="a" of="chain"/><instance name="b" of="chain">
        <placement part="upper"><pose>{QUARTER}</pose></placement>
        <placement part="lower"><pose><position>0 0.4 0</position>{QUARTER}</pose></placement></instance>"""
    file = flexible(tmp_path, instances)
    text = file.read_text().replace('axes="part"', 'axes="assembly"').replace('xx="0.01"', 'xx="0.015"')
    file.write_text(
        text.replace('type="revolute"', 'type="spherical"')
        .replace("<axis>0.0 0.0 1.0</axis>", '<start angularVelocity="30 0 0"/>')
    )  # fmt: skip
    assembly = read_assembly(file)
    for name in ("a/lower", "b/lower"):
        np.testing.assert_allclose(
            assembly.part(name).mass_properties.inertia, np.diag([0.015, 0.01, 0.01]), atol=1e-15
        )
    spins = [item.angular_velocity for item in assembly.joints]
    np.testing.assert_allclose(spins, np.radians([[30, 0, 0], [0, 30, 0]]), atol=1e-12)


@pytest.mark.parametrize(
    ("inside", "words"),
    [
        ('<placement part="middle"><pose/></placement>', "names 'x/middle', which does not exist"),
        ('<jointStart joint="knee" position="3"/>', "names 'x/knee', which does not exist"),
        ('<jointStart joint="hinge" velocity="1 0 0"/>', "the start of a revolute joint has no velocity"),
    ],
)
def test_wrong_flexible_instances(tmp_path: Path, inside: str, words: str) -> None:
    file = flexible(tmp_path, f'<instance name="x" of="chain">{inside}</instance>')
    with pytest.raises(InputError) as caught:
        read_assembly(file)
    assert words in str(caught.value)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"kind": "screw"}, "needs a pitch"),
        ({"kind": "screw", "pitch": 0.0}, "needs a pitch"),
        ({"kind": "revolute", "pitch": 0.1}, "has no pitch"),
        ({"kind": "cylindrical", "extra": '<limits upper="1"/>'}, "a cylindrical joint has no limits"),
        ({"kind": "planar", "extra": '<friction dry="1"/>'}, "a planar joint has no friction"),
        ({"kind": "revolute", "extra": '<limits lower="2" upper="1"/>'}, "the lower must be smaller"),
        ({"kind": "revolute", "start": 'position="2"', "extra": '<limits upper="1"/>'}, "starts at 2, outside"),
        ({"kind": "revolute", "extra": '<friction dry="-1"/>'}, "dry"),
    ],
)
def test_wrong_joints(tmp_path: Path, arguments: dict[str, object], words: str) -> None:
    kind = str(arguments.pop("kind"))
    wrong = joint("j", kind, "ground", "a", axis=(0, 0, 1), **arguments)  # type: ignore[arg-type]
    with pytest.raises(InputError) as caught:
        read_assembly(write_assembly(tmp_path / "wrong.xml", [part("a")], [wrong]))
    assert words in str(caught.value)
