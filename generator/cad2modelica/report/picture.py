"""A shaded picture of solids: parallel projection, depth buffer, dark edges, written as PNG."""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from cad2modelica.geometry.spatial import Array, dot

Mask = NDArray[np.bool_]

WIDTH, HEIGHT = 560, 420  # px
FINER = 2  # drawn so many times finer and averaged
FRAME = 0.05  # of the picture is left free on every side
MOST_TRIANGLES = 12_000  # drawn; more are coarsened to what a picture of this size can show
AZIMUTH, ELEVATION = np.radians(-35.0), np.radians(25.0)
LIGHT = np.array([-0.35, 0.75, 0.56])  # right, up, towards the viewer
EDGE_SHADE = 0.45
EDGE_TURN = 0.8  # cosine between normals of neighbouring points below which there is an edge
BACKGROUND = 255


@dataclass(frozen=True, eq=False)
class Solid:
    """Triangles of one colour.

    Attributes:
        corners: in the world, counter-clockwise seen from outside, shape (n, 3, 3), m.
        color: red, green, blue from 0 to 1.
    """

    corners: Array
    color: tuple[float, float, float]


def view_axes(up: Array) -> Array:
    """Rows: to the right, up and towards the viewer, seen from the front, a little from the right and above."""
    up = up / np.linalg.norm(up)
    side = np.array([1.0, 0.0, 0.0]) if abs(up[0]) < 0.9 else np.array([0.0, 1.0, 0.0])
    side -= up * (side @ up)
    side /= np.linalg.norm(side)
    front = np.cross(side, up)
    level = np.cos(AZIMUTH) * front - np.sin(AZIMUTH) * side
    viewer = np.cos(ELEVATION) * level + np.sin(ELEVATION) * up
    right = np.cross(up, viewer)
    right /= np.linalg.norm(right)
    return np.array([right, np.cross(viewer, right), viewer])


def draw(solids: Sequence[Solid], up: Array, around: Sequence[Solid] = ()) -> bytes:
    """Draws solids as PNG; the same solids give the same bytes.

    Args:
        solids: what is drawn.
        up: direction that is up in the picture.
        around: what the picture has room for; the solids themselves if empty.
    """
    axes = view_axes(up)
    seen = [solid.corners @ axes.T for solid in solids]
    frame = np.concatenate([(solid.corners @ axes.T).reshape(-1, 3) for solid in (around or solids)])
    low, high = frame.min(axis=0), frame.max(axis=0)
    size = np.array([WIDTH, HEIGHT]) * FINER
    scale = float(((1 - 2 * FRAME) * size / np.maximum(high - low, 1e-12)[:2]).min())
    middle = (low + high)[:2] / 2
    corners = np.concatenate(seen) * scale
    corners[..., :2] += size / 2 - scale * middle
    corners[..., 1] = size[1] - corners[..., 1]
    color = np.repeat([solid.color for solid in solids], [len(item) for item in seen], axis=0)
    color, corners = _coarsened(color, corners)
    return _png(_averaged(_painted(corners, color, int(size[0]), int(size[1]))))


def _coarsened(color: Array, corners: Array) -> tuple[Array, Array]:
    """Drops what looks away; moves corners to grids of more and more points until few enough triangles are left."""
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    towards = normal[:, 2] < 0  # the picture's second axis points down
    color, corners = color[towards], corners[towards]
    cell = 1.0
    while len(corners) > MOST_TRIANGLES:
        moved = np.round(corners / cell) * cell
        area = np.cross(moved[:, 1] - moved[:, 0], moved[:, 2] - moved[:, 0])[:, 2]
        kept = area < 0
        color, corners, cell = color[kept], moved[kept], 2 * cell
    return color, corners


def _painted(corners: Array, color: Array, width: int, height: int) -> Array:
    """Colours of all points, shape (height, width, 3), 0 to 255."""
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal = np.column_stack([normal[:, 0], -normal[:, 1], normal[:, 2]]) * -1.0
    normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
    depth = np.full((height, width), -np.inf)
    owner = np.full((height, width), -1, dtype=np.int64)
    low = np.maximum(np.ceil(corners[..., :2].min(axis=1) - 0.5), 0).astype(int)
    high = np.minimum(np.floor(corners[..., :2].max(axis=1) - 0.5), [width - 1, height - 1]).astype(int)
    for number in np.flatnonzero((low <= high).all(axis=1)):
        (x0, y0), (x1, y1) = low[number], high[number]
        a, b, c = corners[number]
        x, y = np.arange(x0, x1 + 1) + 0.5, (np.arange(y0, y1 + 1) + 0.5)[:, None]
        whole = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
        of_b = ((x - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (y - a[1])) / whole
        of_c = ((b[0] - a[0]) * (y - a[1]) - (x - a[0]) * (b[1] - a[1])) / whole
        near = a[2] + of_b * (b[2] - a[2]) + of_c * (c[2] - a[2])
        place = (slice(y0, y1 + 1), slice(x0, x1 + 1))
        shown = (of_b >= 0) & (of_c >= 0) & (of_b + of_c <= 1) & (near > depth[place])
        depth[place][shown] = near[shown]
        owner[place][shown] = number
    light = LIGHT / np.linalg.norm(LIGHT)
    shade = 0.6 + 0.4 * np.clip(dot(normal, light), 0.0, 1.0)
    image = np.full((height, width, 3), float(BACKGROUND))
    hit = owner >= 0
    image[hit] = 255 * (color * shade[:, None])[owner[hit]]
    facing = np.zeros((height, width, 3))
    facing[hit] = normal[owner[hit]]
    image[_edges(facing, np.where(hit, depth, -1e9), hit)] *= EDGE_SHADE
    return image


def _edges(facing: Array, depth: Array, hit: Mask) -> Mask:
    """Where the solid ends, or turns sharply, against the point to the right or below."""
    edge = np.zeros(hit.shape, dtype=np.bool_)
    for here, there in (
        ((slice(None), slice(None, -1)), (slice(None), slice(1, None))),
        ((slice(None, -1), slice(None)), (slice(1, None), slice(None))),
    ):
        both = hit[here] & hit[there]
        turned = both & (dot(facing[here], facing[there]) < EDGE_TURN)
        # A step in depth that the slopes of the two points do not explain.
        steep = 2.0 / np.maximum(np.minimum(facing[here][..., 2], facing[there][..., 2]), 0.1)
        stepped = both & (np.abs(depth[here] - depth[there]) > 2 + steep)
        edge[here] |= turned | stepped | (hit[here] & ~hit[there])
        edge[there] |= hit[there] & ~hit[here]
    return edge


def _averaged(image: Array) -> Array:
    return np.asarray(image.reshape(HEIGHT, FINER, WIDTH, FINER, 3).mean(axis=(1, 3)))


def _png(image: Array) -> bytes:
    buffer = io.BytesIO()
    Image.fromarray(np.clip(np.round(image), 0, 255).astype(np.uint8)).save(buffer, "PNG")
    return buffer.getvalue()
