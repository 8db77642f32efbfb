"""Shapes of all parts: in the parts' order, once for each geometry, with every part's own name in its notes."""

from __future__ import annotations

import numpy as np
import pytest
from cad2modelica.collision import part_geometries as module
from cad2modelica.collision.collision_shapes import CollisionGeometry, collision_geometry
from cad2modelica.collision.part_geometries import part_geometries
from cad2modelica.geometry.mesh import Mesh
from cad2modelica.geometry.spatial import IDENTITY
from cad2modelica.mechanism.model import NO_LIMITS, CollisionChoice, DecompositionLimits, MassProperties, Part
from contact_foundation.errors import InputError, Place
from contact_foundation.progress import silent
from scipy.spatial import ConvexHull


def part(name: str, seed: int, choice: CollisionChoice = CollisionChoice.HULL, closed: bool = True) -> Part:
    points = np.random.default_rng(seed).normal(size=(20, 3))
    hull = ConvexHull(points)
    corners = points[hull.simplices]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    outward = (normal * hull.equations[:, :3]).sum(axis=1) > 0
    triangles = np.where(outward[:, None], hull.simplices, hull.simplices[:, ::-1]).astype(np.int64)
    mesh = Mesh("m", points, triangles if closed else triangles[1:], (0.5, 0.5, 0.5))
    zero = np.zeros(3)
    return Part(name, None, IDENTITY, MassProperties(1.0, zero, np.eye(3)), (mesh,), choice, False, Place())


def test_same_geometry_is_looked_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    looked_at: list[str] = []

    def counted(given: Part, limits: DecompositionLimits) -> CollisionGeometry:
        looked_at.append(given.name)
        return collision_geometry(given, limits)

    monkeypatch.setattr(module, "collision_geometry", counted)
    parts = [part(f"p{k}", k % 3, closed=k % 3 != 2) for k in range(9)] + [part("box", 0, CollisionChoice.AUTO)]
    told: list[float] = []

    def tell(phase: str, fraction: float, message: str = "") -> None:
        assert phase == "collision shapes"
        assert message
        told.append(fraction)

    found = part_geometries(parts, NO_LIMITS, tell)
    assert sorted(looked_at) == ["box", "p0", "p1", "p2"]
    assert list(found) == [item.name for item in parts]
    for item in parts:
        alone = collision_geometry(item)
        assert found[item.name].descriptor == alone.descriptor
        assert found[item.name].notes == alone.notes
    assert "part 'p8'" in found["p8"].notes[0]
    assert told == sorted(told)
    assert told[-1] == 1.0


def test_the_first_part_that_is_wrong_is_named() -> None:
    parts = [part("good", 0), part("first", 1, CollisionChoice.SPHERE), part("second", 2, CollisionChoice.BOX)]
    for _ in range(5):
        with pytest.raises(InputError, match="part 'first'"):
            part_geometries(parts, NO_LIMITS, silent)
