"""Runs V-HACD in a process of its own: ``python -m cad2modelica.collision.vhacd_process TASK.npz RESULT.npz``.

V-HACD takes a number of pieces and no length of error. So the largest number is halved as long as the sampled Hausdorff
distance of body and pieces stays within the error.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import vhacdx

from cad2modelica.geometry.convex_hull import convex_hull
from cad2modelica.geometry.mesh import Indices
from cad2modelica.geometry.solid_comparison import compare
from cad2modelica.geometry.spatial import Array

VOXELS = 100_000  # in which the body's bounding box is divided, at most; V-HACD: 400 000
VOLUME_ERROR = 1.0  # per cent of its volume below which a piece is not split any more


def main(task: Path, result: Path) -> None:
    """Decomposes the mesh of a task file (arrays vertices, triangles, error, pieces, corners)."""
    with np.load(task, allow_pickle=False) as given:
        vertices, triangles = given["vertices"], given["triangles"].astype(np.int64)
        error, most, corners = float(given["error"]), int(given["pieces"]), int(given["corners"])
    pieces = _pieces(vertices, triangles, most, corners)
    fewer = pieces
    while len(fewer) > 1 and _within(error, vertices, triangles, fewer):
        pieces, fewer = fewer, _pieces(vertices, triangles, len(fewer) // 2, corners)
    np.savez(result, *pieces)


def _within(error: float, vertices: Array, triangles: Indices, pieces: list[Array]) -> bool:
    hulls = [hull for piece in pieces if (hull := convex_hull(piece)) is not None]
    return bool(hulls) and compare(vertices, triangles, hulls).distance <= error


def _pieces(vertices: Array, triangles: Indices, count: int, corners: int) -> list[Array]:
    # Faces are rows of a count and that many indices.
    faces = np.column_stack([np.full(len(triangles), 3), triangles]).astype(np.uint32)
    found = vhacdx.compute_vhacd(
        np.ascontiguousarray(vertices, dtype=np.float64),
        np.ascontiguousarray(faces),
        maxConvexHulls=count,
        resolution=VOXELS,
        minimumVolumePercentErrorAllowed=VOLUME_ERROR,
        maxNumVerticesPerCH=corners,
        asyncACD=False,  # the order of threads would show in the pieces
    )
    return [np.asarray(points, dtype=np.float64) for points, _ in found]


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
