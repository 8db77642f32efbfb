"""Random grounds of small scenes: level half-spaces, and blocks, hulls, meshes and terrain with edges to strike."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final

_TOP: Final = -0.02
"""Height in m that no part of a ground is above, so that bodies are clear of it however it is turned."""
_MESH_POINTS: Final = 24
"""Contact points of a pair with a mesh: as few as keep its energy."""


@dataclass(frozen=True)
class Ground:
    """A ground: its kind, the call of its shape (none for the half-space that is there without), points of a pair."""

    kind: str
    shape: str
    points: int


def random_ground(source: random.Random) -> Ground:
    """One of all kinds; bodies are above the origin."""
    kind = source.choice(tuple(_KINDS))
    return _KINDS[kind](source)


def _half_space(_: random.Random) -> Ground:
    return Ground("halfSpace", "", 4)


def _box(source: random.Random) -> Ground:
    """A block that is tilted a little, its sides near enough to fall off."""
    x, y, z = (source.uniform(0.1, 0.6), source.uniform(0.1, 0.6), source.uniform(0.1, 0.3))
    angle = source.uniform(-0.2, 0.2)
    cosine, sine = math.cos(angle), math.sin(angle)
    middle = _TOP - (z * cosine + x * abs(sine)) / 2.0
    rotation = _text(((cosine, 0.0, -sine), (0.0, 1.0, 0.0), (sine, 0.0, cosine)))
    shape = (
        f"ContactMultiBody.Shapes.box({_text((x, y, z))}, position={_text((0.0, 0.0, middle))}, rotation={rotation})"
    )
    return Ground("box", shape, 8)


def _hull(source: random.Random) -> Ground:
    """A block whose top is smaller than its bottom."""
    x, y, slope = source.uniform(0.1, 0.4), source.uniform(0.1, 0.4), source.uniform(0.02, 0.2)
    corners = [
        (side * (x + out), end * (y + out), height)
        for out, height in ((0.0, _TOP), (slope, _TOP - 0.2))
        for side in (-1.0, 1.0)
        for end in (-1.0, 1.0)
    ]
    return Ground("hull", f"ContactMultiBody.Shapes.hull({_text(corners)})", 8)


def _mesh(source: random.Random) -> Ground:
    """A step, closed and no hull."""
    half, step = source.uniform(0.2, 0.5), source.uniform(0.01, 0.1)
    profile = [
        (-half, _TOP - 0.3),
        (half, _TOP - 0.3),
        (half, _TOP - step),
        (0.0, _TOP - step),
        (0.0, _TOP),
        (-half, _TOP),
    ]
    corners = [(x, y, z) for y in (-half, half) for x, z in profile]
    around = len(profile)
    triangles = [(1, 2, 3), (1, 3, 4), (1, 4, 5), (1, 5, 6)]
    triangles += [(a + around, c + around, b + around) for a, b, c in triangles]
    for first in range(1, around + 1):
        second = first % around + 1
        triangles += [(first, second + around, second), (first, first + around, second + around)]
    rows = ",".join("{" + ",".join(map(str, triangle)) + "}" for triangle in triangles)
    return Ground("mesh", f"ContactMultiBody.Shapes.mesh({_text(corners)}, {{{rows}}})", _MESH_POINTS)


def _height_field(source: random.Random) -> Ground:
    """Hills and dales of some centimetres."""
    size, rough, count = source.uniform(0.8, 2.0), source.uniform(0.0, 0.05), 9
    heights = [[_TOP - source.uniform(0.0, rough) for _ in range(count)] for _ in range(count)]
    shape = f"ContactMultiBody.Shapes.heightField({_text((size, size))}, {_text(heights)})"
    return Ground("heightField", shape, _MESH_POINTS)


_KINDS: Final[dict[str, Callable[[random.Random], Ground]]] = {
    "halfSpace": _half_space,
    "box": _box,
    "hull": _hull,
    "mesh": _mesh,
    "heightField": _height_field,
}

_Numbers = Sequence[float] | Sequence[Sequence[float]]


def _text(numbers: _Numbers) -> str:
    """An array as Modelica has it."""
    return "{" + ",".join(f"{row:.6g}" if isinstance(row, float) else _text(row) for row in numbers) + "}"
