"""A call of a function with several outputs is worth its first one in an expression (Modelica 3.6, section 12.4.3)."""

from __future__ import annotations

import numpy as np
import pytest

MODEL = """model Several
  function powers
    input Real x;
    output Real square;
    output Real cube;
  algorithm
    square := x^2;
    cube := x^3;
  end powers;
  function squared
    input Real x[:];
    output Real squares[size(x, 1)];
    output Real last;
  algorithm
    squares := {x[i]^2 for i in 1:size(x, 1)};
    last := x[size(x, 1)];
  end squared;
  record Pair
    Real a, b;
  end Pair;
  function pair
    input Real x;
    output Pair p;
    output Real rest;
  algorithm
    p := Pair(x, 2*x);
    rest := x^3;
  end pair;
  Real bound = powers(time);
  Real equal, square, cube;
  Real summed = powers(time) + 1;
  Real total = sum(squared({time, 2*time}));
  Real chosen;
  Real listed[2] = {powers(time), powers(2*time)};
  Real x(start = 0, fixed = true);
  Real vector[2] = squared({time, 2*time});
  Pair p = pair(time);
  Real field = p.b;
  parameter Real half = 0.5;
  parameter Real known = powers(half);
  Real constant_ = known;
  discrete Real caught(start = 0, fixed = true);
  discrete Real first(start = 0, fixed = true), second(start = 0, fixed = true);
equation
  equal = powers(time);
  (square, cube) = powers(time);
  der(x) = powers(time);
  if time > 0.525 then
    chosen = powers(time);
  else
    chosen = 2*powers(time);
  end if;
  when time >= 0.525 then
    caught = powers(time);
  end when;
algorithm
  when time >= 0.525 then
    (first, second) := powers(time);
  end when;
end Several;
"""
AT = 0.525
EXPECTED = {
    "bound": lambda t: t**2,
    "equal": lambda t: t**2,
    "square": lambda t: t**2,
    "cube": lambda t: t**3,
    "summed": lambda t: t**2 + 1,
    "total": lambda t: 5 * t**2,
    "chosen": lambda t: np.where(t > AT, t**2, 2 * t**2),
    "listed[2]": lambda t: 4 * t**2,
    "x": lambda t: t**3 / 3,
    "vector[2]": lambda t: 4 * t**2,
    "field": lambda t: 2 * t,
    "constant_": lambda t: np.full_like(t, 0.25),
    "caught": lambda t: np.where(t > AT, AT**2, 0),
    "first": lambda t: np.where(t > AT, AT**2, 0),
    "second": lambda t: np.where(t > AT, AT**3, 0),
}


@pytest.fixture(scope="module")
def result(simulate):
    return simulate(MODEL, list(EXPECTED))


@pytest.mark.parametrize("name", EXPECTED)
def test_value_is_that_of_the_first_output(result, name: str) -> None:
    beside = np.abs(result["time"] - AT) > 1e-6  # at the event both values are given
    assert beside.sum() > 20
    np.testing.assert_allclose(result[name][beside], EXPECTED[name](result["time"][beside]), atol=1e-6)
