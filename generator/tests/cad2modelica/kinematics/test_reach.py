"""Pairs that can never meet: closed forms of linkages, and chains of joints turned at random."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from assembly_text import joint, part, write_assembly
from cad2modelica import generate, read_assembly
from cad2modelica.collision.collision_shape import CollisionShape
from cad2modelica.collision.collision_shapes import CollisionGeometry
from cad2modelica.geometry.spatial import Pose, rotation_about
from cad2modelica.kinematics.kinematic_graph import kinematic_tree
from cad2modelica.kinematics.reach import Ball, Reach
from cad2modelica.mechanism.model import Assembly, Plane
from contact_foundation.errors import Place
from hypothesis import given, settings
from hypothesis import strategies as st

Z = (0.0, 0.0, 1.0)


def reach_of(assembly: Assembly, planes: tuple[Plane, ...] = ()) -> Reach:
    return Reach(assembly.parts, planes, kinematic_tree(assembly))


def balls_of(assembly: Assembly, radius: float) -> dict[str, Ball]:
    return {item.name: Ball(item.pose.position, radius) for item in assembly.parts}


def two_cranks(tmp_path: Path, kind: str) -> Assembly:
    """Two arms of length 1 on pivots 3 apart: their ends come as near as 1 and as far apart as 5."""
    parts = [part("left", position=(0, 1, 0)), part("right", position=(3, 1, 0))]
    joints = [
        joint("a", kind, "ground", "left", origin=(0, 0, 0), axis=None if kind == "spherical" else Z),
        joint("b", kind, "ground", "right", origin=(3, 0, 0), axis=None if kind == "spherical" else Z),
    ]
    return read_assembly(write_assembly(tmp_path / "cranks.xml", parts, joints))


@pytest.mark.parametrize("kind", ["revolute", "spherical"])
@pytest.mark.parametrize(("radius", "apart"), [(0.49, True), (0.51, False)])
def test_two_cranks(tmp_path: Path, kind: str, radius: float, apart: bool) -> None:
    assembly = two_cranks(tmp_path, kind)
    assert reach_of(assembly).apart(balls_of(assembly, radius))("left", "right") is apart


def test_what_slides_may_go_anywhere(tmp_path: Path) -> None:
    for kind in ("prismatic", "cylindrical", "planar"):
        assembly = two_cranks(tmp_path, kind)
        assert not reach_of(assembly).apart(balls_of(assembly, 1e-3))("left", "right")


def test_free_parts_may_go_anywhere(tmp_path: Path) -> None:
    parts = [part("free", position=(100, 0, 0)), part("held")]
    assembly = read_assembly(
        write_assembly(tmp_path / "a.xml", parts, [joint("j", "revolute", "ground", "held", axis=Z)])
    )
    assert not reach_of(assembly).apart(balls_of(assembly, 1e-3))("free", "held")


def test_branches_of_a_free_body(tmp_path: Path) -> None:
    """Two short arms on a long body that flies."""
    parts = [part("body"), part("left", position=(-5, 1, 0)), part("right", position=(5, 1, 0))]
    joints = [
        joint("a", "revolute", "body", "left", origin=(-5, 0, 0), axis=Z),
        joint("b", "revolute", "body", "right", origin=(5, 0, 0), axis=Z),
    ]
    assembly = read_assembly(write_assembly(tmp_path / "a.xml", parts, joints))
    assert reach_of(assembly).apart(balls_of(assembly, 3.9))("left", "right")
    assert not reach_of(assembly).apart(balls_of(assembly, 4.1))("left", "right")


@pytest.mark.parametrize(("height", "apart"), [(-1.6, True), (-1.4, False), (0.5, False), (10.0, False)])
def test_floor_below_a_pendulum(tmp_path: Path, height: float, apart: bool) -> None:
    parts = [part("bob", position=(1, 0, 0))]
    assembly = read_assembly(
        write_assembly(tmp_path / "p.xml", parts, [joint("j", "revolute", "ground", "bob", axis=(0, 1, 0))])
    )
    floor = Plane("floor", None, np.array([7.0, 0.0, height]), np.array(Z), Place())
    assert reach_of(assembly, (floor,)).apart(balls_of(assembly, 0.5))("floor", "bob") is apart


@pytest.mark.full
@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_no_pose_of_a_chain_contradicts(tmp_path_factory: pytest.TempPathFactory, seed: int) -> None:
    """A chain from the ground with axes and lengths at random, turned at random: what is dropped never meets."""
    random = np.random.default_rng(seed)
    count = int(random.integers(2, 5))
    origins = np.cumsum(random.normal(size=(count, 3)) * random.choice([0.2, 3.0], size=(count, 1)), axis=0)
    axes = random.normal(size=(count, 3))
    places = origins + random.normal(size=(count, 3))
    names = [f"p{k}" for k in range(count)]
    joints = [
        joint(f"j{k}", "revolute", names[k - 1] if k else "ground", names[k], origin=origins[k], axis=axes[k])
        for k in range(count)
    ]
    file = tmp_path_factory.mktemp("chain") / "chain.xml"
    parts = [part(name, position=place) for name, place in zip(names, places, strict=True)]
    assembly = read_assembly(write_assembly(file, parts, joints))
    moved: list[list[np.ndarray]] = []
    for _ in range(200):
        pose, centers = Pose(np.zeros(3), np.eye(3)), []
        for k in range(count):
            turn = rotation_about(axes[k], random.uniform(-np.pi, np.pi))
            pose = pose @ Pose(origins[k] - turn @ origins[k], turn)
            centers.append(pose.point(places[k]))
        moved.append(centers)
    centers_of = np.array(moved)
    for radius in (0.1, 0.5, 1.0):
        reach, balls = reach_of(assembly), balls_of(assembly, radius)
        for first in range(count):
            for second in range(first + 1, count):
                if reach.apart(balls)(names[first], names[second]):
                    nearest = np.linalg.norm(centers_of[:, first] - centers_of[:, second], axis=1).min()
                    assert nearest > 2 * radius


@pytest.mark.parametrize(
    "shape",
    [
        CollisionShape("sphere", Pose(np.array([1.0, 2.0, 3.0]), np.eye(3)), radius=0.5),
        CollisionShape("box", Pose(np.array([1.0, 0.0, 0.0]), rotation_about((1, 2, 3), 0.7)), size=(1.0, 2.0, 3.0)),
        CollisionShape("capsule", Pose(np.zeros(3), rotation_about((1, 0, 0), 1.0)), radius=0.5, length=4.0),
        CollisionShape("hull", vertices=np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 5.0]])),
    ],
)
def test_ball_holds_the_shape(shape: CollisionShape) -> None:
    pose = Pose(np.array([4.0, -1.0, 0.0]), rotation_about((0, 1, 1), 2.0))
    ball = CollisionGeometry((shape,), ()).ball(pose)
    points, margin = shape.outline
    away = np.linalg.norm(pose.point(points) - ball.center, axis=1)
    assert away.max() + margin <= ball.radius * (1 + 1e-12)
    exact = {"sphere": 0.5, "box": np.sqrt(14) / 2, "capsule": 2.5}
    if shape.kind in exact:
        # Closed forms: of the box at most the bound by the aligned box about it.
        assert exact[shape.kind] - 1e-12 <= ball.radius <= 1.2 * exact[shape.kind]


def test_generation_says_what_was_dropped(pendulum: Path, tmp_path: Path) -> None:
    """A floor far below the pendulum cannot be hit; included explicitly the pair stays."""
    text = pendulum.read_text()
    begin, end = text.index("<ground>"), text.index("</ground>")
    name = read_assembly(pendulum).planes[0].name
    pendulum.write_text(text[:begin] + f'<ground><plane name="{name}" position="0 0 -1e5"/>' + text[end:])
    package = generate(pendulum, tmp_path / "out")
    notes = [note for note in package.notes if "keep them apart" in note]
    assert len(notes) == 1
    assert repr(name) in notes[0]
