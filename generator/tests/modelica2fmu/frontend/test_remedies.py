"""Legal constructs that the front end does not take are refused with what to write instead, and that is taken."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from contact_data import core_subset
from contact_foundation.errors import InputError, Place
from modelica2fmu.library.standard_library import StandardLibrary, find_standard_library
from modelica2fmu.translation import translate

LIBRARY = StandardLibrary(core_subset(), "", "core subset")
POWERS = """
  function powers
    input Real x;
    output Real a;
    output Real b;
  algorithm
    a := x^2;
    b := x^3;
  end powers;
"""
PARTS = """
  model Part
    parameter Real m = 7;
    parameter Real r[3] = {1, 1, 1};
    input Real u = 0;
    Real y = m*time;
  end Part;
"""
BUS = """
  expandable connector Bus%s
  end Bus;
  Bus bus;
  Modelica.Blocks.Sources.RealExpression e(y = time);
  Modelica.Blocks.Math.Gain g(k = 1);
"""


def refusal(text: str, folder: Path) -> InputError:
    (folder / "M.mo").write_text(text)
    with pytest.raises(InputError) as caught:
        translate("M", [folder / "M.mo"], LIBRARY)
    return caught.value


@pytest.mark.parametrize(
    ("text", "line", "said", "remedy"),
    [
        ("\n  Real x = time, y = der(x^2);", 2, "der of an expression", "Real e = ...; and write der(e)"),
        ("\n  Real v[3], w[2] = {x for x in v[1:2]};", 2, "a loop over values", "constant E all[2]"),
        ("\n  Real v[2];\nequation\n  for i in fill(1, 2) loop\n    v[i] = 1;\n  end for;", 4, "a loop", "for i in"),
        (
            "\n  parameter Integer k = integer(3.5);\n  Real s;\nalgorithm\n  s := 0;\n  for i in 1:k loop\n"
            "    s := s + i;\n  end for;",
            6,
            "loop",
            "function",
        ),
        (
            "\n  Real v[2](each start = 1);\nequation\n  when time > 1 then\n    v[1] = 2;\n  end when;",
            2,
            "v[1]",
            "Part",
        ),
        (
            "\n  Real v[2](each start = 1);\nequation\n  der(v) = -v;\n  when time > 1 then\n"
            "    reinit(v[1], 2);\n  end when;",
            5,
            "reinit takes no element",
            "Part",
        ),
        ("\n  parameter Real m[1, 2] = [1, 2], y = sum(m);", 2, "y has the sum", "sum(sum(m[i, :])"),
        ("\n  parameter Real m[1, 1] = [2], y[1, 1] = m^2;", 2, "y has the power", "m*m"),
        ("\n  Real v[2, 1] = matrix({time, 1});", 2, "the operator matrix", "a function"),
        (
            "\n  Integer a(start = 0, fixed = true);\nequation\n  when sample(0.5, 1) then\n    a = pre(a) + 1;\n"
            "  elsewhen sample(1, 1) then\n    a = pre(a) + 2;\n  end when;",
            4,
            "several sample(...)",
            "count: k = pre(k) + 1",
        ),
        (
            "\n  Integer y(start = 1, fixed = true);\nalgorithm\n  when time > 0.5 then\n    y := 2;\n  end when;\n"
            "  when time > 1 then\n    y := pre(y) + 3;\n  end when;",
            2,
            "y is set in several when-statements",
            "elsewhen",
        ),
        ("\n  Real y = delay(sin(time), 1);", 2, "no Integer as its time argument", "1.0 in place of 1"),
        ("\n  parameter Boolean b = 1;", 2, "a Boolean is given a number", "true or false"),
        ("\n  Integer i = time;", 2, "i is an Integer", "integer(...)"),
        ("\n  Integer i;\nequation\n  i = if time > 1 then 1.5 else 2;", 4, "i is an Integer", "integer(...)"),
        ("\n  Boolean b = time;", 2, "b is a Boolean", "a relation"),
        ("\n  String s = time;", 2, "s is a String", "String(...)"),
    ],
)
def test_what_to_write_is_told(tmp_path: Path, text: str, line: int, said: str, remedy: str) -> None:
    error = refusal(f"model M{text}\nend M;\n", tmp_path)
    assert said in error.message
    assert remedy in (error.remedy or "")
    assert error.place is not None
    assert (error.place.file, error.place.line) == (tmp_path / "M.mo", line)


@pytest.mark.parametrize(
    ("text", "said", "remedy"),
    [
        ("Real y, z;\nalgorithm\n  (y, z) := powers(time);", "algorithm section", "as an equation"),
        (
            "discrete Real y, z;\nequation\n  when time > 0.5 then\n    (y, z) = powers(time);\n  end when;",
            "when-equation",
            "algorithm section",
        ),
        ("Real v[2];\nequation\n  (v[1], v[2]) = powers(time);", "elements", "(a, b) = f(x)"),
    ],
)
def test_calls_with_several_outputs(tmp_path: Path, text: str, said: str, remedy: str) -> None:
    error = refusal(f"model M{POWERS}  {text}\nend M;\n", tmp_path)
    assert said in error.message
    assert remedy in (error.remedy or "")
    assert error.place is not None
    assert error.place.line is not None
    assert error.place.line > POWERS.count("\n")


@pytest.mark.parametrize(
    "given",
    ["m = 2*ones(3)", "m = 2*{1, 2, 3}", "m = 1:3", "m = 2*v", "m = -v", "m = v + v", "r = identity(3)", "u = 2*v"],
)
@pytest.mark.parametrize("array", ["b[3]({})", pytest.param("b[3](each y(min = 0), {})", marks=pytest.mark.full)])
def test_arrays_that_modify_arrays_of_components(tmp_path: Path, given: str, array: str) -> None:
    text = f"model M{PARTS}  parameter Real v[3] = {{1, 2, 3}};\n  Part {array.format(given)};\nend M;\n"
    error = refusal(text, tmp_path)
    assert given in error.message
    assert "the array b" in error.message
    assert f"write b({given[0]} = values)" in (error.remedy or "")
    assert error.place is not None
    assert error.place.line == PARTS.count("\n") + 2


def test_buses_that_do_not_declare_a_variable(tmp_path: Path) -> None:
    text = f"model M{BUS % ''}equation\n  connect(e.y, bus.speed);\n  connect(bus.speed, g.u);\nend M;\n"
    error = refusal(text, tmp_path)
    assert "e.y and bus.speed" in error.message
    assert "expandable connector Bus Real speed" in (error.remedy or "")
    assert error.place is not None
    assert error.place.line in (8, 9)


BLOCK = """
  block Twice
    Modelica.Blocks.Interfaces.RealInput u;
    Modelica.Blocks.Interfaces.RealOutput y = k*u;
    parameter Real k = 2;
  end Twice;
"""


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("parameter Real k[:] = {1, 2, 3};\n  Part g[size(k, 1)](m = k);", 2),
        ("parameter Real k[3] = {1, 2, 3};\n  Part g[size(k, 1)](m = {4, 5, 6});", 2),
        ("parameter Real k[:] = {1, 2, 3};\n  Part g[size(k, 1)](each m = 7);", 2),
        ("parameter Real k[:] = {1, 2};\n  parameter Integer n = size(k, 1);\n  Part g[n](m = k);", 3),
        ("parameter Real k[:] = {1, 2};\n  Twice g[size(k, 1)](k = k, each u = 1);", 2),
    ],
)
def test_arrays_of_components_whose_size_is_asked(tmp_path: Path, text: str, line: int) -> None:
    """Their variables became arrays of one component, in which a product is that of vectors."""
    before = f"model M{PARTS}{BLOCK}"
    error = refusal(f"{before}  {text}\nend M;\n", tmp_path)
    assert "how many elements" in error.message
    assert "g[n](k = k)" in (error.remedy or "")
    assert error.place is not None
    assert error.place.line == before.count("\n") + line


NUMBER = """operator record Number
  Real re;
  Real im;
  encapsulated operator '*'
    import Number;
    function multiply
      input Number a;
      input Number b;
      output Number c;
    algorithm
      c := Number(a.re*b.re - a.im*b.im, a.re*b.im + a.im*b.re);
    end multiply;
  end '*';
end Number;
"""


@pytest.mark.parametrize(
    "text",
    [
        "Number w = z*z;",
        "Number w;\nequation\n  w = Number(0, 1)*z;",
        "Number w;\nequation\n  w = Number(z.re, 0) .* z;",
        "Number w = Number(1, 2)*Number(0, time);",
        "Number w = -z;",
    ],
)
def test_operators_between_records(tmp_path: Path, text: str) -> None:
    (tmp_path / "Number.mo").write_text(NUMBER)
    (tmp_path / "M.mo").write_text(f"model M\n  Number z = Number(1, 2*time);\n  {text}\nend M;\n")
    with pytest.raises(InputError) as caught:
        translate("M", [tmp_path / "M.mo", tmp_path / "Number.mo"], LIBRARY)
    assert "operators between records of Number" in caught.value.message
    assert "Number.'*'.multiply(a, b)" in (caught.value.remedy or "")
    assert caught.value.place is not None
    assert caught.value.place.line == 3 + text.count("\n")


def test_functions_and_fields_of_operator_records(tmp_path: Path) -> None:
    (tmp_path / "Number.mo").write_text(NUMBER)
    text = "Number w = Number.'*'.multiply(z, z);\n  Real a = -z.re*w.im + 2*z.im;"
    (tmp_path / "M.mo").write_text(f"model M\n  Number z = Number(1, 2*time);\n  {text}\nend M;\n")
    assert "a" in translate("M", [tmp_path / "M.mo", tmp_path / "Number.mo"], LIBRARY).scalar.variables


def test_arrays_of_components_of_libraries_whose_size_is_asked(tmp_path: Path) -> None:
    """Of the Standard Library's visualizers, on which nothing depends, the lines at the axes' ends are some."""
    library = tmp_path / "Drawings"
    library.mkdir()
    (library / "package.mo").write_text(
        "package Drawings\n  model Line\n    parameter Real m = 1;\n  end Line;\n"
        "  model Letter\n    parameter Real k[:] = {1, 2};\n    Line g[size(k, 1)](m = k);\n  end Letter;\n"
        "end Drawings;\n"
    )
    model = tmp_path / "own" / "M.mo"
    model.parent.mkdir()
    model.write_text(
        "model M\n  Drawings.Letter letter;\n  Real x(start = 1, fixed = true);\nequation\n  der(x) = -x;\nend M;\n"
    )
    assert translate("M", [model, library], LIBRARY) is not None


def test_a_range_to_the_end_in_connect(tmp_path: Path) -> None:
    text = (
        "  Modelica.Blocks.Sources.Constant c[3](k = {1, 2, 3});\n  Modelica.Blocks.Interfaces.RealOutput y[2];\n"
        "equation\n  connect(c[2:end].y, y);\n"
    )
    error = refusal(f"model M\n{text}end M;\n", tmp_path)
    assert "2:end counts from the end" in error.message
    assert "in place of end" in (error.remedy or "")
    assert error.place is not None
    assert error.place.line == 5


def test_members_of_buses_that_nothing_uses_are_not_there(simulate: Callable[..., Any]) -> None:
    """Modelica 3.6, section 9.1.3: they are but potentially present."""
    text = """model Unused
  expandable connector Bus
    Real speed;
    Real angle;
    Real all[2];
  end Bus;
  block Source
    Bus bus;
    Modelica.Blocks.Sources.RealExpression e(y = 3*time);
  equation
    connect(e.y, bus.speed);
  end Source;
  block Sink
    Bus bus;
    Modelica.Blocks.Math.Gain g(k = 2);
  equation
    connect(bus.speed, g.u);
  end Sink;
  Source a;
  Sink b;
  Real y = b.g.y;
equation
  connect(a.bus, b.bus);
end Unused;
"""
    result = simulate(text, ["y"])
    np.testing.assert_allclose(result["y"], 6 * result["time"], atol=1e-9)


def test_what_the_messages_say_is_taken(simulate) -> None:
    text = f"""model Remedies{POWERS}{PARTS}{BUS % " Real speed;"}
  type E = enumeration(a, b, c);
  constant E all[3] = {{E.a, E.b, E.c}};
  function total
    input Real x;
    output Real s = 0;
  algorithm
    for i in 1:3 loop
      s := s + i*x;
    end for;
  end total;
  Real square = time^2, rate = der(square);
  Real v[E], looped = v[E.c];
  Real summed = total(time);
  parameter Real values[:] = 2*{{1, 2, 3}};
  Part b[3](m = values);
  Real modified = b[3].y;
  Real late = delay(sin(time), 0.5);
  Integer k(start = 0, fixed = true), a(start = 0, fixed = true);
  Real y, z, counted = a, bussed = g.y;
equation
  (y, z) = powers(time);
  for i in 1:3 loop
    v[all[i]] = Integer(all[i])*time;
  end for;
  when sample(0.26, 0.25) then
    k = pre(k) + 1;
    a = if mod(k, 2) == 1 then pre(a) + 1 else pre(a) + 2;
  end when;
  connect(e.y, bus.speed);
  connect(bus.speed, g.u);
end Remedies;
"""
    expected = {
        "rate": lambda t: 2 * t,
        "looped": lambda t: 3 * t,
        "summed": lambda t: 6 * t,
        "modified": lambda t: 6 * t,
        "z": lambda t: t**3,
        "late": lambda t: np.where(t < 0.5, 0, np.sin(t - 0.5)),
        "counted": lambda t: np.select([t < 0.26, t < 0.51, t < 0.76], [0, 1, 3], 4),
        "bussed": lambda t: t,
    }
    result = simulate(text, list(expected))
    time = result["time"]
    beside = np.abs((time - 0.01) % 0.25) > 1e-3
    for name, form in expected.items():
        np.testing.assert_allclose(result[name][beside], form(time[beside]), atol=1e-6, err_msg=name)


def test_a_table_of_an_unknown_file_is_told_in_the_file_of_its_model(tmp_path: Path) -> None:
    """Of the Standard Library as a whole, whose tables ask for the ending of the file's name."""
    library = find_standard_library()
    if library.folder == core_subset():
        pytest.skip("no Modelica Standard Library is installed")
    package = tmp_path / "P"
    package.mkdir()
    (package / "package.mo").write_text("package P end P;")
    (package / "T.mo").write_text(
        'within P;\nmodel T\n  parameter String file = "a.txt";\n  Modelica.Blocks.Sources.CombiTimeTable t(\n'
        '    tableOnFile=true, tableName="a",\n    fileName=Modelica.Utilities.Files.loadResource(file));\nend T;\n'
    )
    with pytest.raises(InputError, match="file of a table") as refused:
        translate("P.T", [package], library)
    assert refused.value.place == Place(file=package / "T.mo", line=5, component="P.T")
    assert "fileName=" in str(refused.value.remedy)
