"""A quotient of Integers is a Real (Modelica 3.6, section 10.6.5), also where both can change."""

from __future__ import annotations

import numpy as np
import pytest

MODEL = """model Quotients
  function quotient
    input Integer a;
    input Integer b;
    output Real y;
  algorithm
    y := a/b;
  end quotient;
  parameter Integer a = 1, b = 2;
  parameter Real bound = a/b;
  parameter Boolean first = true;
  Integer steps(start = 3, fixed = true);
  Real plain = a/b, called = quotient(a, b), of_bound = bound, of_difference = (b - a)/b, of_steps = steps/b;
  Real chosen = (if first then a else b)/(if first then b else a);
  Real negative = (-a)/b, twice = a/b/b;
  Real before(start = 0, fixed = true);
  parameter Integer over[60] = {k for k in 1:60}, under[60] = {k + 1 for k in 1:60};
  Real x[60];
  Real last = x[60], third = x[3];
equation
  for k in 1:60 loop
    x[k] = over[k]/under[k]*time^2 + sin(x[k] - x[k]);
  end for;
  when time > 0.525 then
    steps = pre(steps) + 2;
    before = pre(steps)/b;
  end when;
end Quotients;
"""
EXPECTED = {
    "plain": lambda t: 0.5 + 0 * t,
    "called": lambda t: 0.5 + 0 * t,
    "of_bound": lambda t: 0.5 + 0 * t,
    "of_difference": lambda t: 0.5 + 0 * t,
    "of_steps": lambda t: np.where(t < 0.525, 1.5, 2.5),
    "chosen": lambda t: 0.5 + 0 * t,
    "negative": lambda t: -0.5 + 0 * t,
    "twice": lambda t: 0.25 + 0 * t,
    "before": lambda t: np.where(t < 0.525, 0, 1.5),
    "third": lambda t: 3 / 4 * t**2,
    "last": lambda t: 60 / 61 * t**2,
}


@pytest.fixture(scope="module")
def result(simulate):
    return simulate(MODEL, list(EXPECTED))


@pytest.mark.parametrize("name", EXPECTED)
def test_quotients_of_integers_are_real(result, name: str) -> None:
    beside = np.abs(result["time"] - 0.525) > 1e-6
    np.testing.assert_allclose(result[name][beside], EXPECTED[name](result["time"][beside]), atol=1e-9)
