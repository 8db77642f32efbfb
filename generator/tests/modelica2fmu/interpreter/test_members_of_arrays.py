"""Members of elements of arrays of components in sums, products, and extremes."""

from __future__ import annotations

import pytest

SUMS = """model Sums
  record Pair
    Real a;
    Real b[2];
  end Pair;
  model Inner
    parameter Real k = 0;
    Real y = k*time;
  end Inner;
  model Part
    parameter Real k = 1;
    Real x = k*time;
    Real z[2] = {x, k};
    Inner inside(k = 2*k);
    Pair pair(a = k*time, b = {k, x});
  end Part;
  model Group
    Part part[2](k = {1, 2});
  end Group;
  function total
    input Real z[2];
    output Real y;
  algorithm
    y := z[1] + z[2];
  end total;
  parameter Integer n = 3;
  Part o[n](k = {1, 2, 3});
  Group group;
  %s
end Sums;
"""
# Each with its value at time 0.5; the first is made by the front end's own comprehension.
REDUCTIONS = [
    ("sum(o[i].x^2 for i in 1:n)", 3.5),
    ("max(o[i].x for i in 1:3)", 1.5),
    ("min(o[i].x - i for i in 1:3)", -1.5),
    ("sum(o[i].inside.y for i in 1:n)", 6.0),
    ("sum(o[i].z[2] for i in 1:n)", 6.0),
    ("product(o[i].k for i in 2:n)", 6.0),
    ("sum(o[4 - i].z*{1, i} for i in 1:n)", 13.0),
    ("sum(total(o[i].z) for i in 1:n)", 9.0),
    ("sum(o[i].pair.a + o[i].pair.b[1] for i in 1:n)", 9.0),
    ("sum(group.part[i].x for i in 1:2)", 1.5),
    ("sum(sum(o[i].x*o[j].x for j in 1:n) for i in 1:n)", 9.0),
    ("sum(if o[i].x > 0.75 then o[i].x else 0 for i in 1:n)", 2.5),
]


def test_one_sum_of_members(simulate):
    result = simulate(SUMS % "Real v = sum(o[i].x^2 for i in 1:3);", ["v"], stop=0.5)
    assert result["v"] == pytest.approx(14 * result["time"] ** 2, abs=1e-12)


def test_sums_of_members(simulate):
    names = [f"r{number}" for number in range(len(REDUCTIONS))]
    text = "\n  ".join(f"Real {name} = {text};" for name, (text, _) in zip(names, REDUCTIONS, strict=True))
    result = simulate(SUMS % text, names, stop=0.5)
    for name, (text, value) in zip(names, REDUCTIONS, strict=True):
        assert result[name][-1] == pytest.approx(value), text
