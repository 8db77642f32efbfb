"""Parts with more bodies, and hulls with more corners, than the contact engine takes."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from cad2modelica import generate
from cad2modelica.collision.collision_shapes import MOST_SHAPES, CollisionGeometry, collision_geometry
from cad2modelica.geometry.hull_thinning import MOST_CORNERS, MOST_TOGETHER, thinned
from cad2modelica.geometry.mesh import Indices, Mesh, bodies, weld
from cad2modelica.geometry.primitive_meshes import box_surface
from cad2modelica.geometry.spatial import IDENTITY
from cad2modelica.mechanism.model import CollisionChoice, DecompositionLimits, MassProperties, Part
from contact_data import contact_engine
from contact_foundation.errors import Place
from scipy.spatial import ConvexHull

FINE = 30_000


def shapes_of(vertices: np.ndarray, triangles: Indices, choice: CollisionChoice) -> CollisionGeometry:
    zero = np.zeros(3)
    mesh = Mesh("m", vertices, triangles, (0.5, 0.5, 0.5))
    properties = MassProperties(1.0, zero, np.eye(3))
    return collision_geometry(Part("town", None, IDENTITY, properties, (mesh,), choice, False, Place()))


def houses(sizes: np.ndarray) -> tuple[np.ndarray, Indices]:
    """Cubes of the given sizes in a row, three metres apart."""
    vertices, triangles = box_surface(np.ones(3))
    corners = [size * vertices + [3.0 * k, 0.0, 0.0] for k, size in enumerate(sizes)]
    faces = [triangles + k * len(vertices) for k in range(len(sizes))]
    return np.concatenate(corners), np.concatenate(faces)


def egg(count: int) -> np.ndarray:
    """Points of an ellipsoid with the half-axes 1, 2 and 3, on a golden spiral."""
    k = np.arange(count) + 0.5
    height, around = 1 - 2 * k / count, np.pi * (1 + 5**0.5) * k
    across = np.sqrt(1 - height**2)
    return np.column_stack([np.cos(around) * across, 2 * np.sin(around) * across, 3 * height])


def test_the_largest_bodies_of_too_many_collide() -> None:
    sizes = np.linspace(1.0, 2.0, MOST_SHAPES + 76)[np.random.default_rng(1).permutation(MOST_SHAPES + 76)]
    geometry = shapes_of(*houses(sizes), CollisionChoice.AUTO)
    assert [shape.kind for shape in geometry.shapes] == ["box"] * MOST_SHAPES
    smallest = np.sort(sizes)[76]
    kept = np.flatnonzero(sizes >= smallest)
    np.testing.assert_allclose([shape.pose.position[0] for shape in geometry.shapes], 3.0 * kept, atol=1e-6)
    (note,) = geometry.notes
    left_out = 1000 * np.sqrt(3) * np.sort(sizes)[75]
    assert f"has {MOST_SHAPES + 76} bodies" in note
    assert float(re.search(r"up to ([\d.e+]+) mm", note)[1]) == pytest.approx(left_out, rel=1e-2)


@pytest.mark.full
def test_many_concave_bodies_keep_within_the_number_of_shapes() -> None:
    """So many angle irons that not even two pieces are left for each keep their hulls, with one note for all."""
    outline = np.array([[0, 0], [2, 0], [2, 0.2], [0.2, 0.2], [0.2, 2], [0, 2]], dtype=float)
    ring = np.concatenate([np.column_stack([outline, np.full(6, height)]) for height in (0.0, 1.0)])
    caps = [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5)]
    faces = [(c, b, a) for a, b, c in caps] + [(a + 6, b + 6, c + 6) for a, b, c in caps]
    for k in range(6):
        after = (k + 1) % 6
        faces += [(k, after, after + 6), (k, after + 6, k + 6)]
    count = MOST_SHAPES // 2 + 1
    vertices = np.concatenate([ring + np.array([3.0 * k, 0.0, 0.0]) for k in range(count)])
    triangles = np.concatenate([np.array(faces) + 12 * k for k in range(count)])
    geometry = shapes_of(vertices, triangles, CollisionChoice.AUTO)
    assert [shape.kind for shape in geometry.shapes] == ["hull"] * count
    (note,) = geometry.notes
    assert note.startswith(f"part 'town', {count} of {count} bodies (1, 2, 3, 4, 5, ...): is not convex")
    assert f"no decomposition: the part has {count} bodies" in note


def test_bodies_are_split_in_the_order_of_their_first_triangles() -> None:
    vertices, triangles = houses(np.array([1.0, 2.0, 1.5]))
    mixed = triangles[np.random.default_rng(2).permutation(len(triangles))]
    found = bodies(vertices, mixed)
    first = [int(np.flatnonzero(mixed[:, 0] // 8 == house)[0]) for house in range(3)]
    sizes = [float(np.ptp(body[0][:, 0])) for body in found]
    assert sizes == [[1.0, 2.0, 1.5][house] for house in np.argsort(first)]
    for corners, faces in found:
        assert len(corners) == 8
        assert len(faces) == 12


def test_many_triangles_about_one_corner_are_welded() -> None:
    """A disc as STL has it, each triangle with corners of its own: twenty thousand of them in the middle."""
    count = 20_000
    angle = 2 * np.pi * np.arange(count) / count
    ring = np.column_stack([np.cos(angle), np.sin(angle), np.zeros(count)])
    corners = np.stack([np.zeros((count, 3)), ring, np.roll(ring, -1, axis=0)], axis=1).reshape(-1, 3)
    corners[3::6] = -0.0  # of every other triangle; equal, though not in its bits
    vertices, triangles = weld(corners, np.arange(3 * count).reshape(-1, 3))
    np.testing.assert_array_equal(vertices, np.concatenate([np.zeros((1, 3)), ring]))
    expected = np.column_stack([np.zeros(count), 1 + np.arange(count), 1 + (1 + np.arange(count)) % count])
    np.testing.assert_array_equal(triangles, expected)


@pytest.mark.full
def test_thinned_hull_differs_by_no_more_than_it_says() -> None:
    points = egg(FINE)
    hull = ConvexHull(points)
    assert len(hull.vertices) > MOST_CORNERS
    left, error = thinned(hull)
    assert len(left) <= MOST_CORNERS
    assert 0.0 < error < 2e-3  # steps of sqrt(4 pi / 8192) on a sphere of radius 3 lose 3 * step**2 / 4 or so
    # Support functions of two convex bodies differ by the Hausdorff distance at most, and somewhere by just that.
    directions = np.random.default_rng(3).normal(size=(500, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    lost = [float((points @ d).max() - (left @ d).max()) for d in directions]
    assert min(lost) >= 0.0
    assert max(lost) <= error * (1 + 1e-9)
    # Facet by facet: no corner is farther outside a facet's plane than the error.
    equations = ConvexHull(left).equations
    beyond = max(float((equations[:, :3] @ block.T + equations[:, 3:]).max()) for block in np.array_split(points, 60))
    assert beyond <= error * (1 + 1e-9)
    assert error <= 1.5 * beyond


@pytest.mark.full
def test_fine_hulls_of_one_part_keep_within_the_length_of_a_descriptor() -> None:
    """Forty eggs of 4000 corners each share what is allowed; the thinner the hull, the greater the distance told."""
    egg_hull = ConvexHull(egg(4000) / 100)
    count = 40
    vertices = np.concatenate([egg_hull.points + np.array([k, 0.0, 0.0]) for k in range(count)])
    triangles = np.concatenate([egg_hull.simplices.astype(np.int64) + 4000 * k for k in range(count)])
    geometry = shapes_of(vertices, triangles, CollisionChoice.HULL)
    kept = [len(shape.vertices) for shape in geometry.shapes]
    assert len(kept) == count
    assert 0.5 * MOST_TOGETHER < sum(kept) <= MOST_TOGETHER
    assert len(geometry.descriptor) < 16 * 2**20
    told = [
        float(re.search(r"Hausdorff distance ([\d.e-]+) mm", note)[1]) for note in geometry.notes if "count" in note
    ]
    assert told
    assert 0.0 < min(told) <= max(told) < 0.1


def test_a_hull_far_from_its_body_is_coarse_unless_asked() -> None:
    """An egg whose top is pushed in, of too many triangles to be decomposed: its hull adds 18 %, and corners finer than
    0.2 % of it do not count."""
    whole = ConvexHull(egg(3000))
    corners = whole.points[whole.simplices]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    inward = np.einsum("ij,ij->i", normals, whole.equations[:, :3]) < 0
    triangles = np.where(inward[:, None], whole.simplices[:, ::-1], whole.simplices).astype(np.int64)
    bowl = whole.points.copy()
    bowl[:, 2] = np.minimum(bowl[:, 2], 3.0 - bowl[:, 2])

    def geometry(points: np.ndarray, choice: CollisionChoice) -> CollisionGeometry:
        mesh = Mesh("m", points, triangles, (0.5, 0.5, 0.5))
        properties = MassProperties(1.0, np.zeros(3), np.eye(3))
        part = Part("bowl", None, IDENTITY, properties, (mesh,), choice, False, Place())
        return collision_geometry(part, DecompositionLimits(triangles=1000))

    (unasked, asked, convex) = (
        geometry(bowl, CollisionChoice.AUTO),
        geometry(bowl, CollisionChoice.HULL),
        geometry(whole.points, CollisionChoice.AUTO),
    )
    assert (unasked.is_filled, asked.is_filled, convex.is_filled) == (True, True, False)
    counts = [len(item.shapes[0].vertices) for item in (unasked, asked, convex)]
    assert 100 < counts[0] < 0.4 * counts[1]
    assert counts[2] > 2990
    told = float(re.search(r"Hausdorff distance ([\d.e-]+) mm", " ".join(unasked.notes))[1])
    diagonal = 2 * np.sqrt(1 + 4 + 2.25**2)
    assert 1.0 * diagonal < told <= 2.0 * diagonal + 0.5  # mm for each metre; told with two digits


def test_few_corners_stay_as_they_are() -> None:
    hull = ConvexHull(egg(200))
    left, error = thinned(hull)
    assert error == 0.0
    np.testing.assert_array_equal(left, hull.points[hull.vertices])


@pytest.mark.full
@pytest.mark.skipif(not contact_engine().is_file(), reason="the contact engine is not installed")
def test_the_contact_engine_takes_both(tmp_path: Path) -> None:
    """An egg of 30 000 corners, 0.1 m deep in one house of a row of 1100; both reach the engine through the package."""
    vertices, triangles = houses(np.full(MOST_SHAPES + 76, 2.0))
    fine = ConvexHull(egg(FINE))
    for name, corners, faces in (("town", vertices, triangles), ("egg", fine.points, fine.simplices)):
        lines = [f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in corners]
        lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in faces]
        (tmp_path / f"{name}.obj").write_text("\n".join(lines))
    (tmp_path / "town.urdf").write_text(
        """<robot name="town">
        <link name="town"><collision><geometry><mesh filename="town.obj"/></geometry></collision></link>
        <link name="egg">
        <inertial><mass value="1000"/><inertia ixx="900" iyy="900" izz="900" ixy="0" ixz="0" iyz="0"/></inertial>
        <collision><geometry><mesh filename="egg.obj"/></geometry></collision></link>
        <joint name="j" type="floating"><parent link="town"/><child link="egg"/><origin xyz="30 0 3.9"/></joint>
        </robot>"""
    )
    package = generate(tmp_path / "town.urdf", tmp_path / "out")
    (thinning,) = [note for note in package.notes if "vertices of its convex hull" in note]
    (overlap,) = [note for note in package.notes if "'town' and 'egg'" in note]
    error = float(re.search(r"Hausdorff distance ([\d.]+) mm", thinning)[1])
    assert 100 - 1.05 * error <= float(re.search(r"by ([\d.]+) mm", overlap)[1]) <= 100 + 1e-3
