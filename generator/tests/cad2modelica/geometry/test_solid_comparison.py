"""Lines through surfaces and distances from them: against closed forms, and against looking at every triangle."""

from __future__ import annotations

import numpy as np
import pytest
from cad2modelica.geometry.mesh import volume_integrals
from cad2modelica.geometry.ray_crossings import crossings, inside
from cad2modelica.geometry.solid_comparison import compare
from cad2modelica.geometry.surface_distance import Surface
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

BOX = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)


def surface(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The hull of points as a mesh, counter-clockwise seen from outside."""
    hull = ConvexHull(points)
    corners = points[hull.simplices]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    outward = (normal * hull.equations[:, :3]).sum(axis=1) > 0
    return points, np.where(outward[:, None], hull.simplices, hull.simplices[:, ::-1]).astype(np.int64)


def distance_of_segments(point: np.ndarray, corners: np.ndarray) -> float:
    """The distance of a point from a triangle by minimising over barycentric coordinates on a fine grid."""
    steps = np.linspace(0, 1, 401)
    a, b = np.meshgrid(steps, steps)
    a, b = a[a + b <= 1], b[a + b <= 1]
    places = corners[0] + np.outer(a, corners[1] - corners[0]) + np.outer(b, corners[2] - corners[0])
    return float(np.linalg.norm(places - point, axis=1).min())


@pytest.mark.parametrize("seed", range(6))
def test_distance_from_one_triangle(seed: int) -> None:
    random = np.random.default_rng(seed)
    corners = random.normal(size=(1, 3, 3))
    points = 2 * random.normal(size=(20, 3))
    found = Surface(corners).distance(points)
    expected = [distance_of_segments(point, corners[0]) for point in points]
    np.testing.assert_allclose(found, expected, atol=0.02)
    assert (found <= np.array(expected) + 1e-12).all()


@pytest.mark.full
def test_distance_from_triangles_of_many_sizes() -> None:
    """The trees find what a look at each triangle finds, to the last bits."""
    random = np.random.default_rng(1)
    scale = 10.0 ** random.uniform(-3, 0, size=(600, 1, 1))
    corners = random.uniform(-1, 1, size=(600, 1, 3)) + scale * random.normal(size=(600, 3, 3))
    points = random.uniform(-2, 2, size=(300, 3))
    each = np.min([Surface(corners[k : k + 1]).distance(points) for k in range(len(corners))], axis=0)
    together = Surface(corners)
    np.testing.assert_allclose(together.distance(points), each, rtol=1e-13, atol=1e-15)
    assert together.farthest(points) == pytest.approx(each.max(), rel=1e-13)
    assert together.farthest(np.zeros((0, 3))) == 0.0


def test_distance_from_a_box() -> None:
    vertices, triangles = surface(BOX)
    points = np.random.default_rng(2).uniform(-1, 2, size=(500, 3))
    outside = np.linalg.norm(np.maximum(np.maximum(-points, points - 1), 0), axis=1)
    within = np.minimum(points, 1 - points).min(axis=1)
    found = Surface(vertices[triangles]).distance(points)
    np.testing.assert_allclose(found, np.where(within > 0, within, outside), atol=1e-14)


def test_lines_through_corners_and_edges_enter_as_often_as_they_leave() -> None:
    """A grid of cubes, whose corners, edges and upright faces all lie on lines of the grid."""
    vertices, triangles = surface(BOX)
    cubes = [vertices[triangles] + [x, y, z] for x in (0, 1, 3) for y in (0, 2) for z in (0, 1, 4)]
    corners = np.concatenate(cubes)
    grid = np.stack(np.meshgrid(np.linspace(-1, 5, 25), np.linspace(-1, 5, 25)), axis=-1).reshape(-1, 2)
    found = crossings(grid, corners)
    assert np.bincount(found.line, found.change, len(grid)).tolist() == [0.0] * len(grid)
    for number in np.unique(found.line):
        own = found.line == number
        order = np.lexsort((-found.change[own], found.height[own]))
        assert (np.cumsum(found.change[own][order]) >= 0).all()


@settings(max_examples=25, deadline=None)
@given(st.integers(4, 60), st.tuples(*[st.floats(-3, 3)] * 3))
def test_inside_of_a_convex_body_is_behind_all_its_faces(count: int, turn: tuple[float, float, float]) -> None:
    random = np.random.default_rng(count)
    points = Rotation.from_rotvec(turn).apply(random.normal(size=(count, 3)))
    vertices, triangles = surface(points)
    hull = ConvexHull(points)
    samples = np.concatenate([1.5 * random.normal(size=(400, 3)), points.mean(axis=0)[None]])
    height = (samples @ hull.equations[:, :3].T + hull.equations[:, 3]).max(axis=1)
    clear = np.abs(height) > 1e-9
    np.testing.assert_array_equal(inside(samples, vertices[triangles])[clear], (height < 0)[clear])


@pytest.mark.parametrize("share", [0.1, 0.5, 0.9])
def test_volumes_on_lines(share: float) -> None:
    """A turned box against a part of itself, and against itself moved along its length."""
    turn = Rotation.from_rotvec([0.4, -0.7, 1.1])
    vertices, triangles = surface(turn.apply(BOX * [3, 1, 2]))
    assert volume_integrals(vertices, triangles).volume == pytest.approx(6.0)
    part = ConvexHull(turn.apply(BOX * [3 * share, 1, 2]))
    difference = compare(vertices, triangles, [part])
    assert difference.missing == pytest.approx(1 - share, abs=0.005)
    assert difference.foreign == pytest.approx(0.0, abs=1e-12)
    assert difference.distance == pytest.approx(3 * (1 - share), rel=1e-9)
    moved = ConvexHull(turn.apply(BOX * [3, 1, 2] + [3 * share, 0, 0]))
    difference = compare(vertices, triangles, [moved])
    assert (difference.missing, difference.foreign) == pytest.approx((share, share), abs=0.005)
    assert difference.distance == pytest.approx(3 * share, rel=1e-9)
