"""Surfaces and their feature edges, of any size."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from javascript import evaluate, needs_modules
from numpy.typing import NDArray

pytestmark = needs_modules
CORNERS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=float)
TRIANGLES = [0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1, 2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3]
RING = 24


def surface(corners: NDArray[np.float64], triangles: list[int]) -> tuple[Any, Any, Any]:
    """Lines, positions and normals, shapes (n, 2, 3), (m, 3) and (m, 3)."""
    found = evaluate(
        "import {surface} from '@/viewer/meshes.js';",
        "const {faces, edges} = surface(new Float32Array(data.corners), new Uint32Array(data.triangles));"
        "const array = (geometry, name) => geometry ? Array.from(geometry.getAttribute(name).array) : [];"
        "return [array(edges, 'position'), array(faces, 'position'), array(faces, 'normal')];",
        {"corners": corners.ravel().tolist(), "triangles": triangles},
    )
    lines, positions, normals = (np.array(values) for values in found)
    return lines.reshape(-1, 2, 3), positions.reshape(-1, 3), normals.reshape(-1, 3)


@pytest.mark.parametrize("size", [1e-5, 0.003, 1.0, 4000.0])
def test_a_box_has_twelve_edges_and_flat_faces_that_look_outwards(size: float) -> None:
    half = size * np.array([0.5, 0.3, 0.05])
    lines, positions, normals = surface(CORNERS * half, TRIANGLES)
    assert len(lines) == 12
    assert np.abs(positions).max(axis=0) == pytest.approx(half, rel=1e-6)
    assert np.sort(np.abs(normals), axis=1) == pytest.approx(np.broadcast_to([0, 0, 1], normals.shape), abs=1e-6)
    assert (np.einsum("ni,ni->n", positions, normals) > 0).all()


@pytest.mark.parametrize("size", [1e-4, 1.0])
def test_a_cylinder_is_smooth_around_and_sharp_at_its_rims(size: float) -> None:
    angles = 2 * np.pi * np.arange(RING) / RING
    circle = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    corners = [(x, y, z) for z in (-1, 1) for x, y in circle] + [(0, 0, -1), (0, 0, 1)]
    triangles = []
    for k in range(RING):
        n = (k + 1) % RING
        triangles += [k, n, RING + n, k, RING + n, RING + k, 2 * RING, n, k, 2 * RING + 1, RING + k, RING + n]
    lines, positions, normals = surface(size * np.array(corners), triangles)
    assert len(lines) == 2 * RING
    side = np.abs(normals[:, 2]) < 0.5
    assert np.abs(normals[~side]) == pytest.approx(np.broadcast_to([0, 0, 1], normals[~side].shape), abs=1e-6)
    assert normals[side][:, :2] == pytest.approx(positions[side][:, :2] / size, abs=np.pi / RING)  # half a facet


def test_an_open_sheet_is_drawn_with_its_rim() -> None:
    lines, _, _ = surface(np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float), [0, 1, 2, 0, 2, 3])
    assert len(lines) == 4
