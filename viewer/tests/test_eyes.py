"""Cameras and colours for two eyes against lines of sight and least squares."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from javascript import evaluate, needs_modules
from lines_of_sight import Lengths, seen
from numpy.typing import NDArray

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


@pytest.mark.parametrize("camera", ["central", "parallel", "convergent"])
@pytest.mark.parametrize("seed", range(4))
def test_points_lie_where_lines_of_sight_say(camera: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    lengths = Lengths(rng.uniform(0, 0.3), rng.uniform(0.3, 5), rng.uniform(0.1, 3), rng.uniform(0.3, 4))
    aspect = rng.uniform(0.5, 2.5)
    points = rng.uniform([-1, -1, -6], [1, 1, -0.4], (50, 3))
    found = projected(
        points,
        camera=camera,
        lengths=lengths.as_page(),
        aspect=aspect,
        eye=rng.normal(size=3).tolist(),
        target=rng.normal(size=3).tolist(),
    )
    assert found == pytest.approx(seen(points, camera, lengths, aspect), rel=1e-6, abs=1e-6)


@pytest.mark.parametrize("camera", ["parallel", "convergent"])
def test_left_and_right_are_not_swapped(camera: str) -> None:
    """What is near lies farther to the right for the left eye, what is far farther to the left."""
    left, right = projected(
        np.array([[0, 0, -0.8], [0, 0, -5]]), camera=camera, lengths=Lengths().as_page(), aspect=1.5
    )
    assert left[0, 0] > 0 > right[0, 0]
    assert left[1, 0] < 0 < right[1, 0]


AUTOMATIC = {"eyeDistance": 0.065, "convergenceDistance": None, "screenWidth": 0.5, "viewingDistance": None}


def test_without_lengths_the_cameras_converge_at_what_is_looked_at_and_span_the_usual_angle() -> None:
    half = np.tan(0.3)
    points = np.array([[0.4, 0.2, -3.0], [0.0, 3 * half, -3.0], [3 * half * 1.5, 0.0, -3.0]])
    left, right = projected(points, camera="parallel", lengths=AUTOMATIC, aspect=1.5, focus=3.0)
    assert left == pytest.approx(right, abs=1e-9)
    assert left[1] == pytest.approx([0, 1], abs=1e-9)
    assert left[2] == pytest.approx([1, 0], abs=1e-9)


def test_parallel_projection_keeps_sizes_and_at_the_distance_looked_at_agrees_with_perspective() -> None:
    view = {"camera": "central", "lengths": AUTOMATIC, "aspect": 1.5, "focus": 3.0}

    def shown(depth: float, perspective: bool) -> NDArray[np.float64]:
        return projected(np.array([[0.4, 0.2, -depth]]), **view, perspective=perspective)[0, 0]

    assert shown(3, True) == pytest.approx(shown(3, False), rel=1e-6)
    assert shown(6, False) == pytest.approx(shown(3, False), rel=1e-6)
    assert shown(6, True) == pytest.approx(shown(6, False) / 2, rel=1e-6)


@pytest.mark.parametrize("perspective", [True, False])
def test_a_head_that_moves_sees_what_is_behind_the_screen_move_along(perspective: bool) -> None:
    points = np.array([[0.0, 0.0, -2.0], [0.0, 0.0, -3.0], [0.0, 0.0, -4.0]])
    view = {"camera": "central", "lengths": AUTOMATIC, "aspect": 1.5, "focus": 3.0, "perspective": perspective}
    near, screen, far = projected(points, **view, head=[0.3, -0.2])[0]
    assert screen == pytest.approx([0, 0], abs=1e-9)
    assert (far * [1, -1] > 0.01).all()
    assert (near * [1, -1] < -0.01).all()


XYZ = np.array(
    [[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]]
)
RED_CYAN = ((0.80, 0.04, 0.02), (0.03, 0.70, 0.75))


@pytest.mark.parametrize("goggles", [RED_CYAN, ((0.1, 0.7, 0.05), (0.6, 0.02, 0.5))])
def test_colours_of_anaglyphs_are_the_least_squares_that_keep_white(goggles: Any) -> None:
    found = evaluate(
        IMPORTS,
        "const {left, right} = anaglyphMatrices(data);return [left, right].map(m => m.clone().transpose().elements);",
        {"left": goggles[0], "right": goggles[1]},
    )
    both = np.hstack(np.reshape(found, (2, 3, 3)))
    seen_through = np.vstack([XYZ * np.array(eye) for eye in goggles])
    wanted = np.linalg.lstsq(seen_through, np.kron(np.eye(2), XYZ))[0]
    assert both == pytest.approx(wanted / wanted.sum(axis=1, keepdims=True), rel=1e-6, abs=1e-9)
    assert both.sum(axis=1) == pytest.approx(1)


def test_each_eye_sees_its_own_picture_brighter_through_the_usual_goggles() -> None:
    found = evaluate(
        IMPORTS,
        "const {left, right} = anaglyphMatrices(); return [left, right].map(m => m.clone().transpose().elements);",
    )
    for eye, other, matrix in zip(RED_CYAN, RED_CYAN[::-1], np.reshape(found, (2, 3, 3)), strict=True):
        shown = np.clip(matrix.sum(axis=1), 0, 1)  # white for this eye, black for the other

        def share(filter_: Any, shown: NDArray[np.float64] = shown) -> float:
            return float(XYZ[1] @ (filter_ * shown) / (XYZ[1] @ np.array(filter_)))

        assert share(eye) > 3 * share(other)
