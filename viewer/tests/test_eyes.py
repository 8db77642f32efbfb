"""Cameras and colours for two eyes against geometry and least squares by other means."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from javascript import evaluate, needs_modules
from numpy.typing import NDArray
from stereo_views.anaglyph import RED_CYAN, Goggles, anaglyph_matrices
from stereo_views.cameras import CameraModel, cameras
from stereo_views.viewing import Viewing

pytestmark = needs_modules
IMPORTS = (
    "import {PerspectiveCamera, Vector3} from 'three'; import {Eyes} from '@/viewer/eyes.js';"
    "import {anaglyphMatrices} from '@/viewer/anaglyph.js';"
)
PROJECT = """
const rig = new PerspectiveCamera();
rig.position.set(...data.eye);
rig.lookAt(...data.target);
rig.updateMatrixWorld();
const eyes = new Eyes();
eyes.place(rig, {angle: 0.6, near: 0.05, far: 100, perspective: true, head: [0, 0], focus: 1, ...data.view});
return ["left", "right"].map(eye => data.points.map(point =>
  new Vector3(...point).applyMatrix4(rig.matrixWorld).project(eyes[eye]).toArray()));
"""


def projected(points: NDArray[np.float64], **view: Any) -> NDArray[np.float64]:
    """Where both eyes see points given in the middle camera's axes; shape (2, n, 2)."""
    eye, target = view.pop("eye", [0, 0, 0]), view.pop("target", [0, 0, -1])
    found = evaluate(IMPORTS, PROJECT, {"points": points.tolist(), "view": view, "eye": eye, "target": target})
    return np.array(found)[..., :2]


@pytest.mark.parametrize("model", list(CameraModel))
@pytest.mark.parametrize("seed", range(4))
def test_points_lie_where_geometry_says(model: CameraModel, seed: int) -> None:
    rng = np.random.default_rng(seed)
    lengths = {
        "eyeDistance": rng.uniform(0, 0.3),
        "convergenceDistance": rng.uniform(0.3, 5),
        "screenWidth": rng.uniform(0.1, 3),
        "viewingDistance": rng.uniform(0.3, 4),
    }
    viewing = Viewing(*lengths.values(), aspect=rng.uniform(0.5, 2.5))
    points = rng.uniform([-1, -1, -6], [1, 1, -0.4], (50, 3))
    found = projected(
        points,
        camera=model.value,
        lengths=lengths,
        aspect=viewing.aspect,
        eye=rng.normal(size=3).tolist(),
        target=rng.normal(size=3).tolist(),
    )
    for eye, camera in zip(found, cameras(model, viewing), strict=True):
        assert eye == pytest.approx(camera.project(points), rel=1e-6, abs=1e-6)


AUTOMATIC = {"eyeDistance": 0.065, "convergenceDistance": None, "screenWidth": 0.5, "viewingDistance": None}


def test_without_lengths_the_cameras_converge_at_what_is_looked_at_and_span_the_usual_angle() -> None:
    half = np.tan(0.3)
    points = np.array([[0.4, 0.2, -3.0], [0.0, 3 * half, -3.0], [3 * half * 1.5, 0.0, -3.0]])
    left, right = projected(points, camera="parallel", lengths=AUTOMATIC, aspect=1.5, focus=3.0)
    assert left == pytest.approx(right, abs=1e-9)
    assert left[1] == pytest.approx([0, 1], abs=1e-9)
    assert left[2] == pytest.approx([1, 0], abs=1e-9)


def test_parallel_projection_keeps_sizes_and_at_the_distance_looked_at_agrees_with_perspective() -> None:
    def seen(depth: float, perspective: bool) -> NDArray[np.float64]:
        points = np.array([[0.4, 0.2, -depth]])
        return projected(points, camera="central", lengths=AUTOMATIC, aspect=1.5, focus=3.0, perspective=perspective)[
            0, 0
        ]

    assert seen(3, True) == pytest.approx(seen(3, False), rel=1e-6)
    assert seen(6, False) == pytest.approx(seen(3, False), rel=1e-6)
    assert seen(6, True) == pytest.approx(seen(6, False) / 2, rel=1e-6)


@pytest.mark.parametrize("perspective", [True, False])
def test_a_head_that_moves_sees_what_is_behind_the_screen_move_along(perspective: bool) -> None:
    points = np.array([[0.0, 0.0, -2.0], [0.0, 0.0, -3.0], [0.0, 0.0, -4.0]])
    view = {"camera": "central", "lengths": AUTOMATIC, "aspect": 1.5, "focus": 3.0, "perspective": perspective}
    near, screen, far = projected(points, **view, head=[0.3, -0.2])[0]
    assert screen == pytest.approx([0, 0], abs=1e-9)
    assert (far * [1, -1] > 0.01).all()
    assert (near * [1, -1] < -0.01).all()


@pytest.mark.parametrize("goggles", [RED_CYAN, Goggles((0.1, 0.7, 0.05), (0.6, 0.02, 0.5))])
def test_colours_of_anaglyphs_are_the_least_squares(goggles: Goggles) -> None:
    found = evaluate(
        IMPORTS,
        "const {left, right} = anaglyphMatrices(data); return [left, right].map(m => m.clone().transpose().elements);",
        {"left": goggles.left, "right": goggles.right},
    )
    wanted = anaglyph_matrices(goggles)
    for values, matrix in zip(found, (wanted.left, wanted.right), strict=True):
        assert np.reshape(values, (3, 3)) == pytest.approx(matrix, rel=1e-9, abs=1e-12)
