"""Concave bodies become convex pieces: properties against closed forms, choices, limits, the cache."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from cad2modelica import GenerateOptions, generate, read_assembly
from cad2modelica.collision import convex_decomposition, decomposition_cache
from cad2modelica.collision.collision_shapes import CollisionGeometry, collision_geometry
from cad2modelica.collision.convex_decomposition import MAXIMUM_CORNERS, decompose
from cad2modelica.geometry.mesh import Indices, Mesh, is_closed, volume_integrals
from cad2modelica.geometry.polygon import triangulate
from cad2modelica.geometry.solid_comparison import compare
from cad2modelica.geometry.spatial import IDENTITY
from cad2modelica.mechanism.model import (
    NO_LIMITS,
    CollisionChoice,
    Decomposer,
    DecompositionLimits,
    MassProperties,
    Part,
)
from contact_foundation.cache import user_cache
from contact_foundation.errors import InputError, Place
from scipy.spatial import ConvexHull

L_OUTLINE = np.array([[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3]], dtype=float)
BOX = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)


@pytest.fixture(autouse=True)
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty cache for each test."""
    folder = tmp_path / "cache"
    monkeypatch.setenv("XDG_CACHE_HOME", str(folder))
    return folder


def prism(outline: np.ndarray, height: float) -> tuple[np.ndarray, Indices]:
    """A closed prism over a counter-clockwise outline, standing on z = 0."""
    count = len(outline)
    bottom = np.column_stack([outline, np.zeros(count)])
    cap = triangulate(bottom)
    sides = [(k, (k + 1) % count) for k in range(count)]
    triangles = [(c, b, a) for a, b, c in cap] + [(a + count, b + count, c + count) for a, b, c in cap]
    triangles += [t for a, b in sides for t in ((a, b, b + count), (a, b + count, a + count))]
    return np.vstack([bottom, bottom + np.array([0, 0, height])]), np.array(triangles, dtype=np.int64)


def shapes_of(
    vertices: np.ndarray,
    triangles: Indices,
    choice: CollisionChoice = CollisionChoice.AUTO,
    own: DecompositionLimits = NO_LIMITS,
    limits: DecompositionLimits = NO_LIMITS,
) -> CollisionGeometry:
    mesh = Mesh("m", vertices, triangles, (0.5, 0.5, 0.5))
    part = Part("body", None, IDENTITY, MassProperties(1.0, np.zeros(3), np.eye(3)), (mesh,), choice, False, Place())
    return collision_geometry(
        Part(**{**vars(part), "decomposition": own}),
        limits,
    )


def test_an_l_becomes_two_boxes_worth_of_pieces() -> None:
    vertices, triangles = prism(L_OUTLINE, 1.0)
    assert is_closed(triangles)
    assert volume_integrals(vertices, triangles).volume == pytest.approx(5.0)
    geometry = shapes_of(vertices, triangles)
    assert 2 <= len(geometry.shapes) <= 16
    hulls = [ConvexHull(shape.vertices) for shape in geometry.shapes]
    assert sum(hull.volume for hull in hulls) == pytest.approx(5.0, rel=0.02)
    # The notch, where the hull would collide, is free; both legs are solid.
    inside = [
        any((hull.equations[:, :3] @ point + hull.equations[:, 3] <= 0).all() for hull in hulls)
        for point in ([1.5, 1.4, 0.5], [2.5, 0.5, 0.5], [0.5, 2.5, 0.5], [0.5, 0.5, 0.5])
    ]
    assert inside == [False, True, True, True]
    assert all(len(hull.vertices) <= MAXIMUM_CORNERS for hull in hulls)
    (note,) = geometry.notes
    assert f"{len(hulls)} convex pieces" in note


@pytest.mark.full
def test_faces_turned_inside_out_give_the_same_pieces() -> None:
    vertices, triangles = prism(L_OUTLINE, 1.0)
    plain, turned = shapes_of(vertices, triangles), shapes_of(vertices, triangles[:, ::-1])
    volumes = [sum(ConvexHull(s.vertices).volume for s in g.shapes) for g in (plain, turned)]
    assert volumes[1] == pytest.approx(volumes[0], rel=0.02)
    assert len(turned.notes) == 2


@pytest.mark.full
def test_what_is_almost_convex_is_its_hull_unless_asked() -> None:
    """A dent of 2 % of the hull, a house: below the bound of "auto", above none of "decomposition"."""
    dented = np.array([[0, 0], [10, 0], [11, 1], [10, 2.5], [5, 2.4], [0, 2.5]], dtype=float)
    vertices, triangles = prism(dented, 3.0)
    assert [shape.kind for shape in shapes_of(vertices, triangles).shapes] == ["hull"]
    fine = DecompositionLimits(error=0.05)
    split = shapes_of(vertices, triangles, CollisionChoice.DECOMPOSITION, fine)
    assert sum(ConvexHull(s.vertices).volume for s in split.shapes) < ConvexHull(vertices).volume
    assert len(shapes_of(vertices, triangles, CollisionChoice.HULL).shapes) == 1


@pytest.mark.full
def test_a_hull_that_is_a_box_does_not_hide_what_is_cut_out() -> None:
    """A U has a box for its hull; the slot must be free, or said to be filled."""
    u = np.array([[0, 0], [3, 0], [3, 2], [2, 2], [2, 1], [1, 1], [1, 2], [0, 2]], dtype=float)
    u[4, 1], u[5, 1] = 0.9, 1.0  # no three corners on a line
    vertices, triangles = prism(u, 1.0)
    geometry = shapes_of(vertices, triangles)
    volume = sum(ConvexHull(shape.vertices).volume for shape in geometry.shapes if shape.kind == "hull")
    assert volume == pytest.approx(volume_integrals(vertices, triangles).volume, rel=0.05)
    filled = shapes_of(vertices, triangles, CollisionChoice.BOX)
    assert [shape.kind for shape in filled.shapes] == ["box"]
    assert "collides as a box, 1" in filled.notes[0]


@pytest.mark.full
def test_limits() -> None:
    """A comb of five teeth: the part's own limits count before the given ones, the count before the error."""
    # Every tooth and gap at a height of its own: no three corners lie on a line.
    teeth = [
        (x, y + 0.01 * x * x)
        for k in range(5)
        for x, y in ((9 - 2 * k, 3), (8 - 2 * k, 3), (8 - 2 * k, 1), (7 - 2 * k, 1))
    ]
    outline = np.array([(0, 0), (9, 0), *teeth[:-2]], dtype=float)
    vertices, triangles = prism(outline, 1.0)
    assert is_closed(triangles)
    volume = volume_integrals(vertices, triangles).volume
    two, many = DecompositionLimits(pieces=2), DecompositionLimits(error=0.1, pieces=32)
    assert len(shapes_of(vertices, triangles, limits=two).shapes) <= 2
    assert len(shapes_of(vertices, triangles, own=two, limits=many).shapes) <= 2
    fine = shapes_of(vertices, triangles, limits=many)
    assert len(fine.shapes) >= 5
    assert sum(ConvexHull(s.vertices).volume for s in fine.shapes) == pytest.approx(volume, rel=0.05)
    coarse = shapes_of(vertices, triangles, limits=DecompositionLimits(error=5.0))
    assert len(coarse.shapes) < len(fine.shapes)


def test_forced_shape() -> None:
    box = ConvexHull(BOX)
    corners = BOX[box.simplices]
    outward = np.einsum(
        "ij,ij->i", np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), box.equations[:, :3]
    )
    triangles = np.where(outward[:, None] > 0, box.simplices, box.simplices[:, ::-1]).astype(np.int64)
    assert shapes_of(BOX, triangles, CollisionChoice.BOX).shapes[0].kind == "box"
    with pytest.raises(InputError, match="sphere"):
        shapes_of(BOX, triangles, CollisionChoice.SPHERE)


def test_comparison_against_closed_forms() -> None:
    """The hull of the L adds a triangular prism of volume 2; its farthest point is the middle of the slanted face."""
    vertices, triangles = prism(L_OUTLINE, 1.0)
    difference = compare(vertices, triangles, [ConvexHull(vertices)])
    assert difference.foreign == pytest.approx(2.0 / 5.0, abs=0.02)
    assert difference.missing == 0.0
    # Points (2, 2) - t: distance 1 - t from both legs, on the slanted face x + y = 4.
    assert 0.9 < difference.distance <= 1.0 + 1e-12
    leg = ConvexHull(BOX * [3, 1, 1])
    difference = compare(vertices, triangles, [leg])
    assert difference.missing == pytest.approx(2.0 / 5.0, abs=0.02)
    assert difference.foreign == 0.0
    assert difference.distance == pytest.approx(2.0)  # from (0, 3) to y = 1
    both = compare(vertices, triangles, [leg, ConvexHull(BOX * [1, 3, 1])])
    assert (both.foreign, both.missing) == (0.0, 0.0)
    assert both.distance < 1e-12


def test_cache_gives_the_same_and_ignores_what_is_broken(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    vertices, triangles = prism(L_OUTLINE, 1.0)
    first = decompose(vertices, triangles, 0.2, 8)
    (entry,) = cache.rglob("*.json")
    whole = entry.read_bytes()
    content = json.loads(whole)
    content["pieces"][0][0][0] += 0.5
    for broken in (b"", whole[: len(whole) // 2], b"[]", b"\xff\xfe", json.dumps(content).encode()):
        entry.write_bytes(broken)
        assert decomposition_cache.read_pieces(entry) is None
    entry.write_bytes(b"{}")
    again = decompose(vertices, triangles, 0.2, 8)
    assert [piece.tobytes() for piece in again.pieces] == [piece.tobytes() for piece in first.pieces]
    assert entry.read_bytes() == whole
    monkeypatch.setattr(subprocess, "Popen", None)  # from here on only the cache can answer
    cached = decompose(vertices, triangles, 0.2, 8)
    assert [piece.tobytes() for piece in cached.pieces] == [piece.tobytes() for piece in first.pieces]


def test_cache_folder() -> None:
    assert user_cache("x", {"XDG_CACHE_HOME": "/c", "HOME": "/h"}) == Path("/c/contactmultibody/x")
    for environment in ({"HOME": "/h"}, {"XDG_CACHE_HOME": "", "HOME": "/h"}, {"XDG_CACHE_HOME": "c", "HOME": "/h"}):
        assert user_cache("x", environment) == Path("/h/.cache/contactmultibody/x")


@pytest.mark.full
def test_vhacd_keeps_the_error_and_the_number() -> None:
    """The Hausdorff distance is within the error where the number allows it; the same input gives the same pieces."""
    vertices, triangles = prism(L_OUTLINE, 1.0)
    limits = DecompositionLimits(error=0.05, pieces=16, decomposer=Decomposer.VHACD)
    geometry = shapes_of(vertices, triangles, limits=limits)
    hulls = [ConvexHull(shape.vertices) for shape in geometry.shapes if shape.kind == "hull"]
    difference = compare(vertices, triangles, hulls)
    assert 2 <= len(hulls) <= 16
    assert difference.distance <= 0.05
    assert difference.foreign < 0.05
    assert difference.missing < 0.02
    few = shapes_of(vertices, triangles, limits=DecompositionLimits(error=1e-3, pieces=3, decomposer=Decomposer.VHACD))
    assert len(few.shapes) <= 3
    again = decompose(vertices, triangles, 0.05, 16, Decomposer.VHACD)
    for entry in user_cache("decomposition").glob("*.json"):
        entry.unlink()
    fresh = decompose(vertices, triangles, 0.05, 16, Decomposer.VHACD)
    assert [piece.tobytes() for piece in fresh.pieces] == [piece.tobytes() for piece in again.pieces]


@pytest.mark.full
def test_decomposers_have_entries_of_their_own() -> None:
    vertices, triangles = prism(L_OUTLINE, 1.0)
    first = decompose(vertices, triangles, 0.2, 4)
    second = decompose(vertices, triangles, 0.2, 4, Decomposer.VHACD)
    assert len(list(user_cache("decomposition").glob("*.json"))) == 2
    assert [p.tobytes() for p in first.pieces] != [p.tobytes() for p in second.pieces]


@pytest.mark.full
def test_without_a_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    blocked = tmp_path / "file"
    blocked.write_text("")
    monkeypatch.setenv("XDG_CACHE_HOME", str(blocked))
    vertices, triangles = prism(L_OUTLINE, 1.0)
    assert len(decompose(vertices, triangles, 0.2, 8).pieces) >= 2


@pytest.mark.full
def test_the_number_of_threads_does_not_matter(tmp_path: Path) -> None:
    script = (
        "import numpy as np, sys; from cad2modelica.collision.convex_decomposition import decompose;"
        "given = np.load(sys.argv[1]);"
        "print([p.tobytes().hex() for p in decompose(given['v'], given['t'], 0.2, 8).pieces])"
    )
    vertices, triangles = prism(L_OUTLINE, 1.0)
    np.savez(tmp_path / "l.npz", v=vertices, t=triangles)
    outputs = [
        subprocess.run(
            [sys.executable, "-c", script, str(tmp_path / "l.npz")],
            env={**os.environ, "OMP_NUM_THREADS": threads, "XDG_CACHE_HOME": str(tmp_path / threads)},
            capture_output=True,
            check=True,
        ).stdout
        for threads in ("1", "3")
    ]
    assert outputs[0] == outputs[1]
    assert len(outputs[0]) > 500


def test_too_fine_meshes_and_failures_keep_the_hull(monkeypatch: pytest.MonkeyPatch) -> None:
    vertices, triangles = prism(L_OUTLINE, 1.0)
    with monkeypatch.context() as few:  # undone alone: the cache stays the test's own
        few.setattr("cad2modelica.collision.convex_decomposition.MAXIMUM_TRIANGLES", 10)
        geometry = shapes_of(vertices, triangles)
    assert [shape.kind for shape in geometry.shapes] == ["hull"]
    assert "export it coarser" in geometry.notes[0]
    monkeypatch.setattr(sys, "executable", "/bin/false")
    assert "CoACD failed with status 1: no message; V-HACD failed" in shapes_of(vertices, triangles).notes[0]


@pytest.mark.full
def test_what_never_ends_is_stopped_and_vhacd_asked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The limit is of processor time; that there was no end is remembered, so that the next run does not wait again."""
    (tmp_path / "endless.py").write_text("while True:\n    pass\n")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    monkeypatch.setitem(convex_decomposition._PROCESSES, Decomposer.COACD, "endless")
    vertices, triangles = prism(L_OUTLINE, 1.0)
    monkeypatch.setattr(convex_decomposition, "TIME_LIMIT", 12)
    first = shapes_of(vertices, triangles)
    assert 2 <= len(first.shapes) <= 16
    assert "convex pieces" in first.notes[0]
    assert "CoACD took longer than 12 s; V-HACD instead" in first.notes[0]
    monkeypatch.setattr(subprocess, "Popen", None)  # from here on only the cache can answer
    again = shapes_of(vertices, triangles)
    assert (again.descriptor, again.notes) == (first.descriptor, first.notes)
    asked = decompose(vertices, triangles, 0.025 * float(np.linalg.norm([3, 3, 1])), 16, Decomposer.VHACD)
    assert [len(piece) for piece in asked.pieces] == [len(shape.vertices) for shape in first.shapes]


def test_choices_in_the_file(pendulum: Path) -> None:
    text = pendulum.read_text()
    assert "<collision" not in text
    contacts = text.replace("</assembly>", '<contacts collision="hull" collisionError="2.5" maxPieces="7"/></assembly>')
    pendulum.write_text(contacts)
    assembly = read_assembly(pendulum)
    assert assembly.contacts.decomposition == DecompositionLimits(0.0025, 7)
    assert {part.collision for part in assembly.parts} == {CollisionChoice.HULL}
    pendulum.write_text(contacts.replace('maxPieces="7"', 'decomposer="vhacd"'))
    chosen = read_assembly(pendulum).contacts.decomposition
    assert chosen == DecompositionLimits(0.0025, None, decomposer=Decomposer.VHACD)
    first = assembly.parts[0].name
    begin = contacts.index("/>", contacts.index("<geometry", contacts.index(f'name="{first}"'))) + 2
    pendulum.write_text(contacts[:begin] + '<collision shape="none" error="1"/>' + contacts[begin:])
    part = read_assembly(pendulum).parts[0]
    assert part.collision is CollisionChoice.NONE
    assert part.decomposition == DecompositionLimits(0.001, None)


@pytest.mark.parametrize(
    "options",
    [
        GenerateOptions(collision_error=0.0),
        GenerateOptions(collision_error=float("nan")),
        GenerateOptions(max_pieces=0),
        GenerateOptions(max_pieces=257),
    ],
)
def test_wrong_options(pendulum: Path, tmp_path: Path, options: GenerateOptions) -> None:
    with pytest.raises(InputError):
        generate(pendulum, tmp_path / "out", options)
    assert not (tmp_path / "out").exists()
