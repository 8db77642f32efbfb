"""Start positions that do not close: gaps as they are, and the least-squares step that closes them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from assembly_text import joint, numbers, part, write_assembly
from cad2modelica import GenerateOptions, generate, read_assembly
from cad2modelica.kinematics.assembling import assembled, require_closed
from cad2modelica.kinematics.kinematic_graph import kinematic_tree
from contact_foundation.errors import InputError
from scipy.spatial.transform import Rotation

ACROSS = (0, 1, 0)


def four_bar(folder: Path, *, crank: float, coupler: float, length: float = 0.5, start: str = "") -> Path:
    """Links of 0.2, 0.5 and 0.4 m, 0.5 m between the bearings; the joint at the coupler's end in both its parts.

    Angles from the x axis towards z; the rocker stands upright.
    """
    tip = 0.2 * np.array([np.cos(crank), 0, np.sin(crank)])
    parts = [
        part("crank", turn=(ACROSS, -crank)),
        part("coupler", position=tip, turn=(ACROSS, -coupler)),
        part("rocker", position=(0.5, 0, 0)),
    ]
    closing = joint("j3", "revolute", "rocker", "coupler", axis=ACROSS, start=start).replace(
        "<origin>0.0 0.0 0.0</origin>", '<origin frame="parent">0 0 0.4</origin>'
    )
    sides = f'<childOrigin frame="child">{length!r} 0 0</childOrigin><childAxis frame="child">0 1 0</childAxis>'
    at = closing.index("</axis>") + len("</axis>")
    joints = [
        joint("j1", "revolute", "ground", "crank", axis=ACROSS),
        joint("j2", "revolute", "crank", "coupler", origin=tip, axis=ACROSS),
        joint("j4", "revolute", "ground", "rocker", origin=(0.5, 0, 0), axis=ACROSS),
        closing[:at] + sides + closing[at:],
    ]
    return write_assembly(folder / "bar.xml", parts, joints, name="Bar")


def closed_angles() -> tuple[float, float]:
    """Crank and coupler angles that put the coupler's end on the upright rocker's, by intersecting two circles."""
    target = np.array([0.5, 0.4])
    distance = float(np.hypot(*target))
    inner = np.arccos((0.2**2 + distance**2 - 0.5**2) / (2 * 0.2 * distance))
    crank = float(np.arctan2(target[1], target[0]) + inner)
    rest = target - 0.2 * np.array([np.cos(crank), np.sin(crank)])
    return crank, float(np.arctan2(rest[1], rest[0]))


def test_a_loop_that_closes_is_accepted(tmp_path: Path) -> None:
    crank, coupler = closed_angles()
    require_closed(read_assembly(four_bar(tmp_path, crank=crank, coupler=coupler)))


def test_gap_is_reported_in_numbers(tmp_path: Path) -> None:
    crank, coupler = closed_angles()
    file = four_bar(tmp_path, crank=crank, coupler=coupler + 0.02)
    gap = 1000 * 2 * 0.5 * np.sin(0.01)
    with pytest.raises(InputError) as caught:
        generate(file, tmp_path / "out")
    assert f"the joint 'j3' does not close at the start: its parts are {gap:.4g} mm and 0 degrees" in str(caught.value)
    assert "--assemble" in str(caught.value)
    assert not (tmp_path / "out").exists()


def test_parts_are_moved_together(tmp_path: Path) -> None:
    """Afterwards every joint fits, links have their lengths, and coordinates tell how far the parts turned."""
    crank, coupler = closed_angles()
    assembly = read_assembly(four_bar(tmp_path, crank=crank + 0.03, coupler=coupler - 0.04))
    closed = assembled(assembly, kinematic_tree(assembly))
    tip = closed.part("crank").pose.point([0.2, 0, 0])
    np.testing.assert_allclose(closed.part("coupler").pose.position, tip, atol=1e-10)
    end = closed.part("coupler").pose.point([0.5, 0, 0])
    np.testing.assert_allclose(closed.part("rocker").pose.point([0, 0, 0.4]), end, atol=1e-10)
    np.testing.assert_allclose(closed.part("rocker").pose.position, [0.5, 0, 0], atol=1e-10)
    np.testing.assert_allclose(closed.part("crank").pose.position, [0, 0, 0], atol=1e-10)
    turns = {}
    for name in ("crank", "coupler", "rocker"):
        change = closed.part(name).pose.rotation @ assembly.part(name).pose.rotation.T
        turns[name] = Rotation.from_matrix(change).as_rotvec() @ np.array(ACROSS)
    positions = {joint.name: joint.position for joint in closed.joints}
    assert positions["j1"] == pytest.approx(turns["crank"], abs=1e-10)
    assert positions["j2"] == pytest.approx(turns["coupler"] - turns["crank"], abs=1e-10)
    assert positions["j4"] == pytest.approx(turns["rocker"], abs=1e-10)
    assert max(abs(turn) for turn in turns.values()) < 0.2
    assert any("'coupler' was moved" in note for note in closed.notes)
    require_closed(closed)


def test_generated_model_of_moved_parts_is_a_loop(tmp_path: Path) -> None:
    crank, coupler = closed_angles()
    file = four_bar(tmp_path, crank=crank, coupler=coupler + 0.02)
    package = generate(file, tmp_path / "out", GenerateOptions(assemble=True))
    assert "RevolutePlanarLoopConstraint" in (package.root / "Mechanics.mo").read_text()
    assert any("to close the joints" in note for note in package.notes)


def test_impossible_lengths_are_refused_with_what_is_left(tmp_path: Path) -> None:
    """A coupler of 1.5 m is longer than crank, rocker and the distance of their bearings together."""
    crank, coupler = closed_angles()
    file = four_bar(tmp_path, crank=crank, coupler=coupler, length=1.5)
    assembly = read_assembly(file)
    with pytest.raises(InputError, match="cannot be assembled"):
        assembled(assembly, kinematic_tree(assembly))


@pytest.mark.parametrize(
    ("kind", "sides", "words"),
    [
        ("prismatic", "<childOrigin>0 0.003 5</childOrigin>", "3 mm and 0 degrees"),
        ("cylindrical", '<childOrigin>0 0 5</childOrigin><childAxis frame="child">0 0.1 1</childAxis>', "0 mm and 5.7"),
        ("planar", "<childOrigin>4 5 0.002</childOrigin>", "2 mm and 0 degrees"),
        ("spherical", "<childOrigin>0 0 0.001</childOrigin>", "1 mm and 0 degrees"),
    ],
)
def test_gaps_count_only_what_the_joint_holds(tmp_path: Path, kind: str, sides: str, words: str) -> None:
    """Along a guide, about an axis, in a plane the parts may stand wherever they like; --assemble closes the rest."""
    axis = None if kind == "spherical" else (0, 0, 1)
    text = joint("j", kind, "ground", "a", axis=axis)
    at = text.index("</axis>") + len("</axis>") if axis is not None else text.index("</origin>") + len("</origin>")
    parts = [part("a", position=(0.1, 0.2, 0.3)), part("far", position=(1, 0, 0))]
    other = joint("k", "revolute", "ground", "far", origin=(1, 0, 0), axis=(0, 0, 1))
    assembly = read_assembly(write_assembly(tmp_path / "one.xml", parts, [text[:at] + sides + text[at:], other]))
    with pytest.raises(InputError) as caught:
        require_closed(assembly)
    assert words in str(caught.value)
    closed = assembled(assembly, kinematic_tree(assembly))
    require_closed(closed)
    np.testing.assert_allclose(closed.part("far").pose.position, [1, 0, 0], atol=1e-12)
    assert numbers(closed.part("a").pose.position) != numbers(assembly.part("a").pose.position)
