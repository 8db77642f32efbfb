"""Cameras against closed forms: disparity, keystone distortion, which eye is which."""

from __future__ import annotations

import math

import numpy as np
import pytest
from contact_foundation.errors import InputError
from stereo_views.cameras import CameraModel, cameras
from stereo_views.disparity import disparity, seen_depth
from stereo_views.viewing import Viewing

VIEWING = Viewing(eye_distance=0.065, convergence_distance=1.5, screen_width=0.5, viewing_distance=0.7, pixels=1600)
DEPTHS = [0.6, 1.0, 1.5, 2.5, 10.0, 90.0]


@pytest.mark.parametrize("depth", DEPTHS)
@pytest.mark.parametrize(("x", "y"), [(0.0, 0.0), (0.2, 0.1), (-0.3, 0.15)])
def test_parallel_axes_give_the_disparity_of_similar_triangles(depth, x, y):
    """d = b v (1/c - 1/z), wherever in the picture, and none upwards."""
    found = disparity(np.array([x, y, -depth]), CameraModel.PARALLEL, VIEWING)
    metres = 0.065 * 0.7 * (1 / 1.5 - 1 / depth)
    assert found[0] == pytest.approx(metres * 1600 / 0.5, abs=1e-9)
    assert found[1] == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize("depth", DEPTHS)
@pytest.mark.parametrize(("x", "y"), [(0.0, 0.0), (0.2, 0.1), (-0.3, 0.15)])
def test_convergent_axes_give_the_disparity_of_the_angles_of_sight(depth, x, y):
    half = math.atan(0.0325 / 1.5)
    wanted = []
    for offset, axis in ((-0.0325, half), (0.0325, -half)):
        to_the_right = math.atan2(x - offset, depth) - axis
        distance = math.hypot(x - offset, depth)
        along = distance * math.cos(to_the_right)
        wanted.append((distance * math.sin(to_the_right) / along, y / along))
    (left_x, left_y), (right_x, right_y) = wanted
    found = disparity(np.array([x, y, -depth]), CameraModel.CONVERGENT, VIEWING)
    pixels = 1600 / 0.5 * 0.7
    assert found == pytest.approx([pixels * (right_x - left_x), pixels * (right_y - left_y)], abs=1e-9)


def test_the_point_of_convergence_has_no_disparity():
    for model in CameraModel:
        np.testing.assert_allclose(disparity(np.array([0, 0, -1.5]), model, VIEWING), 0, atol=1e-9)


def test_left_and_right_are_not_swapped():
    """What is near lies farther to the right for the left eye, what is far farther to the left."""
    for model in (CameraModel.PARALLEL, CameraModel.CONVERGENT):
        left, right = cameras(model, VIEWING)
        near, far = np.array([0, 0, -0.8]), np.array([0, 0, -5.0])
        assert left.project(near)[0] > 0 > right.project(near)[0]
        assert left.project(far)[0] < 0 < right.project(far)[0]


def test_a_central_camera_has_no_disparity_and_the_screen_s_angle():
    left, right = cameras(CameraModel.CENTRAL, VIEWING)
    points = np.array([[0.3, 0.2, -1.0], [0.1, -0.2, -4.0]])
    np.testing.assert_array_equal(left.project(points), right.project(points))
    edge = np.array([2.0 * 0.25 / 0.7, 0, -2.0])
    assert left.project(edge)[0] == pytest.approx(1)
    np.testing.assert_allclose(left.project(points)[:, 0], points[:, 0] / -points[:, 2] * 0.7 / 0.25)


def test_convergent_axes_bend_the_plane_of_convergence_and_parallel_ones_do_not():
    corners = np.array([[x, y, -1.5] for x in (-0.4, 0.4) for y in (-0.25, 0.25)])
    assert np.abs(disparity(corners, CameraModel.PARALLEL, VIEWING)).max() < 1e-9
    convergent = disparity(corners, CameraModel.CONVERGENT, VIEWING)
    assert np.abs(convergent[:, 1]).min() > 1.0
    # The left eye, to the left, is nearer to the left edge and sees it taller.
    left, right = cameras(CameraModel.CONVERGENT, VIEWING)
    assert left.project(corners[1])[1] > right.project(corners[1])[1]


@pytest.mark.parametrize("depth", DEPTHS)
def test_depth_is_seen_where_it_is_if_the_screen_stands_at_the_convergence_distance(depth):
    """With cameras as far apart as eyes and the screen's plane as the plane of convergence, space is as it was."""
    viewing = Viewing(0.065, 0.7, 0.5, 0.7, 1600)
    found = disparity(np.array([0.05, 0, -depth]), CameraModel.PARALLEL, viewing)[0]
    assert seen_depth(np.array(found), viewing) == pytest.approx(depth)


def test_lines_of_sight_that_do_not_meet_lead_to_infinity():
    assert np.isinf(seen_depth(np.array(0.066 * 1600 / 0.5), VIEWING))


def test_depth_range_is_that_of_clip_coordinates():
    camera, _ = cameras(CameraModel.CENTRAL, VIEWING, near=0.1, far=20.0)
    for depth, wanted in ((0.1, -1.0), (20.0, 1.0)):
        clip = camera.matrix @ np.array([0, 0, -depth, 1])
        assert clip[2] / clip[3] == pytest.approx(wanted)


@pytest.mark.parametrize(
    ("name", "value"),
    [("eye_distance", -0.1), ("convergence_distance", 0.0), ("screen_width", math.nan), ("viewing_distance", math.inf)],
)
def test_impossible_lengths_are_refused(name, value):
    with pytest.raises(InputError, match=name):
        Viewing(**{name: value})
