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
    <dynamics damping="0.1"/>
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
    assert any("dynamics" in note and "limit" in note for note in assembly.notes)


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


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('child link="b2"', 'child link="b3"', "'b3' is no link"),
        ('type="continuous"', 'type="helical"', "'helical'"),
        ('mass value="0.7"', 'mass value="0"', "must be positive"),
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
        ('type="fixed"', 'type="prismatic"', "moves, but has no inertial"),
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
