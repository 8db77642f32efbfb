"""What a user's model modifies, names or leaves partial without its being there is told at the user's own line."""

from __future__ import annotations

from pathlib import Path

import pytest
from contact_data import core_subset
from contact_foundation.errors import InputError
from modelica2fmu.build import translate
from modelica2fmu.library.standard_library import StandardLibrary

LIBRARY = StandardLibrary(core_subset(), "", "core subset")
MODEL = """model Swing
  inner Modelica.Mechanics.MultiBody.World world;
  Modelica.Mechanics.MultiBody.Joints.Revolute joint(phi(start = 0.5, fixed = true));
  Modelica.Mechanics.MultiBody.Parts.Body body(m = 1, r_CM = {0, -1, 0});
  parameter Real slack[2](each min = 0) = {1, 2};
  Integer count(start = 3) = integer(slack[1]);
equation
  connect(world.frame_b, joint.frame_a);
  connect(joint.frame_b, body.frame_a);
end Swing;
"""


def refused(folder: Path, old: str, new: str, model: str = "Swing") -> InputError:
    text = MODEL.replace(old, new)
    assert text != MODEL
    (folder / "Swing.mo").write_text(text)
    with pytest.raises(InputError) as caught:
        translate(model, [folder / "Swing.mo"], LIBRARY)
    return caught.value


@pytest.mark.parametrize(
    ("old", "new", "line", "said", "near"),
    [
        ("r_CM =", "r_CMM =", 4, "Modelica.Mechanics.MultiBody.Parts.Body has no r_CMM", "r_CM"),
        ("phi(start", "phy(start", 3, "Modelica.Mechanics.MultiBody.Joints.Revolute has no phy", "phi"),
        ("fixed = true", "fixd = true", 3, "(Real) has no attribute fixd", "fixed"),
        ("each min", "each minimum", 5, "Real has no attribute minimum", "min"),
        ("count(start", "count(nominal", 6, "Integer has no attribute nominal", "min"),
        (
            "Parts.Body",
            "Parts.Bdy",
            4,
            "there is no class Modelica.Mechanics.MultiBody.Parts.Bdy",
            "Modelica.Mechanics.MultiBody.Parts.Body",
        ),
        ("body.frame_a", "body.frame_c", 9, "unresolved component reference: 'body.frame_c'", "body.frame_a"),
        ("integer(slack", "integer(slak", 6, "'slak'", "slack"),
    ],
)
def test_misspelt_names(tmp_path: Path, old: str, new: str, line: int, said: str, near: str) -> None:
    error = refused(tmp_path, old, new)
    assert error.place is not None
    assert (error.place.file, error.place.line) == (tmp_path / "Swing.mo", line)
    assert said in error.message
    assert "did you mean" in (error.remedy or "")
    assert near in (error.remedy or "")
    assert len(str(error).splitlines()) == 2


def test_modifiers_of_modifiers_and_of_extended_classes(tmp_path: Path) -> None:
    end = "model Wide extends Swing(joint(phi(star = 1))); end Wide;"
    error = refused(tmp_path, "end Swing;\n", f"end Swing;\n{end}\n", "Wide")
    assert error.place is not None
    assert error.place.line == 11
    assert "has no attribute star" in error.message
    assert error.remedy == "did you mean start?"


def test_partial_model_is_refused(tmp_path: Path) -> None:
    error = refused(tmp_path, "model Swing", "partial model Swing")
    assert "the model Swing is partial" in error.message
    assert error.place is not None
    assert error.place.line == 1


def test_right_modifiers_are_taken(tmp_path: Path) -> None:
    (tmp_path / "Swing.mo").write_text(MODEL)
    assert "joint.phi" in translate("Swing", [tmp_path / "Swing.mo"], LIBRARY).scalar.variables


def test_a_base_that_is_not_there_is_told_not_what_stands_beside_it(tmp_path: Path) -> None:
    extends = "  extends Modelica.Mechanics.MultiBody.Examples.Loops.Engine1a;\n"
    error = refused(tmp_path, "model Swing\n", f"model Swing\n{extends}")
    assert error.place is not None
    assert error.place.line == 2
    assert error.message == "there is no class Modelica.Mechanics.MultiBody.Examples.Loops.Engine1a"
    assert "cmb msl install" in (error.remedy or "")


RECORDS = """model Slide
  record Material
    extends Basic;
    parameter Real mu = 0.1;
  end Material;
  record Basic
    parameter Real hardness = 1;
  end Basic;
  model Body
    parameter Material material;
    Real friction = material.mu*time;
  end Body;
  parameter Material chosen = Material(mu = 0.4, hardness = 2);
  Body first(material = chosen);
  Body second(material = Material(hardness = 3, mu = 0.2));
  parameter Material third = Material(
    1,
    mu = 3);
  Real height(start = 0, fixed = true);
equation
  der(height) = 1;
end Slide;
"""


@pytest.mark.parametrize(
    ("old", "new", "line", "wrong"),
    [
        ("mu = 0.4", "muu = 0.4", 13, "muu"),
        ("hardness = 2)", "hardnes = 2)", 13, "hardnes"),
        ("mu = 0.2", "friction = 0.2", 15, "friction"),
        ("    mu = 3", "    m = 3", 18, "m"),
    ],
)
def test_records_have_the_fields_that_their_constructors_name(
    tmp_path: Path, old: str, new: str, line: int, wrong: str
) -> None:
    (tmp_path / "Slide.mo").write_text(RECORDS)
    translate("Slide", [tmp_path / "Slide.mo"], LIBRARY)
    assert old in RECORDS
    (tmp_path / "Slide.mo").write_text(RECORDS.replace(old, new))
    with pytest.raises(InputError) as caught:
        translate("Slide", [tmp_path / "Slide.mo"], LIBRARY)
    error = caught.value
    assert error.message == f"Material has no {wrong}"
    assert error.place is not None
    assert (error.place.file, error.place.line) == (tmp_path / "Slide.mo", line)


@pytest.mark.parametrize(
    ("old", "new", "line", "what"),
    [
        ("{0, -1, 0}", "{0, -1, time}", 4, "the parameter body.r_CM"),
        ("m = 1", "m = if time > 1 then 1 else 2", 4, "the parameter body.m"),
        ("start = 0.5", "start = 0.5 + time", 3, "the start value of joint.phi"),
        ("{1, 2};", "{1, time};", 5, "the parameter slack"),
    ],
)
def test_what_stays_does_not_depend_on_time(tmp_path: Path, old: str, new: str, line: int, what: str) -> None:
    error = refused(tmp_path, old, new)
    assert error.message == f"{what} depends on time, which it cannot"
    assert error.place is not None
    assert (error.place.file, error.place.line) == (tmp_path / "Swing.mo", line)


@pytest.mark.parametrize(
    ("old", "new", "line", "said", "remedy"),
    [
        (
            "r_CM = {0, -1, 0}",
            "r_CM = 0",
            4,
            "r_CM of Modelica.Mechanics.MultiBody.Parts.Body is an array [3]",
            "fill(0, 3)",
        ),
        ("r_CM = {0, -1, 0}", "each r_CM = -1e-3", 4, "-1e-3 is one value", "fill(-1e-3, 3)"),
        ("{1, 2};", "{1, 2}; Part part(typed = 2);", 5, "typed of Part is an array [3]", "fill(2, 3)"),
        ("{1, 2};", "{1, 2}; Part part(typed = 2*count - 1);", 5, "2*count - 1 is one value", "fill(2*count - 1, 3)"),
        ("{1, 2};", "{1, 2}; Part part(weights = 2.);", 5, "is an array [n]", "fill(2., part.n)"),
        ("{1, 2};", "{1, 2}; Part parts[2](each weights = 2);", 5, "is an array [n]", "fill(2, parts[1].n)"),
        ("{1, 2};", "{1, 2}; Part part(squares = 2);", 5, "is an array [n, 2*n]", "write an array"),
    ],
)
def test_one_value_for_an_array(tmp_path: Path, old: str, new: str, line: int, said: str, remedy: str) -> None:
    part = "\n".join(
        (
            "  model Part",
            "    parameter Integer n = 2;",
            "    parameter Real weights[n] = {1, 2};",
            "    parameter Real squares[n, 2*n] = fill(1, n, 2*n);",
            "    parameter Real[3] typed = {1, 2, 3};",
            "  end Part;",
            "equation\n",
        )
    )
    text = MODEL.replace(old, new).replace("equation\n", part)
    (tmp_path / "Swing.mo").write_text(text)
    with pytest.raises(InputError) as caught:
        translate("Swing", [tmp_path / "Swing.mo"], LIBRARY)
    assert caught.value.place is not None
    assert caught.value.place.line == line
    assert said in caught.value.message
    assert remedy in (caught.value.remedy or "")


@pytest.mark.parametrize(
    "given",
    [
        *("slack", "{0, -1, 0}", "zeros(3)", "2*slack - slack"),
        *(pytest.param(given, marks=pytest.mark.full) for given in ("fill(0, 3)", "-{0, 1, 0}", "slack*1")),
    ],
)
def test_arrays_for_arrays_are_taken(tmp_path: Path, given: str) -> None:
    text = MODEL.replace("slack[2](each min = 0) = {1, 2}", "slack[3] = {1, 0, 2}").replace("{0, -1, 0}", given)
    (tmp_path / "Swing.mo").write_text(text)
    assert translate("Swing", [tmp_path / "Swing.mo"], LIBRARY).scalar.variables
