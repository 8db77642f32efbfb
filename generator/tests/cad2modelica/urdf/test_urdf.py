"""URDF: the same mechanism as a reference model, meshes, massless links, and wrong input."""

from __future__ import annotations

import re
import struct
from pathlib import Path

import numpy as np
import pytest
from cad2modelica import GenerateOptions, SourceChoices, generate, read_assembly
from cad2modelica.collision.collision_shapes import collision_geometry
from cad2modelica.geometry.mesh import is_closed, join, volume_integrals, weld
from cad2modelica.geometry.primitive_meshes import box_surface
from cad2modelica.mechanism.model import Assembly, DecompositionLimits, JointFriction, JointType
from cad2modelica.meshio.mesh_files import read_mesh
from contact_foundation.errors import InputError
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


def test_edges_among_the_faces_of_an_obj_file(tmp_path: Path) -> None:
    (tmp_path / "a.obj").write_bytes(obj(box_surface(np.array([1.0, 2.0, 3.0]))) + b"\nf 1 2\nf 3\n")
    assert volume_integrals(*weld(*read_mesh(tmp_path / "a.obj"))).volume == pytest.approx(6.0)
    (tmp_path / "a.obj").write_text("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2\nf 1 2 3\nf 1 2 1\n")
    with pytest.raises(InputError, match="holds no triangle"):
        read_mesh(tmp_path / "a.obj")


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
    return read_assembly(write(tmp_path, text), choices=SourceChoices(allow_missing=True))


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
    assert any("'b2': visual geometry left out" in note and "gone.stl" in note for note in assembly.notes)


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


def test_collada_bound_to_a_material_that_is_not_there(tmp_path: Path) -> None:
    bound = """<instance_geometry url="#g"><bind_material><technique_common>
      <instance_material symbol="m" target="#missing"/></technique_common></bind_material></instance_geometry>"""
    text = COLLADA.replace('<instance_geometry url="#g"/>', bound)
    text = text.replace('<triangles count="4">', '<triangles material="m" count="4">')
    (tmp_path / "tetrahedron.dae").write_text(text)
    assert len(read_mesh(tmp_path / "tetrahedron.dae")[1]) == 4


@pytest.mark.parametrize("first", range(6))
def test_concave_faces_of_a_collada_file(tmp_path: Path, first: int) -> None:
    """An L of area 3, 1 high, from any of its corners on: triangles that reach out of it have a larger surface."""
    outline = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
    corners = [(first + k) % 6 for k in range(6)]
    sides = [(k, (k + 1) % 6, (k + 1) % 6 + 6, k + 6) for k in range(6)]
    faces = [corners[::-1], [k + 6 for k in corners], *sides]
    points = " ".join(f"{x} {y} {z}" for z in (0, 1) for x, y in outline)
    polylist = (
        f'<polylist count="8"><input semantic="VERTEX" source="#v" offset="0"/><vcount>6 6{" 4" * 6}</vcount>'
        f"<p>{' '.join(str(corner) for face in faces for corner in face)}</p></polylist>"
    )
    text = re.sub(r"<triangles.*</triangles>", polylist, COLLADA, flags=re.DOTALL)
    text = text.replace("0 0 0 100 0 0 0 200 0 0 0 300", points).replace('count="12"', 'count="36"')
    (tmp_path / "l.dae").write_text(text.replace('count="4" stride', 'count="12" stride').replace("0.001", "1"))
    vertices, triangles = read_mesh(tmp_path / "l.dae")
    solid = volume_integrals(*weld(vertices, triangles))
    assert solid.volume == pytest.approx(3.0)
    edges = vertices[triangles[:, 1:]] - vertices[triangles[:, :1]]
    assert 0.5 * np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1).sum() == pytest.approx(2 * 3.0 + 8.0)


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
        ('<robot name="double pendulum">', '<robot name="d"><deformable name="torus"/></robot>', "no link has"),
        (
            '<link name="world"/>',
            '<link name="world"/><x:macro xmlns:x="http://www.ros.org/wiki/xacro" name="leg"/>',
            "xacro ('macro')",
        ),
        ('<limit effort="1"/>', '<dynamics damping="-1"/>', "must not be negative"),
        ('xyz="0 1 0"', 'xyz="0 0 0"', "r1: the axis is the zero vector"),
        ('xyz="0.25 0 0"', 'xyz="${length} 0 0"', "xacro"),
        ('xyz="0.25 0 0"', 'xyz="nan 0 0"', "finite"),
        ('link name="b2"', 'link name="b1"', "name of its own"),
        ('joint name="r2"', 'joint name="r1"', "name of its own"),
        ('parent link="world"', 'parent link="b2"', "circle"),
        ('<box size="0.1 0.2 0.3"/>', '<box size="0.1 0 0.3"/>', "a box needs positive lengths"),
        ('<box size="0.1 0.2 0.3"/>', '<box size="-0.1 0.2 0.3"/>', "a box needs positive lengths"),
        ('<box size="0.1 0.2 0.3"/>', "<box/>", "a box needs positive lengths"),
        ('<box size="0.1 0.2 0.3"/>', '<cylinder radius="0.1"/>', "a cylinder needs positive lengths"),
        ('<box size="0.1 0.2 0.3"/>', '<sphere radius="-0.1"/>', "a sphere needs positive lengths"),
        ('<box size="0.1 0.2 0.3"/>', '<mesh filename="a.stl" scale="1 0 1"/>', "scale is zero"),
    ],
)
def test_wrong_urdf(tmp_path: Path, old: str, new: str, words: str) -> None:
    assert old in PENDULUM
    text = new if "</robot>" in new else PENDULUM.replace(old, new)
    file = write(tmp_path, text)
    (tmp_path / "a.stl").write_bytes(binary_stl(box_surface(np.ones(3))))
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


@pytest.mark.parametrize("decomposed", [False, pytest.param(True, marks=pytest.mark.full)])
def test_finely_tessellated_part_is_decomposed_only_if_asked(tmp_path: Path, decomposed: bool) -> None:
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
    if decomposed:
        asked = collision_geometry(part, DecompositionLimits(pieces=8).or_else(limits))
        assert 3 <= len(asked.shapes) <= 8


@pytest.mark.parametrize(
    ("geometry", "words"),
    [
        ('<box size="0 0 0"/>', "has no extent"),
        ('<sphere radius="0.0"/>', "has no extent"),
        ('<mesh filename="a.dae"/>', "does not exist"),
        ('<mesh filename="../secret.stl"/>', "leaves"),
        ('<mesh filename="file:///etc/passwd"/>', "not a relative path"),
        ('<mesh filename="/etc/passwd.stl"/>', "not a relative path"),
        ('<mesh filename="package://arm/secret.stl"/>', "does not exist"),
        ('<mesh filename="model.blend"/>', "does not exist"),
        ("<torus/>", "not known"),
        ("", "names no geometry"),
    ],
)
def test_geometry_that_cannot_be_read_is_left_out(tmp_path: Path, geometry: str, words: str) -> None:
    """The body stays with its mass, and a note says what is missing; nothing outside the folder is read."""
    (tmp_path / "secret.stl").write_bytes(binary_stl(box_surface(np.array([1.0, 2.0, 3.0]))))
    (tmp_path / "urdf").mkdir()
    assembly = changed(tmp_path / "urdf", ('<box size="0.1 0.2 0.3"/>', geometry))
    part = assembly.part("b1")
    assert part.meshes == ()
    assert part.mass_properties.mass == 1.0
    (note,) = [note for note in assembly.notes if "geometry left out" in note]
    assert words in note
    assert "robot.urdf:" in note
    assert "link 'bracket'" in note


def test_meshes_beside_the_description_in_its_package(tmp_path: Path) -> None:
    """``../meshes`` is read where package.xml says that both belong together, and no further."""
    package = tmp_path / "arm"
    for folder in ("urdf", "meshes"):
        (package / folder).mkdir(parents=True)
    (package / "package.xml").write_text("<package/>")
    solid = binary_stl(box_surface(np.array([1.0, 2.0, 3.0])))
    (package / "meshes" / "box.stl").write_bytes(solid)
    (tmp_path / "secret.stl").write_bytes(solid)
    mesh = '<mesh filename="{}"/>'
    inside = changed(package / "urdf", ('<box size="0.1 0.2 0.3"/>', mesh.format("../meshes/box.stl")))
    assert len(inside.part("b1").meshes) == 1
    outside = changed(package / "urdf", ('<box size="0.1 0.2 0.3"/>', mesh.format("../../secret.stl")))
    assert outside.part("b1").meshes == ()


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('xyz="0.25 0 0"', 'xyz="0.25, 0, 0"', "read as '0.25 0 0'"),
        ('xyz="0.25 0 0"', 'xyz="0.25 0 0 7"', "the first 3 numbers"),
        ('xyz="0.25 0 0"', 'xyz="$(optenv HOME 0.25 0 0)"', "read as '0.25 0 0'"),
    ],
)
def test_numbers_as_other_programs_read_them(tmp_path: Path, old: str, new: str, words: str) -> None:
    assembly = changed(tmp_path, (old, new))
    np.testing.assert_allclose(assembly.part("b1").mass_properties.center_of_mass, [0.25, 0, 0])
    assert any(words in note for note in assembly.notes)


def test_zero_bytes_behind_the_end(tmp_path: Path) -> None:
    assert len(read_assembly(write(tmp_path, PENDULUM + "\0\0")).parts) == 2


@pytest.mark.parametrize("rest", ['"0"', '"0.01" iyz="0.02"', '"-2e-35"'])
def test_moments_not_positive_are_raised(tmp_path: Path, rest: str) -> None:
    """Products too large, or rounded nothing: raised to the least moment, with a note; the others stay."""
    if "iyz" in rest:
        old, new = 'izz="0.01" ixy="0" ixz="0" iyz="0"', f'izz={rest} ixy="0" ixz="0"'
        expected = [0.7e-8, 1e-3, 0.03]  # 0.01 + 0.02 and 0.01 - 0.02
    else:
        old, new = 'iyy="0.01" izz="0.01"', f'iyy={rest} izz="0.01"'
        expected = [0.7e-8, 1e-3, 0.01]
    assembly = changed(tmp_path, (old, new))
    moments = np.linalg.eigvalsh(assembly.part("b2").mass_properties.inertia)
    np.testing.assert_allclose(moments, expected, rtol=1e-9)
    assert any("'b2': principal moments" in note and "raised" in note for note in assembly.notes)


def test_massless_root_with_geometry_stands_in_the_world_and_collides(tmp_path: Path) -> None:
    table = '<link name="world"><collision><geometry><box size="2 2 0.1"/></geometry></collision></link>'
    assembly = changed(
        tmp_path,
        ('<link name="world"/>', table),
        ('<link name="b2">', '<link name="b2"><collision><geometry><sphere radius="0.1"/></geometry></collision>'),
    )
    world = assembly.part("world")
    assert world.grounded
    assert world.mass_properties.mass == 0.0
    assert assembly.joints[0].parent == "world"
    package = generate(tmp_path / "robot.urdf", tmp_path / "out")
    text = (package.root / "Mechanics.mo").read_text()
    assert "contacts.frame" in text
    assert text.count("geometry=Geometry.") == 3  # world, b1 with its bracket, b2


def test_scenery_without_any_mass(tmp_path: Path) -> None:
    """What other simulators load as an immovable obstacle."""
    text = """<robot name="tray"><link name="base"><inertial><mass value="0"/></inertial>
      <collision><geometry><box size="1 1 0.1"/></geometry></collision></link></robot>"""
    (part,) = read_assembly(write(tmp_path, text)).parts
    assert part.grounded
    assert len(part.meshes) == 1
    generate(tmp_path / "robot.urdf", tmp_path / "out")


def test_link_named_like_the_ground(tmp_path: Path) -> None:
    assembly = changed(tmp_path, ('link name="b1"', 'link name="ground"'), ('link="b1"', 'link="ground"'))
    assert [part.name for part in assembly.parts] == ["ground link", "b2"]
    assert assembly.joints[0].parent == "ground"
    assert assembly.joints[1].parent == "ground link"


def test_floating_joint_behind_a_body_moves_freely(tmp_path: Path) -> None:
    assembly = changed(tmp_path, ('joint name="r2" type="revolute"', 'joint name="r2" type="floating"'))
    assert assembly.joints[1].type is JointType.FREE
    text = (generate(tmp_path / "robot.urdf", tmp_path / "out").root / "Mechanics.mo").read_text()
    assert "ContactMultiBody.Parts.FreeBody b2" in text


def test_inertia_without_mass_is_noted(tmp_path: Path) -> None:
    inertial = '<inertial><mass value="0"/><inertia ixx="1e-6" iyy="0" izz="0.000" ixy="0" ixz="0" iyz="0"/></inertial>'
    assembly = changed(tmp_path, ('<link name="bracket">', f'<link name="bracket">{inertial}'))
    assert "link 'bracket' has inertia without mass, which is left out" in assembly.notes
    assembly = changed(tmp_path, ('<link name="bracket">', f'<link name="bracket">{inertial.replace("1e-6", "0.0")}'))
    assert not any("without mass" in note for note in assembly.notes)


# ----- limits, ratings, ground -----

LIMITS = '<limit effort="12" velocity="3" lower="-0.5" upper="2"/>'


def mechanics(tmp_path: Path, options: GenerateOptions, *replacements: tuple[str, str]) -> tuple[str, tuple[str, ...]]:
    changed(tmp_path, ('<limit effort="1"/>', LIMITS), *replacements)
    package = generate(tmp_path / "robot.urdf", tmp_path / "out", options)
    return (package.root / "Mechanics.mo").read_text(), package.notes


def test_limits_are_stops_if_asked(tmp_path: Path) -> None:
    text, notes = mechanics(tmp_path, GenerateOptions())
    assert "EndStop" not in text
    assert "1 joint moves without stops at the limits; --stops adds them, --no-stops does without" in notes
    text, notes = mechanics(tmp_path, GenerateOptions(stops=True, accept_structure=True))
    assert text.count("Actuators.Rotational.EndStop ") == 1
    assert "phi_min=-0.5" in text
    assert "phi_max=2" in text


def test_limit_that_is_no_number_is_left_out(tmp_path: Path) -> None:
    text, notes = mechanics(tmp_path, GenerateOptions(stops=True), ('effort="12"', 'effort="-1.57."'))
    assert "EndStop" in text
    assert any("effort='-1.57.' is no number and was left out" in note and "robot.urdf:" in note for note in notes)


def test_no_stop_where_the_joint_starts_outside_its_range(tmp_path: Path) -> None:
    text, notes = mechanics(tmp_path, GenerateOptions(stops=True), ('lower="-0.5"', 'lower="0.5"'))
    assert "EndStop" not in text
    assert any("'r2' has no stops, for it starts at 0, outside its range 0.5 to 2" in note for note in notes)


@pytest.mark.parametrize("stops", [None, False])
def test_note_on_joints_without_stops_that_start_outside_their_range(tmp_path: Path, stops: bool | None) -> None:
    _, notes = mechanics(tmp_path, GenerateOptions(stops=stops), ('lower="-0.5"', 'lower="0.5"'))
    said = "1 joint starts outside its range, where parts may lie in each other: 'r2' at 0 (0.5 to 2)"
    assert said in notes
    _, inside = mechanics(tmp_path, GenerateOptions(stops=stops, accept_structure=True))
    assert not any("outside its range" in note for note in inside)


def test_continuous_joints_and_empty_ranges_have_no_stops(tmp_path: Path) -> None:
    for old, new in (('name="r2" type="revolute"', 'name="r2" type="continuous"'), ('upper="2"', 'upper="-0.5"')):
        text, _ = mechanics(tmp_path, GenerateOptions(stops=True), (old, new))
        assert "EndStop" not in text


@pytest.mark.parametrize(
    ("entry", "expected"),
    [
        ('component = "Servo"', ["tau_max=12"]),
        ('component = "Torque"', ["tau_max=12"]),
        ('component = "Torque"\nparameters = { tau_max = 5.0 }', ["tau_max=5"]),
        ('component = "CascadeServo"\nparameters = { ratio = 50.0 }', ["w_max=150", "ratio=50"]),
    ],
)
def test_ratings_are_the_drives_limits(tmp_path: Path, entry: str, expected: list[str]) -> None:
    (tmp_path / "actuators.toml").write_text(f'[[actuator]]\njoint = "r2"\n{entry}\n')
    changed(tmp_path, ('<limit effort="1"/>', LIMITS))
    package = generate(tmp_path / "robot.urdf", tmp_path / "out")
    text = re.sub(r"\s", "", (package.root / "Mechatronics.mo").read_text())
    for item in expected:
        assert item in text
    assert text.count("tau_max=") <= 1


def test_changed_rating_reaches_the_mechatronic_model(tmp_path: Path) -> None:
    (tmp_path / "actuators.toml").write_text('[[actuator]]\njoint = "r2"\ncomponent = "Servo"\n')
    for effort in ("12", "15"):
        changed(tmp_path, ('<limit effort="1"/>', LIMITS.replace("12", effort)))
        package = generate(tmp_path / "robot.urdf", tmp_path / "out")
        assert f"tau_max={effort}" in (package.root / "Mechatronics.mo").read_text()


def test_spindle_turns_a_speed_into_that_of_its_rotor(tmp_path: Path) -> None:
    entry = '[[actuator]]\njoint = "r2"\ncomponent = "CascadeServo"\nparameters = { pitch = 0.01 }\n'
    (tmp_path / "actuators.toml").write_text(entry)
    changed(tmp_path, ('<limit effort="1"/>', LIMITS), ('name="r2" type="revolute"', 'name="r2" type="prismatic"'))
    package = generate(tmp_path / "robot.urdf", tmp_path / "out")
    value = re.search(r"w_max=([\d.]+)", (package.root / "Mechatronics.mo").read_text())
    assert value is not None
    assert float(value[1]) == pytest.approx(3 / 0.01 * 2 * np.pi)


def test_root_held_in_the_world(tmp_path: Path) -> None:
    free = PENDULUM.replace('<link name="world"/>', "").replace(
        PENDULUM[PENDULUM.index('  <joint name="r1"') : PENDULUM.index('  <link name="b1">')], ""
    )
    file = write(tmp_path, free)
    notes = generate(file, tmp_path / "free").notes
    assert "link 'b1' is the root and moves freely; --ground b1 holds it" in notes
    held = generate(file, tmp_path / "held", GenerateOptions(ground=("b1",)))
    assert not any("moves freely" in note for note in held.notes)
    text = (held.root / "Mechanics.mo").read_text()
    assert "Parts.FreeBody" not in text
    assert re.search(r"connect\(world\.frame_b, b1\.frame_a\)", text)
    with pytest.raises(InputError, match="no part 'b3' to ground"):
        generate(file, tmp_path / "wrong", GenerateOptions(ground=("b3",)))


def test_rounding_is_no_offset_of_the_centre(tmp_path: Path) -> None:
    (tmp_path / "a.urdf").write_text(
        '<robot name="r"><link name="a"><inertial><origin xyz="0 0 1e-11"/><mass value="10"/>'
        '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
        '<visual><geometry><box size="0.2 0.2 0.2"/></geometry></visual></link></robot>'
    )
    (note,) = [note for note in generate(tmp_path / "a.urdf", tmp_path / "out").notes if "uniform density" in note]
    assert "(inertia" in note
    assert "centre" not in note
