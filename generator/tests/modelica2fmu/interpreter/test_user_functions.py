"""Functions of a model's author: defaults, named arguments, several outputs, records, sizes, inheritance.

Values are worked out by hand from the Modelica Language Specification 3.6, chapter 12.
"""

from __future__ import annotations

import pytest
from fmpy import simulate_fmu
from modelica2fmu.build import BuildOptions, build_fmu

MODEL = """package P
  constant Real big = 100;
  record Data
    Real a = 1;
    Real v[2] = {2, 3};
  end Data;
  function base
    input Real u;
    input Real k = 2;
    input Real m = k + 1;
    output Real y = 0;
  protected
    Real t = u*k;
  algorithm
    y := t + 10*m;
  end base;
  function two
    input Real u[:];
    input Integer n = size(u, 1);
    output Real s = 0;
    output Real l[size(u, 1)];
    output Integer c = n;
  algorithm
    for i in 1:size(u, 1) loop
      s := s + u[i];
      l[i] := u[i]*i;
    end for;
  end two;
  function heir
    extends base(k = 5);
    input Real z = 7;
  end heir;
  partial function Shape
    input Real u;
    output Real y;
  end Shape;
  function lin
    extends Shape;
    input Real a = 3;
  algorithm
    y := a*u;
  end lin;
  function lin5 = lin(a = 5);
  function make
    input Real a;
    output Data d;
  algorithm
    d := Data(a = a, v = {a, 2*a});
  end make;
  function make2
    input Real a;
    output Data d;
  algorithm
    d.a := a;
    d.v := {8, 4};
  end make2;
  function use
    input Data d = Data(a = 9);
    input Real w[:, :] = {{1, 2}, {3, 4}};
    output Real y;
  algorithm
    y := d.a + d.v[1]*10 + d.v[2]*100 + w[2, 1]*1000 + size(w, 1);
  end use;
  function local
    input Real u;
    output Real y;
  protected
    constant Real big = 3;
    Real v[3] = {u, 2*u, 3*u};
    Integer n = size(v, 1);
  algorithm
    y := big*v[n] + sum(v[2:end]);
  end local;
  model Uses
    replaceable function f = lin constrainedby Shape;
    parameter Real q = 4;
    Real y = f(q);
  end Uses;
  model Def
    parameter Real k = 6;
    function g = lin(a = 8);
    Real y = g(k) + lin(k, 2) + lin(a = 1, u = k);
  end Def;
  model Vec
    parameter Real x[3] = {1, 2, 3};
    Real s;
    Real l[3];
    Integer c;
    Real s2;
    Real l2[3]; Integer c2;
  equation
    (s, l, c) = two(x);
    (s2, l2, c2) = two(x, 3);
  end Vec;
  model Alg
    parameter Real x[2] = {5, 6};
    Real s;
    Real l[2];
    Real s0; Integer c3;
  equation
    (s0, l, c3) = two(u = x);
    s = s0 + 1;
  end Alg;
  model M
    Real y1 = base(1);
    Real y2 = base(1, m = 4);
    Real y3 = base(k = 3, u = 2);
    Real y4 = heir(1);
    Real y6 = lin5(2);
    Real y7 = use();
    Real y8 = use(make(3));
    Real y9 = use(w = {{0, 0}, {9, 0}, {0, 0}}, d = make2(2));
    Real y10 = local(2);
    Data d = make(5);
    Data e(a = 12);
    Data f = Data(v = {7, 7});
    Real y11 = use(e) + f.a;
    Uses u1;
    Uses u3(q = 1, redeclare function f = lin);
    Def def1;
    Def def2(k = 1);
    Vec vec;
    Vec vec2(x = {3, 2, 1});
    Alg alg;
    Real arr[3] = lin({1, 2, 3});
    Real arr2[2] = base({1, 2}, 1);
  end M;
end P;
"""
VALUES = {
    "y1": 32, "y2": 42, "y3": 46, "y4": 65, "y6": 10, "y7": 3331, "y8": 3635, "y9": 9485, "y10": 28, "y11": 3335,
    "d.a": 5, "d.v[2]": 10, "e.a": 12, "e.v[2]": 3, "f.a": 1, "f.v[1]": 7, "u1.y": 12, "u3.y": 3, "def1.y": 66,
    "def2.y": 11, "vec.s": 6, "vec.l[3]": 9, "vec.c": 3, "vec.s2": 6, "vec2.s": 6, "vec2.l[1]": 3, "vec2.l[3]": 3,
    "alg.s": 12, "alg.l[2]": 12, "arr[3]": 9, "arr2[2]": 22,
}  # fmt: skip


def test_values_are_those_of_the_language(tmp_path, fmu_cache):
    source = tmp_path / "P.mo"
    source.write_text(MODEL, encoding="utf-8")
    build_fmu("P.M", [source], tmp_path / "M.fmu", BuildOptions(cache=fmu_cache))
    result = simulate_fmu(str(tmp_path / "M.fmu"), output=list(VALUES), stop_time=0.1)
    assert {name: float(result[name][-1]) for name in VALUES} == pytest.approx(VALUES)
