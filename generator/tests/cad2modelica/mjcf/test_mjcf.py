"""MJCF: against closed forms, against MuJoCo where it is installed, and wrong input."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from cad2modelica import GenerateOptions, generate, read_assembly
from cad2modelica.geometry.primitive_meshes import Surface, box_surface
from cad2modelica.mechanism.model import Assembly, JointType
from contact_foundation.errors import CmbError, InputError
from mechanics_simulation import ROOT, simulate
from scipy.spatial.transform import Rotation

PENDULUM = """<mujoco model="double pendulum">
  <compiler angle="radian"/>
  <worldbody>
    <body name="b1" euler="0 0.5 0">
      <joint name="r1" axis="0 1 0"/>
      <inertial pos="0.25 0 0" mass="1" diaginertia="1e-3 0.02 0.02"/>
      <body name="b2" pos="0.5 0 0" euler="0 0.2 0">
        <joint name="r2" axis="0 1 0"/>
        <inertial pos="0.2 0 0" mass="0.7" diaginertia="1e-3 0.01 0.01"/>
      </body>
    </body>
  </worldbody>
</mujoco>
"""

# One of everything that says where something is, or what it weighs.
EVERYTHING = """<mujoco model="everything">
  <compiler angle="degree" eulerseq="zYx" autolimits="true"/>
  <default>
    <geom density="700" rgba="1 0 0 1"/>
    <joint damping="0.2" armature="0.01"/>
    <default class="thin">
      <geom type="capsule" size="0.02"/>
      <joint axis="0 1 0" range="-30 60"/>
      <default class="heavy"><geom density="8000"/></default>
    </default>
  </default>
  <asset>
    <mesh name="wedge" vertex="0 0 0  0.1 0 0  0 0.2 0  0 0 0.3" scale="1 2 0.5" refpos="0.01 0.02 0.03"
          refquat="0.8 0 0.6 0" inertia="exact" face="0 2 1  0 1 3  0 3 2  1 2 3"/>
    <mesh name="hull" vertex="0 0 0  0.1 0 0  0 0.2 0  0 0 0.3  0.1 0.2 0.3" inertia="convex"/>
  </asset>
  <worldbody>
    <geom name="floor" type="plane" size="1 1 0.1" pos="0 0 -0.5" zaxis="0 0.1 1"/>
    <body name="base" pos="0.1 0.2 0.3" axisangle="1 1 0 40">
      <geom type="box" size="0.1 0.1 0.02"/>
      <body name="arm" pos="0 0 0.1" euler="10 20 30" childclass="thin">
        <joint name="hinge" pos="0.01 0.02 0.03"/>
        <joint name="slide" type="slide" axis="1 2 2" range="-0.1 0.2" ref="0.05"/>
        <geom name="bone" fromto="0 0 0 0.1 0.2 0.3"/>
        <geom name="knob" class="heavy" type="ellipsoid" size="0.03 0.04 0.05" pos="0.1 0.2 0.3" xyaxes="1 1 0 0 1 1"/>
        <geom name="cup" type="cylinder" size="0.02 0.04" quat="0.5 0.5 -0.5 0.5" mass="0.3"/>
        <body name="plate" pos="0.1 0 0">
          <geom type="box" size="0.02" fromto="0.2 0 0 0.3 0.1 0"/>
          <frame pos="0 0.3 0" euler="0 0 90">
            <body name="tip" pos="0.1 0 0">
              <joint name="ball" type="ball" pos="0 0 0.02" range="0 80"/>
              <geom type="sphere" size="0.05"/>
              <geom type="mesh" mesh="wedge" pos="0 0 0.1" euler="0 45 0"/>
            </body>
          </frame>
        </body>
      </body>
    </body>
    <replicate count="3" sep="-" offset="0 0.3 0" euler="0 0 30">
      <body name="loose" pos="1 0 0.5"><freejoint/><geom type="mesh" mesh="hull" density="500"/></body>
    </replicate>
  </worldbody>
</mujoco>
"""


def read(tmp_path: Path, text: str, name: str = "model.xml") -> Assembly:
    (tmp_path / name).write_text(text)
    return read_assembly(tmp_path / name)


def refused(tmp_path: Path, text: str) -> str:
    with pytest.raises(CmbError) as caught:
        read(tmp_path, text)
    return str(caught.value)


def body(content: str, *, sections: str = "") -> str:
    return f"<mujoco>{sections}<worldbody><body name='b'>{content}</body></worldbody></mujoco>"


@pytest.mark.full
def test_double_pendulum_agrees_with_openmodelica(tmp_path: Path) -> None:
    (tmp_path / "pendulum.xml").write_text(PENDULUM)
    package = generate(tmp_path / "pendulum.xml", tmp_path / "out")
    found = simulate(tmp_path / "out", package.mechanics, 1.0, 0.1)
    reference = np.genfromtxt(ROOT / "Resources" / "reference" / "DoublePendulum.csv", delimiter=",", names=True)
    # The reference falls with 9.80665 m/s2: speeds agree where times are scaled.
    scaled = np.interp(found.time * np.sqrt(9.81 / 9.80665), reference["time"], reference["r1phi"])
    rows = found.time <= 0.9
    np.testing.assert_allclose((found.columns["r1.phi"] + 0.5)[rows], scaled[rows], atol=1e-4)


def test_places_and_masses_agree_with_mujoco(tmp_path: Path) -> None:
    mujoco = pytest.importorskip("mujoco", reason="MuJoCo is not installed: pip install mujoco")
    assembly = read(tmp_path, EVERYTHING)
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "model.xml"))
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    moving = [name for name in ("arm", "tip", "loose-0", "loose-1", "loose-2")]
    for name in moving:
        index = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, name)
        group = [number for number in range(1, model.nbody) if model.body_weldid[number] == index]
        part = assembly.part(name)
        np.testing.assert_allclose(part.pose.position, data.xpos[index], atol=1e-9)
        np.testing.assert_allclose(part.pose.rotation, data.xmat[index].reshape(3, 3), atol=1e-9)
        mass = model.body_mass[group].sum()
        center = model.body_mass[group] @ data.xipos[group] / mass
        inertia = np.zeros((3, 3))
        for number in group:
            turn = data.ximat[number].reshape(3, 3)
            arm = data.xipos[number] - center
            inertia += turn @ np.diag(model.body_inertia[number]) @ turn.T
            inertia += model.body_mass[number] * (arm @ arm * np.eye(3) - np.outer(arm, arm))
        found = part.mass_properties
        # MuJoCo keeps the corners of meshes in single precision.
        assert found.mass == pytest.approx(mass, rel=1e-6)
        np.testing.assert_allclose(part.pose.point(found.center_of_mass), center, atol=1e-7)
        turned = part.pose.rotation @ found.inertia @ part.pose.rotation.T
        np.testing.assert_allclose(turned, inertia, atol=1e-6 * np.abs(inertia).max())
    for joint in assembly.joints:
        index = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, joint.name)
        if index >= 0 and joint.type is not JointType.FREE:
            np.testing.assert_allclose(joint.origin, data.xanchor[index], atol=1e-9)
        if index >= 0 and joint.axis is not None:
            np.testing.assert_allclose(joint.axis, data.xaxis[index], atol=1e-9)


def test_what_is_known_without_mujoco(tmp_path: Path) -> None:
    assembly = read(tmp_path, EVERYTHING)
    joints = {joint.name: joint for joint in assembly.joints}
    assert [part.name for part in assembly.parts if part.grounded] == ["base"]
    # Two joints of one body: a part without mass stands between them.
    assert (joints["hinge"].parent, joints["hinge"].child) == ("base", "arm between 1")
    assert (joints["slide"].parent, joints["slide"].child) == ("arm between 1", "arm")
    assert joints["slide"].position == 0.05
    limits = joints["hinge"].limits
    assert limits is not None
    np.testing.assert_allclose([limits.lower, limits.upper], np.radians([-30, 60]))
    assert joints["hinge"].rotor_inertia == 0.01
    # The ellipsoid's class is heavy, and inside the capsule's.
    knob = 8000 * 4 / 3 * np.pi * 0.03 * 0.04 * 0.05
    capsule = 700 * np.pi * 0.02**2 * (np.sqrt(0.14) + 4 / 3 * 0.02)
    plate = 700 * 8 * 0.02 * 0.02 * np.sqrt(0.02) / 2
    assert assembly.part("arm").mass_properties.mass == pytest.approx(knob + 0.3 + capsule + plate, rel=1e-12)
    hull = assembly.part("loose-1").mass_properties
    assert hull.mass == assembly.part("loose-0").mass_properties.mass
    # Copies are displaced one after the other; the last of the angles is that about x.
    step = np.array([0, 0.3, 0])
    turn = np.array([[1, 0, 0], [0, np.sqrt(3) / 2, -0.5], [0, 0.5, np.sqrt(3) / 2]])
    expected = step + turn @ (step + turn @ np.array([1, 0, 0.5]))
    np.testing.assert_allclose(assembly.part("loose-2").pose.position, expected, atol=1e-12)
    plane = assembly.planes[0]
    np.testing.assert_allclose(plane.normal, np.array([0, 0.1, 1]) / np.hypot(0.1, 1))


def test_spring_and_rotor_make_an_oscillator(tmp_path: Path) -> None:
    text = """<mujoco><option gravity="0 0 0"/><worldbody><body name="wheel">
      <joint name="shaft" stiffness="5" springref="10" armature="0.03"/>
      <inertial pos="0 0 0" mass="1" diaginertia="0.01 0.01 0.02"/></body></worldbody></mujoco>"""
    (tmp_path / "wheel.xml").write_text(text)
    package = generate(tmp_path / "wheel.xml", tmp_path / "out")
    found = simulate(tmp_path / "out", package.mechanics, 1.0, 0.05)
    expected = np.radians(10) * (1 - np.cos(np.sqrt(5 / 0.05) * found.time))
    np.testing.assert_allclose(found.columns["shaft.phi"], expected, atol=1e-7)


def test_time_spring_counts_what_the_joint_moves_while_the_others_are_free(tmp_path: Path) -> None:
    """By the inverse mass matrix: of two slides in a row the second one sees both masses in series."""
    text = """<mujoco><worldbody><body><joint name="first" type="slide" axis="1 0 0"/>
      <inertial pos="0 0 0" mass="2" diaginertia="1 1 1"/>
      <body><joint name="second" type="slide" axis="1 0 0" springdamper="0.5 0.2" stiffness="9" damping="9"/>
      <inertial pos="0 0 0" mass="6" diaginertia="1 1 1"/></body></body></worldbody></mujoco>"""
    joint = {joint.name: joint for joint in read(tmp_path, text).joints}["second"]
    assert joint.spring is not None
    assert joint.friction is not None
    reduced = 2 * 6 / (2 + 6)
    assert joint.spring.stiffness == pytest.approx(reduced / (0.5 * 0.2) ** 2)
    assert joint.friction.viscous == pytest.approx(2 * reduced / 0.5)


def test_damping_ratio_of_a_position_actuator_is_that_of_the_joint(tmp_path: Path) -> None:
    text = body(
        "<joint name='j'/><inertial pos='0 0 0' mass='1' diaginertia='1 1 5'/>",
        sections="<actuator><position joint='j' kp='40' dampratio='0.7' gear='3'/></actuator>",
    )
    (drive,) = read(tmp_path, text).drives
    stiffness, damping = drive.parameters["c"], drive.parameters["d"]
    assert stiffness == pytest.approx(40 * 3**2)
    assert damping == pytest.approx(2 * 0.7 * np.sqrt(stiffness * 5))


def test_copies_turn_by_multiples_of_their_angles(tmp_path: Path) -> None:
    text = """<mujoco><compiler angle="radian"/><worldbody>
      <replicate count="3" offset="0.1 0.2 0.3" euler="0.3 0.4 0.5">
      <body name="b"><joint/><geom size="0.1"/></body></replicate></worldbody></mujoco>"""
    assembly = read(tmp_path, text)

    def turn(number: int) -> np.ndarray:
        return Rotation.from_euler("XYZ", number * np.array([0.3, 0.4, 0.5])).as_matrix()

    offset = np.array([0.1, 0.2, 0.3])
    place = np.zeros(3)
    for number in range(3):
        pose = assembly.part(f"b{number}").pose
        np.testing.assert_allclose(pose.rotation, turn(number), atol=1e-15)
        np.testing.assert_allclose(pose.position, place, atol=1e-15)
        place = place + turn(number) @ offset


def test_bodies_that_stand_have_their_share_in_the_total_mass(tmp_path: Path) -> None:
    text = """<mujoco><compiler settotalmass="7"/><worldbody><geom size="0.3"/><body><geom size="0.2"/></body>
      <body name="b"><joint/><geom size="0.2"/></body></worldbody></mujoco>"""
    assert read(tmp_path, text).part("b").mass_properties.mass == pytest.approx(3.5)


@pytest.mark.parametrize("geom", ["", "<geom size='1' group='4'/>", "<geom size='1' mass='0'/>"])
def test_inertial_counts_where_no_geom_weighs_anything(tmp_path: Path, geom: str) -> None:
    sections = "<compiler inertiafromgeom='true' inertiagrouprange='0 3'/>"
    inertial = "<inertial pos='0.1 0 0' mass='2' diaginertia='1 1 1'/>"
    found = read(tmp_path, body(f"<joint/>{geom}{inertial}", sections=sections)).part("b").mass_properties
    assert found.mass == 2.0
    np.testing.assert_allclose(found.center_of_mass, [0.1, 0, 0])


@pytest.mark.parametrize(
    ("geom", "size"),
    [
        ("sphere", (0.2, 0, 0)),
        ("box", (0.1, 0.2, 0.3)),
        ("cylinder", (0.1, 0.2, 0)),
        ("capsule", (0.1, 0.2, 0)),
        ("ellipsoid", (0.2, 0.2, 0.2)),
    ],
)
def test_shells_weigh_by_their_surface(tmp_path: Path, geom: str, size: tuple[float, float, float]) -> None:
    """Against sums over a fine triangulation; general ellipsoids are an approximation, as in MuJoCo."""
    words = " ".join(str(value) for value in size if value)
    text = body(f"<joint/><geom type='{geom}' size='{words}' shellinertia='true' density='100'/>")
    found = read(tmp_path, text).part("b").mass_properties
    vertices, triangles = surface_of(geom, size)
    corners = vertices[triangles]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    assert found.mass == pytest.approx(100 * areas.sum(), rel=2e-3)
    sums = corners.sum(axis=1)
    products = np.einsum("t,tci,tcj->ij", areas, corners, corners) + np.einsum("t,ti,tj->ij", areas, sums, sums)
    expected = 100 * (np.trace(products) * np.eye(3) - products) / 12
    np.testing.assert_allclose(found.inertia, expected, rtol=4e-3, atol=1e-9)


def surface_of(geom: str, size: tuple[float, float, float]) -> Surface:
    if geom == "box":
        return box_surface(2 * np.array(size))
    if geom in ("sphere", "ellipsoid"):
        return fine_surface(size[0], 0.0, caps=False)
    return fine_surface(size[0], size[1], caps=geom == "cylinder")


def fine_surface(radius: float, half: float, *, caps: bool) -> Surface:
    """A sphere pulled apart along z by twice ``half``; with caps a tube with two disks in place of half spheres."""
    polar = np.linspace(0, np.pi / 2, 65)
    profile = [(radius * np.sin(angle), 0.0 if caps else radius * np.cos(angle)) for angle in polar]
    upper = [(r, z + half) for r, z in profile]
    lower = [(r, -z - half) for r, z in reversed(profile)]
    rings = np.array(upper + lower)
    turn = np.linspace(0, 2 * np.pi, 129)[:-1]
    points = np.array([[(r * np.cos(t), r * np.sin(t), z) for t in turn] for r, z in rings]).reshape(-1, 3)
    count = len(turn)
    triangles = [
        corner
        for ring in range(len(rings) - 1)
        for k in range(count)
        for a, b in [(ring * count + k, ring * count + (k + 1) % count)]
        for corner in ((a, a + count, b), (b, a + count, b + count))
    ]
    return points, np.array(triangles)


@pytest.mark.full
def test_a_connect_closes_a_loop(tmp_path: Path) -> None:
    text = """<mujoco><compiler angle="radian"/><option gravity="3 0 -9"><flag contact="disable"/></option><worldbody>
      <body name="crank"><joint name="a" axis="0 1 0"/><geom type="capsule" size="0.01" fromto="0 0 0 0 0 0.2"/>
        <body name="coupler" pos="0 0 0.2"><joint name="b" axis="0 1 0"/>
          <geom type="capsule" size="0.01" fromto="0 0 0 0.5 0 0.1"/></body></body>
      <body name="rocker" pos="0.5 0 0"><joint name="c" axis="0 1 0"/>
        <geom type="capsule" size="0.01" fromto="0 0 0 0 0 0.3"/></body></worldbody>
      <equality><connect body1="coupler" body2="rocker" anchor="0.5 0 0.1"/></equality></mujoco>"""
    assembly = read(tmp_path, text)
    closing = assembly.joints[-1]
    assert (closing.type, closing.parent, closing.child) == (JointType.SPHERICAL, "coupler", "rocker")
    np.testing.assert_allclose(closing.origin, [0.5, 0, 0.3], atol=1e-15)
    package = generate(tmp_path / "model.xml", tmp_path / "out")
    found = simulate(tmp_path / "out", package.mechanics, 0.3, 0.05)
    a, b, c = (found.columns[f"{name}.phi"] for name in "abc")
    # The coupler's end stays at the rocker's: a closed four-bar in the plane.
    x = 0.2 * np.sin(a) + 0.5 * np.cos(a + b) + 0.1 * np.sin(a + b)
    z = 0.2 * np.cos(a) - 0.5 * np.sin(a + b) + 0.1 * np.cos(a + b)
    np.testing.assert_allclose(x, 0.5 + 0.3 * np.sin(c), atol=1e-7)
    np.testing.assert_allclose(z, 0.3 * np.cos(c), atol=1e-7)
    assert np.abs(a[-1]) > 1e-3


def test_actuators_become_drives(tmp_path: Path) -> None:
    text = """<mujoco><default><position kp="50" forcerange="-7 7"/></default><worldbody>
      <body name="b1"><joint name="j1"/><geom size="0.1"/>
      <body name="b2"><joint name="j2" type="slide"/><geom size="0.1"/>
      <body name="b3"><joint name="j3"/><geom size="0.1"/>
      <body name="b4"><joint name="j4"/><geom size="0.1"/></body></body></body></body></worldbody>
      <actuator><position name="servo" joint="j1" gear="2" kv="3"/>
      <motor name="push" joint="j2" ctrlrange="-2 2" gear="5"/>
      <velocity name="speed" joint="j3" kv="4"/>
      <general name="again" joint="j4" gainprm="9" biastype="affine" biasprm="0 -9 -1"/>
      <muscle name="pull" joint="j4"/></actuator></mujoco>"""
    assembly = read(tmp_path, text)
    drives = {drive.name: drive for drive in assembly.drives}
    assert drives["servo"].parameters == {"c": 200.0, "d": 12.0, "tau_max": 14.0}
    assert (drives["push"].component, drives["push"].parameters) == ("Force", {"f_max": 10.0})
    assert drives["speed"].parameters == {"c": 0.0, "d": 4.0, "useSpeedReference": True, "tau_max": 7.0}
    assert drives["again"].parameters == {"c": 9.0, "d": 1.0, "tau_max": 7.0}
    assert any("'muscle' are left out" in note for note in assembly.notes)
    package = generate(tmp_path / "model.xml", tmp_path / "out")
    mechatronics = (package.root / "Mechatronics.mo").read_text()
    assert "Actuators.Rotational.Servo servo" in mechatronics
    assert "Actuators.Translational.Force push" in mechatronics


def test_masks_exclusions_and_friction_are_kept(tmp_path: Path) -> None:
    text = """<mujoco><worldbody><geom name="floor" type="plane" size="0 0 1" friction="0.3"/>
      <body name="a" pos="0 0 1"><freejoint/><geom name="ga" size="0.1" friction="0.9"/></body>
      <body name="b" pos="1 0 1"><freejoint/><geom size="0.1" contype="2" conaffinity="2"/></body>
      <body name="c" pos="2 0 1"><freejoint/><geom size="0.1" contype="0" conaffinity="0"/></body>
      <body name="d" pos="3 0 1"><freejoint/><geom name="gd" size="0.1" contype="4" conaffinity="0"/></body>
      <body name="e" pos="4 0 1"><freejoint/><geom size="0.1"/></body></worldbody>
      <contact><exclude body1="a" body2="e"/><pair geom1="gd" geom2="ga"/></contact></mujoco>"""
    (tmp_path / "model.xml").write_text(text)
    package = generate(tmp_path / "model.xml", tmp_path / "out")
    scene = (tmp_path / "out" / "scene.json").read_text()
    pairs = {frozenset(pair) for pair in re.findall(r'"bodies":\["(\w+)","(\w+)"\]', scene)}
    assert pairs == {frozenset(pair) for pair in (("a", "floorPlane"), ("e", "floorPlane"), ("a", "d"))}
    mechanics = (package.root / "Mechanics.mo").read_text()
    assert "frictionRule=ContactMultiBody.Types.CombinationRule.Maximum" in mechanics
    assert "muStatic=0.9" in mechanics
    assert "muStatic=0.3" in mechanics


def test_meshes_collide_as_their_hulls(tmp_path: Path) -> None:
    vertices, triangles = box_surface(np.array([0.2, 0.2, 0.2]))
    points = np.vstack([vertices, [[0.0, 0.0, 0.0]]])
    triangles = np.vstack([triangles[2:], [[len(vertices), a, b] for a, b in ((0, 1), (1, 3), (3, 2), (2, 0))]])
    lines = [f"v {x} {y} {z}" for x, y, z in points] + [f"f {a} {b} {c}" for a, b, c in triangles + 1]
    (tmp_path / "meshes").mkdir()
    (tmp_path / "meshes" / "dented.obj").write_text("\n".join(lines))
    assembly = read(
        tmp_path,
        """<mujoco><compiler meshdir="meshes"/><asset><mesh file="dented.obj"/></asset><worldbody>
        <body name="b"><freejoint/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
        <geom type="mesh" mesh="dented"/></body></worldbody></mujoco>""",
    )
    part = assembly.part("b")
    assert part.collision_meshes is not None
    assert len(part.meshes[0].vertices) == 9
    assert len(part.collision_meshes[0].vertices) == 8


def test_binary_meshes_of_older_models(tmp_path: Path) -> None:
    corners = np.array([[0, 0, 0], [0.1, 0, 0], [0, 0.2, 0], [0, 0, 0.3]], dtype="<f4")
    triangles = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], dtype="<i4")
    normals = np.zeros((4, 3), dtype="<f4")
    data = np.array([4, 4, 0, 4], dtype="<i4").tobytes() + corners.tobytes() + normals.tobytes() + triangles.tobytes()
    (tmp_path / "wedge.msh").write_bytes(data)
    text = """<mujoco><asset><mesh file="wedge.msh" inertia="exact"/></asset><worldbody><body name="b"><freejoint/>
      <geom type="mesh" mesh="wedge" density="1000"/></body></worldbody></mujoco>"""
    assert read(tmp_path, text).part("b").mass_properties.mass == pytest.approx(1.0, rel=1e-6)
    (tmp_path / "wedge.msh").write_bytes(data[:-4])
    assert "its counts ask for" in refused(tmp_path, text)
    wrong = data[:-4] + np.array([9], dtype="<i4").tobytes()
    (tmp_path / "wedge.msh").write_bytes(wrong)
    assert "corner that does not exist" in refused(tmp_path, text)


def test_files_are_included_from_the_folder_only(tmp_path: Path) -> None:
    inside = tmp_path / "robot"
    (inside / "parts").mkdir(parents=True)
    (inside / "parts" / "arm.xml").write_text(
        "<mujocoinclude><worldbody><body name='b'><joint name='j'/><geom size='1'/></body></worldbody></mujocoinclude>"
    )
    (tmp_path / "secret.xml").write_text("<mujocoinclude/>")
    assembly = read(inside, "<mujoco><include file='parts/arm.xml'/></mujoco>")
    assert [joint.name for joint in assembly.joints] == ["j"]
    assert "leaves the assembly's folder" in refused(inside, "<mujoco><include file='../secret.xml'/></mujoco>")
    assert "not a relative path" in refused(inside, "<mujoco><include file='/etc/passwd'/></mujoco>")
    twice = "<mujoco><include file='parts/arm.xml'/><include file='parts/arm.xml'/></mujoco>"
    assert "for a second time" in refused(inside, twice)
    assert "for a second time" in refused(inside, "<mujoco><include file='model.xml'/></mujoco>")
    entity = "<!DOCTYPE m [<!ENTITY x SYSTEM 'file:///etc/passwd'>]><mujoco>&x;</mujoco>"
    assert "document type" in refused(inside, entity)


@pytest.mark.parametrize(
    ("flag", "lost"),
    [
        ("gravity", {"gravity"}),
        ("spring", {"spring"}),
        ("damper", {"damper"}),
        ("frictionloss", {"dry"}),
        ("limit", {"limits"}),
        ("equality", {"equality"}),
        ("actuation", {"drives"}),
        ("clampctrl", {"clamped"}),
        ("contact", {"contact"}),
        ("constraint", {"equality", "dry", "limits", "contact"}),
        ("passive", {"spring", "damper"}),
        ("warmstart", set()),
    ],
)
def test_flags_switch_off(tmp_path: Path, flag: str, lost: set[str]) -> None:
    text = """<mujoco><option><flag warmstart="enable"/></option><worldbody>
      <body name="b"><joint name="j" stiffness="1" damping="2" frictionloss="3" range="-30 30"/>
      <geom name="g" size="0.1"/></body><body name="c"><joint name="k"/><geom name="h" size="0.1"/></body></worldbody>
      <contact><pair geom1="g" geom2="h"/></contact><equality><joint joint1="k" joint2="j"/></equality>
      <actuator><motor joint="j" ctrlrange="-1 1"/></actuator></mujoco>"""
    everything = {"gravity", "spring", "damper", "dry", "limits", "equality", "drives", "clamped", "contact"}
    assert _what_counts(read(tmp_path, text)) == everything
    found = _what_counts(read(tmp_path, text.replace('warmstart="enable"', f'{flag}="disable"')))
    assert found == everything - lost - ({"clamped"} if flag == "actuation" else set())


def _what_counts(assembly: Assembly) -> set[str]:
    joint = next(joint for joint in assembly.joints if joint.name == "j")
    contacts = assembly.contacts
    counts = {
        "gravity": assembly.gravity.any(),
        "spring": joint.spring is not None,
        "damper": joint.friction is not None and joint.friction.viscous > 0,
        "dry": joint.friction is not None and joint.friction.dry > 0,
        "limits": joint.limits is not None,
        "equality": bool(assembly.couplings),
        "drives": bool(assembly.drives),
        "clamped": any(drive.parameters for drive in assembly.drives),
        "contact": contacts.all_pairs or bool(contacts.included),
    }
    return {key for key, value in counts.items() if value}


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (body("<joint/><geom size='0.1' class='none'/>"), "default class 'none' does not exist"),
        (body("<joint axis='0 0 0'/><geom size='0.1'/>"), "axis is the zero vector"),
        (body("<joint type='screw'/><geom size='0.1'/>"), "type 'screw' are not known"),
        (body("<joint/><geom size='nan'/>"), "finite number"),
        (body("<joint/><geom size='0'/>"), "positive number"),
        (body("<joint/><geom type='mesh' mesh='m'/>"), "no asset defines"),
        (body("<joint/>"), "moves and has no mass"),
        (body("<joint/><geom size='1' type='box'/>"), "needs 3 positive numbers"),
        (body("<joint range='1 -1'/><geom size='1'/>"), "the lower must be smaller"),
        (body("<joint/><joint type='free'/><geom size='1'/>"), "must be the only one"),
        (body("<joint name='x'/><joint name='x'/><geom size='1'/>"), "two joints 'x'"),
        (body("<joint/><wheel/><geom size='1'/>"), "'wheel' is not known here"),
        (body("<joint/><geom size='1'/><body name='b'/>"), "two bodies 'b'"),
        (body("<joint/><inertial pos='0 0 0' mass='-1' diaginertia='1 1 1'/>"), "must be positive"),
        (body("<joint/><geom size='1'/>", sections="<compiler eulerseq='abc'/>"), "is no sequence"),
        (body("<replicate count='1000000000'><geom size='1'/></replicate><joint/>"), "copies of"),
        (
            body("<replicate count='9999'><replicate count='9999'><geom size='1'/></replicate></replicate><joint/>"),
            "copies of",
        ),
        (
            body("<joint/><geom size='1'/>", sections="<contact><exclude body1='b' body2='q'/></contact>"),
            "does not exist",
        ),
        (body("<joint/><geom size='1'/>", sections="<actuator><motor joint='q'/></actuator>"), "which does not exist"),
        (body("<geom size='1'/>"), "holds no rigid body that moves"),
    ],
)
def test_wrong_models_are_refused(tmp_path: Path, text: str, message: str) -> None:
    assert message in refused(tmp_path, text)


def test_strict_refuses_what_is_left_out(tmp_path: Path) -> None:
    text = body("<joint name='j'/><geom size='1'/>", sections="<sensor><jointpos joint='j'/></sensor>")
    (tmp_path / "model.xml").write_text(text)
    assert any("1 sensors" in note for note in generate(tmp_path / "model.xml", tmp_path / "out").notes)
    with pytest.raises(InputError, match="1 sensors"):
        generate(tmp_path / "model.xml", tmp_path / "strict", GenerateOptions(strict=True))
