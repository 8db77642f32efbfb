"""URDF: the same mechanism as a reference model, meshes, massless links, and wrong input."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np
import pytest
from cad2modelica import generate, read_assembly
from cad2modelica.collision_shapes import collision_geometry
from cad2modelica.mesh import is_closed, join, volume_integrals, weld
from cad2modelica.mesh_files import read_mesh
from cad2modelica.model import Assembly, DecompositionLimits, JointFriction, JointType
from cad2modelica.primitive_meshes import box_surface
from cmb_base.errors import InputError
from mechanics_simulation import ROOT, simulate
from scipy.spatial.transform import Rotation

# The double pendulum of Resources/reference; URDF starts at joint position zero, so the start angles 0.5 and 0.2
# stand in the joints' origins.
PENDULUM = """<?xml version="1.0"?>
<robot name="double pendulum">
  <link name="world"/>
  <joint name="r1" type="continuous">
    <parent link="world"/><child link="b1"/><origin rpy="0 0.5 0"/><axis xyz="0 1 0"/>
  </joint>
  <link name="b1"><inertial><origin xyz="0.25 0 0"/><mass value="1"/>
    <inertia ixx="1e-3" iyy="0.02" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <joint name="tip" type="fixed"><parent link="b1"/><child link="bracket"/><origin xyz="0.5 0 0" rpy="0.3 0 0"/></joint>
  <link name="bracket"><visual><geometry><box size="0.1 0.2 0.3"/></geometry></visual></link>
  <joint name="r2" type="revolute">
    <parent link="bracket"/><child link="b2"/><origin rpy="0 0 0"/><axis xyz="0 1 0"/><limit effort="1"/>
  </joint>
  <link name="b2"><inertial><origin xyz="0.2 0 0" rpy="0 0 0"/><mass value="0.7"/>
    <inertia ixx="1e-3" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
</robot>
"""


def write(tmp_path: Path, text: str, name: str = "robot.urdf") -> Path:
    file = tmp_path / name
    file.write_text(text)
    return file


def test_double_pendulum_agrees_with_openmodelica(tmp_path: Path) -> None:
    text = PENDULUM.replace('rpy="0.3 0 0"', 'rpy="0 0 0"').replace('<origin rpy="0 0 0"/>', '<origin rpy="0 0.2 0"/>')
    package = generate(write(tmp_path, text), tmp_path / "out")
    found = simulate(tmp_path / "out", package.mechanics, 1.0, 0.1)
    reference = np.genfromtxt(ROOT / "Resources" / "reference" / "DoublePendulum.csv", delimiter=",", names=True)
    rows = [int(np.argmin(np.abs(reference["time"] - time))) for time in found.time]
    np.testing.assert_allclose(reference["time"][rows], found.time, atol=1e-9)
    # The reference falls with 9.80665 m/s2, URDF says nothing about gravity: times are scaled to compare.
    assert read_assembly(tmp_path / "robot.urdf").gravity[2] == -9.81
    scaled = found.time * np.sqrt(9.81 / 9.80665)
    for ours, theirs, start in (("r1.phi", "r1phi", 0.5), ("r2.phi", "r2phi", 0.2)):
        expected = np.interp(scaled, reference["time"], reference[theirs]) - start
        np.testing.assert_allclose(found.columns[ours], expected, atol=2e-4, err_msg=ours)
    assert np.ptp(found.columns["r2.phi"]) > 0.1


def test_massless_link_lends_its_geometry(tmp_path: Path) -> None:
    assembly = read_assembly(write(tmp_path, PENDULUM))
    assert [part.name for part in assembly.parts] == ["b1", "b2"]
    vertices, _ = join(assembly.part("b1").meshes)
    np.testing.assert_allclose(vertices.mean(axis=0), [0.5, 0, 0], atol=1e-12)
    expected = Rotation.from_euler("x", 0.3).apply(np.array([0.05, 0.1, 0.15]))
    assert np.linalg.norm(vertices - (expected + np.array([0.5, 0, 0])), axis=1).min() < 1e-12
    # The axis of r2 is given in the frame of the child, which the bracket turns by 0.3 about x.
    axis = assembly.joints[1].axis
    assert axis is not None
    np.testing.assert_allclose(
        Rotation.from_euler("y", -0.5).apply(axis), Rotation.from_euler("x", 0.3).apply([0, 1, 0]), atol=1e-12
    )
    assert assembly.joints[1].parent == "b1"
    assert "not used: limit of joints" in assembly.notes


def test_inertia_turns_with_its_origin(tmp_path: Path) -> None:
    text = PENDULUM.replace('<origin xyz="0.2 0 0" rpy="0 0 0"/>', '<origin xyz="0.2 0 0" rpy="0.1 -0.4 0.9"/>')
    inertia = read_assembly(write(tmp_path, text)).part("b2").mass_properties.inertia
    turn = Rotation.from_euler("xyz", [0.1, -0.4, 0.9]).as_matrix()
    np.testing.assert_allclose(inertia, turn @ np.diag([1e-3, 0.01, 0.01]) @ turn.T, atol=1e-12)


def binary_stl(surface: tuple[np.ndarray, np.ndarray]) -> bytes:
    vertices, triangles = surface
    body = b"".join(struct.pack("<12fH", 0, 0, 0, *vertices[t].ravel(), 0) for t in triangles)
    return b"solid but binary".ljust(80, b" ") + struct.pack("<I", len(triangles)) + body


def text_stl(surface: tuple[np.ndarray, np.ndarray]) -> bytes:
    vertices, triangles = surface
    facets = "".join(
        "facet normal 0 0 0\nouter loop\n"
        + "".join("vertex " + " ".join(map(str, vertices[k])) + "\n" for k in t)
        + "endloop\nendfacet\n"
        for t in triangles
    )
    return f"solid x\n{facets}endsolid x\n".encode()


def obj(surface: tuple[np.ndarray, np.ndarray]) -> bytes:
    vertices, _ = surface
    quads = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    lines = ["v " + " ".join(map(str, vertex)) for vertex in vertices]
    lines += ["f " + " ".join(f"{k + 1}/1/1" for k in quad) for quad in quads[:3]]
    lines += ["f " + " ".join(str(k - 8) for k in quad) for quad in quads[3:]]
    return ("# a box\n" + "\n".join(lines)).encode()


@pytest.mark.parametrize(("name", "encode"), [("a.stl", binary_stl), ("b.STL", text_stl), ("c.obj", obj)])
def test_mesh_files(tmp_path: Path, name: str, encode) -> None:
    (tmp_path / name).write_bytes(encode(box_surface(np.array([1.0, 2.0, 3.0]))))
    vertices, triangles = weld(*read_mesh(tmp_path / name))
    assert len(vertices) == 8
    assert is_closed(triangles)
    assert volume_integrals(vertices, triangles).volume == pytest.approx(6.0)


def test_meshes_of_a_package_folder_and_scale(tmp_path: Path) -> None:
    """The usual layout: package://NAME/meshes, the description in NAME/urdf; collision shapes from collision."""
    package = tmp_path / "arm_description"
    for folder in ("urdf", "meshes"):
        (package / folder).mkdir(parents=True)
    (package / "meshes" / "box.stl").write_bytes(binary_stl(box_surface(np.array([100.0, 200.0, 300.0]))))
    geometry = """<visual><origin xyz="0.5 0 0"/><geometry>
        <mesh filename="package://arm_description/meshes/box.stl" scale="0.001 0.001 0.001"/></geometry></visual>
        <collision><geometry><sphere radius="0.1"/></geometry></collision>"""
    file = write(package / "urdf", PENDULUM.replace('<link name="b2">', f'<link name="b2">{geometry}'))
    part = read_assembly(file).part("b2")
    np.testing.assert_allclose(np.ptp(join(part.meshes)[0], axis=0), [0.1, 0.2, 0.3], atol=1e-6)
    assert [shape.kind for shape in collision_geometry(part).shapes] == ["sphere"]


def changed(tmp_path: Path, *replacements: tuple[str, str]) -> Assembly:
    text = PENDULUM
    for old, new in replacements:
        assert old in text
        text = text.replace(old, new)
    return read_assembly(write(tmp_path, text))


def test_dynamics_of_joints(tmp_path: Path) -> None:
    assembly = changed(tmp_path, ('<limit effort="1"/>', '<dynamics damping="0.25" friction="0.5"/>'))
    assert [joint.friction for joint in assembly.joints] == [None, JointFriction(0.25, 0.5)]


def test_axis_of_fixed_joints_does_not_matter(tmp_path: Path) -> None:
    assembly = changed(
        tmp_path, ('<joint name="tip" type="fixed">', '<joint name="tip" type="fixed"><axis xyz="0 0 0"/>')
    )
    assert [joint.name for joint in assembly.joints] == ["r1", "r2"]


def test_what_moves_nothing_with_mass_is_fixed(tmp_path: Path) -> None:
    assembly = changed(tmp_path, ('mass value="0.7"', 'mass value="0"'))
    assert [part.name for part in assembly.parts] == ["b1"]
    assert "joint 'r2' moves nothing that has mass: it was taken as fixed" in assembly.notes


def test_massless_link_between_joints_carries_what_is_behind_it(tmp_path: Path) -> None:
    assembly = changed(tmp_path, ('joint name="tip" type="fixed"', 'joint name="tip" type="prismatic"'))
    assert [(part.name, part.mass_properties.mass) for part in assembly.parts] == [
        ("b1", 1.0),
        ("bracket", 0.0),
        ("b2", 0.7),
    ]
    assert "link 'bracket' has no mass: it only carries what is behind it" in assembly.notes


def test_vanishing_moment_of_inertia_is_raised(tmp_path: Path) -> None:
    """A rod without thickness: the other two moments and the axes stay."""
    assembly = changed(tmp_path, ('ixx="1e-3" iyy="0.01"', 'ixx="0" iyy="0.01"'))
    moments = np.linalg.eigvalsh(assembly.part("b2").mass_properties.inertia)
    np.testing.assert_allclose(moments, [0.7 * (1e-3 * 0.1) ** 2, 0.01, 0.01], rtol=1e-12)
    assert any("link 'b2': principal moments of inertia 0, 0.01, 0.01 kg.m2 raised" in note for note in assembly.notes)


def test_impossible_inertia_is_noted_and_kept(tmp_path: Path) -> None:
    assembly = changed(tmp_path, ('ixx="1e-3" iyy="0.01" izz="0.01"', 'ixx="1e-3" iyy="0.01" izz="0.5"'))
    np.testing.assert_allclose(np.diag(assembly.part("b2").mass_properties.inertia), [1e-3, 0.01, 0.5])
    assert any("one exceeds the sum of the others" in note for note in assembly.notes)


@pytest.mark.parametrize("declaration", ['<?xml version="0.0" ?>', '<!-- by hand -->\n<?xml version="1.0"?>', " \n"])
def test_odd_declarations(tmp_path: Path, declaration: str) -> None:
    text = PENDULUM.replace('<?xml version="1.0"?>', declaration)
    assert len(read_assembly(write(tmp_path, text)).parts) == 2


def test_capsule(tmp_path: Path) -> None:
    assembly = changed(tmp_path, ('<box size="0.1 0.2 0.3"/>', '<capsule radius="0.1" length="0.4"/>'))
    (mesh,) = assembly.part("b1").meshes
    solid = volume_integrals(*weld(mesh.vertices, mesh.triangles))
    exact = np.pi * 0.1**2 * 0.4 + 4 / 3 * np.pi * 0.1**3
    assert 0.95 * exact < solid.volume < exact
    np.testing.assert_allclose(sorted(np.ptp(mesh.vertices, axis=0))[-1], 0.6, rtol=0.1)


def test_spherical_joint(tmp_path: Path) -> None:
    assembly = changed(tmp_path, ('joint name="r2" type="revolute"', 'joint name="r2" type="spherical"'))
    assert assembly.joints[-1].type is JointType.SPHERICAL


def test_collision_geometry_stands_in_for_a_missing_visual(tmp_path: Path) -> None:
    geometry = """<visual><geometry><mesh filename="gone.stl"/></geometry></visual>
        <collision><geometry><sphere radius="0.1"/></geometry></collision>"""
    assembly = changed(tmp_path, ('<link name="b2">', f'<link name="b2">{geometry}'))
    assert len(assembly.part("b2").meshes) == 1
    assert any("b2: geometry left out" in note and "gone.stl" in note for note in assembly.notes)


def test_package_beside_the_description(tmp_path: Path) -> None:
    (tmp_path / "meshes_of_arm").mkdir()
    (tmp_path / "meshes_of_arm" / "box.stl").write_bytes(binary_stl(box_surface(np.array([1.0, 2.0, 3.0]))))
    mesh = '<mesh filename="package://meshes_of_arm/box.stl"/>'
    (tmp_path / "urdf").mkdir()
    assembly = changed(tmp_path / "urdf", ('<box size="0.1 0.2 0.3"/>', mesh))
    np.testing.assert_allclose(sorted(np.ptp(assembly.part("b1").meshes[0].vertices, axis=0))[0], 1.0, atol=0.5)


COLLADA = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit name="millimeter" meter="0.001"/><up_axis>Y_UP</up_axis></asset>
  <library_geometries><geometry id="g"><mesh>
    <source id="p"><float_array id="pa" count="12">0 0 0 100 0 0 0 200 0 0 0 300</float_array>
      <technique_common><accessor source="#pa" count="4" stride="3">
        <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
      </accessor></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/>
      <p>0 2 1 0 1 3 1 2 3 0 3 2</p></triangles>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="s"><node><translate>10 0 0</translate>
    <rotate>0 0 1 90</rotate><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
"""


def test_collada(tmp_path: Path) -> None:
    """Unit and transforms of nodes count: a quarter turn about z, then 10 mm along x."""
    (tmp_path / "tetrahedron.dae").write_text(COLLADA)
    vertices, triangles = read_mesh(tmp_path / "tetrahedron.dae")
    solid = volume_integrals(*weld(vertices, triangles))
    assert solid.volume == pytest.approx(0.1 * 0.2 * 0.3 / 6)
    np.testing.assert_allclose(solid.center, [0.010 - 0.05, 0.025, 0.075], atol=1e-8)  # single precision inside


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("<COLLADA", '<!DOCTYPE COLLADA [<!ENTITY b "c">]><COLLADA', "document type"),
        ("0 2 1 0 1 3", "0 2 1 0 1 9", "beyond the limits"),
        ("COLLADA", "ASSEMBLY", "no COLLADA document"),
        ("</scene>", "", "well-formed"),
        ('<instance_geometry url="#g"/>', "", "no triangle"),
    ],
)
def test_wrong_collada(tmp_path: Path, old: str, new: str, words: str) -> None:
    file = tmp_path / "wrong.dae"
    file.write_text(COLLADA.replace(old, new))
    with pytest.raises(InputError) as caught:
        read_mesh(file)
    assert words in str(caught.value)
    assert str(file) in str(caught.value)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('child link="b2"', 'child link="b3"', "'b3' is no link"),
        ('type="continuous"', 'type="helical"', "'helical'"),
        ('mass value="0.7"', 'mass value="-0.7"', "must be positive"),
        ('<limit effort="1"/>', '<dynamics damping="-1"/>', "must not be negative"),
        ('iyy="0.01"', 'iyy="-0.01"', "positive definite"),
        ('xyz="0 1 0"', 'xyz="0 0 0"', "zero vector"),
        ('xyz="0.25 0 0"', 'xyz="${length} 0 0"', "xacro"),
        ('xyz="0.25 0 0"', 'xyz="nan 0 0"', "finite"),
        ('link name="b2"', 'link name="b1"', "name of its own"),
        ('joint name="r2"', 'joint name="r1"', "name of its own"),
        ('parent link="world"', 'parent link="b2"', "circle"),
        ('<box size="0.1 0.2 0.3"/>', '<box size="0.1 0 0.3"/>', "positive lengths"),
        ('<box size="0.1 0.2 0.3"/>', '<mesh filename="a.dae"/>', "does not exist"),
        ('<box size="0.1 0.2 0.3"/>', '<mesh filename="../a.stl"/>', "leaves"),
        ('<box size="0.1 0.2 0.3"/>', '<mesh filename="file:///etc/passwd"/>', "not a relative path"),
    ],
)
def test_wrong_urdf(tmp_path: Path, old: str, new: str, words: str) -> None:
    assert old in PENDULUM
    text = PENDULUM.replace(old, new)
    file = write(tmp_path, text)
    with pytest.raises(InputError) as caught:
        generate(file, tmp_path / "out")
    assert caught.value.exit_status == 2
    assert words in str(caught.value)
    assert f"{file}:" in str(caught.value)
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(("encode", "cut"), [(binary_stl, 60), (text_stl, 20)])
def test_truncated_meshes(tmp_path: Path, encode, cut: int) -> None:
    """OBJ has no end mark: a cut file may read as an open mesh, which the notes on the shape report."""
    (tmp_path / "a.stl").write_bytes(encode(box_surface(np.array([1.0, 2.0, 3.0])))[:-cut])
    with pytest.raises(InputError, match="too early"):
        read_mesh(tmp_path / "a.stl")


def test_finely_tessellated_part_is_decomposed_only_if_asked(tmp_path: Path) -> None:
    count = 400  # corners of a star's outline: 1600 triangles
    angle = 2 * np.pi * np.arange(count) / count
    radius = 0.06 + 0.04 * np.cos(5 * angle)
    lines = ["v 0 0 0", "v 0 0 0.05"]
    outline = np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])
    lines += [f"v {x:.9f} {y:.9f} {z}" for z in (0, 0.05) for x, y in outline]
    for k in range(count):
        low, after = 3 + k, 3 + (k + 1) % count
        lines += [f"f 1 {after} {low}", f"f 2 {low + count} {after + count}"]
        lines += [f"f {low} {after} {after + count}", f"f {low} {after + count} {low + count}"]
    (tmp_path / "star.obj").write_text("\n".join(lines))
    text = """<robot name="star"><link name="a">
      <inertial><mass value="1"/><inertia ixx="1e-3" iyy="1e-3" izz="1e-3" ixy="0" ixz="0" iyz="0"/></inertial>
      <collision><geometry><mesh filename="star.obj"/></geometry></collision></link></robot>"""
    assembly = read_assembly(write(tmp_path, text))
    (part,), limits = assembly.parts, assembly.contacts.decomposition
    unasked = collision_geometry(part, limits)
    assert len(unasked.shapes) == 1
    assert any("1600 triangles in all" in note for note in unasked.notes)
    asked = collision_geometry(part, DecompositionLimits(pieces=8).or_else(limits))
    assert 3 <= len(asked.shapes) <= 8
