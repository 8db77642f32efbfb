"""Round shapes as hulls and meshes: closed, outward, inscribed, and as fine as asked for."""

from __future__ import annotations

import math

import numpy as np
import pytest
from accuracy_study.tessellation import decomposed, tessellated
from contact_foundation.errors import SimulationError
from scipy.spatial import ConvexHull


def read(descriptor: str) -> tuple[str, np.ndarray, np.ndarray | None, dict[str, str]]:
    words = descriptor.split()
    values = dict(word.split("=", 1) for word in words[2:])
    vertices = np.array([float(x) for x in values.pop("vertices").split(",")]).reshape(-1, 3)
    triangles = values.pop("triangles", None)
    if triangles is None:
        return words[1], vertices, None, values
    return words[1], vertices, np.array([int(i) for i in triangles.split(",")]).reshape(-1, 3) - 1, values


VOLUMES = {
    "sphere radius=0.5": 4 / 3 * math.pi * 0.5**3,
    "ellipsoid size=1,2,3": 4 / 3 * math.pi * 0.5 * 1 * 1.5,
    "cylinder radius=0.5 length=2": math.pi * 0.5**2 * 2,
    "cone radius=0.5 length=3": math.pi * 0.5**2,
    "capsule radius=0.5 length=2": math.pi * 0.5**2 * 2 + 4 / 3 * math.pi * 0.5**3,
    "box size=1,2,3": 6.0,
}


@pytest.mark.parametrize("shape", VOLUMES)
@pytest.mark.parametrize("segments", [8, 31, 64])
def test_volume_approaches_that_of_the_shape_from_below(shape, segments):
    kind, vertices, triangles, _ = read(tessellated(f"cmb/1 {shape}", "mesh", segments))
    assert kind == "mesh"
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    volume = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
    # Closed: every edge once in each direction.
    edges = [(int(t[i]), int(t[(i + 1) % 3])) for t in triangles for i in range(3)]
    assert len(set(edges)) == len(edges)
    assert {(j, i) for i, j in edges} == set(edges)
    exact = VOLUMES[shape]
    if shape.startswith("box"):
        assert volume == pytest.approx(exact, rel=1e-12)
    else:
        # An inscribed polygon of n edges lacks 2 pi^2/(3 n^2) of its circle's area; both directions lack as much.
        assert exact * (1 - 3 * 2 * math.pi**2 / (3 * segments**2)) < volume < exact


def test_place_is_kept_and_other_shapes_stay():
    text = "cmb/1 sphere radius=1 position=1,2,3 rotation=1,0,0,0,1,0,0,0,1;cmb/1 halfspace"
    ball, plane = tessellated(text, "hull", 12).split(";")
    kind, vertices, triangles, rest = read(ball)
    assert (kind, triangles) == ("hull", None)
    assert rest == {"position": "1,2,3", "rotation": "1,0,0,0,1,0,0,0,1"}
    assert np.linalg.norm(vertices, axis=1) == pytest.approx(np.ones(len(vertices)), abs=1e-15)
    assert plane == "cmb/1 halfspace"
    mesh = "cmb/1 mesh vertices=0,0,0 triangles=1,1,1"
    assert tessellated(mesh, "hull", 12) == mesh


def bracket() -> str:
    """A prism over an L of area 3 and height 1, as a closed mesh, moved by 5."""
    corners = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
    vertices = [x for z in (0, 1) for a, b in corners for x in (a, b, z)]
    cap = [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5)]
    walls = [t for i in range(6) for j in [(i + 1) % 6] for t in ((i, j, j + 6), (i, j + 6, i + 6))]
    triangles = [(a, c, b) for a, b, c in cap] + [(a + 6, b + 6, c + 6) for a, b, c in cap] + walls
    numbers = ",".join(str(i + 1) for t in triangles for i in t)
    return f"cmb/1 mesh vertices={','.join(map(str, vertices))} triangles={numbers} position=5,0,0"


def test_closed_meshes_become_convex_pieces_that_fill_them():
    *pieces, ball = decomposed(f"{bracket()};cmb/1 sphere radius=1", 0.01).split(";")
    assert ball == "cmb/1 sphere radius=1"
    assert len(pieces) >= 2
    volume = 0.0
    for piece in pieces:
        kind, vertices, _, rest = read(piece)
        assert (kind, rest) == ("hull", {"position": "5,0,0"})
        volume += ConvexHull(vertices).volume
    assert volume == pytest.approx(3.0, rel=0.01)
    assert len(decomposed(bracket(), 10.0).split(";")) == 1


def test_a_mesh_without_inside_is_refused():
    with pytest.raises(SimulationError, match="cannot be decomposed"):
        decomposed("cmb/1 mesh vertices=0,0,0,1,0,0,0,1,0 triangles=1,2,3", 0.01)
