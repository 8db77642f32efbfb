"""Cameras as pairs of matrices: one central camera, two with parallel axes, two with convergent axes.

All look from near the origin along -z, with x to the right and y up, as OpenGL's cameras do. With parallel axes the
frusta are off-axis: both windows coincide at the convergence distance, so that the pictures differ in nothing but
horizontal disparity. With convergent axes the cameras are turned towards each other ("toe-in") and have symmetric
frusta, so that points off the middle also have a vertical disparity (A. Woods, T. Docherty, R. Koch, "Image
distortions in stereoscopic video systems", Proc. SPIE 1915, 1993).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from stereo_views.viewing import Viewing

FloatArray = NDArray[np.float64]


class CameraModel(Enum):
    """How many cameras, and how their axes lie."""

    CENTRAL = "central"
    PARALLEL = "parallel"
    CONVERGENT = "convergent"


@dataclass(frozen=True)
class Camera:
    """A camera's matrices for column vectors of homogeneous coordinates.

    Attributes:
        view: from the world to the camera; shape (4, 4).
        projection: from the camera to clip coordinates, -w to w; shape (4, 4).
    """

    view: FloatArray
    projection: FloatArray

    @property
    def matrix(self) -> FloatArray:
        """From the world to clip coordinates; shape (4, 4)."""
        return self.projection @ self.view

    def project(self, points: FloatArray) -> FloatArray:
        """Where points lie in the picture.

        Args:
            points: in the world, m; shape (..., 3); in front of the camera.

        Returns:
            -1 to 1 from left to right and from bottom to top within the picture; shape (..., 2).
        """
        clip = np.concatenate([points, np.ones((*points.shape[:-1], 1))], axis=-1) @ self.matrix.T
        return np.asarray(clip[..., :2] / clip[..., 3:])


def cameras(model: CameraModel, viewing: Viewing, near: float = 0.05, far: float = 100.0) -> tuple[Camera, Camera]:
    """The cameras of the left and the right eye; of a central camera both are the same.

    Args:
        model: how the axes lie.
        viewing: lengths.
        near, far: the range of depths, m.
    """
    if model is CameraModel.CENTRAL:
        camera = _off_axis(0.0, viewing, near, far)
        return camera, camera
    half = viewing.eye_distance / 2
    make = _off_axis if model is CameraModel.PARALLEL else _toed_in
    return make(-half, viewing, near, far), make(half, viewing, near, far)


def _off_axis(offset: float, viewing: Viewing, near: float, far: float) -> Camera:
    """A camera at x = offset whose window is that of a camera in the middle, at the convergence distance."""
    view = np.eye(4)
    view[0, 3] = -offset
    shift = -offset / viewing.convergence_distance
    return Camera(view, _frustum(shift, viewing, near, far))


def _toed_in(offset: float, viewing: Viewing, near: float, far: float) -> Camera:
    """A camera at x = offset turned towards the point of convergence on the middle axis."""
    angle = math.atan2(offset, viewing.convergence_distance)
    cosine, sine = math.cos(angle), math.sin(angle)
    # Rows are the camera's axes in the world: its z axis points away from what it looks at.
    view = np.eye(4)
    view[:3, :3] = [[cosine, 0.0, -sine], [0.0, 1.0, 0.0], [sine, 0.0, cosine]]
    view[:3, 3] = -view[:3, :3] @ np.array([offset, 0.0, 0.0])
    return Camera(view, _frustum(0.0, viewing, near, far))


def _frustum(shift: float, viewing: Viewing, near: float, far: float) -> FloatArray:
    """Projection whose window's middle lies at x = shift times the depth (OpenGL's glFrustum)."""
    projection = np.zeros((4, 4))
    projection[0, 0] = 1 / viewing.half_width
    projection[0, 2] = shift / viewing.half_width
    projection[1, 1] = 1 / viewing.half_height
    projection[2, 2] = -(far + near) / (far - near)
    projection[2, 3] = -2 * far * near / (far - near)
    projection[3, 2] = -1.0
    return projection
