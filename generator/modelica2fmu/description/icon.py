"""The icon of FMUs whose model has none: two bodies that touch, with the normal of their contact."""

from __future__ import annotations

import io

import numpy as np
from numpy.typing import NDArray
from PIL import Image

_SIZE = 64
_OVERSAMPLING = 4

_Mask = NDArray[np.bool_]


def _paint(image: NDArray[np.float64], mask: _Mask, color: tuple[int, int, int]) -> None:
    image[mask] = (*color, 255.0)


def model_icon() -> bytes:
    """A PNG of 64 x 64 pixels with transparent background."""
    count = _SIZE * _OVERSAMPLING
    y, x = np.mgrid[0:count, 0:count] / _OVERSAMPLING
    image = np.zeros((count, count, 4))
    _paint(image, (np.hypot(x - 24.0, y - 24.0) < 19.0), (43, 108, 176))
    _paint(image, (np.hypot(x - 24.0, y - 24.0) < 16.0), (144, 205, 244))
    turned_x, turned_y = (x + y) / np.sqrt(2.0), (y - x) / np.sqrt(2.0)
    _paint(image, (np.abs(turned_x - 62.5) < 9.5) & (np.abs(turned_y) < 25.0), (74, 85, 104))
    _paint(image, (np.abs(turned_x - 62.5) < 6.5) & (np.abs(turned_y) < 22.0), (203, 213, 224))
    _paint(image, (np.abs(turned_y) < 1.6) & (np.abs(turned_x - 42.0) < 10.0), (197, 48, 48))
    _paint(image, (np.abs(turned_y) < 0.9 * (turned_x - 28.0)) & (turned_x < 35.0), (197, 48, 48))
    small = image.reshape(_SIZE, _OVERSAMPLING, _SIZE, _OVERSAMPLING, 4).mean(axis=(1, 3))
    return encode_png(np.rint(small).astype(np.uint8))


def encode_png(pixels: NDArray[np.uint8]) -> bytes:
    """A PNG of pixels with red, green, blue and opacity, rows by columns by 4."""
    buffer = io.BytesIO()
    Image.fromarray(pixels).save(buffer, "PNG")
    return buffer.getvalue()
