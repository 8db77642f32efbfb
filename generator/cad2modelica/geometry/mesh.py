"""Triangle meshes: welding, connected bodies, integrals over closed meshes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from cad2modelica.geometry.spatial import Array

Indices = NDArray[np.int64]

WELD_TOLERANCE = 2e-8  # of the bounding box's diagonal: files carry nine digits or more


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles, counter-clockwise seen from outside.

    Attributes:
        name: of the node in the source.
        vertices: shape (n, 3), m.
        triangles: shape (m, 3), indices into ``vertices``.
        color: red, green, blue from 0 to 1.
    """

    name: str
    vertices: Array
    triangles: Indices
    color: tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class VolumeIntegrals:
    """Of a closed mesh: volume (m3), centre (m), inertia about the centre at density 1 (m5)."""

    volume: float
    center: Array
    inertia: Array


def join(meshes: tuple[Mesh, ...]) -> tuple[Array, Indices]:
    """Vertices and triangles of all meshes together, in their order."""
    vertices = [mesh.vertices for mesh in meshes]
    offsets = np.cumsum([0, *(len(block) for block in vertices)])
    triangles = [mesh.triangles + offset for mesh, offset in zip(meshes, offsets[:-1], strict=True)]
    return np.concatenate(vertices), np.concatenate(triangles)


def weld(vertices: Array, triangles: Indices) -> tuple[Array, Indices]:
    """Merges vertices that lie within the weld tolerance and drops triangles that lose their area by it.

    Equal ones are merged first: pairs of all that meet in a point would be as many as their square.
    """
    size = float(np.linalg.norm(vertices.max(axis=0) - vertices.min(axis=0)))
    distinct_vertices, of_vertex = _distinct(vertices)
    pairs = cKDTree(distinct_vertices).query_pairs(WELD_TOLERANCE * size, output_type="ndarray")
    count = len(distinct_vertices)
    graph = coo_matrix((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(count, count))
    label = connected_components(graph, directed=False)[1][of_vertex]
    _, first, group = np.unique(label, return_index=True, return_inverse=True)
    order = np.argsort(first, kind="stable")
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    welded = rank[group][triangles]
    distinct = (welded[:, 0] != welded[:, 1]) & (welded[:, 1] != welded[:, 2]) & (welded[:, 2] != welded[:, 0])
    return vertices[first[order]], welded[distinct]


def _distinct(vertices: Array) -> tuple[Array, Indices]:
    """Points without repetitions, and the number of each vertex's point among them."""
    rows = np.ascontiguousarray(vertices + 0.0)  # no -0.0, which is equal to 0.0 but has another sign bit
    keys = rows.view(np.dtype((np.void, rows.dtype.itemsize * rows.shape[1]))).ravel()
    _, first, inverse = np.unique(keys, return_index=True, return_inverse=True)
    return rows[first], inverse.ravel()


def bodies(vertices: Array, triangles: Indices) -> list[tuple[Array, Indices]]:
    """Splits a welded mesh into its connected bodies, in the order of their first triangles."""
    count = len(vertices)
    rows = np.concatenate([triangles[:, 0], triangles[:, 1]])
    columns = np.concatenate([triangles[:, 1], triangles[:, 2]])
    graph = coo_matrix((np.ones(len(rows)), (rows, columns)), shape=(count, count))
    _, label = connected_components(graph, directed=False)
    of_triangle = label[triangles[:, 0]]
    order = np.argsort(of_triangle, kind="stable")
    runs = np.split(order, np.flatnonzero(np.diff(of_triangle[order])) + 1) if len(order) else []
    found = []
    for run in sorted(runs, key=lambda run: int(run[0])):
        own = triangles[run]
        used, renumbered = np.unique(own, return_inverse=True)
        found.append((vertices[used], renumbered.reshape(own.shape)))
    return found


def is_closed(triangles: Indices) -> bool:
    """Whether every edge of a welded mesh is passed once in each direction."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    keys, counts = np.unique(edges, axis=0, return_counts=True)
    if (counts != 1).any():
        return False
    reverse = keys[:, ::-1]
    return bool((reverse[np.lexsort((reverse[:, 1], reverse[:, 0]))] == keys).all())


def volume_integrals(vertices: Array, triangles: Indices) -> VolumeIntegrals:
    """Volume, centre and inertia of a closed mesh, by tetrahedra to a point near it.

    Second moments of a tetrahedron with one corner at the origin: integral of x x^T is
    V/20 (sum of c c^T + s s^T), c its other corners and s their sum.
    """
    reference = vertices.mean(axis=0)
    corners = vertices[triangles] - reference
    volumes = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6.0
    volume = float(volumes.sum())
    sums = corners.sum(axis=1)
    center = volumes @ sums / 4.0 / volume if volume != 0.0 else np.zeros(3)
    second = np.einsum("t,tci,tcj->ij", volumes, corners, corners) + np.einsum("t,ti,tj->ij", volumes, sums, sums)
    second = second / 20.0 - volume * np.outer(center, center)
    inertia = np.trace(second) * np.eye(3) - second
    return VolumeIntegrals(volume, reference + center, inertia)
