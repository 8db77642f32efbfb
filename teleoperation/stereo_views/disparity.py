"""Disparity: how far the right eye's picture of a point lies to the right of the left eye's."""

from __future__ import annotations

import numpy as np

from stereo_views.cameras import CameraModel, FloatArray, cameras
from stereo_views.viewing import Viewing


def disparity(points: FloatArray, model: CameraModel, viewing: Viewing) -> FloatArray:
    """Disparity of points on the screen.

    Args:
        points: in the world, m; shape (..., 3).
        model: of the cameras.
        viewing: lengths and pixels.

    Returns:
        Pixels to the right and up, right eye less left eye; positive to the right for points behind the screen
        (uncrossed), negative before it (crossed); shape (..., 2).
    """
    left, right = cameras(model, viewing)
    size = np.array([viewing.pixels, viewing.pixels / viewing.aspect])
    return np.asarray((right.project(points) - left.project(points)) * size / 2)


def seen_depth(disparity_pixels: FloatArray, viewing: Viewing, eyes: float = 0.065) -> FloatArray:
    """How far from the eyes a point is seen whose pictures have a horizontal disparity, m.

    Args:
        disparity_pixels: right less left; shape (...).
        viewing: screen and viewing distance.
        eyes: distance of the observer's eyes, m.

    Returns:
        Distances; infinite where the lines of sight do not meet; shape (...).
    """
    metres = disparity_pixels * viewing.screen_width / viewing.pixels
    with np.errstate(divide="ignore"):
        return np.where(metres < eyes, eyes * viewing.viewing_distance / np.maximum(eyes - metres, 1e-300), np.inf)
