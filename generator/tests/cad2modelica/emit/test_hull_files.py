"""Hulls in STL files of the generated package: what they hold, who owns them, and that an FMU needs none of them."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import numpy as np
import pytest
from cad2modelica import GenerateOptions, generate
from cad2modelica.collision.collision_shape import FILE_ERROR, INLINE_CORNERS, CollisionShape
from cad2modelica.collision.collision_shapes import CollisionGeometry
from cad2modelica.emit.hull_files import FOLDER, package_geometry, stl
from cad2modelica.geometry.mesh import is_closed, volume_integrals, weld
from cad2modelica.meshio.mesh_files import read_mesh
from contact_data import checkout
from contact_foundation.errors import InputError
from fmpy import simulate_fmu
from modelica2fmu.build import build_fmu
from modelica2fmu.options import BuildOptions
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

ROOT = checkout()
LIBRARY = ROOT / "ContactMultiBody"
ENGINE = LIBRARY / "Resources" / "Library" / "linux64" / "libcontactmultibody.so"
SIDES = 7
TOP, BOTTOM, HEIGHT = 0.03, 0.05, 0.04  # m


def frustum() -> np.ndarray:
    """A pyramid without its top, of seven sides, in millimetres, standing on z = 0, turned in itself."""
    angles = 2 * np.pi * np.arange(SIDES) / SIDES
    ring = np.column_stack([np.cos(angles), np.sin(angles), np.zeros(SIDES)])
    corners = np.concatenate([BOTTOM * ring, TOP * ring + np.array([0.0, 0.0, HEIGHT])])
    return np.asarray(1000 * Rotation.from_euler("z", 0.3).apply(corners))


def write_frustum(folder: Path, height: float = 1.0) -> Path:
    """An assembly of one frustum over a floor, both in millimetres."""
    folder.mkdir(parents=True, exist_ok=True)
    points = ", ".join(" ".join(repr(float(value)) for value in corner) for corner in frustum())
    sides = [f"{k} {(k + 1) % SIDES} {SIDES + (k + 1) % SIDES} {SIDES + k} -1" for k in range(SIDES)]
    caps = [" ".join(map(str, reversed(range(SIDES)))) + " -1", " ".join(map(str, range(SIDES, 2 * SIDES))) + " -1"]
    mesh = f"IndexedFaceSet {{ coord Coordinate {{ point [ {points} ] }} coordIndex [ {' '.join(sides + caps)} ] }}"
    (folder / "foot.wrl").write_text(
        f"#VRML V2.0 utf8\nDEF foot Transform {{ children [ Shape {{ geometry {mesh} }} ] }}\n"
    )
    inertia = 'about="centerOfMass" axes="part" products="tensor" xx="600" yy="600" zz="900" xy="0" xz="0" yz="0"'
    file = folder / "stand.xml"
    file.write_text(
        '<assembly xmlns="urn:contactmultibody:assembly:1" name="Stand"><units length="mm" mass="kg" angle="deg"/>'
        '<gravity>0 0 -9.81</gravity><materials><material name="steel" restitution="0"/></materials>'
        '<ground><plane name="floor" material="steel"/></ground>'
        f'<parts><part name="foot" material="steel"><pose><position>0 0 {height!r}</position></pose>'
        f"<massProperties><mass>1</mass><centerOfMass>0 0 18</centerOfMass><inertia {inertia}/></massProperties>"
        '<geometry file="foot.wrl" node="foot" coordinates="node" length="mm"/></part></parts>'
        '<contacts default="all" stiffness="1e5"/></assembly>'
    )
    return file


def cloud(count: int, offset: float = 0.0) -> np.ndarray:
    points = np.random.default_rng(count).normal(size=(count, 3))
    return np.asarray(points / np.linalg.norm(points, axis=1)[:, None] * 0.1 + offset)


@pytest.mark.parametrize("count", [13, 64, 500])
def test_file_holds_the_hull(tmp_path: Path, count: int) -> None:
    shape = CollisionShape.hull(cloud(count))
    assert shape.vertices is not None
    assert shape.file_corners is not None
    file = tmp_path / "hull.stl"
    file.write_bytes(stl(shape.file_corners))
    vertices, triangles = weld(*read_mesh(file))
    assert is_closed(triangles)
    assert volume_integrals(vertices, triangles).volume == pytest.approx(ConvexHull(shape.vertices).volume, rel=1e-9)
    assert sorted(map(tuple, vertices)) == sorted(map(tuple, shape.vertices))
    normals = np.frombuffer(file.read_bytes()[84:], "<f4").dtype  # little-endian single precision
    assert normals.itemsize == 4
    assert len(file.read_bytes()) == 84 + 50 * len(triangles)


def test_what_single_precision_would_spoil_stays_in_the_text() -> None:
    """A body 100 m from its frame: a corner would move by 4 micrometres, more than a millionth of the body's size."""
    far = cloud(64, 100.0)
    shape = CollisionShape.hull(far)
    assert shape.file_corners is None
    np.testing.assert_array_equal(shape.vertices, far)
    near = CollisionShape.hull(cloud(64)).vertices
    assert near is not None
    assert 0 < np.abs(near - cloud(64)).max() < FILE_ERROR * 0.2
    assert CollisionShape.hull(cloud(INLINE_CORNERS)).file_corners is None


def test_bodies_of_one_hull_share_its_file() -> None:
    large, small = CollisionShape.hull(cloud(20)), CollisionShape("sphere", radius=0.5)
    bodies = {"first": CollisionGeometry((small, large), ()), "second": CollisionGeometry((large,), ())}
    expressions, files = package_geometry("P", bodies)
    uri = f'"modelica://P/{FOLDER}/first-2.stl"'
    call = f"ContactMultiBody.Shapes.hullFile(Modelica.Utilities.Files.loadResource({uri}))"
    assert list(files) == [f"{FOLDER}/first-2.stl"]
    assert expressions["second"] == call
    assert expressions["first"] == f'ContactMultiBody.Shapes.compound({{\n    "cmb/1 sphere radius=0.5",\n    {call}}})'


@pytest.mark.full
def test_files_come_and_go_with_the_hulls(hammer: Path, tmp_path: Path) -> None:
    """Every file is named in Geometry, the other way round too; old ones go, the modeller's own stay."""
    package = generate(hammer, tmp_path / "out")
    folder = package.root / FOLDER

    def named() -> set[str]:
        return set(re.findall(rf"modelica://Hammer/{FOLDER}/([\w-]+\.stl)", (package.root / "Geometry.mo").read_text()))

    first = named()
    assert len(first) > 2
    assert {file.name for file in folder.iterdir()} == first
    (folder / "mine.stl").write_bytes(b"mine")
    generate(hammer, tmp_path / "out", GenerateOptions(max_pieces=2))
    assert named() < first
    assert {file.name for file in folder.iterdir()} == {*named(), "mine.stl"}
    assert (folder / "mine.stl").read_bytes() == b"mine"


@pytest.mark.parametrize("link", [False, True])
def test_a_file_of_ones_own_is_not_written_over(tmp_path: Path, link: bool) -> None:
    assembly = write_frustum(tmp_path / "cad")
    root = generate(assembly, tmp_path / "out").root
    (root / "Resources" / "generation.json").unlink()  # nothing says any more whose the file is
    if link:
        (tmp_path / "elsewhere").mkdir()
        shutil.rmtree(root / FOLDER)
        (root / FOLDER).symlink_to(tmp_path / "elsewhere")
    with pytest.raises(InputError, match="no file of the generator's") as caught:
        generate(assembly, tmp_path / "out")
    assert str(root / FOLDER) in str(caught.value.place)
    assert not (tmp_path / "elsewhere").exists() or not list((tmp_path / "elsewhere").iterdir())


@pytest.mark.full
@pytest.mark.skipif(not ENGINE.is_file(), reason="the contact engine is not installed")
def test_fmu_runs_without_the_package(tmp_path: Path, fmu_cache: Path) -> None:
    """The frustum rests on its face of seven corners, as deep as stiffness and weight say."""
    package = generate(write_frustum(tmp_path / "cad", -1000 * 9.81 / 1e5), tmp_path / "made" / "out")
    assert (package.root / FOLDER / "foot-1.stl").is_file()
    fmu = tmp_path / "stand.fmu"
    core = BuildOptions(msl=ROOT / "Resources" / "MultiBodyCore", cache=fmu_cache)
    build_fmu(package.mechatronics, [package.root, LIBRARY], fmu, core)
    moved = tmp_path / "another place"
    moved.mkdir()
    shutil.move(fmu, moved / "a.fmu")
    shutil.rmtree(tmp_path / "made")
    shown = ["foot.r_0[3]", "contacts.normalForce[1]"]
    result = simulate_fmu(str(moved / "a.fmu"), stop_time=1.0, fmi_type="CoSimulation", output=shown)
    assert result["foot.r_0[3]"] == pytest.approx(-9.81 / 1e5, abs=1e-8)
    assert result["contacts.normalForce[1]"][1:] == pytest.approx(9.81, rel=1e-3)
