"""Anaglyph matrices: the least squares, white stays white, and each eye sees its own picture."""

from __future__ import annotations

import numpy as np
import pytest
from stereo_views.anaglyph import RED_CYAN, XYZ, AnaglyphMatrices, Goggles, anaglyph_matrices, squared_error

PLAIN_FILTERS = Goggles((1.0, 0.0, 0.0), (0.0, 1.0, 1.0))


@pytest.mark.parametrize("goggles", [RED_CYAN, PLAIN_FILTERS])
def test_no_other_matrices_are_nearer(goggles):
    best = anaglyph_matrices(goggles, keep_white=False)
    error = squared_error(best, goggles)
    chance = np.random.default_rng(1)
    for size in (1e-3, 0.1):
        for _ in range(50):
            other = AnaglyphMatrices(
                best.left + size * chance.standard_normal((3, 3)), best.right + size * chance.standard_normal((3, 3))
            )
            assert squared_error(other, goggles) > error


def test_the_least_squares_solve_the_normal_equations():
    seen = np.vstack([XYZ * np.array(RED_CYAN.left), XYZ * np.array(RED_CYAN.right)])
    wanted = np.zeros((6, 6))
    wanted[:3, :3] = wanted[3:, 3:] = XYZ
    best = anaglyph_matrices(keep_white=False)
    np.testing.assert_allclose(
        np.hstack([best.left, best.right]), np.linalg.solve(seen.T @ seen, seen.T @ wanted), rtol=1e-9
    )


def test_channel_masks_are_farther_off():
    masks = AnaglyphMatrices(np.diag([1.0, 0, 0]), np.diag([0, 1.0, 1.0]))
    best = anaglyph_matrices(PLAIN_FILTERS, keep_white=False)
    assert squared_error(best, PLAIN_FILTERS) < 0.8 * squared_error(masks, PLAIN_FILTERS)


def test_white_and_grey_stay():
    matrices = anaglyph_matrices()
    for value in (0.0, 0.5, 1.0):
        grey = np.full(3, value)
        np.testing.assert_allclose(matrices.displayed(grey, grey), grey, atol=1e-12)


def test_each_eye_sees_its_own_picture_brighter():
    matrices = anaglyph_matrices()
    white, black = np.ones(3), np.zeros(3)
    for shown, own, other in (
        (matrices.displayed(white, black), RED_CYAN.left, RED_CYAN.right),
        (matrices.displayed(black, white), RED_CYAN.right, RED_CYAN.left),
    ):
        luminance = [float(XYZ[1] @ (np.array(eye) * shown)) / float(XYZ[1] @ np.array(eye)) for eye in (own, other)]
        assert luminance[0] > 3 * luminance[1]
