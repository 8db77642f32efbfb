"""COLLADA meshes (.dae), read by pycollada."""

from __future__ import annotations

import io
from pathlib import Path

import collada  # type: ignore[import-untyped]
import numpy as np
from contact_foundation.errors import InputError, Place
from lxml import etree

from cad2modelica.geometry.mesh import Indices
from cad2modelica.geometry.polygon import Triangle, split
from cad2modelica.geometry.spatial import Array
from cad2modelica.source.xml_document import read_xml

MAXIMUM_BYTES = 256 * 2**20
MAXIMUM_TRIANGLES = 5_000_000
# Materials and pictures of robots in circulation are often incomplete; geometry does not need them.
_IGNORED = [collada.common.DaeUnsupportedError, collada.common.DaeBrokenRefError, collada.common.DaeIncompleteError]


def read_collada(file: Path) -> tuple[Array, Indices]:
    """Vertices and triangles of all geometry in the file's scene.

    The file's unit of length counts, ``up_axis`` does not: robot descriptions mean the coordinates as they are written
    (so do RViz and Gazebo).

    Returns:
        Vertices, shape (n, 3), m, in the scene's coordinates; triangles, shape (m, 3).

    Raises:
        InputError: the file is too large, no safe XML, or no COLLADA document.
    """
    root = read_xml(file, MAXIMUM_BYTES)  # refuses what pycollada's own parser would let through
    if etree.QName(root).localname != "COLLADA":
        raise InputError("is no COLLADA document", place=Place(file=file), remedy="Export the mesh again.")
    _drop_materials(root)
    try:
        document = collada.Collada(io.BytesIO(etree.tostring(root)), ignore=_IGNORED)
        found = [
            surface
            for geometry in (document.scene.objects("geometry") if document.scene is not None else ())
            for primitive in geometry.primitives()
            if (surface := _triangles(primitive)) is not None
        ]
    except (collada.common.DaeError, ValueError, IndexError, KeyError, AttributeError, TypeError) as error:
        raise InputError(
            f"is no COLLADA mesh that can be read: {error}",
            place=Place(file=file),
            remedy="Convert the mesh to STL or OBJ.",
        ) from error
    unit = document.assetInfo.unitmeter or 1.0
    vertices: list[Array] = [np.zeros((0, 3))]
    triangles: list[Indices] = [np.zeros((0, 3), dtype=np.int64)]
    count = 0
    for points, indices in found:
        vertices.append(points * unit)
        triangles.append(indices + count)
        count += len(points)
        if count > 3 * MAXIMUM_TRIANGLES:
            raise InputError("holds too many triangles", place=Place(file=file), remedy="Export coarser.")
    return np.concatenate(vertices), np.concatenate(triangles)


def _drop_materials(root: etree._Element) -> None:
    """Takes materials and pictures out: geometry bound to one that is broken would be left out."""
    for element in list(
        root.iter("{*}bind_material", "{*}library_materials", "{*}library_effects", "{*}library_images")
    ):
        parent = element.getparent()
        if parent is not None:
            parent.remove(element)


def _triangles(primitive: object) -> tuple[Array, Indices] | None:
    """Points and triangles of a primitive; None for lines."""
    if not isinstance(primitive, collada.polylist.BoundPolylist | collada.triangleset.BoundTriangleSet):
        return None
    if primitive.vertex_index is None:
        return None
    points = np.asarray(primitive.vertex, dtype=np.float64)
    corners = np.asarray(primitive.vertex_index, dtype=np.int64).ravel()
    if len(corners) and (corners.min() < 0 or corners.max() >= len(points)):
        raise ValueError("a triangle or polygon names a vertex that does not exist")
    if isinstance(primitive, collada.triangleset.BoundTriangleSet):
        return points, corners.reshape(-1, 3)
    # Polygons may be concave, which pycollada's own split takes for convex.
    triangles: list[Triangle] = []
    for begin, end in primitive.polyindex.tolist():
        triangles += split(points, corners[begin:end].tolist())
    return points, np.array(triangles, dtype=np.int64).reshape(-1, 3)
