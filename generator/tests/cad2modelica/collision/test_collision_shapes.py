"""Collision shapes: what is recognised, what becomes a hull, and what is reported."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from cad2modelica import read_assembly
from cad2modelica.collision.collision_shape import INLINE_CORNERS, CollisionShape
from cad2modelica.collision.collision_shapes import CollisionGeometry, collision_geometry
from cad2modelica.geometry.mesh import Mesh
from cad2modelica.geometry.spatial import IDENTITY
from cad2modelica.mechanism.model import CollisionChoice, MassProperties, Part
from contact_foundation.errors import Place
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation


def shapes_of(*clouds: np.ndarray, choice: CollisionChoice = CollisionChoice.AUTO) -> CollisionGeometry:
    """Collision shapes of a part whose bodies are the convex hulls of point clouds."""
    meshes = []
    for points in clouds:
        hull = ConvexHull(points)
        corners = points[hull.simplices]
        outward = np.einsum(
            "ij,ij->i", np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), hull.equations[:, :3]
        )
        triangles = np.where(outward[:, None] > 0, hull.simplices, hull.simplices[:, ::-1]).astype(np.int64)
        meshes.append(Mesh("m", points, triangles, (0.5, 0.5, 0.5)))
    properties = MassProperties(1.0, np.zeros(3), np.eye(3))
    return collision_geometry(Part("body", None, IDENTITY, properties, tuple(meshes), choice, False, Place()))


def sphere(radius: float, count: int = 400) -> np.ndarray:
    """Points spread evenly over a sphere (golden spiral)."""
    k = np.arange(count) + 0.5
    polar, around = np.arccos(1 - 2 * k / count), np.pi * (1 + 5**0.5) * k
    return radius * np.column_stack([np.cos(around) * np.sin(polar), np.sin(around) * np.sin(polar), np.cos(polar)])


def capsule(radius: float, length: float) -> np.ndarray:
    points = sphere(radius)
    return points + np.where(points[:, 2:] > 0, 0.5, -0.5) * np.array([0.0, 0.0, length])


def prism(radius: float, length: float, sides: int) -> np.ndarray:
    angles = 2 * np.pi * np.arange(sides) / sides
    ring = np.column_stack([radius * np.cos(angles), radius * np.sin(angles), np.zeros(sides)])
    half = np.array([0.0, 0.0, length / 2])
    return np.concatenate([ring - half, ring + half])


BOX = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])

vectors = st.tuples(*[st.floats(-3, 3)] * 3).map(np.array)
sizes = st.floats(0.001, 10)


@settings(max_examples=40, deadline=None)
@given(st.tuples(sizes, sizes, sizes), vectors, vectors)
def test_box_anywhere(size: tuple[float, float, float], turn: np.ndarray, shift: np.ndarray) -> None:
    """The recognised box has the corners of the mesh, whatever axes it names x, y and z."""
    if max(size) > 50 * min(size):
        return
    points = Rotation.from_rotvec(turn).apply(BOX * size) + shift * max(size)
    (shape,) = shapes_of(points).shapes
    assert shape.kind == "box"
    assert sorted(shape.size) == pytest.approx(sorted(size), rel=1e-6)
    corners = shape.pose.point(BOX * shape.size)
    distance = np.linalg.norm(corners[:, None] - points[None], axis=2)
    assert distance.min(axis=0).max() < 1e-5 * max(size)
    assert np.linalg.det(shape.pose.rotation) == pytest.approx(1.0)


def test_box_along_the_axes_has_no_rotation() -> None:
    (shape,) = shapes_of(BOX * [1.0, 2.0, 3.0] + [0.5, 0.0, -1.0]).shapes
    assert shape.descriptor == "cmb/1 box size=1,2,3 position=0.5,0,-1"


@settings(max_examples=20, deadline=None)
@given(sizes, vectors)
def test_sphere_anywhere(radius: float, shift: np.ndarray) -> None:
    (shape,) = shapes_of(sphere(radius) + shift * radius).shapes
    assert shape.kind == "sphere"
    assert shape.radius == pytest.approx(radius, rel=1e-8)
    np.testing.assert_allclose(shape.pose.position, shift * radius, atol=1e-7 * radius)


def expect_found(
    kind: str, points: np.ndarray, radius: float, length: float, turn: np.ndarray, shift: np.ndarray
) -> CollisionShape:
    """The shape found in turned and shifted points, which is the round one of that size there, either way round."""
    rotation = Rotation.from_rotvec(turn)
    (shape,) = shapes_of(rotation.apply(points) + shift).shapes
    assert shape.kind == kind
    assert (shape.radius, shape.length) == pytest.approx((radius, length), rel=1e-6)
    assert abs(shape.pose.rotation[:, 2] @ rotation.apply([0, 0, 1])) == pytest.approx(1.0, abs=1e-9)
    np.testing.assert_allclose(shape.pose.position, shift, atol=1e-5 * (radius + length))
    return shape


@settings(max_examples=20, deadline=None)
@given(sizes, st.floats(0.2, 6), vectors, vectors)
def test_capsule_anywhere(radius: float, slenderness: float, turn: np.ndarray, shift: np.ndarray) -> None:
    length = radius * slenderness
    expect_found("capsule", capsule(radius, length), radius, length, turn, shift * radius)


@settings(max_examples=20, deadline=None)
@given(sizes, st.floats(0.1, 20), st.integers(60, 400), st.integers(0, 1000))
@example(radius=1.0, slenderness=15.0, count=68, seed=414)  # more corners on one cap than on the other
def test_capsule_with_corners_anywhere_on_it(radius: float, slenderness: float, count: int, seed: int) -> None:
    """Random corners on caps and side beside two rings: neither their centre nor their main axis is the capsule's."""
    generator = np.random.default_rng(seed)
    half = np.array([0.0, 0.0, radius * slenderness / 2])
    points = generator.normal(size=(count, 3))
    points *= radius / np.linalg.norm(points, axis=1)[:, None]
    points += np.sign(points[:, 2:]) * half
    side = generator.normal(size=(int(count * slenderness / (2 + slenderness)), 2))
    side *= radius / np.linalg.norm(side, axis=1)[:, None]
    points = np.vstack(
        [points, prism(radius, 2 * half[2], 16), np.column_stack([side, half[2] * generator.uniform(-1, 1, len(side))])]
    )
    hull = ConvexHull(points)
    assume(hull.volume > 0.86 * np.pi * radius**2 * (2 * half[2] + 4 / 3 * radius))
    (shape,) = shapes_of(Rotation.random(rng=generator).apply(points)).shapes
    assert shape.kind == "capsule"
    assert (shape.radius, shape.length) == pytest.approx((radius, 2 * half[2]), rel=1e-5)


@settings(max_examples=20, deadline=None)
@given(sizes, st.floats(0.02, 30), st.integers(12, 60), vectors, vectors)
@example(radius=1.0, slenderness=0.0625, sides=12, turn=np.array([0.0, 5e-8, 0.0]), shift=np.zeros(3))
def test_cylinder_anywhere(radius: float, slenderness: float, sides: int, turn: np.ndarray, shift: np.ndarray) -> None:
    length = radius * slenderness
    expect_found("cylinder", prism(radius, length, sides), radius, length, turn, shift * radius)


@settings(max_examples=20, deadline=None)
@given(sizes, st.floats(0.02, 30), st.integers(0, 1000), vectors, vectors)
@example(radius=1.0, slenderness=20.0, seed=0, turn=np.array([0.5, -1.0, 0.3]), shift=np.zeros(3))
@example(radius=1.0, slenderness=0.5, seed=0, turn=np.array([0.0, 1e-5, 0.0]), shift=np.zeros(3))
def test_cylinder_and_cone_with_corners_anywhere_on_the_rims(
    radius: float, slenderness: float, seed: int, turn: np.ndarray, shift: np.ndarray
) -> None:
    """Corners crowd at one side of a rim and the rims differ: no mean is on the axis, and main axes lean."""
    generator = np.random.default_rng(seed)
    length = radius * slenderness

    def rim(height: float) -> np.ndarray:
        sides = int(generator.integers(12, 40))
        crowd = generator.uniform(0, generator.uniform(0.5, 6), int(generator.integers(0, 40)))
        angles = np.concatenate([2 * np.pi * np.arange(sides) / sides, crowd])
        return np.column_stack([radius * np.cos(angles), radius * np.sin(angles), np.full(len(angles), height)])

    bottom, top = rim(-length / 2), rim(length / 2)
    expect_found("cylinder", np.vstack([bottom, top]), radius, length, turn, shift * radius)
    expect_found("cone", np.vstack([bottom, [[0.0, 0.0, length / 2]]]), radius, length, turn, shift * radius)


@pytest.mark.parametrize("seed", range(40))
def test_long_prisms_are_no_capsules(seed: int) -> None:
    """Two rims, too coarse for a cylinder's, lie on the sides of capsules that are longer than the prism."""
    generator = np.random.default_rng(seed)
    length = generator.uniform(15, 40)
    rims = []
    for height in (-length / 2, length / 2):
        angles = np.concatenate([np.pi / 5 * np.arange(10), generator.uniform(0, 0.6, 4)])
        rims.append(np.column_stack([np.cos(angles), np.sin(angles), np.full(len(angles), height)]))
    (shape,) = shapes_of(Rotation.random(rng=generator).apply(np.vstack(rims))).shapes
    assert shape.kind == "hull"


def test_outline_of_a_cylinder_holds_it() -> None:
    (shape,) = shapes_of(prism(1.0, 2.0, 24)).shapes
    points, margin = shape.outline
    outline = ConvexHull(points)
    around = 2 * np.pi * np.arange(500) / 500
    rim = np.column_stack([np.cos(around), np.sin(around), np.full(500, 1.0)])
    assert margin == 0.0
    assert (rim @ outline.equations[:, :3].T + outline.equations[:, 3]).max() < 1e-9
    assert outline.volume < 1.01 * 2.0 * np.pi


@pytest.mark.parametrize(
    "points",
    [
        prism(1.0, 2.0, 10),  # a nut blank rather than a cylinder
        prism(1.0, 2.0, 24) * [1, 1.001, 1],
        prism(1.0, 2.0, 24) * np.repeat([[1.0, 1.0, 1.0], [1.001, 1.001, 1.0]], 24, axis=0),  # a frustum
        np.array([[0, 0, 0], [9, 0, 0], [0, 0.5, 0], [9, 0, 0.5]]),  # too few corners for a capsule's fit
        BOX * [1, 1, 1] + np.outer(np.arange(8) == 0, [0.001, 0, 0]),  # a corner moved
        sphere(1.0) * [1, 1, 1.001],  # an ellipsoid
        sphere(1.0, 30),  # too coarse to be called round
        capsule(1.0, 2.0) * [1, 1.001, 1],
        np.vstack([BOX, [0, 0, 0.7]]),  # a house
    ],
)
def test_what_is_almost_a_shape_is_a_hull(points: np.ndarray) -> None:
    (shape,) = shapes_of(points).shapes
    assert shape.kind == "hull"
    assert shape.vertices is not None
    exact = points if len(shape.vertices) <= INLINE_CORNERS else points.astype(np.float32).astype(np.float64)
    assert ConvexHull(shape.vertices).volume == pytest.approx(ConvexHull(exact).volume, rel=1e-12)


def test_choices() -> None:
    assert shapes_of(BOX, choice=CollisionChoice.HULL).shapes[0].kind == "hull"
    assert shapes_of(BOX, choice=CollisionChoice.NONE).shapes == ()


def test_bodies_become_a_compound() -> None:
    geometry = shapes_of(BOX, sphere(0.5) + np.array([3, 0, 0]), capsule(0.5, 1.0) + np.array([0, 5, 0]))
    assert [shape.kind for shape in geometry.shapes] == ["box", "sphere", "capsule"]
    assert geometry.descriptor.count(";") == 2
    assert geometry.notes == ()


def test_descriptor_rotation_is_from_body_to_shape() -> None:
    """The engine's convention: v_shape = T v_body, row by row."""
    rotation = Rotation.from_euler("z", 30, degrees=True)
    (shape,) = shapes_of(rotation.apply(BOX * [1, 2, 3])).shapes
    words = dict(word.split("=") for word in shape.descriptor.split()[2:])
    matrix = np.array(words["rotation"].split(","), dtype=float).reshape(3, 3)
    size = np.array(words["size"].split(","), dtype=float)
    local = (matrix @ rotation.apply(BOX * [1, 2, 3]).T).T
    np.testing.assert_allclose(np.abs(local), np.tile(size / 2, (8, 1)), atol=1e-6)


def test_sample_shapes(hammer: Path) -> None:
    found = {part.name: collision_geometry(part) for part in read_assembly(hammer).parts}
    kinds = {name: [shape.kind for shape in geometry.shapes] for name, geometry in found.items()}
    assert kinds.pop("arm") == ["hull"] * len(found["arm"].shapes)
    assert 1 < len(found["arm"].shapes) <= 16
    assert kinds == {
        "frame": ["box", "cylinder"],
        "hammer head": ["hull", "cylinder", "cylinder"],
        "anvil": ["hull"],
        "ball": ["sphere"],
    }
    assert found["ball"].shapes[0].radius == 0.022
    assert found["anvil"].shapes[0].vertices is not None
    assert len(found["anvil"].shapes[0].vertices) == 12
    notes = [note for geometry in found.values() for note in geometry.notes]
    assert len(notes) == 1
    assert "'arm'" in notes[0]
    assert f"{len(found['arm'].shapes)} convex pieces" in notes[0]


def cone(radius: float, length: float, sides: int) -> np.ndarray:
    ring = prism(radius, length, sides)[:sides]
    return np.concatenate([ring, [[0.0, 0.0, length / 2]]])


def globe(radius: float, segments: int) -> np.ndarray:
    """A sphere by meridians and parallels, as CAD systems and VRML browsers tessellate it."""
    polar = np.pi * np.arange(1, segments // 2) / (segments // 2)
    around = 2 * np.pi * np.arange(segments) / segments
    rings = [
        [radius * np.sin(p) * np.cos(a), radius * np.sin(p) * np.sin(a), radius * np.cos(p)]
        for p in polar
        for a in around
    ]
    return np.array([*rings, [0, 0, radius], [0, 0, -radius]])


def pill(radius: float, length: float, segments: int) -> np.ndarray:
    points = globe(radius, segments)
    ends = [points[points[:, 2] >= -1e-12] + [0, 0, length / 2], points[points[:, 2] <= 1e-12] - [0, 0, length / 2]]
    return np.concatenate(ends)


@settings(max_examples=20, deadline=None)
@given(sizes, st.floats(0.2, 20), st.tuples(*[st.integers(3, 16)] * 2), vectors, vectors)
@example(radius=1.0, slenderness=10.0, quarters=(3, 16), turn=np.array([0.5, -1.0, 0.3]), shift=np.zeros(3))
def test_capsule_with_one_end_finer(
    radius: float, slenderness: float, quarters: tuple[int, int], turn: np.ndarray, shift: np.ndarray
) -> None:
    """Nearly all corners may be at one end, so that their mean says little of where the middle is."""
    length = radius * slenderness
    upper, lower = (pill(radius, length, 4 * quarter) for quarter in quarters)
    points = np.concatenate([upper[upper[:, 2] > 0], lower[lower[:, 2] < 0]])
    expect_found("capsule", points, radius, length, turn, shift * radius)


@settings(max_examples=20, deadline=None)
@given(sizes, st.floats(0.05, 20), st.integers(12, 64), vectors, vectors)
def test_cone_anywhere(radius: float, slenderness: float, sides: int, turn: np.ndarray, shift: np.ndarray) -> None:
    """The base is below, the apex above, as the engine's cone has them."""
    length = radius * slenderness
    shape = expect_found("cone", cone(radius, length, sides), radius, length, turn, shift * radius)
    rotation = Rotation.from_rotvec(turn)
    assert shape.pose.rotation[:, 2] @ rotation.apply([0, 0, 1]) > 0
    points, margin = shape.outline
    apex = rotation.apply([0, 0, length / 2]) + shift * radius
    assert margin == 0.0
    assert np.linalg.norm(points - apex, axis=1).min() < 1e-5 * (radius + length)


@pytest.mark.parametrize("segments", [8, 10, 12, 16, 24, 32, 48, 64])
@pytest.mark.parametrize("digits", [6, 9, 17])
def test_tessellations_from_coarse_to_fine(segments: int, digits: int) -> None:
    """Somewhere in space, written with so many digits; too coarse ones are what they are, prisms and pyramids."""
    turn, shift = Rotation.from_rotvec([0.5, -1.0, 0.3]), np.array([0.3, -0.2, 0.1])

    def kind(points: np.ndarray) -> str:
        placed = turn.apply(points) + shift
        written = np.array([[float(f"{value:.{digits}g}") for value in point] for point in placed])
        (shape,) = shapes_of(written).shapes
        return shape.kind

    round_enough = segments >= 12
    assert kind(prism(0.4, 0.4 * 2**0.5, segments)) == ("cylinder" if round_enough else "hull")
    assert kind(prism(0.4, 1.0, segments)) == ("cylinder" if round_enough else "hull")
    assert kind(cone(0.4, 1.0, segments)) == ("cone" if round_enough else "hull")
    assert kind(globe(0.5, segments)) == ("sphere" if round_enough else "hull")
    assert kind(pill(0.3, 0.8, segments)) == (
        "capsule" if segments % 4 == 0 else "hull"
    )  # else it has no ring at its equator
    assert kind(BOX) == "box"


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_chamfers_and_tapers_beyond_the_tolerance_are_seen(scale: float) -> None:
    ring = prism(1.0, 2.0, 32)
    chamfered = np.concatenate([ring[:32], ring[32:] - [0, 0, 0.001], ring[32:] * [0.999, 0.999, 1.0]])
    box = np.concatenate([BOX * [1, 1, 0.998], BOX * [0.998, 0.998, 1]])
    blunt = np.concatenate([cone(1.0, 2.0, 32)[:32], prism(0.001, 2.0, 32)[32:]])
    for points in (chamfered, box, blunt, cone(1.0, 2.0, 32) + np.outer(np.arange(33) == 32, [0.001, 0, 0])):
        assert [shape.kind for shape in shapes_of(scale * points).shapes] == ["hull"]


def test_missing_caps_are_noted_and_do_not_hide_the_cylinder() -> None:
    sides = 24
    points = prism(1.0, 2.0, sides)
    quads = [(k, (k + 1) % sides, sides + (k + 1) % sides, sides + k) for k in range(sides)]
    triangles = np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))], dtype=np.int64)
    zero = np.zeros(3)
    mesh = Mesh("m", points, triangles, (0.5, 0.5, 0.5))
    properties = MassProperties(1.0, zero, np.eye(3))
    geometry = collision_geometry(
        Part("tube", None, IDENTITY, properties, (mesh,), CollisionChoice.AUTO, False, Place())
    )
    assert [shape.kind for shape in geometry.shapes] == ["cylinder"]
    assert "not closed; collides as its cylinder" in geometry.notes[0]
