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
Numbers = NDArray[np.int64]

WIDTH, HEIGHT = 560, 420  # px
FINER = 2  # drawn so many times finer and averaged
FRAME = 0.05  # of the picture is left free on every side
SMALL = 400  # points around a triangle below which it is painted together with others
AT_ONCE = 1 << 18  # points that are looked at together
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
    image = np.full((HEIGHT, WIDTH, 3), float(BACKGROUND))
    columns, rows = _extent(corners[..., 0], WIDTH), _extent(corners[..., 1], HEIGHT)
    corners = corners - [columns.start * FINER, rows.start * FINER, 0]  # whole numbers: no bit of a difference is lost
    width, height = ((places.stop - places.start) * FINER for places in (columns, rows))
    image[rows, columns] = _averaged(_painted(corners, color, width, height))
    return _png(image)


def _extent(coordinates: Array, count: int) -> slice:
    """Which of a picture's rows or columns are painted: those of the solids and one more on either side."""
    if not coordinates.size:
        return slice(0, 1)
    first, last = (int(np.clip(value // FINER, 0, count - 1)) for value in (coordinates.min(), coordinates.max()))
    return slice(max(first - 1, 0), min(last + 2, count))


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
    depth, owner = _foremost(corners, width, height)
    light = LIGHT / np.linalg.norm(LIGHT)
    shade = 0.6 + 0.4 * np.clip(dot(normal, light), 0.0, 1.0)
    image = np.full((height, width, 3), float(BACKGROUND))
    hit = owner >= 0
    image[hit] = 255 * (color * shade[:, None])[owner[hit]]
    image[_edges(normal, owner, np.where(hit, depth, -1e9))] *= EDGE_SHADE
    return image


def _foremost(corners: Array, width: int, height: int) -> tuple[Array, Numbers]:
    """Depth and number of the triangle in front at each point, of equal ones the first; -1 where there is none."""
    depth = np.full((height, width), -np.inf)
    owner = np.full((height, width), -1, dtype=np.int64)
    low = np.maximum(np.ceil(corners[..., :2].min(axis=1) - 0.5), 0).astype(np.int64)
    high = np.minimum(np.floor(corners[..., :2].max(axis=1) - 0.5), [width - 1, height - 1]).astype(np.int64)
    shown = (low <= high).all(axis=1)
    points = (high - low + 1).prod(axis=1)
    small = np.flatnonzero(shown & (points <= SMALL))
    for part in np.split(small, np.flatnonzero(np.diff(np.cumsum(points[small]) // AT_ONCE)) + 1):
        number = np.repeat(part, points[part])
        index = np.arange(len(number)) - np.repeat(np.cumsum(points[part]) - points[part], points[part])
        columns = (high - low + 1)[number, 0]
        x, y = low[number, 0] + index % columns, low[number, 1] + index // columns
        inside, near = _covered(np.moveaxis(corners[number], 0, -1), x + 0.5, y + 0.5)
        inside &= near > depth[y, x]
        number, near, x, y = number[inside], near[inside], x[inside], y[inside]
        np.maximum.at(depth, (y, x), near)
        first = np.flatnonzero(near == depth[y, x])[::-1]  # of a repeated point the last counts
        owner[y[first], x[first]] = number[first]
    for large in np.flatnonzero(shown & (points > SMALL)):
        (x0, y0), (x1, y1) = low[large], high[large]
        place = (slice(y0, y1 + 1), slice(x0, x1 + 1))
        inside, near = _covered(corners[large], np.arange(x0, x1 + 1) + 0.5, (np.arange(y0, y1 + 1) + 0.5)[:, None])
        inside &= (near > depth[place]) | ((near == depth[place]) & (large < owner[place]))
        depth[place][inside] = near[inside]
        owner[place][inside] = large
    return depth, owner


def _covered(corners: Array, x: Array, y: Array) -> tuple[Mask, Array]:
    """Which points lie in a triangle, and how near its plane is there."""
    a, b, c = corners
    whole = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
    of_b = ((x - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (y - a[1])) / whole
    of_c = ((b[0] - a[0]) * (y - a[1]) - (x - a[0]) * (b[1] - a[1])) / whole
    return (of_b >= 0) & (of_c >= 0) & (of_b + of_c <= 1), a[2] + of_b * (b[2] - a[2]) + of_c * (c[2] - a[2])


def _edges(normal: Array, owner: Numbers, depth: Array) -> Mask:
    """Where the solid ends, or turns sharply, against the point to the right or below."""
    hit = owner >= 0
    edge = np.zeros(hit.shape, dtype=np.bool_)
    for here, there in (
        ((slice(None), slice(None, -1)), (slice(None), slice(1, None))),
        ((slice(None, -1), slice(None)), (slice(1, None), slice(None))),
    ):
        step = np.abs(depth[here] - depth[there])
        # Elsewhere both points lie on one triangle, in a step that every slope explains.
        asked = np.nonzero(hit[here] & hit[there] & ((owner[here] != owner[there]) | (step > 3.9)))
        first, second = normal[owner[here][asked]], normal[owner[there][asked]]
        # A step in depth that the slopes of the two points do not explain.
        steep = 2.0 / np.maximum(np.minimum(first[:, 2], second[:, 2]), 0.1)
        edge[here][asked] |= (dot(first, second) < EDGE_TURN) | (step[asked] > 2 + steep)
        edge[here] |= hit[here] & ~hit[there]
        edge[there] |= hit[there] & ~hit[here]
    return edge


def _averaged(image: Array) -> Array:
    height, width = image.shape[:2]
    return np.asarray(image.reshape(height // FINER, FINER, width // FINER, FINER, 3).mean(axis=(1, 3)))


def _png(image: Array) -> bytes:
    buffer = io.BytesIO()
    Image.fromarray(np.clip(np.round(image), 0, 255).astype(np.uint8)).save(buffer, "PNG")
    return buffer.getvalue()
