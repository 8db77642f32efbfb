"""Frames that are connected to nothing are named; an inner component that is missing is warned of."""

from __future__ import annotations

from pathlib import Path

import pytest
from contact_data import core_subset
from contact_foundation.errors import InputError
from modelica2fmu.library.standard_library import StandardLibrary
from modelica2fmu.translation import Translation, translate

LIBRARY = Path(__file__).parents[4] / "ContactMultiBody"
WORLD = "  inner Modelica.Mechanics.MultiBody.World world;\n"
CONNECTIONS = (
    "  connect(ball.frame_a, contacts.frame[1]);\n",
    "  connect(floor.frame_a, contacts.frame[2]);\n",
)
DROP = f"""model Drop
{WORLD}  ContactMultiBody.Parts.Body ball(
    m=1, r_CM={{0,0,0}}, I_11=0.004, I_22=0.004, I_33=0.004, geometry=ContactMultiBody.Shapes.sphere(0.1));
  ContactMultiBody.Parts.Ground floor;
  ContactMultiBody.ContactManager contacts(
    n=2, geometry={{ball.geometry, floor.geometry}}, material={{ball.material, floor.material}});
equation
{"".join(CONNECTIONS)}end Drop;
"""


def translated(folder: Path, text: str) -> Translation:
    (folder / "Drop.mo").write_text(text)
    return translate("Drop", [folder / "Drop.mo", LIBRARY], StandardLibrary(core_subset(), "", "core subset"))


@pytest.mark.parametrize(
    "left_out", [pytest.param((0,), marks=pytest.mark.full), pytest.param((1,), marks=pytest.mark.full), (0, 1)]
)
def test_frames_that_are_connected_to_nothing_are_named(tmp_path, left_out):
    text = DROP
    for number in left_out:
        text = text.replace(CONNECTIONS[number], "")
    with pytest.raises(InputError) as caught:
        translated(tmp_path, text)
    frames = ", ".join(f"contacts.frame[{number + 1}]" for number in left_out)
    assert caught.value.message.startswith(f"{frames} {'is' if len(left_out) == 1 else 'are'} connected to nothing")
    assert caught.value.place is not None
    assert (caught.value.place.file, caught.value.place.line) == (tmp_path / "Drop.mo", 6)


def test_frames_beyond_those_that_are_connected_are_named(tmp_path):
    """Here the lists are shorter than n, so that the front end does not flatten the model at all."""
    with pytest.raises(InputError) as caught:
        translated(tmp_path, DROP.replace("n=2", "n=3"))
    assert caught.value.message.startswith("contacts.frame[3] is connected to nothing")


def test_a_missing_world_is_warned_of(tmp_path):
    said = translated(tmp_path, DROP.replace(WORLD, "")).scalar.warnings
    assert [warning for warning in said if "no component world is declared as inner" in warning]
    said = translated(tmp_path, DROP).scalar.warnings
    assert not [warning for warning in said if "inner" in warning]


@pytest.mark.parametrize(
    ("right", "wrong", "line", "said"),
    [
        ("m=1", "masss=1", 4, "ContactMultiBody.Parts.Body has no masss"),
        ("r_CM={0,0,0}", 'r_CM="no"', 4, "found `String`"),
        ("n=2", "count=2", 7, "ContactMultiBody.ContactManager has no count"),
    ],
)
def test_a_mistake_is_told_by_its_own_line_alone(tmp_path, right, wrong, line, said):
    """Not after places of libraries in which the front end finds fault only then."""
    with pytest.raises(InputError) as caught:
        translated(tmp_path, DROP.replace(right, wrong))
    assert said in caught.value.message
    assert ".mo:" not in caught.value.message
    assert caught.value.place is not None
    assert (caught.value.place.file, caught.value.place.line) == (tmp_path / "Drop.mo", line)
