"""What the page shows: a machine of boxes on a chequered floor, and the cameras of each constellation.

The page draws with the matrices of `stereo_views` and computes no geometry of its own but the machine's swing.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any

from stereo_views.anaglyph import anaglyph_matrices
from stereo_views.cameras import Camera, CameraModel, cameras
from stereo_views.viewing import Viewing

TECHNIQUES = {
    "plain": "No goggles.",
    "anaglyph": "Put on the red and cyan goggles, red to the left.",
    "polarised": "Put on the polarised goggles.",
    "shutter": "Put on the shutter goggles.",
    "side-by-side": "Set the display to pictures side by side, and put on its goggles.",
    "top-and-bottom": "Set the display to pictures above each other, and put on its goggles.",
}
"""Techniques that the page can show, and what the observer does for them."""
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
_FLOOR = -0.38
_TILE = 0.3
_SWING = 0.35  # rad
_PERIOD = 4.0  # s


def view_of(levels: Mapping[str, str], viewing: Viewing) -> dict[str, Any] | None:
    """What the page needs to show a constellation; None if the design has other factors or levels.

    Args:
        levels: by factor; known are `technique`, `camera` and `scene`.
        viewing: lengths of cameras and screen.
    """
    technique, motion = levels.get("technique", ""), levels.get("scene", "")
    if technique not in TECHNIQUES or motion not in MOTIONS or set(levels) != {"technique", "camera", "scene"}:
        return None
    try:
        model = CameraModel(levels["camera"])
    except ValueError:
        return None
    left, right = cameras(model, viewing)
    return {
        **technique_data(technique),
        "moving": motion == "moving",
        "aspect": viewing.aspect,
        "left": _matrix(left),
        "right": _matrix(right),
    }


def technique_data(technique: str) -> dict[str, Any]:
    """What the page needs to show pictures for both eyes by a known technique."""
    data: dict[str, Any] = {"technique": technique, "goggles": TECHNIQUES[technique]}
    if technique == "anaglyph":
        matrices = anaglyph_matrices()
        data["colours"] = {"left": matrices.left.ravel().tolist(), "right": matrices.right.ravel().tolist()}
    return data


def scene_data(viewing: Viewing) -> dict[str, Any]:
    """Boxes, floor and swing, as the page draws them; the machine stands at the convergence distance."""
    shift = _BOXES[0][0][2] + viewing.convergence_distance
    boxes = [
        {"center": [x, y, z - shift], "size": list(size), "color": list(color)} for (x, y, z), size, color in _BOXES
    ]
    return {
        "boxes": boxes,
        "floor": {"height": _FLOOR, "tile": _TILE, "near": -0.9, "far": -7.2, "half": 3.0},
        "swing": {"angle": _SWING, "period": _PERIOD, "depth": -viewing.convergence_distance},
        "viewing": dataclasses.asdict(viewing),
    }


def _matrix(camera: Camera) -> list[float]:
    """Row by row."""
    return [float(value) for value in camera.matrix.ravel()]
