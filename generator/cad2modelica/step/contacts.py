"""Where faces of two parts meet so that they guide each other: shafts in holes, balls in sockets, planes on planes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from cad2modelica.geometry.spatial import Array, perpendicular
from cad2modelica.step.part_faces import PartFaces, PlaneFace, RoundFace

DISTANCE_TOLERANCE = 2e-4  # of the smaller part's size
LEAST_DISTANCE = 2e-5  # m: clearances and roundings of drawings
ANGLE_TOLERANCE = 2e-3  # rad
RADIUS_TOLERANCE = 0.12  # of the radius: clearance, threads drawn as plain cylinders
LEAST_DEPTH = 0.05  # of the radius that a shaft is in its hole; else they are in line only
WIDEST = 2.5  # diameters of a shaft that a hole may have around it
LEAST_OVERLAP = 0.01  # of the smaller face's area
SAMPLES = np.array(
    [[1, 1, 1], [4, 1, 1], [1, 4, 1], [1, 1, 4], [1, 2, 2], [2, 1, 2], [2, 2, 1]], dtype=np.float64
)  # barycentric, unscaled

FIT, LOOSE, ALIGNED, BALL, FACE = "fit", "loose fit", "aligned holes", "ball", "face"


@dataclass(frozen=True, eq=False)
class FaceContact:
    """Two faces that meet.

    Attributes:
        kind: ``FIT`` (shaft in hole), ``LOOSE`` (in a wider one, or in line with it), ``ALIGNED`` (holes of
            equal size behind each other), ``BALL`` or ``FACE``.
        point: shape (3,), m.
        axis: of the fit or normal of the face, unit vector.
        measure: length in common over the diameter (fits), or area in common, m2 (faces).
        text: what was seen, for the modeller.
    """

    kind: str
    first: str
    second: str
    point: Array
    axis: Array
    measure: float
    text: str


def face_contacts(first: PartFaces, second: PartFaces) -> Iterator[FaceContact]:
    """All places where faces of two parts guide each other."""
    slack = max(DISTANCE_TOLERANCE * min(first.size, second.size), LEAST_DISTANCE)
    if (first.low > second.high + slack).any() or (second.low > first.high + slack).any():
        return
    for one in first.rounds:
        for other in second.rounds:
            found = _round_contact(one, other, slack)
            if found is not None:
                kind, point, measure, text = found
                yield FaceContact(kind, first.name, second.name, point, one.axis, measure, text)
    for plane in first.planes:
        for opposite in second.planes:
            area = _common_area(plane, opposite, slack)
            if area > 0:
                text = f"planes with {area * 1e6:.3g} mm2 in common"
                yield FaceContact(FACE, first.name, second.name, plane.point, plane.normal, area, text)


def _round_contact(one: RoundFace, other: RoundFace, slack: float) -> tuple[str, Array, float, str] | None:
    if one.kind != other.kind:
        return None
    larger, smaller = max(one.radius, other.radius), min(one.radius, other.radius)
    if larger > WIDEST * smaller:
        return None
    close = larger - smaller < RADIUS_TOLERANCE * larger + LEAST_DISTANCE
    arm = other.point - one.point
    millimetres = f"{one.radius * 2e3:.4g} and {other.radius * 2e3:.4g} mm"
    if one.kind == "sphere":
        if one.hollow == other.hollow or not close or np.linalg.norm(arm) > slack:
            return None
        return BALL, one.point, 1.0, f"ball in socket, diameters {millimetres}"
    if np.linalg.norm(np.cross(one.axis, other.axis)) > ANGLE_TOLERANCE:
        return None
    along = float(arm @ one.axis)
    if np.linalg.norm(arm - along * one.axis) > slack:
        return None
    low = max(-one.half_length, along - other.half_length)
    high = min(one.half_length, along + other.half_length)
    middle = one.point + one.axis * (low + high) / 2
    if one.hollow != other.hollow:
        shaft, hole = (one, other) if other.hollow else (other, one)
        if shaft.radius > hole.radius * (1 + 0.02) + LEAST_DISTANCE or low - high > larger:
            return None
        if high - low < LEAST_DEPTH * larger:
            return LOOSE, middle, 0.0, f"shaft in line with a hole, diameters {millimetres}"
        measure = (high - low) / (2 * larger)
        wider = "" if close else "wider "
        text = f"shaft in {wider}hole, diameters {millimetres}, {(high - low) * 1e3:.3g} mm in common"
        return FIT if close else LOOSE, middle, measure, text
    if one.hollow and abs(one.radius - other.radius) < 0.02 * larger and low - high < larger:
        return ALIGNED, middle, 0.0, f"holes behind each other, diameters {millimetres}"
    return None


def _common_area(one: PlaneFace, other: PlaneFace, slack: float) -> float:
    """The area in which two plane faces lie on each other, normals opposite, m2."""
    if one.normal @ other.normal > -1 + ANGLE_TOLERANCE**2 or abs((other.point - one.point) @ one.normal) > slack:
        return 0.0
    small, large = (one, other) if one.area < other.area else (other, one)
    first = perpendicular(small.normal)
    frame = np.array([first, np.cross(small.normal, first)]).T
    inside, outer = small.triangles @ frame, large.triangles @ frame
    if (inside.reshape(-1, 2).min(axis=0) > outer.reshape(-1, 2).max(axis=0)).any() or (
        outer.reshape(-1, 2).min(axis=0) > inside.reshape(-1, 2).max(axis=0)
    ).any():
        return 0.0
    weights = SAMPLES / SAMPLES.sum(axis=1, keepdims=True)
    points = np.einsum("sk,tkd->tsd", weights, inside)
    covered = _covered(points.reshape(-1, 2), outer).reshape(points.shape[:2]).mean(axis=1)
    sides = inside[:, 1:] - inside[:, :1]
    areas = np.abs(sides[:, 0, 0] * sides[:, 1, 1] - sides[:, 0, 1] * sides[:, 1, 0]) / 2
    common = float(areas @ covered)
    return common if common > LEAST_OVERLAP * small.area else 0.0


def _covered(points: Array, triangles: Array) -> Array:
    """Which points, shape (n, 2), lie in one of the triangles, shape (m, 3, 2)."""
    found = np.zeros(len(points), dtype=bool)
    for corner in triangles:
        edges = np.roll(corner, -1, axis=0) - corner
        arms = points[:, None, :] - corner[None]
        crosses = edges[None, :, 0] * arms[..., 1] - edges[None, :, 1] * arms[..., 0]
        found |= (crosses >= 0).all(axis=1) | (crosses <= 0).all(axis=1)
    return found
