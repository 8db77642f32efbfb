"""The engine's distances against those of coal, an independent implementation (PyPI: coal; no test package)."""

from __future__ import annotations

from typing import Any

import pytest
from cad2modelica.geometry.spatial import Pose
from distance_samples import CONVEX, CONVEX_PAIRS, HULL, SignedDistance, pose_pairs

coal = pytest.importorskip("coal", reason="coal is not installed")

TOLERANCE = 1e-6  # m; bodies of about 1 m
# Of other kinds its expanding polytope fails now and then.
EXACT_DEPTH = ("sphere", "box", "capsule", "hull")


def convex_shape(kind: str) -> Any:
    if kind == "hull":
        vertices, triangles = coal.StdVec_Vec3s(), coal.StdVec_Triangle()
        for vertex in HULL.vertices:
            vertices.append(vertex)
        for corners in HULL.triangles:
            triangles.append(coal.Triangle(*(int(corner) for corner in corners)))
        return coal.Convex(vertices, triangles)
    return {
        "sphere": lambda: coal.Sphere(0.3),
        "box": lambda: coal.Box(0.6, 0.8, 1.0),
        "capsule": lambda: coal.Capsule(0.25, 0.7),
        "cylinder": lambda: coal.Cylinder(0.3, 0.8),
        "cone": lambda: coal.Cone(0.4, 0.9),
        "ellipsoid": lambda: coal.Ellipsoid(0.5, 0.35, 0.25),
    }[kind]()


def distance(first: Any, first_pose: Pose, second: Any, second_pose: Pose) -> float:
    request = coal.DistanceRequest()
    request.gjk_tolerance = request.epa_tolerance = 1e-9
    request.gjk_max_iterations = request.epa_max_iterations = 500
    places = [coal.Transform3s(pose.rotation, pose.position) for pose in (first_pose, second_pose)]
    return float(coal.distance(first, places[0], second, places[1], request, coal.DistanceResult()))


@pytest.mark.parametrize(("a", "b"), CONVEX_PAIRS)
def test_signed_distances_are_the_same(signed_distance: SignedDistance, a: str, b: str) -> None:
    first, second = convex_shape(a), convex_shape(b)
    depths = a in EXACT_DEPTH and b in EXACT_DEPTH
    apart = overlapping = 0
    for one, other in pose_pairs(5, 80, 0.2, 2.5):
        ours = signed_distance(CONVEX[a], one, CONVEX[b], other)
        if ours < 0.0 and not depths:
            continue
        apart += ours > 0.0
        overlapping += ours < 0.0
        assert distance(first, one, second, other) == pytest.approx(ours, abs=TOLERANCE)
    assert apart >= 20
    assert overlapping >= 5 or not depths
