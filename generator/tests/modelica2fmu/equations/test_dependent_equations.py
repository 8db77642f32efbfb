"""Equations that are dependent by their numbers, not by their structure."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from contact_foundation.errors import InputError
from modelica2fmu.equations.dependent_equations import combined, dependency
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.linear_form import LinearForm

PARTS = """
  connector Pin Real v; flow Real i; end Pin;
  partial model TwoPins Pin a; Pin b; Real v = a.v - b.v; Real i = a.i; equation a.i + b.i = 0; end TwoPins;
  model Resistor extends TwoPins; equation v = i; end Resistor;
  model Capacitor extends TwoPins; parameter Real k = 1; equation k*der(v) = i; end Capacitor;
  model Inductor extends TwoPins; parameter Real k = 1; equation k*der(i) = v; end Inductor;
  model Ground Pin a; equation a.v = 0; end Ground;
"""
# The ring of an inductor and a resistor is tied to ground by another inductor, through which nothing can flow.
TIED = f"""model Tied
{PARTS}
  model Unit
    Pin one, two;
    Inductor tie;
    Resistor loose, load;
    Ground g;
    Capacitor end_;
  equation
    connect(one, end_.a);
    connect(two, tie.b);
    connect(load.b, loose.a);
    connect(load.b, tie.a);
    connect(g.a, load.a);
  end Unit;
  Inductor ring(k = 2);
  Unit unit[2];
  Capacitor other;
  Resistor side, load;
initial equation
  ring.i = 2;
equation
  connect(unit[2].two, load.a);
  connect(unit[2].one, load.a);
  connect(ring.b, load.a);
  connect(side.a, unit[1].two);
  connect(other.b, unit[1].two);
  connect(side.b, unit[1].one);
  connect(ring.a, load.b);
end Tied;
"""
# Two capacitors side by side, and nothing else between them and ground but a third.
SIDE_BY_SIDE = f"""model SideBySide
{PARTS}
  Capacitor first(v(start = 3, fixed = true)), second(k = 2), tie(v(start = 0.5, fixed = true));
  Resistor load;
  Ground g;
equation
  connect(first.a, second.b);
  connect(first.b, second.a);
  connect(first.a, load.a);
  connect(first.b, load.b);
  connect(first.b, tie.a);
  connect(tie.b, g.a);
end SideBySide;
"""


def form(**coefficients: float) -> LinearForm:
    return LinearForm(ex.symbol("u"), coefficients)


def test_weights_of_a_dependency_add_up_to_nothing():
    rows = [form(x=1.0, y=-2.0), form(y=1.0, z=3.0), form(x=0.5, z=3.0)]
    weights = dependency(rows)
    assert weights is not None
    for name in "xyz":
        assert sum(weight * Fraction(rows[number].coefficients.get(name, 0)) for number, weight in weights.items()) == 0
    assert dependency([*rows[:2], form(x=0.5, z=3.000001)]) is None


def test_coefficients_that_are_no_numbers_depend_on_nothing():
    k = ex.symbol("k")
    assert dependency([LinearForm(0, {"x": k}), LinearForm(0, {"x": k})]) is None


@pytest.mark.parametrize("value", [math.inf, math.nan])
def test_numbers_without_bounds_depend_on_nothing(value):
    assert dependency([form(x=value), form(x=value)]) is None
    x = ex.symbol("x")
    assert not isinstance(combined([(x, Fraction(1)), (value, Fraction(1))]), ex.Node)


def test_a_coefficient_of_nothing_is_no_coefficient():
    assert dependency([form(x=0.0, y=1.0), form(y=2.0)]) is not None


def test_terms_of_a_combination_cancel():
    x, y = ex.symbol("x"), ex.symbol("y")
    first = ex.subtract(ex.multiply(2, x), ex.unary("sin", y))
    second = ex.negate(ex.subtract(x, ex.add(y, 4)))
    total = combined([(first, Fraction(1)), (second, Fraction(2))])
    assert set(ex.symbols(total)) == {"y"}
    assert ex.symbols(combined([(x, Fraction(1)), (ex.divide(x, 2), Fraction(-2))])) == []


@pytest.mark.parametrize("mode", ["ModelExchange", "CoSimulation"])
def test_current_of_a_loop_whose_tie_carries_none(simulate, mode):
    result = simulate(TIED, ["ring.i", "unit[2].tie.i", "load.v"], fmi_type=mode)
    np.testing.assert_allclose(result["ring.i"], 2 * np.exp(-result["time"] / 2), atol=1e-5)
    np.testing.assert_allclose(result["load.v"], 2 * np.exp(-result["time"] / 2), atol=1e-5)
    np.testing.assert_allclose(result["unit[2].tie.i"], 0, atol=1e-9)


@pytest.mark.parametrize("mode", ["ModelExchange", "CoSimulation"])
def test_capacitors_side_by_side(simulate, mode):
    result = simulate(SIDE_BY_SIDE, ["first.v", "second.v", "tie.v"], fmi_type=mode)
    np.testing.assert_allclose(result["first.v"], 3 * np.exp(-result["time"] / 3), atol=1e-5)
    np.testing.assert_allclose(result["second.v"], -result["first.v"], atol=1e-12)
    np.testing.assert_allclose(result["tie.v"], 0.5, atol=1e-9)


def test_potentials_that_nothing_determines_are_refused(build):
    text = SIDE_BY_SIDE.replace("SideBySide", "Floating").replace("connect(tie.b, g.a);", "").replace(
        "tie(v(start = 0.5, fixed = true))", "tie"
    )  # fmt: skip
    with pytest.raises(InputError, match=r"linearly dependent|singular"):
        build(text)
