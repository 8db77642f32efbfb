"""The map of hard cases as SVG: for each knob the shares of the verdicts, and runs over pairs of quantities."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final
from xml.sax.saxutils import escape

from contact_foundation.output import whole_file

from hard_cases.knobs import NUMBERS
from hard_cases.run import Row
from hard_cases.verdict import Kind

COLORS: Final = {
    Kind.RIGHT: "#9ecf9e",
    Kind.STOPPED: "#f2c14e",
    Kind.WARNED: "#f2a65e",
    Kind.UNNAMED: "#b5561a",
    Kind.SLOW: "#a9b4bd",
    Kind.DEEP: "#7a5ea8",
    Kind.CRASHED: "#000000",
    Kind.WRONG: "#c81e3a",
}
_WORDS: Final[dict[str, Callable[[Row], str]]] = {
    "scene": lambda row: row.case.structure.kind,
    "law": lambda row: row.case.structure.law,
    "friction model": lambda row: row.case.structure.friction,
    "method of restitution": lambda row: row.case.structure.restitution,
    "bodies": lambda row: str(row.case.structure.count),
    "mode": lambda row: row.case.mode,
}
_PAIRS: Final[tuple[tuple[str, Callable[[Row], float], str, Callable[[Row], float]], ...]] = (
    ("stiffness, N/m", lambda r: r.case.stiffness, "speed, m/s", lambda r: r.case.speed),
    ("size, m", lambda r: r.case.structure.size, "tolerance", lambda r: r.case.tolerance),
    (
        "depth by thickness, expected",
        lambda r: r.expected.relative_depth,
        "tolerance times size by depth",
        lambda r: r.case.tolerance * r.case.structure.size / r.expected.depth,
    ),
    ("contact times simulated", lambda r: r.expected.contact_times, "mass ratio", lambda r: r.case.mass_ratio),
)
_BINS = 10
_COLUMNS = 4
_WIDTH, _HEIGHT = 270, 170
_PAIR_WIDTH, _PAIR_HEIGHT = 540, 380
_LEFT, _TOP, _BOTTOM, _RIGHT = 46, 26, 34, 12
_HEAD = 60


@dataclass(frozen=True)
class _Frame:
    x: float
    y: float
    width: float
    height: float

    @property
    def inner(self) -> tuple[float, float, float, float]:
        """Left, top, width and height of the plot."""
        return (
            self.x + _LEFT,
            self.y + _TOP,
            self.width - _LEFT - _RIGHT,
            self.height - _TOP - _BOTTOM,
        )


def write_map(rows: Sequence[Row], target: Path) -> None:
    """Writes the map, whole or not at all."""
    with whole_file(target) as staging:
        staging.write_text(hard_map(rows), encoding="utf-8", newline="\n")


def hard_map(rows: Sequence[Row]) -> str:
    """The map."""
    panels = [*_bars_of_numbers(rows), *_bars_of_words(rows)]
    bar_rows = math.ceil(len(panels) / _COLUMNS)
    width = _COLUMNS * _WIDTH
    pair_top = _HEAD + bar_rows * _HEIGHT
    height = pair_top + math.ceil(len(_PAIRS) / 2) * _PAIR_HEIGHT
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" '
        'font-family="sans-serif" font-size="11">',
        f'<rect width="{width}" height="{height}" fill="#ffffff"/>',
        f'<text x="12" y="22" font-size="15" font-weight="bold">{len(rows)} hard cases</text>',
        *_legend(),
    ]
    for k, (title, bars) in enumerate(panels):
        frame = _Frame(k % _COLUMNS * _WIDTH, _HEAD + k // _COLUMNS * _HEIGHT, _WIDTH, _HEIGHT)
        parts += _bars(frame, title, bars)
    for k, (x_name, x, y_name, y) in enumerate(_PAIRS):
        frame = _Frame(k % 2 * _PAIR_WIDTH, pair_top + k // 2 * _PAIR_HEIGHT, _PAIR_WIDTH, _PAIR_HEIGHT)
        parts += _scatter(frame, (x_name, y_name), [(x(row), y(row), row) for row in rows])
    return "\n".join([*parts, "</svg>\n"])


_Bars = tuple[str, list[tuple[str, list[Row]]]]


def _bars_of_numbers(rows: Sequence[Row]) -> list[_Bars]:
    panels: list[_Bars] = []
    for name, knob in NUMBERS.items():
        edges = [
            knob.low * (knob.high / knob.low) ** (k / _BINS)
            if knob.logarithmic
            else knob.low + (knob.high - knob.low) * k / _BINS
            for k in range(_BINS + 1)
        ]
        bars = []
        for k in range(_BINS):
            last = k == _BINS - 1
            own = [r for r in rows if edges[k] <= r.case.number(name) and (last or r.case.number(name) < edges[k + 1])]
            bars.append(
                (
                    f"{edges[k]:.0e}".replace("e-0", "e-").replace("e+0", "e")
                    if knob.logarithmic
                    else f"{edges[k]:.1f}",
                    own,
                )
            )
        panels.append((f"{name.replace('_', ' ')}{'' if knob.unit == '1' else f', {knob.unit}'}", bars))
    return panels


def _bars_of_words(rows: Sequence[Row]) -> list[_Bars]:
    panels: list[_Bars] = []
    for name, word in _WORDS.items():
        values = sorted({word(row) for row in rows})
        panels.append((name, [(value, [row for row in rows if word(row) == value]) for value in values]))
    return panels


def _legend() -> list[str]:
    parts = []
    x = 12.0
    for kind, color in COLORS.items():
        parts.append(f'<rect x="{x:.0f}" y="34" width="12" height="12" fill="{color}"/>')
        parts.append(f'<text x="{x + 16:.0f}" y="44">{kind.value}</text>')
        x += 30 + 5.6 * len(kind.value)
    return parts


def _bars(frame: _Frame, title: str, bars: list[tuple[str, list[Row]]]) -> list[str]:
    left, top, width, height = frame.inner
    step = width / max(len(bars), 1)
    parts = [f'<text x="{left:.0f}" y="{top - 8:.0f}" font-weight="bold">{escape(title)}</text>']
    for k, (label, rows) in enumerate(bars):
        x, bottom = left + k * step, top + height
        for kind, color in COLORS.items():
            share = sum(row.verdict.kind is kind for row in rows) / max(len(rows), 1)
            bottom -= share * height
            if share:
                note = f"{label}: {share:.0%} of {len(rows)} {kind.value}"
                parts.append(
                    f'<rect x="{x:.1f}" y="{bottom:.1f}" width="{0.9 * step:.1f}" height="{share * height:.1f}" '
                    f'fill="{color}"><title>{escape(note)}</title></rect>'
                )
        if len(bars) < _BINS or k % 2 == 0:
            text = label if len(label) * 6 <= step * 1.9 else label[: max(3, int(step / 5.4))]
            at = f'x="{x + 0.45 * step:.1f}" y="{top + height + 12:.1f}"'
            parts.append(f'<text {at} font-size="9" text-anchor="middle">{escape(text)}</text>')
    for share in (0, 0.5, 1):
        y = top + height * (1 - share) + 4
        parts.append(f'<text x="{left - 5:.0f}" y="{y:.0f}" font-size="9" text-anchor="end">{share:.0%}</text>')
    return parts


def _scatter(frame: _Frame, names: tuple[str, str], points: list[tuple[float, float, Row]]) -> list[str]:
    left, top, width, height = frame.inner
    shown = [(math.log10(x), math.log10(y), row) for x, y, row in points if x > 0 and y > 0]
    if not shown:
        return []
    axes = []
    for values in ([x for x, _, _ in shown], [y for _, y, _ in shown]):
        low, high = math.floor(min(values)), math.ceil(max(values))
        axes.append((low, max(high, low + 1)))
    (x0, x1), (y0, y1) = axes
    parts = [
        f'<text x="{left + width / 2:.0f}" y="{top + height + 28:.0f}" text-anchor="middle">{escape(names[0])}</text>',
        f'<text x="{left:.0f}" y="{top - 8:.0f}">{escape(names[1])}</text>',
    ]
    for k in range(x0, x1 + 1, max(1, (x1 - x0) // 8)):
        x = left + (k - x0) / (x1 - x0) * width
        parts.append(f'<path d="M{x:.1f} {top:.1f}v{height:.1f}" stroke="#dddddd"/>')
        parts.append(f'<text x="{x:.1f}" y="{top + height + 13:.1f}" font-size="9" text-anchor="middle">1e{k}</text>')
    for k in range(y0, y1 + 1, max(1, (y1 - y0) // 8)):
        y = top + height - (k - y0) / (y1 - y0) * height
        parts.append(f'<path d="M{left:.1f} {y:.1f}h{width:.1f}" stroke="#dddddd"/>')
        parts.append(f'<text x="{left - 5:.1f}" y="{y + 3:.1f}" font-size="9" text-anchor="end">1e{k}</text>')
    places: dict[Kind, list[str]] = {kind: [] for kind in COLORS}
    for x_value, y_value, row in shown:
        x = left + (x_value - x0) / (x1 - x0) * width
        y = top + height - (y_value - y0) / (y1 - y0) * height
        places[row.verdict.kind].append(f"M{x:.0f} {y:.0f}h0")
    for kind, dots in places.items():  # one path a colour keeps the file small; the worst verdicts lie on top
        if dots:
            style = f'stroke="{COLORS[kind]}" stroke-width="4.5" stroke-linecap="round"'
            parts.append(f'<path {style} d="{"".join(dots)}"/>')
    return parts
