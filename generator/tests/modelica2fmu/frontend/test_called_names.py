"""Functions and records that several packages have under one name are those of their own package, or refused."""

from __future__ import annotations

import pytest
from contact_foundation.errors import UnsupportedModelError
from fmpy import simulate_fmu
from modelica2fmu.build import BuildOptions, build_fmu

PACKAGE = """
  package {name}
    constant Real E = {value};
    record Data
      Real x;
      Real k = {value};
    end Data;
    function scaled
      input Real u;
      output Real y;
    algorithm
      y := E*u;
    end scaled;
    function twice
      input Real u;
      output Real y;
    algorithm
      y := 2*scaled(u);
    end twice;
    function pair
      input Real u;
      output Real y;
      output Real z;
    algorithm
      y := E*u;
      z := u;
    end pair;
    function second
      input Real u;
      output Real y;
    protected
      Real t;
    algorithm
      (y, t) := pair(u);
      y := y + t;
    end second;
    function of{name}
      input Data data;
      output Real y;
    algorithm
      y := data.x + 10*data.k;
    end of{name};
    model Bar
      Real f = scaled(1);
      Real g = twice(1);
      Real k = second(1);
      Real h = of{name}(Data(1));
    end Bar;
  end {name};"""
PACKAGES = PACKAGE.format(name="A", value=2) + PACKAGE.format(name="B", value=3)
VALUES = {"a.f": 2, "a.g": 4, "a.h": 21, "a.k": 3, "b.k": 4, "b.f": 3, "b.g": 6, "b.h": 31, "f": 32}
# Functions in models have no full name.
IN_MODELS = """
  model A
    function f
      input Real u;
      output Real y;
    algorithm
      y := u;
    end f;
    Real x = f(1);
  end A;
  model B
    function f
      input Real u;
      output Real y;
    algorithm
      y := 2*u;
    end f;
    Real x = f(1);
  end B;"""


def test_each_package_calls_its_own(tmp_path, fmu_cache):
    source = tmp_path / "P.mo"
    model = "model M A.Bar a; B.Bar b; Real f = A.scaled(1) + 10*B.scaled(1); end M;"
    source.write_text(f"package P{PACKAGES}\n  {model}\nend P;\n", encoding="utf-8")
    build_fmu("P.M", [source], tmp_path / "M.fmu", BuildOptions(cache=fmu_cache))
    result = simulate_fmu(str(tmp_path / "M.fmu"), output=list(VALUES), stop_time=0.1)
    assert {name: float(result[name][-1]) for name in VALUES} == pytest.approx(VALUES)


def test_what_has_no_full_name_is_refused(tmp_path):
    source = tmp_path / "P.mo"
    source.write_text(f"package P{IN_MODELS}\n  model M A a; B b; end M;\nend P;\n", encoding="utf-8")
    with pytest.raises(UnsupportedModelError, match="several classes have a function f") as caught:
        build_fmu("P.M", [source], tmp_path / "M.fmu", BuildOptions())
    assert caught.value.place.file == source
    assert "Package.f(u)" in str(caught.value)
