"""The bodies of a hard case: shapes, masses, where they start and how fast, and what touches what."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from scipy.spatial.transform import Rotation

from hard_cases.knobs import HardCase, Structure

GRAVITY: Final = 9.81
Vector = tuple[float, float, float]
FLOOR: Final = 0
"""The number of the floor in pairs; bodies count from 1."""
_GAP = 1e-3
_EDGES = 6
_ROD_SLOPE = (0.9, 0.4)
_LEAST_OVERLAP = 1e-3
_LEAST_TILT = 1e-9
MOST_TILT: Final = 1e-2
"""Between the faces of two hulls, rad."""


@dataclass(frozen=True)
class Shape:
    """A shape as Modelica text, the moments of inertia of 1 kg of it in m2, its least extent in m."""

    text: str
    moments: Vector
    thickness: float


@dataclass(frozen=True)
class Motion:
    """How a body starts: mass in kg, position in m, velocity in m/s, angles in rad."""

    mass: float
    position: Vector
    velocity: Vector
    angles: Vector


def has_gravity(structure: Structure) -> bool:
    """Whether the scene has gravity and a floor: all but chains."""
    return structure.kind != "chain"


def shapes(structure: Structure) -> tuple[Shape, ...]:
    """The shape of each body."""
    size, thickness = structure.size, structure.size / structure.slenderness
    if structure.kind == "ball":
        return (_sphere(size / 2),)
    if structure.kind == "box":
        return (_box(size, thickness),)
    if structure.kind == "rod":
        return (_capsule(thickness / 2, size),)
    if structure.kind == "chain":
        return (_sphere(size / 2),) * structure.count
    if structure.kind == "overlap":
        return _box(size, thickness), _sphere(size / 2)
    if structure.kind == "hulls":
        return _prism(size, thickness), _prism(0.8 * size, thickness)
    return (_box(size, thickness),) * structure.count


def pairs(structure: Structure) -> tuple[tuple[int, int], ...]:
    """Bodies that may touch; neighbours, the first one and the floor."""
    neighbours = tuple((k + 1, k) for k in range(1, structure.count))
    return (((1, FLOOR),) if has_gravity(structure) else ()) + neighbours


def gap(case: HardCase) -> float:
    """Between what strikes and what is struck at the start, m: no more than a contact time's way."""
    thickness = case.structure.size / case.structure.slenderness
    return min(_GAP * thickness, case.speed * math.pi * math.sqrt(case.mass / case.stiffness))


def motions(case: HardCase) -> tuple[Motion, ...]:
    """How each body starts."""
    structure = case.structure
    apart = gap(case)
    size, thickness = structure.size, structure.size / structure.slenderness
    light, heavy = case.mass, case.mass * case.mass_ratio
    first, second = (heavy, light) if case.heavy_first else (light, heavy)
    a, b, c = case.detail
    along = 0.5 * case.speed if structure.friction != "None" else 0.0
    if structure.kind == "ball":
        height = size / 2 + apart
        return (Motion(case.mass, (0, 0, height), (along, 0, -case.speed), (0, 0, 0)),)
    if structure.kind == "box":
        turn = (2 * math.pi * a, 2 * math.pi * b, 2 * math.pi * c)
        return (Motion(case.mass, (0, 0, _lowest(size, thickness, turn) + apart), (along, 0, -case.speed), turn),)
    if structure.kind == "rod":
        slope = _ROD_SLOPE[0] + _ROD_SLOPE[1] * a
        height = size / 2 * math.sin(slope) + thickness / 2
        return (Motion(case.mass, (0, 0, height), (-case.speed, 0, 0), (0, math.pi / 2 - slope, 0)),)
    if structure.kind == "chain":
        masses = [light if (k % 2 == 0) != case.heavy_first else heavy for k in range(structure.count)]
        return tuple(
            Motion(mass, (k * (size + apart), 0, 0), (case.speed if k == 0 else 0.0, 0, 0), (0, 0, 0))
            for k, mass in enumerate(masses)
        )
    if structure.kind == "overlap":
        share = _LEAST_OVERLAP ** (1 - a)
        box_height = thickness / 2 * (1 - share)
        ball_height = box_height + thickness / 2 + size / 2 - share * min(thickness, size) / 2
        return (
            Motion(first, (0, 0, box_height), (0, 0, 0), (0, 0, 0)),
            Motion(second, (0.1 * size * b, 0, ball_height), (0, 0, 0), (0, 0, 0)),
        )
    if structure.kind == "hulls":
        tilt = _LEAST_TILT * (MOST_TILT / _LEAST_TILT) ** a
        above = thickness * 1.5 + 0.8 * size * tilt + apart
        return (
            Motion(first, (0, 0, thickness / 2), (0, 0, 0), (0, 0, 0)),
            Motion(second, (0, 0, above), (0, 0, -case.speed), (tilt, tilt * b, c)),
        )
    found = []
    for k in range(structure.count):
        last = k == structure.count - 1
        height = (k + 0.5) * thickness + (apart if last else 0.0)
        place = (0.02 * size * math.sin(7 * (k + a)), 0.02 * size * math.sin(5 * (k + b)), height)
        # From the first to the last evenly in the logarithm, so that neighbours differ by equal factors.
        mass = first * (second / first) ** (k / (structure.count - 1))
        found.append(Motion(mass, place, (0, 0, -case.speed if last else 0.0), (0, 0, 0)))
    return tuple(found)


def _lowest(size: float, thickness: float, turn: Vector) -> float:
    """How far a box reaches below its centre, m, turned about its axes 1, 2 and 3 one after the other."""
    turned = Rotation.from_euler("XYZ", turn).as_matrix()[2]
    return float(abs(turned) @ (size, size, thickness)) / 2


def _sphere(radius: float) -> Shape:
    return Shape(f"sphere({radius!r})", (0.4 * radius**2,) * 3, 2 * radius)


def _box(size: float, thickness: float) -> Shape:
    flat, across = (size**2 + thickness**2) / 12, 2 * size**2 / 12
    return Shape(f"box({{{size!r},{size!r},{thickness!r}}})", (flat, flat, across), thickness)


def _capsule(radius: float, length: float) -> Shape:
    across = (3 * radius**2 + length**2) / 12
    return Shape(f"capsule({radius!r}, {length!r})", (across, across, radius**2 / 2), 2 * radius)


def _prism(size: float, thickness: float) -> Shape:
    corners = [
        (size / 2 * math.cos(2 * math.pi * k / _EDGES), size / 2 * math.sin(2 * math.pi * k / _EDGES))
        for k in range(_EDGES)
    ]
    vertices = [(x, y, z) for z in (-thickness / 2, thickness / 2) for x, y in corners]
    text = ",".join(f"{{{_list(vertex)}}}" for vertex in vertices)
    flat, across = (3 * (size / 2) ** 2 + thickness**2) / 12, (size / 2) ** 2 / 2
    return Shape(f"hull({{{text}}})", (flat, flat, across), thickness)


def _list(values: Sequence[float]) -> str:
    return ",".join(repr(value) for value in values)
