"""MeshLab's VRML importer (PyPI's pymeshlab) as the second oracle for world positions.

It follows PROTO, EXTERNPROTO, Inline, Switch, center and scaleOrientation, which VTK's does not, and puts the corners
of spheres and cylinders on the exact surfaces. It leaves out boxes, cones and extrusions; boxes and cones are written
as faces for it.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from cad2modelica.geometry.primitive_meshes import SEGMENTS
from cad2modelica.geometry.surface_distance import Surface
from oracle_process import imported

_IMPORT = """
import sys
import numpy as np
import pymeshlab

meshes = pymeshlab.MeshSet()
meshes.load_new_mesh(sys.argv[1])
corners = [mesh.transformed_vertex_matrix()[mesh.face_matrix()] for mesh in meshes]
np.save(sys.argv[2], np.concatenate(corners))
"""
_ROUND_ERROR = 1 - np.cos(np.pi / SEGMENTS)  # of the radius: between a circle and our polygon; twice that on spheres
_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_BOX = re.compile(rf"\bBox\s*\{{\s*(?:size((?:[\s,]+{_NUMBER}){{3}})\s*)?\}}")
_CONE = re.compile(rf"\bCone\s*\{{((?:\s*(?:bottomRadius|height)\s+{_NUMBER})*)\s*\}}")
_CONE_SIDES = 48
_BOX_FACES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))


def with_faces(text: str) -> str:
    """The text with boxes and cones as face sets, by their definitions in VRML97, 6.7 and 6.10."""
    return _CONE.sub(_cone, _BOX.sub(_box, text))


def _box(found: re.Match[str]) -> str:
    x, y, z = (float(word) / 2 for word in (found[1] or "2 2 2").replace(",", " ").split())
    return _face_set([(a, b, c) for a in (-x, x) for b in (-y, y) for c in (-z, z)], _BOX_FACES)


def _cone(found: re.Match[str]) -> str:
    words = found[1].split()
    given = {"bottomRadius": 1.0, "height": 2.0} | dict(zip(words[::2], map(float, words[1::2]), strict=True))
    radius, half = given["bottomRadius"], given["height"] / 2
    angles = [2 * np.pi * k / _CONE_SIDES for k in range(_CONE_SIDES)]
    points = [(0.0, half, 0.0), *((radius * np.cos(angle), -half, radius * np.sin(angle)) for angle in angles)]
    sides = [(0, 1 + (k + 1) % _CONE_SIDES, 1 + k) for k in range(_CONE_SIDES)]
    return _face_set(points, [*sides, tuple(range(1, _CONE_SIDES + 1))])


def _face_set(points: Sequence[tuple[float, ...]], faces: Sequence[tuple[int, ...]]) -> str:
    coordinates = ", ".join(" ".join(repr(float(value)) for value in point) for point in points)
    indices = " ".join(f"{' '.join(map(str, face))} -1" for face in faces)
    return f"IndexedFaceSet {{ coord Coordinate {{ point [ {coordinates} ] }} coordIndex [ {indices} ] }}"


def meshlab_triangles(file: Path, folder: Path) -> np.ndarray | None:
    """Corners of all triangles in the world, shape (n, 3, 3); None if MeshLab refuses the file, or crashes.

    Args:
        file: a VRML file, not compressed.
        folder: for intermediate files.
    """
    return imported(_IMPORT, file, folder / "triangles.npy")


def distances(ours: np.ndarray, theirs: np.ndarray) -> tuple[float, float]:
    """Greatest distances of MeshLab's corners from our surface, and of our corners from its surface.

    Args:
        ours: corners of triangles, shape (n, 3, 3).
        theirs: likewise, shape (m, 3, 3).
    """
    return Surface(ours).farthest(theirs.reshape(-1, 3)), Surface(theirs).farthest(ours.reshape(-1, 3))


def round_error(size: float) -> float:
    """How far a sphere, cylinder or cone in a scene of this size may be off our triangles."""
    return float(2 * _ROUND_ERROR * size / 2)
