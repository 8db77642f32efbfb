"""Draws the icon of a model (Modelica 3.6, section 18.6) as an image of points, by Pillow.

Texts are left out: an image of this size has no room for a legible name, which importers write below it anyway.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Final

import numpy as np
from PIL import Image, ImageDraw

from modelica2fmu.description.icon import encode_png
from modelica2fmu.description.icon_annotation import Call, Icon, Item, read_icon

_SIZE: Final = 96
_OVERSAMPLING: Final = 8
_THINNEST: Final = 1.1  # points, of a line
_MILLIMETRE: Final = 4.0  # units of the coordinate system a line of 1 mm is wide
_CURVE_STEPS: Final = 12
_MOST_POINTS: Final = 2000
_FARTHEST: Final = 1e5  # samples

_Points = list[tuple[float, float]]


def icon_png(model: str, sources: Sequence[Path]) -> bytes | None:
    """The icon of a model as PNG of 96 x 96 pixels with transparent background; None where it has no icon.

    Args:
        model: full Modelica name.
        sources: Modelica files, package folders, and folders that contain packages.
    """
    icon = read_icon(model, sources)
    if icon is None:
        return None
    canvas = _Canvas(icon)
    for shape in icon.graphics:
        canvas.draw(shape)
    return canvas.png() if canvas.is_drawn else None


class _Canvas:
    """Paints shapes one over the other, larger than they are shown.

    Attributes:
        is_drawn: = true, if a shape has left something.
    """

    def __init__(self, icon: Icon) -> None:
        left, bottom, right, top = icon.extent
        self._count = _SIZE * _OVERSAMPLING
        self._unit = max(right - left, top - bottom) / self._count  # length of a sample
        self._middle = (left + right) / 2, (bottom + top) / 2
        self._image = Image.new("RGBA", (self._count, self._count))
        self.is_drawn = False

    def png(self) -> bytes:
        """The image, averaged over its samples; colours weighted by opacity."""
        small = self._image.convert("RGBa").resize((_SIZE, _SIZE), Image.Resampling.BOX).convert("RGBA")
        return encode_png(np.asarray(small))

    def draw(self, shape: Call) -> None:
        """Draws a shape; those of unknown kind, or whose visibility depends on the model, are passed over."""
        if shape.named.get("visible", "true") != "true":
            return
        drawing = {
            "Line": self._line, "Polygon": self._polygon, "Rectangle": self._rectangle, "Ellipse": self._ellipse,
        }.get(shape.name)  # fmt: skip
        if drawing is not None:
            drawing(shape)

    # --- shapes ---

    def _line(self, shape: Call) -> None:
        points = _placed(shape, _smoothed(shape, _points(shape), closed=False))
        self._stroke(self._samples(points), shape, "color", "thickness")

    def _polygon(self, shape: Call) -> None:
        points = _points(shape)
        if len(points) > 2:
            self._area(shape, _smoothed(shape, points, closed=True))

    def _rectangle(self, shape: Call) -> None:
        box = _box(shape)
        if box is None:
            return
        left, bottom, right, top = box
        radius = min(abs(_number(shape, "radius", 0.0)), (right - left) / 2, (top - bottom) / 2)
        if radius <= 0:
            self._area(shape, [(left, bottom), (right, bottom), (right, top), (left, top)])
            return
        points: _Points = []
        corners = ((right, top, 0), (left, top, 1), (left, bottom, 2), (right, bottom, 3))
        for x, y, quarter in corners:
            centre = (
                x - math.copysign(radius, x - (left + right) / 2),
                y - math.copysign(radius, y - (bottom + top) / 2),
            )
            for step in range(_CURVE_STEPS + 1):
                angle = (quarter + step / _CURVE_STEPS) * math.pi / 2
                points.append((centre[0] + radius * math.cos(angle), centre[1] + radius * math.sin(angle)))
        self._area(shape, points)

    def _ellipse(self, shape: Call) -> None:
        box = _box(shape)
        if box is None:
            return
        left, bottom, right, top = box
        start, end = _number(shape, "startAngle", 0.0), _number(shape, "endAngle", 360.0)
        count = 4 * _CURVE_STEPS
        angles = [math.radians(start + (end - start) * step / count) for step in range(count + 1)]
        points = [
            ((left + right) / 2 + (right - left) / 2 * math.cos(angle),
             (bottom + top) / 2 + (top - bottom) / 2 * math.sin(angle))
            for angle in angles
        ]  # fmt: skip
        if abs(end - start) < 360:
            points.append(((left + right) / 2, (bottom + top) / 2))
        self._area(shape, points)

    # --- painting ---

    def _area(self, shape: Call, outline: _Points) -> None:
        points = self._samples(_placed(shape, outline))
        pattern = str(shape.named.get("fillPattern", "None")).rsplit(".", 1)[-1]
        if pattern != "None":
            mask = Image.new("L", self._image.size)
            ImageDraw.Draw(mask).polygon(points, fill=255)
            fill = Image.new("RGBA", self._image.size, _rgb(_colour(shape, "fillColor")))
            if pattern in ("HorizontalCylinder", "VerticalCylinder", "Sphere"):
                fill = self._shaded(points, pattern, _colour(shape, "lineColor"), _colour(shape, "fillColor"))
            self._paint(fill, mask)
        self._stroke([*points, points[0]], shape, "lineColor", "lineThickness")

    def _shaded(self, points: _Points, pattern: str, edge: Sequence[float], middle: Sequence[float]) -> Image.Image:
        """Colours from an edge over the middle to the other edge."""
        x, y = np.array(points).T
        row, column = np.mgrid[0 : self._count, 0 : self._count] + 0.5
        across = np.abs(column - (x.min() + x.max()) / 2) / max(np.ptp(x) / 2, 1e-9)
        along = np.abs(row - (y.min() + y.max()) / 2) / max(np.ptp(y) / 2, 1e-9)
        distance = {"HorizontalCylinder": along, "VerticalCylinder": across}.get(pattern, np.hypot(across, along))
        share = np.clip(distance, 0, 1)[..., None]
        colours = share * np.array(edge) + (1 - share) * np.array(middle)
        return Image.fromarray(np.clip(np.rint(colours), 0, 255).astype(np.uint8)).convert("RGBA")

    def _stroke(self, points: _Points, shape: Call, colour: str, thickness: str) -> None:
        if str(shape.named.get("pattern", "Solid")).endswith("None") or len(points) < 2:
            return
        least = _THINNEST * _OVERSAMPLING
        width = min(max(_number(shape, thickness, 0.25) * _MILLIMETRE / self._unit, least), self._count)
        mask = Image.new("L", self._image.size)
        pen = ImageDraw.Draw(mask)
        pen.line(points, fill=255, width=round(width))
        for x, y in points:  # round ends and bends
            pen.ellipse((x - width / 2, y - width / 2, x + width / 2, y + width / 2), fill=255)
        self._paint(Image.new("RGBA", self._image.size, _rgb(_colour(shape, colour))), mask)

    def _samples(self, points: _Points) -> _Points:
        """Points of the coordinate system as places in the large image."""
        (x0, y0), unit = self._middle, self._unit
        return [(self._sample((x - x0) / unit), self._sample((y0 - y) / unit)) for x, y in points]

    def _sample(self, place: float) -> float:
        """From the image's middle to its corner, kept within what Pillow computes with."""
        return self._count / 2 + min(max(place, -_FARTHEST), _FARTHEST)

    def _paint(self, fill: Image.Image, mask: Image.Image) -> None:
        self._image.paste(fill, mask=mask)
        self.is_drawn = self.is_drawn or mask.getbbox() is not None


def _rgb(colour: Sequence[float]) -> tuple[int, int, int]:
    red, green, blue = (min(max(round(part), 0), 255) for part in colour)
    return red, green, blue


def _number(shape: Call, name: str, default: float) -> float:
    value = shape.named.get(name, default)
    return value if isinstance(value, float) and math.isfinite(value) else default


def _pairs(item: Item | None) -> _Points:
    if not isinstance(item, list):
        return []
    found: _Points = []
    for pair in item[:_MOST_POINTS]:
        if isinstance(pair, list) and len(pair) == 2 and all(isinstance(number, float) for number in pair):
            x, y = pair
            assert isinstance(x, float)
            assert isinstance(y, float)
            if math.isfinite(x) and math.isfinite(y):
                found.append((x, y))
    return found


def _points(shape: Call) -> _Points:
    return _pairs(shape.named.get("points"))


def _box(shape: Call) -> tuple[float, float, float, float] | None:
    corners = _pairs(shape.named.get("extent"))
    if len(corners) != 2:
        return None
    (x0, y0), (x1, y1) = corners
    return min(x0, x1), min(y0, y1), max(x0, x1), max(y0, y1)


def _colour(shape: Call, name: str) -> tuple[float, float, float]:
    value = shape.named.get(name)
    numbers = [item for item in value if isinstance(item, float)] if isinstance(value, list) else []
    return (numbers[0], numbers[1], numbers[2]) if len(numbers) == 3 else (0.0, 0.0, 0.0)


def _placed(shape: Call, points: _Points) -> _Points:
    """Points turned by the shape's rotation and moved to its origin."""
    x0, y0 = next(iter(_pairs([shape.named.get("origin", [0.0, 0.0])])), (0.0, 0.0))
    angle = math.radians(_number(shape, "rotation", 0.0))
    cosine, sine = math.cos(angle), math.sin(angle)
    return [(x0 + cosine * x - sine * y, y0 + sine * x + cosine * y) for x, y in points]


def _smoothed(shape: Call, points: _Points, closed: bool) -> _Points:
    """The points, or, with ``Smooth.Bezier``, parabolas that touch the lines in their middles."""
    if not str(shape.named.get("smooth", "")).endswith("Bezier") or len(points) < 3:
        return points

    def middle(i: int) -> tuple[float, float]:
        """Of the line that leads to point i."""
        (x0, y0), (x1, y1) = points[i - 1], points[i % len(points)]
        return (x0 + x1) / 2, (y0 + y1) / 2

    result: _Points = [] if closed else [points[0]]
    for i in range(0 if closed else 1, len(points) if closed else len(points) - 1):
        (x0, y0), (x1, y1), (x2, y2) = middle(i), points[i], middle(i + 1)
        for step in range(_CURVE_STEPS + 1):
            t = step / _CURVE_STEPS
            a, b, c = (1 - t) ** 2, 2 * t * (1 - t), t**2
            result.append((a * x0 + b * x1 + c * x2, a * y0 + b * y1 + c * y2))
    return result if closed else [*result, points[-1]]
