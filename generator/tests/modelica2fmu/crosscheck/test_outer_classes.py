"""Outer classes and variables stand for the inner ones (Modelica 3.6, section 5.4), or the model is refused."""

from __future__ import annotations

import pytest
from contact_data import core_subset
from contact_foundation.errors import UnsupportedModelError
from fmpy import read_model_description, simulate_fmu
from modelica2fmu.build import BuildOptions, build_fmu, translate
from modelica2fmu.library.standard_library import StandardLibrary

LIBRARY = StandardLibrary(core_subset(), "", "core subset")
MODELS = """package Outer
  function once
    input Real x;
    output Real y;
  algorithm
    y := x;
  end once;
  function twice
    input Real x;
    output Real y;
  algorithm
    y := 2*x;
  end twice;
  record Data
    parameter Real a = 1;
  end Data;
  record Sevens
    parameter Real a = 7;
  end Sevens;
  model Slow
    Real y = time;
  end Slow;
  model Fast
    Real y = 7*time;
  end Fast;
  model Part
    %s
  end Part;
  model Base
    Part part;
  end Base;
  model M
    %s
    extends Base;
  end M;
end Outer;
"""


@pytest.mark.parametrize(
    ("outer", "inner", "named"),
    [
        ("outer function f = once; Real y = f(time);", "inner function f = twice;", "function f"),
        ("outer record R = Data; R r; Real y = r.a;", "inner record R = Sevens;", "record R"),
        ("outer model B = Slow; B b;", "inner model B = Fast;", "model B"),
        ("inner outer model B = Slow; B b;", "inner model B = Fast;", "model B"),
    ],
)
def test_outer_classes_are_refused(outer, inner, named, tmp_path):
    file = tmp_path / "Outer.mo"
    file.write_text(MODELS % (outer, inner), encoding="utf-8")
    with pytest.raises(UnsupportedModelError) as caught:
        translate("Outer.M", [file], LIBRARY)
    assert named in caught.value.message
    assert "Part" in caught.value.message
    assert "redeclare" in (caught.value.remedy or "")
    assert caught.value.place is not None
    assert caught.value.place.line == 27


def test_functions_of_outer_components_are_those_of_the_inner_one(tmp_path, fmu_cache):
    file = tmp_path / "Outer.mo"
    outer, inner = "outer Tools tools; Real y = tools.f(time);", "inner Tools tools(redeclare function f = twice);"
    tools = "model Tools replaceable function f = once; Real x = 1; end Tools;"
    file.write_text((MODELS % (outer, inner)).replace("  model Part", f"  {tools}\n  model Part"), encoding="utf-8")
    build_fmu("Outer.M", [file], tmp_path / "m.fmu", BuildOptions(cache=fmu_cache))
    result = simulate_fmu(str(tmp_path / "m.fmu"), output=["part.y"], stop_time=1)
    assert result["part.y"][-1] == pytest.approx(2)


@pytest.mark.parametrize(
    ("outer", "inner", "said", "remedy"),
    [
        ("outer Real g; Real y = g;", "inner Real g = 7*time;", "variable g", "inner Shared shared(g = ...)"),
        ("outer Real g[2]; Real y = g[1];", "inner Real g[2] = {7, 1}*time;", "variable g", "outer Shared shared"),
        ("inner outer Data d(a = 7); Slow s; Real y = d.a;", "inner Data d(a = 2);", "inner and outer", "outer Data d"),
        (
            "inner outer parameter Real g = 7; Real y = g;",
            "inner parameter Real g = 2;",
            "inner and outer",
            "outer Real g",
        ),
    ],
)
def test_outer_variables_that_are_not_carried_through_are_refused(outer, inner, said, remedy, tmp_path):
    file = tmp_path / "Outer.mo"
    file.write_text(MODELS % (outer, inner), encoding="utf-8")
    with pytest.raises(UnsupportedModelError) as caught:
        translate("Outer.M", [file], LIBRARY)
    assert said in caught.value.message
    assert "Part" in caught.value.message
    assert remedy in (caught.value.remedy or "")
    assert caught.value.place is not None
    assert caught.value.place.line == 27


def test_what_the_message_says_about_outer_variables_works(tmp_path, fmu_cache):
    file = tmp_path / "Outer.mo"
    outer, inner = "outer Shared shared; Real y = shared.g;", "inner Shared shared(g = 7*time);"
    shared = "record Shared Real g; end Shared;"
    file.write_text((MODELS % (outer, inner)).replace("  model Part", f"  {shared}\n  model Part"), encoding="utf-8")
    build_fmu("Outer.M", [file], tmp_path / "m.fmu", BuildOptions(cache=fmu_cache))
    result = simulate_fmu(str(tmp_path / "m.fmu"), output=["part.y"], stop_time=1)
    assert result["part.y"][-1] == pytest.approx(7)


@pytest.mark.parametrize(
    ("outer", "inner"),
    [
        ("outer parameter Real g; Real y = g*time;", "inner parameter Real g = 7;"),
        ("outer parameter Real g[2]; Real y = g*{time, 1};", "inner parameter Real g[2] = {7, 0};"),
        ("outer parameter Integer n; Real x[n] = fill(time, n); Real y = sum(x);", "inner parameter Integer n = 7;"),
    ],
)
def test_outer_parameters_are_the_inner_ones_alone(outer, inner, tmp_path, fmu_cache):
    file = tmp_path / "Outer.mo"
    file.write_text(MODELS % (outer, inner), encoding="utf-8")
    build_fmu("Outer.M", [file], tmp_path / "m.fmu", BuildOptions(cache=fmu_cache))
    names = [each.name for each in read_model_description(str(tmp_path / "m.fmu")).modelVariables]
    assert not [name for name in names if name.startswith(("part.g", "part.n"))]
    result = simulate_fmu(str(tmp_path / "m.fmu"), output=["part.y"], stop_time=1)
    assert result["part.y"][-1] == pytest.approx(7)
