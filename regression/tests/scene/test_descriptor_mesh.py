"""Surfaces of descriptors are closed and hold the shapes' volumes, where the descriptor puts them."""

from __future__ import annotations

import math

import numpy as np
import pytest
from fmu_regression.scene.descriptor_mesh import descriptor_meshes
from fmu_regression.scene.scene_file import Mesh


def volume_and_center(mesh: Mesh) -> tuple[float, np.ndarray]:
    a, b, c = (mesh.vertices[mesh.triangles[:, column]] for column in range(3))
    parts = np.einsum("ij,ij->i", a, np.cross(b, c)) / 6
    return float(parts.sum()), np.einsum("i,ij->j", parts, a + b + c) / (4 * parts.sum())


CUBE = "0,0,0,1,0,0,0,1,0,1,1,0,0,0,1,1,0,1,0,1,1,1,1,1"


@pytest.mark.parametrize(
    ("shape", "volume"),
    [
        ("sphere radius=0.5", 4 / 3 * math.pi * 0.5**3),
        ("box size=1,2,3", 6.0),
        ("capsule radius=0.5 length=2", 4 / 3 * math.pi * 0.5**3 + 0.25 * math.pi * 2),
        ("cylinder radius=0.5 length=2", 0.25 * math.pi * 2),
        ("cone radius=0.5 length=3", 0.25 * math.pi),
        ("ellipsoid size=1,2,3", math.pi),
        (f"hull vertices={CUBE}", 1.0),
    ],
)
def test_volumes(shape: str, volume: float) -> None:
    (mesh,) = descriptor_meshes(f"cmb/1 {shape}", 1)
    found, center = volume_and_center(mesh)
    assert found == pytest.approx(volume, rel=0.03)
    (moved,) = descriptor_meshes(f"cmb/1 {shape} position=1,2,3 rotation=0,1,0,-1,0,0,0,0,1", 1)
    found, other = volume_and_center(moved)
    assert found == pytest.approx(volume, rel=0.03)
    x, y, z = center  # T turns the body's x to the shape's -y: v_body = T' v_shape
    assert other == pytest.approx(np.array([1 - y, 2 + x, 3 + z]), abs=1e-9)


def test_compounds_and_what_cannot_be_shown() -> None:
    assert len(descriptor_meshes('cmb/1 sphere radius=1; cmb/1 mesh file="a;b.stl"; cmb/1 halfspace', 1)) == 2
    assert descriptor_meshes("", 1) == ()
    assert descriptor_meshes("cmb/1 sphere radius=much", 1) == ()
