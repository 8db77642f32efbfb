"""Where two eyes see points, by lines of sight; of the viewer it knows nothing."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Lengths:
    """Distances of eyes, of the plane seen at the screen, and of the screen, and its width, m."""

    eyes: float = 0.065
    convergence: float = 2.0
    screen_width: float = 0.52
    viewing: float = 0.6

    def as_page(self) -> dict[str, float]:
        """As the viewer takes them."""
        return {
            "eyeDistance": self.eyes,
            "convergenceDistance": self.convergence,
            "screenWidth": self.screen_width,
            "viewingDistance": self.viewing,
        }


def seen(points: FloatArray, camera: str, lengths: Lengths, aspect: float) -> FloatArray:
    """Where the left and the right eye see points.

    Args:
        points: x to the right, y up, z towards the observer, from the middle between the eyes; shape (n, 3).
        camera: "central", "parallel" or "convergent".
        lengths: of eyes and screen.
        aspect: the picture's width by its height.

    Returns:
        -1 to 1 from left to right and from bottom to top of the picture; shape (2, n, 2).
    """
    x, y, depth = points[:, 0], points[:, 1], -points[:, 2]
    half = 0.0 if camera == "central" else lengths.eyes / 2
    across = lengths.screen_width / (2 * lengths.viewing)
    pictures = []
    for eye in (-half, half):
        if camera == "convergent":
            # Symmetric about the line from the eye to the point of convergence.
            to_the_right = np.arctan2(x - eye, depth) + np.arctan2(eye, lengths.convergence)
            distance = np.hypot(x - eye, depth)
            along = distance * np.cos(to_the_right)
            right, up = distance * np.sin(to_the_right) / along, y / along
        else:
            # Where the line of sight meets the window at the convergence distance, which both eyes share.
            right = (eye + (x - eye) * lengths.convergence / depth) / lengths.convergence
            up = y / depth
        pictures.append(np.stack([right / across, up / across * aspect], axis=1))
    return np.array(pictures)
