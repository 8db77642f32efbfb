"""Collision shapes as Modelica expressions, with hulls of many corners in STL files of the package.

Layout of binary STL: 80 bytes of header, the number of triangles, and for each its normal and three corners in single
precision and two bytes of no meaning, all little-endian (3D Systems, StereoLithography Interface Specification, 1988).
"""

from __future__ import annotations

import struct
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from scipy.spatial import ConvexHull

from cad2modelica.collision.collision_shapes import CollisionGeometry
from cad2modelica.geometry.spatial import Array
from cad2modelica.modelica.text import string

FOLDER = "Resources/Geometry"

_HEADER = b"ContactMultiBody: convex hull, lengths in m".ljust(80, b" ")
_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


@dataclass
class HullFiles:
    """The files of a package, collected while its bodies are written; bodies with the same hull share its file.

    Attributes:
        package: the package's name.
        contents: by their paths in the package.
    """

    package: str
    contents: dict[str, bytes] = field(default_factory=dict)
    _paths: dict[bytes, str] = field(default_factory=dict)

    def expression(self, body: str, geometry: CollisionGeometry) -> str:
        """The Modelica expression for a body's descriptor.

        Args:
            body: its name in the model, unique without regard to case.
            geometry: its shapes, at least one.
        """
        words: list[str] = []
        inline: list[str] = []
        for number, shape in enumerate(geometry.shapes, start=1):
            corners = shape.file_corners
            if corners is None:
                inline.append(shape.descriptor)
                continue
            words += [string(";".join(inline))] if inline else []
            inline = []
            words.append(self._reference(f"{FOLDER}/{body}-{number}.stl", stl(corners)))
        words += [string(";".join(inline))] if inline else []
        if len(words) == 1:
            return words[0]
        listed = ",\n    ".join(words)
        return f"ContactMultiBody.Shapes.compound({{\n    {listed}}})"

    def _reference(self, path: str, content: bytes) -> str:
        known = self._paths.setdefault(content, path)
        self.contents[known] = content
        uri = string(f"modelica://{self.package}/{known}")
        return f"ContactMultiBody.Shapes.hullFile(Modelica.Utilities.Files.loadResource({uri}))"


def package_geometry(package: str, bodies: Mapping[str, CollisionGeometry]) -> tuple[dict[str, str], dict[str, bytes]]:
    """Expressions by body, and contents of files by their paths in the package.

    Args:
        package: the package's name.
        bodies: shapes by the body's name in the model; those without any are left out.
    """
    files = HullFiles(package)
    expressions = {body: files.expression(body, geometry) for body, geometry in bodies.items() if geometry.shapes}
    return expressions, files.contents


def stl(corners: Array) -> bytes:
    """The hull of points that are single precision numbers, shape (n, 3), m, as binary STL; normals point outwards."""
    hull = ConvexHull(corners)
    normals = hull.equations[:, :3]
    triangles = corners[hull.simplices]
    turning = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    inward = np.einsum("ij,ij->i", turning, normals) < 0
    triangles[inward] = triangles[inward][:, ::-1]
    facets = np.zeros(len(triangles), _FACET)
    facets["normal"] = normals
    facets["corners"] = triangles
    return b"".join((_HEADER, struct.pack("<I", len(facets)), facets.tobytes()))
