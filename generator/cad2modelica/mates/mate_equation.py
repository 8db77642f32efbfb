"""Mates as equations: what must be zero between two pieces of geometry, in any pose of theirs.

Points, axes (lines, cylinders, cones, circles) and planes are what kinematics sees of geometry; radii do not matter:
a mate that keeps a distance keeps that of the start.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from cad2modelica.geometry.spatial import Array, Pose

POINT, AXIS, PLANE, CIRCLE = "point", "axis", "plane", "circle"
SHAPES = {
    "point": POINT,
    "sphere": POINT,
    "line": AXIS,
    "cylinder": AXIS,
    "cone": AXIS,
    "plane": PLANE,
    "circle": CIRCLE,
}
PARALLEL = 1e-6  # sine of the angle of directions that count as parallel


@dataclass(frozen=True, eq=False)
class Feature:
    """A point, axis, plane or circle in the axes of what carries it; the direction is a unit vector."""

    shape: str
    point: Array
    axis: Array

    def at(self, pose: Pose) -> Feature:
        """The same in the world."""
        return Feature(self.shape, pose.point(self.point), pose.direction(self.axis))

    def seen_as(self, shape: str) -> Feature:
        """The same as another shape: a circle as its axis or its plane."""
        return Feature(shape, self.point, self.axis)


Residual = Callable[[Feature, Feature], Array]
"""What must be zero: lengths (m) and sines of angles, for features in the world."""


@dataclass(frozen=True, eq=False)
class MateEquation:
    """A mate between two features.

    Attributes:
        residual: gives lengths first, then sines.
        lengths: how many lengths there are.
    """

    name: str
    first: Feature
    second: Feature
    residual: Residual
    lengths: int

    def values(self, first: Pose, second: Pose, size: float) -> Array:
        """What must be zero, lengths divided by a size, with what carries the features in these poses."""
        found = self.residual(self.first.at(first), self.second.at(second))
        scale = np.ones(len(found))
        scale[: self.lengths] = 1.0 / size
        return np.asarray(found * scale)


def mate_equation(
    name: str, kind: str, first: Feature, second: Feature, start: tuple[Pose, Pose]
) -> MateEquation | None:
    """The equation of a mate of a kind (``Coincident``, ``Distance``, ...); None if there is none for it.

    Args:
        start: poses of what carries the features; distances and angles are kept as they are there.
    """
    if POINT == second.shape != first.shape or (PLANE == first.shape != second.shape):
        turned = mate_equation(name, kind, second, first, (start[1], start[0]))
        return _turned(turned) if turned is not None else None
    if CIRCLE in (first.shape, second.shape):
        return _of_circles(name, kind, first, second, start)
    make = _KINDS.get((kind, first.shape, second.shape))
    if make is None:
        return None
    residual, lengths = make(first.at(start[0]), second.at(start[1]))
    return MateEquation(name, first, second, residual, lengths)


def _turned(equation: MateEquation) -> MateEquation:
    def residual(first: Feature, second: Feature) -> Array:
        return equation.residual(second, first)

    return MateEquation(equation.name, equation.second, equation.first, residual, equation.lengths)


def _of_circles(name: str, kind: str, first: Feature, second: Feature, start: tuple[Pose, Pose]) -> MateEquation | None:
    """A circle is its axis, but to lie in a plane it is a plane."""
    both = first.shape == second.shape
    if kind == "Coincident" and both:
        axes = mate_equation(name, kind, first.seen_as(AXIS), second.seen_as(AXIS), start)
        planes = mate_equation(name, kind, first.seen_as(PLANE), second.seen_as(PLANE), start)
        if axes is None or planes is None:
            return None

        def residual(one: Feature, other: Feature) -> Array:
            arm = other.point - one.point
            return np.concatenate([arm, np.cross(one.axis, other.axis)])

        return MateEquation(name, first, second, residual, 3)
    if POINT in (first.shape, second.shape) and kind == "Coincident":
        return None  # a point on a curve
    lies = PLANE in (first.shape, second.shape) and kind in ("Coincident", "Distance", "Parallel")
    shape = PLANE if lies else AXIS
    one = first.seen_as(shape) if first.shape == CIRCLE else first
    other = second.seen_as(shape) if second.shape == CIRCLE else second
    return mate_equation(name, kind, one, other, start)


Maker = Callable[[Feature, Feature], tuple[Residual, int]]


def _constant(residual: Residual, lengths: int) -> Maker:
    return lambda _first, _second: (residual, lengths)


def _arm(first: Feature, second: Feature) -> Array:
    return np.asarray(second.point - first.point)


def _across(first: Feature, second: Feature) -> Array:
    """From the axis of the second to the point of the first, at a right angle to the axis."""
    return np.cross(second.axis, _arm(first, second))


def _sine(first: Feature, second: Feature) -> Array:
    return np.cross(first.axis, second.axis)


def _height(first: Feature, second: Feature) -> Array:
    """Of the first's point over the second's plane."""
    return np.array([_arm(first, second) @ second.axis])


def _cosine(first: Feature, second: Feature) -> Array:
    return np.array([first.axis @ second.axis])


def _joined(*residuals: Residual) -> Residual:
    return lambda first, second: np.concatenate([residual(first, second) for residual in residuals])


def _held(value: Residual, lengths: int, *more: Residual) -> Maker:
    """Keeps a value as it is at the start; further residuals must be zero."""

    def make(first: Feature, second: Feature) -> tuple[Residual, int]:
        start = value(first, second)

        def residual(one: Feature, other: Feature) -> Array:
            return np.concatenate([value(one, other) - start, *(item(one, other) for item in more)])

        return residual, lengths

    return make


def _separation(first: Feature, second: Feature) -> Array:
    return np.array([np.linalg.norm(_arm(first, second))])


def _distance_to_axis(first: Feature, second: Feature) -> Array:
    return np.array([np.linalg.norm(_across(first, second))])


def _angle(first: Feature, second: Feature) -> tuple[Residual, int]:
    """An angle as it is at the start; of none or half a turn, where its cosine does not change: parallel axes."""
    if np.linalg.norm(_sine(first, second)) < PARALLEL:
        return _sine, 0
    return _held(_cosine, 0)(first, second)


_KINDS: dict[tuple[str, str, str], Maker] = {
    ("Coincident", POINT, POINT): _constant(_arm, 3),
    ("Coincident", POINT, AXIS): _constant(_across, 3),
    ("Coincident", POINT, PLANE): _constant(_height, 1),
    ("Coincident", AXIS, AXIS): _constant(_joined(_across, _sine), 3),
    ("Coincident", AXIS, PLANE): _constant(_joined(_height, _cosine), 1),
    ("Coincident", PLANE, PLANE): _constant(_joined(_height, _sine), 1),
    ("Concentric", POINT, POINT): _constant(_arm, 3),
    ("Concentric", POINT, AXIS): _constant(_across, 3),
    ("Concentric", AXIS, AXIS): _constant(_joined(_across, _sine), 3),
    ("Distance", POINT, POINT): _held(_separation, 1),
    ("Distance", POINT, AXIS): _held(_distance_to_axis, 1),
    ("Distance", POINT, PLANE): _held(_height, 1),
    ("Distance", AXIS, AXIS): _held(_distance_to_axis, 1, _sine),
    ("Distance", AXIS, PLANE): _held(_height, 1, _cosine),
    ("Distance", PLANE, PLANE): _held(_height, 1, _sine),
    ("Parallel", AXIS, AXIS): _constant(_sine, 0),
    ("Parallel", AXIS, PLANE): _constant(_cosine, 0),
    ("Parallel", PLANE, PLANE): _constant(_sine, 0),
    ("Perpendicular", AXIS, AXIS): _constant(_cosine, 0),
    ("Perpendicular", AXIS, PLANE): _constant(_sine, 0),
    ("Perpendicular", PLANE, PLANE): _constant(_cosine, 0),
    ("Angle", AXIS, AXIS): _angle,
    ("Angle", AXIS, PLANE): _angle,
    ("Angle", PLANE, PLANE): _angle,
    ("Tangent", POINT, PLANE): _held(_height, 1),
    ("Tangent", POINT, AXIS): _held(_distance_to_axis, 1),
    ("Tangent", AXIS, PLANE): _held(_height, 1, _cosine),
    ("Tangent", AXIS, AXIS): _held(_distance_to_axis, 1, _sine),
}
