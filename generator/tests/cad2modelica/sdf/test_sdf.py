"""SDFormat: frames and masses against closed forms, joints, worlds with includes, and wrong input."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from cad2modelica import GenerateOptions, SourceChoices, generate, read_assembly
from cad2modelica.mechanism.model import GROUND, Assembly, JointType
from contact_foundation.errors import CmbError
from mechanics_simulation import ROOT, simulate
from scipy.spatial.transform import Rotation

INERTIAL = """<inertial><pose>{at} 0 0 0 0 0</pose><mass>{mass}</mass><inertia><ixx>1e-3</ixx><iyy>{inertia}</iyy>
<izz>{inertia}</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial>"""
PENDULUM = f"""<sdf version="1.9"><model name="double pendulum">
  <link name="b1"><pose>0 0 0 0 0.5 0</pose>{INERTIAL.format(at=0.25, mass=1, inertia=0.02)}</link>
  <link name="b2"><pose relative_to="r2"/>{INERTIAL.format(at=0.2, mass=0.7, inertia=0.01)}</link>
  <joint name="r1" type="revolute"><parent>world</parent><child>b1</child><axis><xyz>0 1 0</xyz></axis></joint>
  <joint name="r2" type="revolute"><pose relative_to="b1">0.5 0 0 0 0.2 0</pose><parent>b1</parent><child>b2</child>
    <axis><xyz>0 1 0</xyz></axis></joint>
</model></sdf>"""
BOX = "<{0} name='{0}'><geometry><box><size>0.1 0.1 0.1</size></box></geometry></{0}>"

SHAPE = "<collision name='c'><geometry>{}</geometry></collision>"


def link(name: str, inside: str = "", pose: str = "0 0 0 0 0 0") -> str:
    return f"<link name='{name}'><pose>{pose}</pose>{inside}</link>"


def model(content: str, version: str = "1.9", name: str = "m") -> str:
    return f"<sdf version='{version}'><model name='{name}'>{content}</model></sdf>"


def joint(kind: str, inside: str = "", ends: str = "<parent>a</parent><child>b</child>") -> str:
    return f"<joint name='j' type='{kind}'>{ends}{inside}</joint>"


def read(tmp_path: Path, text: str, choices: SourceChoices | None = None) -> Assembly:
    (tmp_path / "model.sdf").write_text(text)
    return read_assembly(tmp_path / "model.sdf", choices=choices or SourceChoices())


def refused(tmp_path: Path, text: str) -> str:
    with pytest.raises(CmbError) as caught:
        read(tmp_path, text)
    return str(caught.value)


@pytest.mark.full
def test_double_pendulum_agrees_with_openmodelica(tmp_path: Path) -> None:
    (tmp_path / "pendulum.sdf").write_text(PENDULUM)
    package = generate(tmp_path / "pendulum.sdf", tmp_path / "out")
    found = simulate(tmp_path / "out", package.mechanics, 1.0, 0.1)
    reference = np.genfromtxt(ROOT / "Resources" / "reference" / "DoublePendulum.csv", delimiter=",", names=True)
    # The reference falls with 9.80665 m/s2: angles agree where times are scaled.
    expected = np.interp(found.time * np.sqrt(9.81 / 9.80665), reference["time"], reference["r1phi"])
    rows = found.time <= 0.9
    np.testing.assert_allclose((found.columns["r1.phi"] + 0.5)[rows], expected[rows], atol=1e-4)


def test_frames_follow_what_they_stand_in(tmp_path: Path) -> None:
    text = model(
        link("a", pose="1 0 0 0 0 0")
        + "<frame name='f' attached_to='a'><pose>0 2 0 0 0 1.5707963267948966</pose></frame>"
        + "<frame name='g'><pose relative_to='f'>3 0 0 0 0 0</pose></frame>"
        + "<link name='b'><pose relative_to='g' degrees='true'>0 0 1 90 0 0</pose></link>"
        + "<link name='c'><pose relative_to='j' rotation_format='quat_xyzw'>0 0 0 0 0 0.6 0.8</pose></link>"
        + joint("ball", "<pose relative_to='b'>0 1 0 0 0 0</pose>")
        + "<model name='inner' placement_frame='y'><pose relative_to='a'>0 0 5 0 0 0</pose>"
        + link("x")
        + link("y", pose="0.5 0 0 0 0 0")
        + "</model>",
    )
    assembly = read(tmp_path, text)
    b = assembly.part("b").pose
    np.testing.assert_allclose(b.position, [1, 5, 1], atol=1e-12)
    np.testing.assert_allclose(b.rotation, Rotation.from_euler("ZX", [90, 90], degrees=True).as_matrix(), atol=1e-12)
    origin = b.position + b.rotation @ [0, 1, 0]
    np.testing.assert_allclose(assembly.joints[0].origin, origin, atol=1e-12)
    np.testing.assert_allclose(assembly.part("c").pose.position, origin, atol=1e-12)
    np.testing.assert_allclose(
        assembly.part("c").pose.rotation, b.rotation @ Rotation.from_quat([0, 0, 0.6, 0.8]).as_matrix(), atol=1e-12
    )
    np.testing.assert_allclose(assembly.part("inner::y").pose.position, [1, 0, 5], atol=1e-12)
    np.testing.assert_allclose(assembly.part("inner::x").pose.position, [0.5, 0, 5], atol=1e-12)


def test_what_would_change_the_motion_is_told(tmp_path: Path) -> None:
    decay = "<velocity_decay><linear>{}</linear><angular>0</angular></velocity_decay>"
    fluid = "<inertial><mass>1</mass><fluid_added_mass><xx>2</xx></fluid_added_mass></inertial>"
    axis = "<axis><xyz>0 0 1</xyz><initial_position>0.5</initial_position></axis>"
    links = link("a", decay.format("0.1") + fluid) + link("b", decay.format("0.0"))
    notes = read(tmp_path, model(links + joint("revolute", axis))).notes
    for words in ("'a': its velocity_decay", "'a': the mass that a fluid adds", "'j': initial_position is left out"):
        assert any(words in note for note in notes), words
    assert not any("'b': its velocity_decay" in note for note in notes)


@pytest.mark.parametrize(
    ("version", "inside", "expected"),
    [
        ("1.4", "<xyz>1 0 0</xyz>", [0, 1, 0]),  # in the model's frame
        ("1.6", "<xyz>1 0 0</xyz>", [0, 0, -1]),  # in the joint's, which is the child's
        ("1.6", "<xyz>1 0 0</xyz><use_parent_model_frame>true</use_parent_model_frame>", [0, 1, 0]),
        ("1.7", "<xyz expressed_in='__model__'>1 0 0</xyz>", [0, 1, 0]),
        ("1.7", "<xyz expressed_in='a'>0 1 0</xyz>", [-1, 0, 0]),
        ("1.11", "<xyz>1 0 0</xyz>", [0, 0, -1]),
    ],
)
def test_axes_by_version(tmp_path: Path, version: str, inside: str, expected: list[float]) -> None:
    quarter = "1.5707963267948966"
    text = model(
        f"<pose>0 0 0 0 0 {quarter}</pose>"
        + link("a")
        + link("b", pose=f"0 0 0 0 {quarter} 0")
        + joint("revolute", f"<axis>{inside}</axis>"),
        version,
    )
    axis = read(tmp_path, text).joints[0].axis
    assert axis is not None
    np.testing.assert_allclose(axis, expected, atol=1e-12)


def test_joints_are_kept_with_what_acts_on_them(tmp_path: Path) -> None:
    acting = (
        "<axis><xyz>0 0 2</xyz><limit><lower>-1</lower><upper>2</upper><effort>5</effort>"
        "<velocity>1e16</velocity></limit>"
        "<dynamics><damping>0.1</damping><friction>0.2</friction><spring_stiffness>3</spring_stiffness>"
        "<spring_reference>0.5</spring_reference></dynamics></axis>"
    )
    found = read(tmp_path, model(link("a") + link("b") + joint("revolute", acting))).joints[0]
    assert found.limits is not None
    assert (found.limits.lower, found.limits.upper) == (-1, 2)
    assert found.friction is not None
    assert (found.friction.viscous, found.friction.dry) == (0.1, 0.2)
    assert found.spring is not None
    assert (found.spring.stiffness, found.spring.rest) == (3, 0.5)
    assert found.rating is not None
    assert (found.rating.effort, found.rating.speed) == (5, None)
    unlimited = "<axis><xyz>1 0 0</xyz><limit><lower>-1.79769e+308</lower><upper>inf</upper></limit></axis>"
    assert read(tmp_path, model(link("a") + link("b") + joint("prismatic", unlimited))).joints[0].limits is None
    screw = "<axis><xyz>0 0 1</xyz></axis>"
    for pitch, expected in (
        ("<screw_thread_pitch>0.2</screw_thread_pitch>", 0.2),
        ("<thread_pitch>-4</thread_pitch>", np.pi / 2),
    ):
        text = model(link("a") + link("b") + joint("screw", screw + pitch), "1.11")
        assert read(tmp_path, text).joints[0].pitch == pytest.approx(expected)
    two = "<axis><xyz>1 0 0</xyz></axis><axis2><xyz>0 1 0</xyz></axis2>"
    universal = read(tmp_path, model(link("a") + link("b") + joint("universal", two)))
    assert [(item.parent, item.child) for item in universal.joints] == [("a", "j between"), ("j between", "b")]


def test_fixed_links_are_one_body_and_static_ones_stand(tmp_path: Path) -> None:
    text = model(
        link("a", BOX.format("collision") + INERTIAL.format(at=0, mass=2, inertia=0.1))
        + link("b", BOX.format("collision") + INERTIAL.format(at=0, mass=1, inertia=0.1), "3 0 0 0 0 0")
        + link("c", BOX.format("collision"))
        + link("d", INERTIAL.format(at=0, mass=1, inertia=0.1))
        + joint("fixed")
        + "<joint name='k' type='fixed'><parent>world</parent><child>c</child></joint>"
        + "<joint name='l' type='prismatic'><parent>c</parent><child>d</child><axis><xyz>0 0 1</xyz></axis></joint>"
    )
    assembly = read(tmp_path, text)
    assert [part.name for part in assembly.parts] == ["a", "c", "d"]
    assert assembly.part("a").mass_properties.mass == 3
    np.testing.assert_allclose(assembly.part("a").mass_properties.center_of_mass, [1, 0, 0], atol=1e-15)
    assert assembly.part("c").grounded
    assert assembly.joints[0].parent == "c"


def test_masses_from_density_are_exact(tmp_path: Path) -> None:
    shapes = {
        "<sphere><radius>0.2</radius></sphere>": 4 / 3 * np.pi * 0.2**3,
        "<cylinder><radius>0.1</radius><length>0.4</length></cylinder>": np.pi * 0.1**2 * 0.4,
        "<capsule><radius>0.1</radius><length>0.4</length></capsule>": np.pi * 0.1**2 * 0.4 + 4 / 3 * np.pi * 0.1**3,
        "<ellipsoid><radii>0.1 0.2 0.3</radii></ellipsoid>": 4 / 3 * np.pi * 0.1 * 0.2 * 0.3,
        "<cone><radius>0.1</radius><length>0.4</length></cone>": np.pi * 0.1**2 * 0.4 / 3,
    }
    for shape, volume in shapes.items():
        collision = f"<collision name='c'><density>500</density><geometry>{shape}</geometry></collision>"
        text = model(link("a", "<inertial auto='true'/>" + collision), "1.11")
        found = read(tmp_path, text).part("a").mass_properties
        assert found.mass == pytest.approx(500 * volume, rel=1e-12)
        height = -0.1 if "cone" in shape else 0.0
        np.testing.assert_allclose(found.center_of_mass, [0, 0, height], atol=1e-12)
    cone = found.inertia
    np.testing.assert_allclose(cone[2, 2], 0.3 * found.mass * 0.01, rtol=1e-12)
    np.testing.assert_allclose(cone[0, 0], found.mass * (0.15 * 0.01 + 3 / 80 * 0.16), rtol=1e-12)


def test_contacts_by_model_bits_and_friction(tmp_path: Path) -> None:
    surface = (
        "<surface><friction><ode><mu>{mu}</mu></ode></friction>"
        "<contact><collide_bitmask>{bits}</collide_bitmask></contact></surface>"
    )
    shape = "<geometry><sphere><radius>0.1</radius></sphere></geometry>"

    def ball(name: str, x: float, bits: str = "0xffff", mu: float = 0.4) -> str:
        inside = f"<collision name='c'>{shape}{surface.format(bits=bits, mu=mu)}</collision>"
        return link(name, inside + INERTIAL.format(at=0, mass=1, inertia=0.1), f"{x} 0 1 0 0 0")

    text = f"""<sdf version="1.9"><world name="w"><gravity>0 0 -1.6</gravity>
      <model name="floor"><static>true</static><link name="l"><collision name="c"><geometry><plane>
        <normal>0 0 1</normal></plane></geometry></collision></link></model>
      <model name="quiet">{ball("a", 0)}{ball("b", 1)}</model>
      <model name="loud"><self_collide>true</self_collide>{ball("a", 2)}{ball("b", 3, "0x02")}
        {ball("c", 4, "0x04", 0.7)}</model>
    </world></sdf>"""
    (tmp_path / "world.sdf").write_text(text)
    package = generate(tmp_path / "world.sdf", tmp_path / "out")
    scene = (tmp_path / "out" / "scene.json").read_text()
    pairs = {frozenset(pair) for pair in re.findall(r'"bodies":\["(\w+)","(\w+)"\]', scene)}
    assert frozenset(("quietA", "quietB")) not in pairs
    assert {frozenset(("loudA", "loudB")), frozenset(("quietA", "loudA")), frozenset(("loudC", "floorLPlane"))} <= pairs
    assert frozenset(("loudB", "loudC")) not in pairs
    mechanics = (package.root / "Mechanics.mo").read_text()
    assert "frictionRule=ContactMultiBody.Types.CombinationRule.Minimum" in mechanics
    assert "muStatic=0.7" in mechanics
    assert "g=1.6" in mechanics


@pytest.mark.parametrize(
    ("version", "inside", "expected"),
    [
        ("1.4", "<physics type='ode'><gravity>0 0 -1.62</gravity></physics>", [0, 0, -1.62]),
        ("1.5", "<physics><gravity>0 0 -1.62</gravity></physics><gravity>0 0 -3</gravity>", [0, 0, -3]),
        ("1.6", "<physics><gravity>0 0 -1.62</gravity></physics>", [0, 0, -9.8]),
        ("1.9", "", [0, 0, -9.8]),
    ],
)
def test_gravity_of_a_world(tmp_path: Path, version: str, inside: str, expected: list[float]) -> None:
    inner = (
        f"<world name='w'>{inside}<model name='m'>{link('a', INERTIAL.format(at=0, mass=1, inertia=1))}</model></world>"
    )
    assembly = read(tmp_path, f"<sdf version='{version}'>{inner}</sdf>")
    np.testing.assert_allclose(assembly.gravity, expected)
    told = any("gravity in the element physics" in note for note in assembly.notes)
    assert told == (inside != "" and version != "1.4")


def test_joint_to_a_standing_child_keeps_its_coordinates(tmp_path: Path) -> None:
    """Limits belong to the child against the parent; seen from the other side the axis points the other way."""
    limits = "<limit><lower>-0.2</lower><upper>1.5</upper></limit>"
    held = "<joint name='f' type='fixed'><parent>world</parent><child>b</child></joint>"
    links = link("a", INERTIAL.format(at=0, mass=1, inertia=1), "1 0 0 0 0 0") + link("b")
    hinge = joint("revolute", f"<axis><xyz>0 1 0</xyz>{limits}</axis>")
    (found,) = read(tmp_path, model(links + held + hinge)).joints
    assert (found.parent, found.child) == (GROUND, "a")
    assert found.axis is not None
    np.testing.assert_allclose(found.axis, [0, -1, 0], atol=1e-15)
    cross = joint("universal", f"<axis><xyz>0 1 0</xyz>{limits}</axis><axis2><xyz>1 0 0</xyz></axis2>")
    joints = {item.name: item for item in read(tmp_path, model(links + held + cross)).joints}
    first, second = joints["j"], joints["j second axis"]
    assert (second.parent, second.child, first.parent, first.child) == (GROUND, "j between", "j between", "a")
    assert first.axis is not None
    assert second.axis is not None
    np.testing.assert_allclose([first.axis, second.axis], [[0, -1, 0], [-1, 0, 0]], atol=1e-15)


def test_a_world_includes_models(tmp_path: Path) -> None:
    store = tmp_path / "store"
    (store / "ball").mkdir(parents=True)
    (store / "ball" / "model.config").write_text(
        "<model><sdf version='1.4'>old.sdf</sdf><sdf version='1.9'>new.sdf</sdf></model>"
    )
    (store / "ball" / "new.sdf").write_text(model(link("l", BOX.format("collision"), "0 0 0.5 0 0 0"), name="ball"))
    include = "<include><uri>model://ball</uri><name>{0}</name><pose>{1} 0 0 0 0 0</pose></include>"
    text = f"<sdf version='1.9'><world name='w'>{include.format('one', 1)}{include.format('two', 2)}</world></sdf>"
    (tmp_path / "world").mkdir()
    assembly = read(tmp_path / "world", text, SourceChoices(package_paths=(store,)))
    assert [part.name for part in assembly.parts] == ["one::l", "two::l"]
    np.testing.assert_allclose(assembly.part("two::l").pose.position, [2, 0, 0.5])
    with pytest.raises(CmbError, match="'ball', which does not exist"):
        read(tmp_path / "world", text)
    left_out = read(tmp_path / "world", text.replace("</world>", f"<model name='x'>{link('k')}</model></world>"),
                    SourceChoices(allow_missing=True))  # fmt: skip
    assert [part.name for part in left_out.parts] == ["x::k"]
    assert "nothing is fetched" in refused(tmp_path / "world", text.replace("model://ball", "https://fuel.org/ball"))


def test_loops_are_closed_by_joints(tmp_path: Path) -> None:
    axis = "<axis><xyz>0 1 0</xyz></axis>"
    text = model(
        "".join(link(name, INERTIAL.format(at=0, mass=1, inertia=0.1), pose) for name, pose in (
            ("a", "0 0 0 0 0 0"), ("b", "0 0 0.2 0 0 0"), ("c", "0.5 0 0 0 0 0")))
        + f"<joint name='r' type='revolute'><parent>world</parent><child>a</child>{axis}</joint>"
        + f"<joint name='s' type='revolute'><parent>a</parent><child>b</child>{axis}</joint>"
        + f"<joint name='t' type='revolute'><parent>world</parent><child>c</child>{axis}</joint>"
        + f"<joint name='u' type='revolute'><parent>b</parent><child>c</child><pose>0 0 0.3 0 0 0</pose>{axis}</joint>"
    )  # fmt: skip
    (tmp_path / "loop.sdf").write_text(text)
    notes = generate(tmp_path / "loop.sdf", tmp_path / "out").notes
    assert any("'u' closes a kinematic loop (planar" in note for note in notes)


def test_comments_that_xml_forbids_are_read(tmp_path: Path) -> None:
    text = f"<?xml version='1.0'?><!-- gz -- <world> \n --><sdf version='1.9'><model name='m'>{link('a')}</model></sdf>"
    assert [part.name for part in read(tmp_path, text).parts] == ["a"]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (model(link("a") + link("b") + joint("hinge")), "type 'hinge' are not known"),
        (model(link("a") + link("b") + joint("revolute")), "has no axis"),
        (model(link("a") + link("b") + joint("revolute", "<axis><xyz>0 0 0</xyz></axis>")), "zero vector"),
        (model(link("a") + link("a")), "'a' is not"),
        (model(link("a") + joint("ball")), "names b, which does not exist"),
        (model("<link name='a'><pose relative_to='q'>0 0 0 0 0 0</pose></link>"), "names q, which does not exist"),
        (
            model("<frame name='f'><pose relative_to='g'/></frame><frame name='g'><pose relative_to='f'/></frame>"
                  "<link name='a'><pose relative_to='f'/></link>"),
            "stands in itself",
        ),
        (model(link("a", pose="0 0 0 0 0")), "must be 6 finite numbers"),
        (model(link("a", "<inertial><mass>0</mass></inertial>")), "must be positive"),
        (model(link("a", SHAPE.format("<box><size>1 -1 1</size></box>"))), "a box needs positive lengths"),
        (model(link("a", SHAPE.format("<cylinder><radius>0</radius></cylinder>"))), "a cylinder needs positive"),
        (model("<static>true</static>" + link("a", BOX.format("collision"))), "holds no link that moves"),
        (model(link("a"), "2.0"), "is SDFormat '2.0'"),
        ("<sdf version='1.9'/>", "holds no model"),
        (model(link("a", "<visual name='v'><geometry><mesh><uri>../x.stl</uri></mesh></geometry></visual>")), "leaves"),
        ("<!DOCTYPE s [<!ENTITY e 'x'>]><sdf version='1.9'>&e;</sdf>", "document type"),
    ],
)  # fmt: skip
def test_wrong_descriptions_are_refused(tmp_path: Path, text: str, message: str) -> None:
    assert message in refused(tmp_path, text)


def test_strict_refuses_what_is_left_out(tmp_path: Path) -> None:
    text = model(link("a", "<gravity>false</gravity>") + "<plugin name='p' filename='f'/>")
    (tmp_path / "model.sdf").write_text(text)
    assert generate(tmp_path / "model.sdf", tmp_path / "out").notes
    with pytest.raises(CmbError, match="gravity is switched off"):
        generate(tmp_path / "model.sdf", tmp_path / "strict", GenerateOptions(strict=True))
    assert GROUND not in [joint.child for joint in read(tmp_path, text).joints]
    assert not [joint for joint in read(tmp_path, text).joints if joint.type is JointType.FREE]
