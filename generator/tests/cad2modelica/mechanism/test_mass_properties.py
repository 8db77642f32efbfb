"""Mass properties: integrals over the exported meshes against the CAD kernel's numbers, and closed forms."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from assembly_text import joint, part, write_assembly
from cad2modelica import generate, read_assembly
from cad2modelica.geometry.mesh import Mesh, bodies, is_closed, join, volume_integrals, weld
from cad2modelica.mechanism.mass_check import check_against_geometry, check_tensor
from cad2modelica.mechanism.model import Assembly, MassProperties, Part
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation


@pytest.fixture(scope="module")
def sample(hammer: Path) -> Assembly:
    return read_assembly(hammer)


def mesh_mass(part: Part, density: float) -> MassProperties:
    """Mass properties of a part's closed bodies at uniform density, by integrals over its triangles."""
    pieces = [volume_integrals(*piece) for piece in bodies(*weld(*join(part.meshes)))]
    mass = density * sum(piece.volume for piece in pieces)
    center = density * sum(piece.volume * piece.center for piece in pieces) / mass
    inertia = np.zeros((3, 3))
    for piece in pieces:
        arm = piece.center - center
        inertia += density * (piece.inertia + piece.volume * (arm @ arm * np.eye(3) - np.outer(arm, arm)))
    return MassProperties(mass, center, inertia)


@pytest.mark.parametrize(
    ("name", "tolerance"),
    # Flat faces: the mesh is exact. Round faces: chords of 0.3 rad lie inside (outside for bores), which
    # costs 1 - sin(a)/a with a = 0.3, about 1.5 %, of the round volume at most (twice that for a sphere).
    [("anvil", 1e-9), ("frame", 2e-3), ("hammer head", 2e-3), ("arm", 6e-3), ("ball", 3e-2)],
)
def test_meshes_agree_with_the_kernel(sample: Assembly, name: str, tolerance: float) -> None:
    part = sample.part(name)
    density = {material.name: material.density for material in sample.materials}[part.material or ""]
    assert density is not None
    assert all(is_closed(piece[1]) for piece in bodies(*weld(*join(part.meshes))))
    kernel, mesh = part.mass_properties, mesh_mass(part, density)
    assert mesh.mass == pytest.approx(kernel.mass, rel=tolerance)
    size = float(np.ptp(join(part.meshes)[0], axis=0).max())
    np.testing.assert_allclose(mesh.center_of_mass, kernel.center_of_mass, atol=tolerance * size)
    np.testing.assert_allclose(mesh.inertia, kernel.inertia, atol=2 * tolerance * np.abs(kernel.inertia).max())


def box_mesh(size: tuple[float, float, float], offset: tuple[float, float, float]) -> Mesh:
    corners = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]) * size + offset
    quads = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    triangles = np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])
    return Mesh("box", corners, triangles, (0.5, 0.5, 0.5))


def test_integrals_of_a_box_far_away() -> None:
    mesh = box_mesh((1.0, 2.0, 3.0), (100.0, -50.0, 20.0))
    found = volume_integrals(mesh.vertices, mesh.triangles)
    assert found.volume == pytest.approx(6.0, rel=1e-12)
    np.testing.assert_allclose(found.center, [100.0, -50.0, 20.0], rtol=1e-12)
    np.testing.assert_allclose(found.inertia, np.diag([6.5, 5.0, 2.5]), atol=1e-9)


def test_integrals_turn_with_the_body() -> None:
    """Inertia of a turned hull is the turned inertia; and twice the scale gives 32 times the inertia."""
    random = np.random.default_rng(7)
    points = random.normal(size=(30, 3))
    hull = ConvexHull(points)
    triangles = np.array(
        [
            simplex
            if np.dot(np.cross(*(points[simplex[1:]] - points[simplex[0]])), equation[:3]) > 0
            else simplex[::-1]
            for simplex, equation in zip(hull.simplices, hull.equations, strict=True)
        ]
    )
    assert is_closed(triangles)
    base = volume_integrals(points, triangles)
    assert base.volume == pytest.approx(hull.volume, rel=1e-12)
    rotation = Rotation.from_rotvec([0.3, -1.0, 0.5]).as_matrix()
    moved = volume_integrals(2 * points @ rotation.T + [1, 2, 3], triangles)
    assert moved.volume == pytest.approx(8 * base.volume, rel=1e-12)
    np.testing.assert_allclose(moved.inertia, 32 * rotation @ base.inertia @ rotation.T, rtol=1e-10, atol=1e-10)


def test_conventions_of_inertia_agree(pendulum: Path) -> None:
    """One tensor written in all conventions of the format reads as one tensor."""
    text = pendulum.read_text()
    original = 'about="centerOfMass" axes="part" products="tensor" xx="80" yy="1700" zz="1700" xy="0" xz="0" yz="0"'
    assert original in text
    tensor = np.array([[900.0, 120.0, -60.0], [120.0, 1700.0, 30.0], [-60.0, 30.0, 1300.0]])
    center, mass = np.array([100.0, 0.0, 0.0]), 0.5
    rotation = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])
    about_origin = tensor + mass * (center @ center * np.eye(3) - np.outer(center, center))
    for about, axes, products, values in (
        ("centerOfMass", "part", "tensor", tensor),
        ("centerOfMass", "part", "integral", tensor),
        ("origin", "part", "tensor", about_origin),
        ("centerOfMass", "assembly", "tensor", rotation @ tensor @ rotation.T),
        ("origin", "assembly", "integral", rotation @ about_origin @ rotation.T),
    ):
        sign = -1 if products == "integral" else 1
        written = (
            f'about="{about}" axes="{axes}" products="{products}" xx="{values[0, 0]}" yy="{values[1, 1]}" '
            f'zz="{values[2, 2]}" xy="{sign * values[0, 1]}" xz="{sign * values[0, 2]}" yz="{sign * values[1, 2]}"'
        )
        pendulum.write_text(text.replace(original, written))
        found = read_assembly(pendulum).part("rod").mass_properties
        np.testing.assert_allclose(found.inertia * 1e6, tensor, rtol=1e-9, atol=1e-9, err_msg=written)


@pytest.mark.parametrize("scale", [0.5, 2.0])
def test_overridden_mass_is_a_remark_not_an_error(scale: float) -> None:
    mesh = box_mesh((0.1, 0.1, 0.1), (0.0, 0.0, 0.0))
    inertia = np.eye(3) * 7.85 * 0.01 / 6
    assert check_against_geometry(MassProperties(7.85, np.zeros(3), inertia), (mesh,)) == []
    (finding,) = check_against_geometry(MassProperties(7.85, np.zeros(3), scale * inertia), (mesh,))
    assert not finding.wrong


def test_flat_plate_is_at_the_limit_of_the_triangle_inequality() -> None:
    """A thin plate has Ixx + Iyy = Izz: legal, and rounding must not refuse it."""
    assert check_tensor(MassProperties(1.0, np.zeros(3), np.diag([0.1, 0.2, 0.3 * (1 + 1e-9)]))) is None
    assert check_tensor(MassProperties(1.0, np.zeros(3), np.diag([0.1, 0.2, 0.31]))) is not None


@pytest.mark.parametrize(("inertia", "doubtful"), [(0.02, False), (2e4, True)])
def test_inertia_in_wrong_units_without_geometry_is_remarked(tmp_path: Path, inertia: float, doubtful: bool) -> None:
    """1 kg with 20000 kg.m2 would be a ring of 140 m in a mechanism of half a metre: kg.mm2 were meant."""
    moments = (inertia, inertia, inertia)
    parts = [part("arm", inertia=moments), part("hand", position=(0.5, 0, 0))]
    joints = [
        joint("shoulder", "revolute", "ground", "arm", axis=(0, 1, 0)),
        joint("wrist", "revolute", "arm", "hand", origin=(0.5, 0, 0), axis=(0, 1, 0)),
    ]
    notes = generate(write_assembly(tmp_path / "arm.xml", parts, joints), tmp_path / "out").notes
    found = [note for note in notes if "'arm'" in note and "lie within 0.5 m" in note]
    assert bool(found) is doubtful
    assert all("141 m" in note for note in found)


def solid_steel(size: tuple[float, float, float], density: float = 7850.0) -> tuple[Mesh, MassProperties]:
    mesh = box_mesh(size, (0.0, 0.0, 0.0))
    integrals = volume_integrals(mesh.vertices, mesh.triangles)
    return mesh, MassProperties(density * integrals.volume, integrals.center, density * integrals.inertia)


@pytest.mark.parametrize(
    ("factor", "words", "wrong"),
    [
        (1000.0, "1000 times too large for the inertia, as if mm and m were mixed up", True),
        (1e-3, "1000 times too small for the inertia, as if mm and m were mixed up", True),
        (0.01, "100 times too small for the inertia, as if cm and m were mixed up", True),
        (25.4, "25.4 times too large for the inertia, as if mm and inch were mixed up", False),
        (1 / 25.4, "25.4 times too small for the inertia, as if mm and inch were mixed up", True),
        (10.0, "10 times too large for the inertia, as if mm and cm were mixed up", False),
        (300.0, "which no solid has", True),  # no known mistake: nothing is claimed
    ],
)
def test_units_of_length_that_were_mixed_up_are_named(factor: float, words: str, wrong: bool) -> None:
    mesh, properties = solid_steel((0.2, 0.05, 0.03))
    scaled = Mesh(mesh.name, factor * mesh.vertices, mesh.triangles, mesh.color)
    finding = check_against_geometry(properties, (scaled,))[0]
    assert finding.wrong is wrong
    assert words in finding.message
    assert ("mixed up" in finding.message) == ("mixed up" in words)


@pytest.mark.parametrize(
    ("density", "words"),
    [
        (7.85, "7850 kg/m3 if the unit of mass were kg instead of g"),
        (0.5, "less than of any usual material"),
        (30_000.0, "more than of any usual material"),
    ],
)
def test_unusual_densities_are_noted_with_what_was_perhaps_meant(density: float, words: str) -> None:
    mesh, properties = solid_steel((0.2, 0.05, 0.03), density)
    (finding,) = check_against_geometry(properties, (mesh,))
    assert not finding.wrong
    assert words in finding.message


@pytest.mark.parametrize("density", [25.0, 120.0, 1000.0, 7850.0, 22_590.0])
def test_usual_densities_are_not_noted(density: float) -> None:
    mesh, properties = solid_steel((0.2, 0.05, 0.03), density)
    assert check_against_geometry(properties, (mesh,)) == []


def test_parts_without_geometry_are_compared_with_the_joints(tmp_path: Path) -> None:
    """Inertia in kg.mm2 taken for kg.m2 is noted; joints at one point, as those of a cross table, say nothing."""

    def doubts(distance: float, moment: float) -> list[str]:
        parts = [part("slide", inertia=3 * (moment,)), part("table", inertia=3 * (moment,))]
        joints = [
            joint("x", "prismatic", "ground", "slide", axis=(1, 0, 0)),
            joint("y", "prismatic", "slide", "table", origin=(distance, 0, 0), axis=(0, 1, 0)),
        ]
        file = write_assembly(tmp_path / "table.xml", parts, joints)
        return [note for note in generate(file, tmp_path / "out").notes if "check the units" in note]

    assert doubts(0.1, 0.01) == []
    assert len(doubts(0.1, 1e4)) == 2
    assert doubts(0.0, 1e4) == []
