"""Frames that are connected to nothing are named; an inner component that is missing is warned of."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from contact_data import checkout, core_subset
from contact_foundation.errors import InputError
from modelica2fmu.frontend.balance import frames_without_connect
from modelica2fmu.library.standard_library import StandardLibrary
from modelica2fmu.translation import Translation, translate

LIBRARY = checkout() / "ContactMultiBody"
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


# Without the contact library: the front end reads less.
SWING = f"""model Swing
{WORLD}  Modelica.Mechanics.MultiBody.Parts.Body ball(m=1, r_CM={{0,0,0}});
equation
end Swing;
"""


def translated(folder: Path, text: str, *libraries: Path) -> Translation:
    name = text.split(None, 2)[1]
    file = folder / f"{name}.mo"
    file.write_text(text)
    return translate(name, [file, *libraries], StandardLibrary(core_subset(), "", "core subset"))


@pytest.mark.parametrize(
    "left_out", [pytest.param((0,), marks=pytest.mark.full), pytest.param((1,), marks=pytest.mark.full), (0, 1)]
)
def test_frames_that_are_connected_to_nothing_are_named(tmp_path, left_out):
    text = DROP
    for number in left_out:
        text = text.replace(CONNECTIONS[number], "")
    with pytest.raises(InputError) as caught:
        translated(tmp_path, text, LIBRARY)
    frames = ", ".join(f"contacts.frame[{number + 1}]" for number in left_out)
    assert caught.value.message.startswith(f"{frames} {'is' if len(left_out) == 1 else 'are'} connected to nothing")
    assert caught.value.place is not None
    assert (caught.value.place.file, caught.value.place.line) == (tmp_path / "Drop.mo", 6)


@pytest.mark.full
def test_frames_beyond_those_that_are_connected_are_named(tmp_path):
    """Here the lists are shorter than n, so that the front end does not flatten the model at all."""
    with pytest.raises(InputError) as caught:
        translated(tmp_path, DROP.replace("n=2", "n=3"), LIBRARY)
    assert caught.value.message.startswith("contacts.frame[3] is connected to nothing")


def test_a_missing_world_is_warned_of(tmp_path):
    said = translated(tmp_path, SWING.replace(WORLD, "")).scalar.warnings
    assert [warning for warning in said if "no component world is declared as inner" in warning]
    said = translated(tmp_path, SWING).scalar.warnings
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
        translated(tmp_path, DROP.replace(right, wrong), LIBRARY)
    assert said in caught.value.message
    assert ".mo:" not in caught.value.message
    assert caught.value.place is not None
    assert (caught.value.place.file, caught.value.place.line) == (tmp_path / "Drop.mo", line)


JOINT = "Modelica.Mechanics.MultiBody.Joints.Revolute hinge;"
TORQUE = "Modelica.Mechanics.Rotational.Sources.Torque torque;"


LACKS_OR_TOO_MUCH = {
    "bar": (
        "Modelica.Mechanics.MultiBody.Parts.FixedTranslation bar(r={1,0,0});",
        "",
        "Swing.mo:4: Swing: bar is connected",
    ),
    "hinge": (JOINT, "", "Swing.mo:4: Swing: hinge is connected to nothing"),
    "hinge at one end": (JOINT, "connect(hinge.frame_b, ball.frame_a);", "no equation determines: hinge.angle"),
    "torque": (TORQUE, "", "no equation determines: torque.flange.phi"),
    "gain": ("Modelica.Blocks.Math.Gain g(k=2);", "", "no equation determines: g.u"),
    "Real": ("Real x;", "", "no equation determines: x"),
    "element": ("Real x[3];", "x[1] = 1; x[2] = 2;", "no equation determines: x[3]"),
    "twice": ("Real x;", "x = 1; x = time;", "Swing.mo:6: the model is structurally singular"),
    "parameter": ("", "ball.m = 2;", "equations that determine nothing: 0 = (ball.m - 2.0)"),
}
QUICK = {"hinge"}


@pytest.mark.parametrize(
    ("declared", "equations", "said"),
    [
        pytest.param(*case, id=name, marks=() if name in QUICK else pytest.mark.full)
        for name, case in LACKS_OR_TOO_MUCH.items()
    ],
)
def test_what_lacks_or_is_too_much_is_named(tmp_path, declared, equations, said):
    """Not only the numbers of equations and unknowns."""
    text = SWING.replace("equation\n", f"  {declared}\nequation\n").replace("end Swing;", f"  {equations}\nend Swing;")
    with pytest.raises(InputError) as caught:
        translated(tmp_path, text)
    assert said in str(caught.value)


NO_INNER = ("", "", "Swing.mo:2: Swing: world is declared without inner")


@pytest.mark.parametrize("case", ["hinge", "inner", pytest.param("Real", marks=pytest.mark.full)])
def test_it_is_named_in_a_package_of_several_files_too(tmp_path, case):
    declared, equations, said = LACKS_OR_TOO_MUCH.get(case, NO_INNER)
    swing = SWING.replace("  inner ", "  ") if case == "inner" else SWING
    text = swing.replace("equation\n", f"  {declared}\nequation\n").replace("end Swing;", f"  {equations}\nend Swing;")
    package = tmp_path / "P"
    package.mkdir()
    (package / "package.mo").write_text("package P\nend P;\n")
    (package / "package.order").write_text("Swing\n")
    (package / "Swing.mo").write_text(f"within P;{text}")
    with pytest.raises(InputError) as caught:
        translate("P.Swing", [package], StandardLibrary(core_subset(), "", "core subset"))
    assert said.replace(" Swing:", " P.Swing:") in str(caught.value)
    assert "unbalanced model" not in str(caught.value)


def test_managers_are_named_that_nothing_is_connected_to():
    """Also where the front end does not flatten the model, as with concatenated colliders."""
    text = (
        "model M ContactMultiBody.ContactManager contacts(n=k + 1, collider=cat(1, ball.collider, {floor.collider}));\n"
    )
    assert frames_without_connect(text) == ["contacts.frame"]
    assert frames_without_connect(f"{text}equation connect(ball.frame_a, contacts.frame[1:k]);") == []


def test_a_world_without_inner_is_told(tmp_path):
    with pytest.raises(InputError) as caught:
        translated(tmp_path, SWING.replace("  inner ", "  "))
    assert "Swing.mo:2: Swing: world is declared without inner" in str(caught.value)


@pytest.mark.parametrize(
    ("declared", "ends", "said"),
    [
        (
            "Modelica.Mechanics.Rotational.Components.Inertia j(J=1);",
            "j.flange_a, ball.frame_a",
            "j.flange_a has phi, tau",
        ),
        ("Modelica.Mechanics.Translational.Components.Mass s(m=1);", "ball.frame_a, s.flange_b", "s.flange_b has f, s"),
        ("Modelica.Blocks.Sources.Constant c(k=1);", "c.y, ball.frame_a", "c.y has a Real"),
        (
            "Modelica.Blocks.Sources.Constant c(k=1); connector Flag = input Boolean; Flag n;",
            "c . y, n",
            "n has a Boolean",
        ),
    ],
)
def test_connectors_of_different_kinds_are_refused(tmp_path, declared, ends, said):
    """The front end drops such a connection without a word."""
    text = SWING.replace("equation\n", f"  {declared}\nequation\n  // connect(no, matter)\n  connect({ends});\n")
    with pytest.raises(InputError) as caught:
        translated(tmp_path, text)
    assert said in caught.value.message
    assert caught.value.place is not None
    assert caught.value.place.line == 7


def test_buses_are_left_to_the_front_end(tmp_path):
    buses = "expandable connector A Real a; end A; expandable connector B Real b; end B; A a; B b;"
    text = SWING.replace("equation\n", f"  {buses}\nequation\n  connect(a, b);\n")
    with pytest.raises(InputError, match="expandable connector"):
        translated(tmp_path, text)


BALLS = """model Balls
  inner Modelica.Mechanics.MultiBody.World world;
  ContactMultiBody.Parts.FreeBody ball[3](
    each m=1, each r_CM={0,0,0}, each geometry=ContactMultiBody.Shapes.sphere(0.1));
  ContactMultiBody.Parts.Ground floor;
  ContactMultiBody.ContactManager contacts(
    n=4,
    geometry=cat(1, {ball[i].geometry for i in 1:3}, {floor.geometry}),
    material=cat(1, {ball[i].material for i in 1:3}, {floor.material}));
equation
  connect(ball.frame_a, contacts.frame[1:3]);
  connect(floor.frame_a, contacts.frame[4]);
end Balls;
"""
BALLS_TO_FRAMES = "connect(ball.frame_a, contacts.frame[1:3]);"


@pytest.mark.full
@pytest.mark.parametrize(
    "written",
    [
        BALLS_TO_FRAMES,
        "connect(contacts.frame[1:3], ball.frame_a);",
        "connect(ball[1:3].frame_a, contacts.frame[1:3]);",
        "connect(ball[1:2].frame_a, contacts.frame[1:2]); connect(ball[3].frame_a, contacts.frame[3]);",
        "for i in 1:3 loop connect(ball[i].frame_a, contacts.frame[i]); end for;",
    ],
)
def test_arrays_of_bodies_are_connected_to_slices(tmp_path, written):
    scalar = translated(tmp_path, BALLS.replace(BALLS_TO_FRAMES, written), LIBRARY).scalar
    expected = {f"ball[{number}].frame_a.r_0[1]" for number in (1, 2, 3)}
    assert expected <= scalar.variables.keys()


@pytest.mark.parametrize(
    ("written", "said"),
    [
        pytest.param(
            "connect(ball.frame_a, contacts.frame);",
            "ball.frame_a has 3 elements, but contacts.frame has 4 elements",
            marks=pytest.mark.full,
        ),
        (
            "connect(ball[1:2].frame_a, contacts.frame[1:3]);",
            "array dimension mismatch for `connect`: expected [2], found [3]",
        ),
        pytest.param(
            "connect(ball.frame_a, contacts.frame[1:2]);",
            "array dimension mismatch for `connect`: expected [3], found [2]",
            marks=pytest.mark.full,
        ),
    ],
)
def test_arrays_of_different_sizes_are_refused(tmp_path, written, said):
    with pytest.raises(InputError) as caught:
        translated(tmp_path, BALLS.replace(BALLS_TO_FRAMES, written), LIBRARY)
    assert caught.value.place is not None
    assert caught.value.place.line == 11
    assert said in caught.value.message


VECTORS = """model Vectors
  Modelica.Blocks.Sources.RealExpression source[3](y = {2*time, 3*time, 4*time});
  Modelica.Blocks.Math.Gain gain[2](each k = 1);
  Modelica.Blocks.Interfaces.RealOutput vector[2];
  inner Modelica.Mechanics.MultiBody.World world(
    gravityType = Modelica.Mechanics.MultiBody.Types.GravityTypes.NoGravity);
  Modelica.Mechanics.MultiBody.Forces.WorldForce force(
    resolveInFrame = Modelica.Mechanics.MultiBody.Types.ResolveInFrameB.world);
  Modelica.Mechanics.MultiBody.Parts.Body body(
    m = 2, r_CM = {0, 0, 0}, r_0(each fixed = true), v_0(each fixed = true), angles_fixed = true, w_0_fixed = true);
  Real second = gain[2].y, far = body.r_0[3];
equation
  connect(source[2:3].y, vector);
  connect(vector, gain.u);
  connect(source.y, force.force);
  connect(force.frame_b, body.frame_a);
end Vectors;
"""


def test_scalars_of_arrays_of_blocks_are_connected_with_vectors(simulate: Callable[..., Any]) -> None:
    result = simulate(VECTORS, ["second", "far"])
    time = result["time"]
    np.testing.assert_allclose(result["second"], 4 * time, atol=1e-9)
    np.testing.assert_allclose(result["far"], 4 / 2 * time**3 / 6, atol=1e-7)


@pytest.mark.full
@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("source[2:3].y", "source[1:1].y"),  # too few equations
        ("source.y", "source[2:3].y"),
        ("source.y", "source[1].y"),
    ],
)
def test_vectors_of_other_sizes_are_refused(tmp_path: Path, old: str, new: str) -> None:
    before, found, _ = VECTORS.partition(f"connect({old}")
    assert found
    with pytest.raises(InputError) as caught:
        translated(tmp_path, VECTORS.replace(old, new))
    assert new in caught.value.message
    assert caught.value.place is not None
    assert caught.value.place.line == before.count("\n") + 1
