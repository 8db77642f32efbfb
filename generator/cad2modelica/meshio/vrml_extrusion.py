"""Surface of VRML97's Extrusion: a cross-section moved along a spine (ISO/IEC 14772-1, 6.18)."""

from __future__ import annotations

import numpy as np

from cad2modelica.geometry.mesh import Indices
from cad2modelica.geometry.polygon import triangulate
from cad2modelica.geometry.primitive_meshes import Surface
from cad2modelica.geometry.spatial import Array, perpendicular, rotation_about

SMALL = 1e-12  # relative to the spine's length: shorter vectors have no direction


def extrusion_surface(
    cross_section: Array, spine: Array, scale: Array, orientation: Array, caps: tuple[bool, bool]
) -> Surface:
    """Vertices and triangles of an extrusion.

    The cross-section's points (x, z) are scaled, turned and set into the plane that belongs to each point of the spine.

    Args:
        cross_section: shape (k, 2).
        spine: shape (n, 3), n >= 2.
        scale: shape (n, 2).
        orientation: axis and angle (rad), shape (n, 4).
        caps: whether the beginning and the end are closed.
    """
    count = len(cross_section)
    rings = []
    for point, frame, factors, turn in zip(spine, spine_frames(spine), scale, orientation, strict=True):
        flat = np.column_stack([cross_section[:, 0] * factors[0], np.zeros(count), cross_section[:, 1] * factors[1]])
        rotation = rotation_about(turn[:3], float(turn[3])) if turn[3] != 0.0 and turn[:3].any() else np.eye(3)
        rings.append(point + flat @ rotation.T @ frame.T)
    triangles = [_wall(len(spine), count)]
    last = (len(spine) - 1) * count
    outline = count - 1 if (cross_section[0] == cross_section[-1]).all() else count
    # The caps of a ring lie on each other, face to face: without them it is a closed body.
    ring = bool((rings[0] == rings[-1]).all()) and len(spine) > 2
    if caps[0] and not ring and outline >= 3:
        triangles.append(_cap(rings[0][:outline])[:, ::-1])
    if caps[1] and not ring and outline >= 3:
        triangles.append(_cap(rings[-1][:outline]) + last)
    return np.concatenate(rings), np.concatenate(triangles)


def spine_frames(spine: Array) -> Array:
    """Axes x, y, z of the cross-section's plane at each point of the spine as columns, shape (n, 3, 3).

    y is the tangent, z the normal of the plane through the neighbours; where that is not defined, the one before
    counts, and at the beginning the first that is. On a straight spine all frames are the shortest turn from y to it.
    """
    closed = bool((spine[0] == spine[-1]).all()) and len(spine) > 2
    before, after = np.roll(spine, 1, axis=0), np.roll(spine, -1, axis=0)
    if closed:
        before[0], after[-1] = spine[-2], spine[1]
    size = float(np.abs(np.ptp(spine, axis=0)).max())
    tangents = after - before
    normals = np.cross(after - spine, before - spine)
    if not closed:
        tangents[0], tangents[-1] = spine[1] - spine[0], spine[-1] - spine[-2]
        normals[0] = normals[-1] = 0.0
    tangents = _filled(tangents, SMALL * size)
    normals = _filled(normals, SMALL * size * size)
    if not tangents.any():
        return np.tile(np.eye(3), (len(spine), 1, 1))
    if not normals.any():
        return np.tile(_straight(tangents[0]), (len(spine), 1, 1))
    for k in range(1, len(normals)):
        if normals[k] @ normals[k - 1] < 0.0:
            normals[k] = -normals[k]
    frames = []
    for tangent, normal in zip(tangents, normals, strict=True):
        across = np.cross(tangent, normal)
        # A normal borrowed across a spine that turns back may run along the tangent.
        x = across / np.linalg.norm(across) if np.linalg.norm(across) > SMALL else perpendicular(tangent)
        frames.append(np.column_stack([x, tangent, np.cross(x, tangent)]))
    return np.array(frames)


def _filled(vectors: Array, smallest: float) -> Array:
    """Unit vectors; where there is no direction, the last one before, else the first one after; else zeros."""
    lengths = np.linalg.norm(vectors, axis=1)
    defined = np.flatnonzero(lengths > smallest)
    if not len(defined):
        return np.zeros_like(vectors)
    source = defined[np.maximum(np.searchsorted(defined, np.arange(len(vectors)), side="right") - 1, 0)]
    return np.asarray(vectors[source] / lengths[source, None])


def _straight(tangent: Array) -> Array:
    """The shortest turn that takes y to a straight spine; half a turn about x if the spine runs against y."""
    up = np.array([0.0, 1.0, 0.0])
    axis = np.cross(up, tangent)
    sine, cosine = float(np.linalg.norm(axis)), float(up @ tangent)
    if sine < SMALL:
        return np.eye(3) if cosine > 0 else np.diag([1.0, -1.0, -1.0])
    return rotation_about(axis, float(np.arctan2(sine, cosine)))


def _wall(rings: int, count: int) -> Indices:
    ring, k = np.meshgrid(np.arange(rings - 1), np.arange(count - 1), indexing="ij")
    a = (ring * count + k).ravel()
    b, c, d = a + 1, a + count + 1, a + count
    return np.stack([np.column_stack([a, b, c]), np.column_stack([a, c, d])], axis=1).reshape(-1, 3).astype(np.int64)


def _cap(points: Array) -> Indices:
    return np.array(triangulate(points), dtype=np.int64).reshape(-1, 3)
