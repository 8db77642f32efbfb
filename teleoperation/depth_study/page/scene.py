"""What the page shows: a machine of boxes on a floor, as data for the viewer, and the camera of each constellation."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from fmu_regression.report.plots import encode_array

from depth_study.page.viewing import Viewing

TECHNIQUES = {
    "plain": "No goggles.",
    "anaglyph": "Put on the red and cyan goggles, red to the left.",
    "polarised": "Put on the polarised goggles.",
    "shutter": "Put on the shutter goggles.",
    "side-by-side": "Set the display to pictures side by side, and put on its goggles.",
    "top-and-bottom": "Set the display to pictures above each other, and put on its goggles.",
}
"""Techniques that the page can show, and what the observer does for them."""
CAMERAS = ("central", "parallel", "convergent")
MOTIONS = ("still", "moving")

# Centre and size in m, x to the right, y up, -z away from the observer; colour in sRGB, 0 to 255.
_BOXES: tuple[tuple[tuple[float, float, float], tuple[float, float, float], tuple[int, int, int]], ...] = (
    ((0.0, -0.33, -2.0), (0.36, 0.10, 0.36), (110, 115, 125)),
    ((0.0, -0.13, -2.0), (0.10, 0.30, 0.10), (215, 150, 60)),
    ((0.13, 0.055, -2.0), (0.40, 0.07, 0.08), (215, 150, 60)),
    ((0.30, -0.04, -2.0), (0.05, 0.12, 0.05), (150, 155, 165)),
    ((-0.28, -0.31, -1.62), (0.14, 0.14, 0.14), (70, 130, 190)),
    ((0.34, -0.32, -2.42), (0.12, 0.12, 0.12), (190, 80, 80)),
    ((-0.45, -0.23, -2.55), (0.10, 0.30, 0.10), (90, 160, 100)),
    ((0.62, -0.18, -3.2), (0.14, 0.40, 0.14), (150, 120, 180)),
    ((-0.85, -0.13, -3.6), (0.16, 0.50, 0.16), (120, 150, 160)),
)
_CORNERS = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
_QUADS = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
_TRIANGLES = np.array([triangle for a, b, c, d in _QUADS for triangle in ((a, b, c), (a, c, d))])
_FLOOR = -0.38
_RADIUS = 1.6
_BACKGROUND = (0.80, 0.84, 0.89)
_SWING = 0.35  # rad
_PERIOD = 4.0  # s


def view_of(levels: Mapping[str, str], viewing: Viewing) -> dict[str, Any] | None:
    """What the page needs to show a constellation; None if the design has other factors or levels.

    Args:
        levels: by factor; known are `technique`, `camera` and `scene`.
        viewing: lengths of cameras and screen.
    """
    if set(levels) != {"technique", "camera", "scene"}:
        return None
    technique, camera, motion = levels["technique"], levels["camera"], levels["scene"]
    if technique not in TECHNIQUES or camera not in CAMERAS or motion not in MOTIONS:
        return None
    return {**technique_data(technique), "camera": camera, "moving": motion == "moving", "aspect": viewing.aspect}


def technique_data(technique: str) -> dict[str, Any]:
    """What the page needs to show pictures for both eyes by a known technique."""
    return {"technique": technique, "goggles": TECHNIQUES[technique]}


def scene_data(viewing: Viewing) -> dict[str, Any]:
    """The viewer's data of one body of boxes, its swing and the lengths; it stands at the convergence distance."""
    depth = -viewing.convergence_distance
    return {
        "viewer": {
            "up": [0.0, 1.0, 0.0],
            "center": [0.0, 0.0, depth],
            "radius": _RADIUS,
            "floor": _FLOOR,
            "follow": False,
            "largestForce": 1.0,
            "background": list(_BACKGROUND),
            "stand": {"eye": [0.0, 0.0, 0.0], "target": [0.0, 0.0, depth]},
            # The body's origin is the axis of its swing.
            "bodies": [{"meshes": [_mesh(*box) for box in _BOXES]}],
        },
        "swing": {"angle": _SWING, "period": _PERIOD, "depth": depth},
        "lengths": {
            "eyeDistance": viewing.eye_distance,
            "convergenceDistance": viewing.convergence_distance,
            "screenWidth": viewing.screen_width,
            "viewingDistance": viewing.viewing_distance,
        },
    }


def _mesh(
    center: tuple[float, float, float], size: tuple[float, float, float], color: tuple[int, int, int]
) -> dict[str, Any]:
    """A box as a mesh, about the axis of the first one."""
    middle = np.array(center) - [0.0, 0.0, _BOXES[0][0][2]]
    return {
        "vertices": encode_array(middle + _CORNERS * size, "f4"),
        "triangles": encode_array(_TRIANGLES, "u4"),
        "color": [value / 255 for value in color],
    }
