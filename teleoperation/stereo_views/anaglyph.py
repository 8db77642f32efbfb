"""Anaglyphs by least squares: the displayed colour that through the goggles is nearest to the stereo picture.

For each pixel the six numbers that the eyes should see (left and right, CIE XYZ) are approximated by what three
primaries give through two filters (E. Dubois, "A projection method to generate anaglyph stereo images", ICASSP 2001). A
filter is described by the share of each primary's light that it lets through.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stereo_views.cameras import FloatArray

# Linear sRGB to CIE XYZ (IEC 61966-2-1).
XYZ = np.array(
    [[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]]
)


@dataclass(frozen=True)
class Goggles:
    """Shares of the light of the red, green and blue primary that each eye's filter lets through."""

    left: tuple[float, float, float]
    right: tuple[float, float, float]


RED_CYAN = Goggles((0.80, 0.04, 0.02), (0.03, 0.70, 0.75))
"""Typical gelatine filters on an sRGB display; measure your own for less crosstalk."""


@dataclass(frozen=True)
class AnaglyphMatrices:
    """Matrices on linear RGB: displayed = left @ left eye's colour + right @ right eye's colour; shape (3, 3) each."""

    left: FloatArray
    right: FloatArray

    def displayed(self, left: FloatArray, right: FloatArray) -> FloatArray:
        """Displayed linear RGB, 0 to 1, for both eyes' colours; shapes (..., 3)."""
        return np.clip(left @ self.left.T + right @ self.right.T, 0.0, 1.0)


def anaglyph_matrices(goggles: Goggles = RED_CYAN, *, keep_white: bool = True) -> AnaglyphMatrices:
    """Least-squares matrices.

    Args:
        goggles: the filters.
        keep_white: scale each primary so that white for both eyes is displayed as white. The filters darken everything;
            without this the least squares try to make up for that and go beyond what a display can show.
    """
    seen = _seen(goggles)
    wanted = np.kron(np.eye(2), XYZ)
    both = np.asarray(np.linalg.lstsq(seen, wanted)[0], dtype=np.float64)
    if keep_white:
        both = both / both.sum(axis=1, keepdims=True)
    return AnaglyphMatrices(both[:, :3], both[:, 3:])


def squared_error(matrices: AnaglyphMatrices, goggles: Goggles) -> float:
    """Sum of squares of what the least squares minimise: XYZ seen less wanted, over six unit inputs."""
    both = np.hstack([matrices.left, matrices.right])
    return float(((_seen(goggles) @ both - np.kron(np.eye(2), XYZ)) ** 2).sum())


def _seen(goggles: Goggles) -> FloatArray:
    """From displayed linear RGB to XYZ seen by the left and the right eye; shape (6, 3)."""
    return np.vstack([XYZ * np.array(goggles.left), XYZ * np.array(goggles.right)])
