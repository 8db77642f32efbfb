"""MSH, the binary mesh files of older models of MuJoCo: counts, corners, normals, texture coordinates, triangles."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from contact_foundation.errors import InputError, Place

from cad2modelica.geometry.mesh import Indices
from cad2modelica.geometry.spatial import Array

HEADER = 16


def read_msh(data: bytes, file: Path) -> tuple[Array, Indices]:
    """Corners and triangles (MuJoCo's XML reference, asset/mesh: four numbers, then single precision).

    Raises:
        InputError: the file is no such mesh, or ends too early.
    """
    counts = np.frombuffer(data[:HEADER], "<i4").astype(np.int64) if len(data) >= HEADER else np.zeros(4, np.int64)
    corners, normals, textures, triangles = (int(count) for count in counts)
    size = HEADER + 12 * corners + 12 * normals + 8 * textures + 12 * triangles
    if min(corners, normals, textures, triangles) < 0 or size != len(data):
        raise InputError(
            f"is no mesh of MuJoCo: {len(data)} bytes, but its counts ask for {size}",
            place=Place(file=file),
            remedy="Export or copy it again.",
        )
    vertices = np.frombuffer(data, "<f4", 3 * corners, HEADER).astype(np.float64).reshape(-1, 3)
    start = size - 12 * triangles
    indices = np.frombuffer(data, "<i4", 3 * triangles, start).astype(np.int64).reshape(-1, 3)
    if len(indices) and not 0 <= indices.min() <= indices.max() < max(corners, 1):
        raise InputError("a triangle names a corner that does not exist", place=Place(file=file))
    return vertices, indices
