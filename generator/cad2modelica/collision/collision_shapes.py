"""Collision shapes from meshes: spheres, boxes, cylinders and capsules are recognised, all else becomes hulls."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from contact_foundation.errors import InputError
from scipy.spatial import ConvexHull, cKDTree

from cad2modelica.collision.collision_shape import CollisionShape
from cad2modelica.collision.convex_decomposition import decompose
from cad2modelica.collision.shape_recognition import RECOGNISERS, recognise
from cad2modelica.geometry.convex_hull import convex_hull
from cad2modelica.geometry.hull_coarsening import coarsened
from cad2modelica.geometry.hull_thinning import MOST_CORNERS, share_of_corners, thinned
from cad2modelica.geometry.mesh import Indices, bodies, is_closed, join, volume_integrals, weld
from cad2modelica.geometry.solid_comparison import compare
from cad2modelica.geometry.spatial import Array, Pose
from cad2modelica.kinematics.reach import Ball
from cad2modelica.mechanism.model import NO_LIMITS, CollisionChoice, Decomposer, DecompositionLimits, Part
from cad2modelica.source.lost import Lost

CONCAVITY_REMARK = 0.01  # a hull that adds more than this share of its volume is reported
DECOMPOSED = 0.05  # a body whose hull adds more than this share of the hull's volume is decomposed
CONVEX = 1e-6  # a hull that adds no more than this is the body itself
DEFAULT_ERROR = 0.025  # concavity of a piece, relative to the diagonal of the body's bounding box
SMALLEST_ERROR = 0.005  # likewise: what a decomposition can resolve
SNAP = 2e-6  # distance below which a piece's corner is one of the body's, relative to the same
DEFAULT_PIECES = 16
COARSE_ERROR = 0.002  # by its diagonal, of the hull of a body that would be decomposed, were it not too fine
MAXIMUM_PIECES = 256
MOST_SHAPES = 1024  # of a body in the contact engine's descriptors
LISTED_BODIES = 5  # numbers of a part's bodies in a note

Body = tuple[Array, Indices]


@dataclass(frozen=True, eq=False)
class CollisionGeometry:
    """The shapes of one part and remarks on how they differ from its geometry.

    Attributes:
        shapes: they collide.
        notes: remarks.
        is_filled: whether a hull or another shape fills what is hollow in the part, or what may be, for its faces are
            not closed.
    """

    shapes: tuple[CollisionShape, ...]
    notes: tuple[str, ...]
    is_filled: bool = False

    @property
    def descriptor(self) -> str:
        """The contact engine's text for the body; empty if it does not collide."""
        return ";".join(shape.descriptor for shape in self.shapes)

    def ball(self, pose: Pose) -> Ball:
        """A ball that holds all shapes of the body standing at ``pose``."""
        outlines = [shape.outline for shape in self.shapes]
        if not outlines:
            return Ball(pose.position, 0.0)
        points = np.concatenate([points for points, _ in outlines])
        center = (points.min(axis=0) + points.max(axis=0)) / 2
        radius = max(float(np.linalg.norm(points - center, axis=1).max()) + margin for points, margin in outlines)
        return Ball(pose.point(center), radius)


class _BodyShapes(NamedTuple):
    """Shapes of one connected body, remarks on them, and whether they fill what is hollow."""

    shapes: list[CollisionShape]
    remarks: list[str]
    is_filled: bool = False


def collision_geometry(part: Part, limits: DecompositionLimits = NO_LIMITS) -> CollisionGeometry:
    """The shapes that stand for a part in contacts: one or more for each connected body of its geometry.

    Args:
        part: the part.
        limits: of decompositions, where the part says nothing itself.

    Raises:
        InputError: the part asks for a shape that its geometry is not.
    """
    meshes = part.meshes if part.collision_meshes is None else part.collision_meshes
    if part.collision is CollisionChoice.NONE or not meshes:
        return CollisionGeometry((), ())
    shapes: list[CollisionShape] = []
    remarks: list[tuple[int, str]] = []
    is_filled = False
    vertices, triangles = weld(*join(meshes))
    found = bodies(vertices, triangles)
    kept, note = _largest(found)
    limits = part.decomposition.or_else(limits)
    refusal = _too_fine(part, len(triangles), limits) or _too_many(len(kept))
    limits = _shared_out(limits, len(kept))
    hulls = {number: convex_hull(found[number][0]) for number in kept}
    corners = share_of_corners([hull for hull in hulls.values() if hull is not None])
    for number, hull in hulls.items():
        if hull is None:
            remarks.append((number, Lost("is flat and was left out of the contacts")))
            continue
        label = _label(part, [number], len(found))
        own = _body_shapes(part, label, hull, found[number], limits, refusal, corners)
        shapes += own.shapes
        remarks += [(number, text) for text in own.remarks]
        is_filled = is_filled or own.is_filled
    return CollisionGeometry(tuple(shapes), _notes(part, remarks, len(found), note), is_filled)


def _largest(found: list[Body]) -> tuple[list[int], str]:
    """Numbers of the bodies that collide, from 0, and a note if these are not all."""
    if len(found) <= MOST_SHAPES:
        return list(range(len(found))), ""
    sizes = np.array([np.linalg.norm(np.ptp(vertices, axis=0)) for vertices, _ in found])
    order = np.argsort(-sizes, kind="stable")
    return sorted(order[:MOST_SHAPES].tolist()), Lost(
        f"has {len(found)} bodies, but collides with {MOST_SHAPES} shapes at most: the largest do, those left out are "
        f"up to {1000 * sizes[order[MOST_SHAPES]]:.3g} mm in size; split the part or join its bodies if these matter"
    )


def _too_many(count: int) -> str:
    """Why so many bodies are not decomposed; empty if they are."""
    most = MOST_SHAPES // 2
    return f"the part has {count} bodies, more than {most}" if count > most else ""


def _shared_out(limits: DecompositionLimits, count: int) -> DecompositionLimits:
    """Limits by which so many bodies, all of them decomposed, have no more pieces than a part may have shapes."""
    pieces = limits.pieces if limits.pieces is not None else DEFAULT_PIECES
    share = MOST_SHAPES // max(count, 1)
    return limits if pieces <= share else replace(limits, pieces=share)


def _label(part: Part, numbers: list[int], count: int) -> str:
    """What a remark is about: a part, one of its bodies, or several."""
    if count == 1:
        return f"part {part.name!r}"
    if len(numbers) == 1:
        return f"part {part.name!r}, body {numbers[0] + 1} of {count}"
    listed = ", ".join(str(number + 1) for number in numbers[:LISTED_BODIES])
    more = ", ..." if len(numbers) > LISTED_BODIES else ""
    return f"part {part.name!r}, {len(numbers)} of {count} bodies ({listed}{more})"


def _notes(part: Part, remarks: list[tuple[int, str]], count: int, note: str) -> tuple[str, ...]:
    """Notes on a part and its bodies; bodies with the same remark share a note."""
    by_text: dict[str, list[int]] = {}
    for number, text in remarks:
        by_text.setdefault(text, []).append(number)
    whole = (type(note)(f"part {part.name!r}: {note}"),) if note else ()
    return (*whole, *(type(text)(f"{_label(part, numbers, count)}: {text}") for text, numbers in by_text.items()))


def _body_shapes(
    part: Part, label: str, hull: ConvexHull, body: Body, limits: DecompositionLimits, refusal: str, corners: int
) -> _BodyShapes:
    """Shapes of one connected body and remarks on them.

    A refusal says why it is not decomposed; its hull keeps no more than so many corners.
    """
    vertices, triangles = body
    shape = recognise(hull, part.collision)
    if shape is None and part.collision in RECOGNISERS:
        raise InputError(
            f"{label} is to collide as a {part.collision.value}, but its geometry is none",
            place=part.place,
            remedy="Use shape='auto' or shape='hull', or export the geometry finer.",
        )
    if not is_closed(triangles):
        kind = "convex hull" if shape is None else shape.kind
        remarks = [f"the geometry is not closed; collides as its {kind}"]
        return _one_shape(shape, hull, corners, remarks, is_filled=True)
    volume = volume_integrals(vertices, triangles).volume
    remarks = ["the faces are turned inside out"] if volume < 0 else []
    added = 1.0 - abs(volume) / hull.volume
    threshold = {CollisionChoice.AUTO: DECOMPOSED, CollisionChoice.DECOMPOSITION: CONVEX}.get(part.collision)
    failure = refusal
    if threshold is not None and added > threshold and not refusal:
        outward = triangles if volume > 0 else triangles[:, ::-1]
        pieces, failure = _pieces(vertices, outward, limits)
        if pieces:
            accuracy = _accuracy(vertices, outward, pieces) + (f" ({failure})" if failure else "")
            return _BodyShapes([_hull_shape(piece)[0] for piece in pieces], [*remarks, accuracy])
    is_filled = added > CONCAVITY_REMARK
    if is_filled:
        name = f"its convex hull of {len(hull.vertices)} vertices" if shape is None else f"a {shape.kind}"
        remarks.append(
            f"is not convex; collides as {name}, {100 * added:.0f} % of which is not part of the body"
            + (f" (no decomposition: {failure})" if failure else "")
        )
    is_coarse = added > DECOMPOSED and not _is_asked(part, limits)
    return _one_shape(shape, hull, corners, remarks, is_filled=is_filled, is_coarse=is_coarse)


def _is_asked(part: Part, limits: DecompositionLimits) -> bool:
    """Whether someone chose how the part collides."""
    return part.collision is not CollisionChoice.AUTO or any((limits.error, limits.pieces, limits.decomposer))


def _too_fine(part: Part, triangles: int, limits: DecompositionLimits) -> str:
    """Why bodies of a part are not decomposed unasked; empty if they are."""
    asked = _is_asked(part, limits)
    if asked or limits.triangles is None or triangles <= limits.triangles:
        return ""
    options = "--decomposer, --collision-error or --max-pieces"
    return f"{triangles} triangles in all, more than {limits.triangles}; {options} ask for it"


def _pieces(vertices: Array, triangles: Indices, limits: DecompositionLimits) -> tuple[list[ConvexHull], str]:
    """Convex pieces of a concave body; none, and the reason, if it cannot be decomposed."""
    size = float(np.linalg.norm(vertices.max(axis=0) - vertices.min(axis=0)))
    error = max(limits.error if limits.error is not None else DEFAULT_ERROR * size, SMALLEST_ERROR * size)
    most = limits.pieces if limits.pieces is not None else DEFAULT_PIECES
    done = decompose(vertices, triangles, error, most, limits.decomposer or Decomposer.COACD)
    hulls = [convex_hull(_snapped(piece, vertices, SNAP * size)) for piece in done.pieces]
    return [hull for hull in hulls if hull is not None], done.failure


def _snapped(points: Array, vertices: Array, distance: float) -> Array:
    """Corners that are the body's own but for rounding become exactly those."""
    found = cKDTree(vertices).query(points)
    away, nearest = np.asarray(found[0]), np.asarray(found[1])
    result = points.copy()
    close = np.flatnonzero(away <= distance)
    result[close] = vertices[nearest[close]]
    return result


def _accuracy(vertices: Array, triangles: Indices, pieces: list[ConvexHull]) -> str:
    difference = compare(vertices, triangles, pieces)
    return (
        f"is not convex; collides as {len(pieces)} convex piece{'s' if len(pieces) > 1 else ''} with "
        f"{sum(len(piece.vertices) for piece in pieces)} vertices; of the body's volume, "
        f"{100 * difference.foreign:.1f} % is added and {100 * difference.missing:.1f} % missing, "
        f"Hausdorff distance {1000 * difference.distance:.2g} mm (sampled)"
    )


def _one_shape(
    shape: CollisionShape | None,
    hull: ConvexHull,
    corners: int,
    remarks: list[str],
    *,
    is_filled: bool,
    is_coarse: bool = False,
) -> _BodyShapes:
    """The recognised shape, or else the hull, and the remarks with one on a hull that has lost corners.

    A coarse hull leaves out what is finer than ``COARSE_ERROR``.
    """
    if shape is not None:
        return _BodyShapes([shape], remarks, is_filled)
    shape, error = _hull_shape(hull, corners, is_coarse=is_coarse)
    if error > 0.0 and shape.vertices is not None:
        remarks = [
            *remarks,
            f"of the {len(hull.vertices)} vertices of its convex hull {len(shape.vertices)} count in contacts, "
            f"Hausdorff distance {1000 * error:.2g} mm",
        ]
    return _BodyShapes([shape], remarks, is_filled)


def _hull_shape(hull: ConvexHull, most: int = MOST_CORNERS, *, is_coarse: bool = False) -> tuple[CollisionShape, float]:
    """The hull as a shape, and how far corners that it has lost lie outside of it, m."""
    if is_coarse:
        size = float(np.linalg.norm(np.ptp(hull.points[hull.vertices], axis=0)))
        corners, error = coarsened(hull, COARSE_ERROR * size)
        if len(corners) <= most:
            return CollisionShape.hull(corners), error
    corners, error = thinned(hull, most)
    return CollisionShape.hull(corners), error
