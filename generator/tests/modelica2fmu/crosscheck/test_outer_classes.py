"""An outer class stands for the inner one (Modelica 3.6, section 5.4), or the model is refused."""

from __future__ import annotations

import pytest
from contact_data import core_subset
from contact_foundation.errors import UnsupportedModelError
from fmpy import simulate_fmu
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
