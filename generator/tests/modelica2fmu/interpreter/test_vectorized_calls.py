"""Functions of scalars that are called with arrays are called once an element (Modelica 3.6, 12.4.6)."""

from __future__ import annotations

import pytest
from contact_foundation.errors import CmbError
from fmpy import simulate_fmu
from modelica2fmu.build import BuildOptions, build_fmu

MODEL = """package P
  type Axis = Real[3];
  function square
    input Real u;
    output Real y;
  algorithm
    y := u*u;
  end square;
  function both
    input Real u;
    input Real v = 2;
    output Real y;
  protected
    Real t;
  algorithm
    t := u*v;
    y := t*t;
  end both;
  function along
    input Axis n;
    input Real r;
    output Real v[3];
  algorithm
    v := n*(n*n)*r;
  end along;
  model M
    parameter Real p[2] = {1, 2};
    Real a[2] = square(p);
    Real b[2] = both(p, {3, 4});
    Real c[2] = both(p);
    Real d[2, 2] = square([1, 2; 3, 4]);
    Real e[3] = along({1, 2, 3}, 2);
    Real f[2, 3] = along({1, 2, 3}, {2, 5});
    Real g[2] = both({1, 2} + p, time + 3);
  end M;
end P;
"""
VALUES = {
    "a[1]": 1, "a[2]": 4, "b[1]": 9, "b[2]": 64, "c[1]": 4, "c[2]": 16, "d[1,2]": 4, "d[2,1]": 9, "e[3]": 84,
    "f[1,1]": 28, "f[2,3]": 210, "g[1]": 4*9.61, "g[2]": 16*9.61,
}  # fmt: skip


def test_each_element_has_a_call(tmp_path, fmu_cache):
    source = tmp_path / "P.mo"
    source.write_text(MODEL, encoding="utf-8")
    build_fmu("P.M", [source], tmp_path / "M.fmu", BuildOptions(cache=fmu_cache))
    result = simulate_fmu(str(tmp_path / "M.fmu"), output=list(VALUES), stop_time=0.1)
    assert {name: float(result[name][-1]) for name in VALUES} == pytest.approx(VALUES)


def test_arrays_of_other_sizes_are_refused(tmp_path):
    source = tmp_path / "P.mo"
    source.write_text(MODEL.replace("{3, 4}", "{3, 4, 5}"), encoding="utf-8")
    with pytest.raises(CmbError):
        build_fmu("P.M", [source], tmp_path / "M.fmu", BuildOptions())
