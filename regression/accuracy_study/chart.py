"""A chart of error over processor time, as SVG."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final
from xml.sax.saxutils import escape

Point = tuple[float, float, str]
"""Across, up, and what the point is called."""

_WIDTH, _HEIGHT = 760, 440
_LEFT, _RIGHT, _TOP, _BOTTOM = 76, 250, 40, 56
COLORS: Final = ("#1f5fa8", "#c4551d", "#2c8a4b", "#8a3fa0", "#a07c12", "#137d8a", "#b3324d", "#5b6770")
_MARKS: Final = ("circle", "square", "diamond", "triangle")
_LONGEST_LABEL = 36
_PADDING = 0.06
_LEAST_SPAN = 0.8
_DECADES_OF_TICKS = 3
_SUPERSCRIPTS: Final = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


@dataclass(frozen=True)
class Line:
    """A curve.

    Attributes:
        label: in the legend.
        points: from one end to the other.
        color: number of its colour.
        mark: number of its mark.
    """

    label: str
    points: Sequence[Point]
    color: int
    mark: int


def chart(title: str, lines: Sequence[Line], best: Sequence[Point]) -> str:
    """Error over processor time of every line, with the points that nothing beats dashed; "" without a point."""
    every = [point for line in lines for point in line.points]
    if not every:
        return ""
    axes = _Axes(_padded([x for x, _, _ in every]), _decades([y for _, y, _ in every]))
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {_WIDTH} {_HEIGHT}" width="{_WIDTH}" '
        f'height="{_HEIGHT}" font-family="sans-serif" font-size="12">',
        f'<rect width="{_WIDTH}" height="{_HEIGHT}" fill="#ffffff"/>',
        f'<text x="{_LEFT}" y="24" font-size="15" font-weight="bold">{escape(title)}</text>',
        *axes.drawn(),
        _line([axes.at(point) for point in best], "#222222", dashed=True),
    ]
    for number, line in enumerate(lines):
        parts += _curve(axes, line, number, any(other.mark for other in lines))
    parts.append(_legend_line(len(lines), "#222222", "Pareto front", dashed=True))
    return "\n".join([*(part for part in parts if part), "</svg>\n"])


@dataclass(frozen=True)
class _Axes:
    """Logarithmic axes: (from, to) as exponents of ten, of y whole ones."""

    x: tuple[float, float]
    y: tuple[int, int]

    def at(self, point: Point) -> tuple[float, float]:
        across = (math.log10(point[0]) - self.x[0]) / (self.x[1] - self.x[0])
        up = (math.log10(point[1]) - self.y[0]) / (self.y[1] - self.y[0])
        return _LEFT + across * (_WIDTH - _LEFT - _RIGHT), _HEIGHT - _BOTTOM - up * (_HEIGHT - _TOP - _BOTTOM)

    def drawn(self) -> list[str]:
        """Grid lines at the decades, their numbers, and the axes' names."""
        right, bottom = _WIDTH - _RIGHT, _HEIGHT - _BOTTOM
        parts = []
        for tick in _ticks(*self.x):
            x, _ = self.at((tick, 10.0 ** self.y[0], ""))
            parts.append(f'<path d="M{x:.1f} {_TOP}V{bottom}" stroke="#dddddd"/>')
            parts.append(f'<text x="{x:.1f}" y="{bottom + 18}" text-anchor="middle">{tick:g}</text>')
        for k in range(self.y[0], self.y[1] + 1):
            _, y = self.at((10.0 ** self.x[0], 10.0**k, ""))
            parts.append(f'<path d="M{_LEFT} {y:.1f}H{right}" stroke="#dddddd"/>')
            parts.append(f'<text x="{_LEFT - 8}" y="{y + 4:.1f}" text-anchor="end">{_power(k)}</text>')
        middle = (_TOP + bottom) / 2
        parts.append(
            f'<text x="{(_LEFT + right) / 2}" y="{bottom + 40}" text-anchor="middle">processor time in s</text>'
        )
        parts.append(f'<text transform="translate(20 {middle}) rotate(-90)" text-anchor="middle">error</text>')
        return parts


def _decades(values: Sequence[float]) -> tuple[int, int]:
    low, high = math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))
    return (low, high) if high > low else (low, low + 1)


def _padded(values: Sequence[float]) -> tuple[float, float]:
    low, high = math.log10(min(values)), math.log10(max(values))
    more = max(_PADDING * (high - low), _LEAST_SPAN / 2 - (high - low) / 2)
    return low - more, high + more


def _ticks(low: float, high: float) -> list[float]:
    """1, 2 and 5 times powers of ten, over more than three decades the powers alone."""
    steps = (1.0, 2.0, 5.0) if high - low < _DECADES_OF_TICKS else (1.0,)
    every = [step * 10.0**k for k in range(math.floor(low), math.ceil(high) + 1) for step in steps]
    return [tick for tick in every if low <= math.log10(tick) <= high]


def _power(k: int) -> str:
    return "10" + str(k).translate(_SUPERSCRIPTS)


def _curve(axes: _Axes, line: Line, number: int, marks_tell: bool) -> list[str]:
    color = COLORS[line.color % len(COLORS)]
    places = [axes.at(point) for point in line.points]
    mark = _MARKS[line.mark % len(_MARKS)]
    dashed = line.mark >= len(_MARKS)
    parts = [_line(places, color, dashed)]
    for (x, y), (_, _, note) in zip(places, line.points, strict=True):
        parts.append(_mark(x, y, color, mark, note))
    parts.append(_legend_line(number, color, line.label, dashed=dashed, mark=mark if marks_tell else ""))
    return parts


def _line(places: Sequence[tuple[float, float]], color: str, dashed: bool = False) -> str:
    if len(places) < 2:
        return ""
    path = "L".join(f"{x:.1f} {y:.1f}" for x, y in places)
    style = ' stroke-dasharray="5 4"' if dashed else ""
    return f'<path d="M{path}" fill="none" stroke="{color}" stroke-width="1.5"{style}/>'


def _mark(x: float, y: float, color: str, mark: str, note: str) -> str:
    title = f"<title>{escape(note)}</title>"
    if mark == "circle":
        return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5" fill="{color}">{title}</circle>'
    shapes = {
        "square": "M-3.2 -3.2H3.2V3.2H-3.2Z",
        "diamond": "M0 -4.6L4.6 0L0 4.6L-4.6 0Z",
        "triangle": "M0 -4.4L4.2 3.2H-4.2Z",
    }
    return f'<path transform="translate({x:.1f} {y:.1f})" d="{shapes[mark]}" fill="{color}">{title}</path>'


def _legend_line(number: int, color: str, label: str, dashed: bool = False, mark: str = "") -> str:
    x, y = _WIDTH - _RIGHT + 12, _TOP + 8 + 18 * number
    if y > _HEIGHT - 12:
        return ""
    style = ' stroke-dasharray="5 4"' if dashed else ""
    text = label if len(label) <= _LONGEST_LABEL else label[: _LONGEST_LABEL - 1] + "…"
    return (
        f'<path d="M{x} {y}h18" stroke="{color}" stroke-width="2"{style}/>'
        + (_mark(x + 9, y, color, mark, text) if mark else "")
        + f'<text x="{x + 24}" y="{y + 4}" font-size="11">{escape(text)}</text>'
    )
