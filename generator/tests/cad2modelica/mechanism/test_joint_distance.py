"""Remarks on joints that lie far from their parts: numbers, and what would put them right."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from assembly_text import joint, part, write_assembly
from cad2modelica import generate, read_assembly
from cad2modelica.geometry.mesh import Mesh
from cad2modelica.geometry.spatial import rotation_about
from cad2modelica.mechanism.joint_distance import distance_notes
from cad2modelica.mechanism.model import Assembly


def box(size: float) -> Mesh:
    """A cube around the origin; corners and faces suffice."""
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * size / 2
    return Mesh("box", corners, np.array([[0, 1, 2], [5, 6, 7]]), None)


def assembly(folder: Path, *joints: str, turn: float = 0.0) -> Assembly:
    """A block of 0.2 m at x = 1 and an arm of 0.4 m at x = 1.2, turned about z, with geometry."""
    parts = [part("block", position=(1, 0, 0)), part("arm", position=(1.2, 0, 0), turn=((0, 0, 1), turn))]
    found = read_assembly(write_assembly(folder / "far.xml", parts, joints))
    sizes = {"block": 0.2, "arm": 0.4}
    return replace(found, parts=tuple(replace(item, meshes=(box(sizes[item.name]),)) for item in found.parts))


def hinge(origin: tuple[float, float, float], kind: str = "revolute") -> str:
    axis = None if kind == "spherical" else (0, 0, 1)
    return joint("hinge", kind, "block", "arm", origin=origin, axis=axis)


def test_joint_in_its_parts_gives_no_remark(tmp_path: Path) -> None:
    assert distance_notes(assembly(tmp_path, hinge((1.05, 0, 0)))) == ()


def test_distance_is_that_of_the_line(tmp_path: Path) -> None:
    """The origin of a hinge may lie anywhere on its axis, that of a ball may not; a guide has a direction only."""
    far = (1.05, 0, 30)
    assert distance_notes(assembly(tmp_path, hinge(far))) == ()
    assert distance_notes(assembly(tmp_path, hinge((1.05, 30, 0), "prismatic"))) == ()
    (note,) = distance_notes(assembly(tmp_path, hinge(far, "spherical")))
    radius = 0.1 * np.sqrt(3)
    away = np.hypot(0.05, 30) - radius
    assert f"joint 'hinge' lies {1000 * away:.4g} mm outside 'block', whose size is {2000 * radius:.4g} mm" in note


@pytest.mark.parametrize(
    ("origin", "turn", "words"),
    [
        ((1050, 0, 0), 0.0, "; 0.001 times its origin would fit: another unit of length?"),
        ((1.05 * 25.4, 0, 0), 0.0, "; 0.0394 times its origin would fit: another unit of length?"),
        ((-0.1, 0.05, 0), np.pi, ': is its origin meant in the coordinates of its parent (frame="parent")?'),
        ((0, 0.19, 0), np.pi / 2, ': is its origin meant in the coordinates of its child (frame="child")?'),
        ((1.05, 7, 0), 0.0, ": is it where it should be?"),
    ],
)
def test_reason(tmp_path: Path, origin: tuple[float, float, float], turn: float, words: str) -> None:
    (note,) = distance_notes(assembly(tmp_path, hinge(origin), turn=turn))
    assert note.endswith(words)


def test_origin_in_the_world_that_was_meant_in_a_part(tmp_path: Path) -> None:
    """frame="child" with the numbers of the assembly."""
    turned = rotation_about([0, 0, 1], 0.5)
    wrong = np.array([1.2, 0, 0]) + turned @ [1.1, 0.05, 0]
    (note,) = distance_notes(assembly(tmp_path, hinge(tuple(wrong)), turn=0.5))
    assert "in the world's coordinates, and not in those of its child" in note


def test_many_are_counted_and_the_report_shows_them(tmp_path: Path, pendulum: Path) -> None:
    joints = [hinge((1.05, 9 + k, 0)).replace("hinge", f"hinge {k}") for k in range(8)]
    notes = distance_notes(assembly(tmp_path, *joints))
    assert len(notes) == 6
    assert notes[-1] == "so far from a part they join lie 3 more joints"
    text = pendulum.read_text()
    pendulum.write_text(text.replace("<origin>", '<origin frame="child">', 1))
    (note,) = distance_notes(read_assembly(pendulum))
    assert "in the world's coordinates, and not in those of its child" in note
    begin = text.index("<origin>") + len("<origin>")
    pendulum.write_text(text[:begin] + "90000 0 0" + text[text.index("</origin>") :])
    package = generate(pendulum, tmp_path / "out")
    assert any("mm outside" in note for note in package.notes)
    assert "mm outside" in package.report.read_text()
