"""Hulls with fewer corners: none that is left out is farther from what is left than the error that is told."""

from __future__ import annotations

import numpy as np
import pytest
from cad2modelica.geometry.hull_coarsening import FEW_CORNERS, coarsened
from scipy.spatial import ConvexHull


def egg(count: int, halves: tuple[float, float, float]) -> np.ndarray:
    """Points of an ellipsoid on a golden spiral."""
    k = np.arange(count) + 0.5
    height, around = 1 - 2 * k / count, np.pi * (1 + 5**0.5) * k
    across = np.sqrt(1 - height**2)
    return np.column_stack([np.cos(around) * across, np.sin(around) * across, height]) * halves


@pytest.mark.full
@pytest.mark.parametrize("halves", [(1.0, 2.0, 3.0), (1.0, 0.02, 0.3)], ids=["egg", "blade"])
@pytest.mark.parametrize("error", [3e-2, 3e-3])
def test_what_is_left_out_is_no_farther_than_told(halves: tuple[float, float, float], error: float) -> None:
    points = egg(3000, halves)
    left, told = coarsened(ConvexHull(points), error)
    assert {tuple(corner) for corner in left} <= {tuple(point) for point in points}
    # Support functions differ by the Hausdorff distance at most.
    directions = np.random.default_rng(3).normal(size=(2000, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    lost = (points @ directions.T).max(axis=0) - (left @ directions.T).max(axis=0)
    assert lost.min() >= 0.0
    assert lost.max() <= told * (1 + 1e-9)
    # By the planes of what is left, which are no farther from a point than the solid is.
    equations = ConvexHull(left).equations
    assert (equations[:, :3] @ points.T + equations[:, 3:]).max() <= error * (1 + 1e-9)
    assert told <= error


@pytest.mark.full
def test_the_finer_the_more_corners() -> None:
    hull = ConvexHull(egg(3000, (1.0, 2.0, 3.0)))
    counts = [len(coarsened(hull, error)[0]) for error in (0.1, 0.03, 0.01, 0.003)]
    assert counts == sorted(counts)
    assert counts[0] < 100 < 600 < counts[-1] < 3000


def test_a_body_of_large_faces_keeps_them() -> None:
    """Points strewn on a cube are left out, its corners are not."""
    generator = np.random.default_rng(7)
    cube = np.array([[x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
    ball = generator.normal(size=(500, 3))
    ball /= np.linalg.norm(ball, axis=1)[:, None]
    left, told = coarsened(ConvexHull(np.concatenate([cube, 1.001 * ball])), 0.01)
    np.testing.assert_array_equal(left, cube)
    assert told < 0.01


def test_few_corners_stay_as_they_are() -> None:
    hull = ConvexHull(egg(FEW_CORNERS, (1.0, 2.0, 3.0)))
    left, told = coarsened(hull, 1.0)
    np.testing.assert_array_equal(left, hull.points[hull.vertices])
    assert told == 0.0
