"""Expressions and functions of models, evaluated at translation and expanded."""

from __future__ import annotations

import numpy as np
import pytest
from contact_foundation.errors import InputError, UnsupportedModelError
from modelica2fmu.symbolic import expression as ex


def value(translation, name):
    return translation.scalar.variables[name].value


STRINGS = """model Strings
  parameter Real r = 0.1;
  parameter Real unused = 3;
  parameter Integer n = 7;
  parameter Boolean b = true;
  parameter String a = "r=" + String(r, significantDigits = 17) + ";" + String(r) + ";" + String(1e-7);
  parameter String c = String(n) + "," + String(b) + "," + String(n, minimumLength = 4) + "|";
  parameter String d = if a == c then "same" else "other";
  Real x = r*unused*time;
end Strings;
"""


def test_strings_are_those_of_modelica(translated):
    translation = translated(STRINGS)
    assert value(translation, "a") == "r=0.10000000000000001;0.1;1e-07"
    assert value(translation, "c") == "7,true,7   |"
    assert value(translation, "d") == "other"


def test_only_parameters_of_strings_are_frozen(translated):
    variables = translated(STRINGS).scalar.variables
    assert variables["r"].kind.value == "constant"
    assert variables["unused"].kind.value == "parameter"


SIZES = """model Sizes
  parameter Integer n = 3;
  parameter Real free = 2;
  Real v[n];
  Real empty[0, 3];
  Real total = sum(v) + sum(empty) + product(v)*max(v);
equation
  for i in 1:n loop
    v[i] = i*free*time;
  end for;
end Sizes;
"""


def test_sizes_and_empty_arrays(translated):
    translation = translated(SIZES)
    names = [name for name in translation.scalar.variables if name.startswith("v[")]
    assert names == ["v[1]", "v[2]", "v[3]"]
    assert not [name for name in translation.scalar.variables if name.startswith("empty")]


def test_dependent_parameters_stay_expressions(translated):
    translation = translated(
        "model Dependent\n  parameter Real a = 2;\n  parameter Real b = a^2 + 1;\n  Real x = b*time;\nend Dependent;\n"
    )
    binding = value(translation, "b")
    assert isinstance(binding, ex.Node)
    assert ex.evaluate(binding, {"a": 3.0}) == 10.0


def test_recursion_without_end_is_refused(translated):
    text = """model Endless
  function f
    input Real x;
    output Real y;
  algorithm
    y := f(x) + 1;
  end f;
  Real x = f(time);
end Endless;
"""
    with pytest.raises((UnsupportedModelError, InputError)):
        translated(text)


HALVE = """  function halve
    input Real x;
    output Integer n = 0;
  protected
    Real y = x;
  algorithm
    while y > 1 loop
      y := y/2;
      n := n + 1;
    end while;
  end halve;
"""


def test_while_loop_on_variables_is_refused_with_its_function(translated):
    text = f"""model Halving
{HALVE}  Integer n = halve(time);
end Halving;
"""
    with pytest.raises(InputError, match=r"while-loop|halve") as caught:
        translated(text)
    assert caught.value.place is not None
    assert caught.value.place.line is not None


def test_while_loop_on_numbers_is_run(translated):
    text = f"""model Halved
{HALVE}  constant Integer n = halve(9.0);
  Real x = n*time;
end Halved;
"""
    assert value(translated(text), "n") == 4


SECOND_NAMES = """model SecondNames
  function sine
    input Real u;
    output Real y;
    external "builtin" y = sin(u);
  end sine;
  function angle
    input Real u1;
    input Real u2;
    output Real y;
    external "builtin" y = atan2(u1, u2);
  end angle;
  Real x(start = 0.5, fixed = true);
  Real y = sine(x) + angle(x, 2);
  Real rate = der(y);
equation
  der(x) = 1;
end SecondNames;
"""


def test_second_names_of_built_in_functions_have_their_derivatives(simulate):
    """So the Standard Library 4.0 defines Modelica.Math; sin(x) + atan(x/2) and its derivative, x = 1/2 + t."""
    result = simulate(SECOND_NAMES, ["y", "rate"])
    x = 0.5 + np.asarray(result["time"])
    np.testing.assert_allclose(result["y"], np.sin(x) + np.arctan(x / 2), atol=1e-6)
    np.testing.assert_allclose(result["rate"], np.cos(x) + 2 / (4 + x * x), atol=1e-6)
