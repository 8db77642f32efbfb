"""Start speeds: of free parts against parents that move themselves, in closed form, and what no joint can have."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from assembly_text import joint, part, write_assembly
from cad2modelica import generate
from contact_foundation.errors import InputError


def vector(text: str, body: str, name: str) -> np.ndarray:
    found = re.search(rf"\b{body}\((.*?)\n  [A-Zce]", text, re.DOTALL)
    assert found is not None
    value = re.search(rf"{name}(?:\(start)?=\{{([^}}]*)\}}", found[1])
    assert value is not None
    return np.array([float(word) for word in value[1].split(",")])


def mechanics(tmp_path: Path, parts: list[str], joints: list[str]) -> tuple[str, tuple[str, ...]]:
    package = generate(write_assembly(tmp_path / "test.xml", parts, joints), tmp_path / "out")
    return (package.root / "Mechanics.mo").read_text(), package.notes


def test_free_part_starts_against_its_moving_parent(tmp_path: Path) -> None:
    """An arm turns about z with 2 rad/s on a cart with 3 m/s along x; what it throws has 1 m/s and 5 rad/s more."""
    text, _ = mechanics(
        tmp_path,
        [part("cart"), part("arm", position=(0, 0, 1)), part("load", position=(4, 1, 1))],
        [
            joint("rail", "prismatic", "ground", "cart", axis=(1, 0, 0), start='speed="3"'),
            joint("shaft", "revolute", "cart", "arm", origin=(0, 0, 1), axis=(0, 0, 1), start='speed="2"'),
            joint("grip", "free", "arm", "load", origin=(4, 0, 1), start='velocity="0 1 0" angularVelocity="0 0 5"'),
        ],
    )
    # 3 m/s of the cart, 2 rad/s x (4, 1), 1 m/s along y at the grip and 5 rad/s x (0, 1)
    np.testing.assert_allclose(vector(text, "load", "v_0"), [3 - 2 - 5, 8 + 1, 0], atol=1e-12)
    np.testing.assert_allclose(vector(text, "load", "w_0_start"), [0, 0, 7], atol=1e-12)


def test_free_part_starts_against_a_free_part_listed_later(tmp_path: Path) -> None:
    text, notes = mechanics(
        tmp_path,
        [part("load", position=(0, 2, 0)), part("truck", start='<start velocity="10 0 0" angularVelocity="0 0 1"/>')],
        [joint("bed", "free", "truck", "load", origin=(0, 2, 0))],
    )
    np.testing.assert_allclose(vector(text, "load", "v_0"), [10 - 2, 0, 0], atol=1e-12)
    np.testing.assert_allclose(vector(text, "load", "w_0_start"), [0, 0, 1], atol=1e-12)
    assert not [note for note in notes if "ignored" in note]


def test_free_joint_against_what_hangs_on_the_child_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="'b', which hangs on 'a' itself") as caught:
        mechanics(
            tmp_path,
            [part("a"), part("b", position=(1, 0, 0))],
            [joint("hinge", "revolute", "a", "b", axis=(0, 0, 1)), joint("loose", "free", "b", "a")],
        )
    assert caught.value.place is not None
    assert caught.value.place.line is not None


@pytest.mark.parametrize(
    ("kind", "axes", "start", "counts"),
    [
        ("planar", {"axis": (0, 0, 1)}, 'velocity="1 2 3" angularVelocity="4 5 6"', "0 0 6 rad/s and velocity 1 2 0"),
        ("spherical", {}, 'velocity="1 0 0" angularVelocity="4 5 6"', "4 5 6 rad/s and velocity 0 0 0"),
        ("cylindrical", {"axis": (1, 0, 0)}, 'velocity="1 2 0"', "0 0 0 rad/s and velocity 1 0 0"),
        ("universal", {"axis": (1, 0, 0), "axis2": (0, 1, 0)}, 'angularVelocity="1 2 3"', "1 2 0 rad/s"),
    ],
)
def test_speeds_that_a_joint_cannot_have_are_noted(
    tmp_path: Path, kind: str, axes: dict[str, tuple[float, ...]], start: str, counts: str
) -> None:
    _, notes = mechanics(
        tmp_path, [part("body")], [joint("j", kind, "ground", "body", origin=(1, 2, 3), start=start, **axes)]
    )
    (note,) = [note for note in notes if "joint 'j'" in note]
    assert counts in note


def test_speeds_that_other_joints_or_parts_give_are_noted(tmp_path: Path) -> None:
    speed = 'velocity="1 0 0"'
    _, notes = mechanics(
        tmp_path,
        [part("held"), part("both", start=f"<start {speed}/>"), part("twice")],
        [
            joint("hinge", "revolute", "ground", "held", axis=(0, 0, 1)),
            joint("a", "free", "ground", "held", start=speed),
            joint("b", "free", "ground", "both", start=speed),
            joint("c", "free", "ground", "twice"),
            joint("d", "free", "ground", "twice", start=speed),
        ],
    )
    said = "\n".join(notes)
    assert "joint 'a': its start speed was ignored, for 'held' is held otherwise" in said
    assert "part 'both': its start speed was ignored, for that of its free joint 'b' counts" in said
    assert "joint 'd': its start speed was ignored, for that of 'c' counts" in said
