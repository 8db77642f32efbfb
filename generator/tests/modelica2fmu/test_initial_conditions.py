"""Initial conditions that others determine already must agree with them."""

from __future__ import annotations

import pytest
from contact_foundation.errors import InputError

DOUBLED = """model {name}
  Real x(start = 1, fixed = true);
  Real y(start = {start}, fixed = true);
equation
  der(x) = -x;
  y = 2*x;
end {name};
"""
EQUATION = """model {name}
  Real x(start = 1, fixed = true);
initial equation
  {equation}
equation
  der(x) = -x;
end {name};
"""
ALIAS = """model {name}
  parameter Real p = 5;
  Real x(start = {x}, fixed = true);
  Real y(start = {y}, fixed = true);
equation
  der(x) = -x;
  y = {sign}x;
end {name};
"""


def test_a_start_value_that_agrees_is_taken(simulate):
    result = simulate(DOUBLED.format(name="Doubled", start=2), ["x", "y"])
    assert result["y"][0] == pytest.approx(2)


def test_a_start_value_that_contradicts_stops_the_initialization(build, simulate, capfd):
    text = DOUBLED.format(name="Tripled", start=3)
    assert "the start value of y is not used, only checked" in build(text).text()
    with pytest.raises(Exception, match="ExitInitializationMode"):
        simulate(text, ["x", "y"])
    message = capfd.readouterr().out
    assert "initial conditions contradict each other: by the others, the start value of y (Tripled.mo:3)" in message
    assert "2 is not 3" in message


def test_start_values_that_are_set_are_checked(simulate):
    text = DOUBLED.format(name="Doubled", start=2)
    assert simulate(text, ["y"], start_values={"x": 4, "y": 8})["y"][0] == pytest.approx(8)
    with pytest.raises(Exception, match="ExitInitializationMode"):
        simulate(text, ["y"], start_values={"x": 4})


def test_an_initial_equation_that_contradicts_stops_the_initialization(simulate):
    assert simulate(EQUATION.format(name="Same", equation="der(x) = -1;"), ["x"])["x"][0] == 1
    with pytest.raises(Exception, match="ExitInitializationMode"):
        simulate(EQUATION.format(name="Other", equation="x = 2;"), ["x"])


@pytest.mark.parametrize(("sign", "y"), [("", 5), ("-", 1)])
def test_equal_variables_that_start_differently_are_refused(build, sign, y):
    with pytest.raises(InputError, match=r"fixed start value.*\n  fix one of the start values"):
        build(ALIAS.format(name="Alias", x=1, y=y, sign=sign))


def test_equal_variables_that_start_alike_are_taken(simulate):
    assert simulate(ALIAS.format(name="Alias", x=1, y=-1, sign="-"), ["y"])["y"][0] == -1


def test_equal_variables_whose_start_values_are_parameters_are_checked(simulate):
    text = ALIAS.format(name="OfParameter", x=5, y="p", sign="")
    assert simulate(text, ["y"])["y"][0] == 5
    with pytest.raises(Exception, match="ExitInitializationMode"):
        simulate(text, ["y"], start_values={"p": 4})


def test_a_variable_that_is_a_number_starts_with_it(build, simulate):
    text = "model Still\n  Real x(start = {start}, fixed = true);\n  Real y(start = 0, fixed = true);\n"
    text += "equation\n  x = 3;\n  der(y) = x;\nend Still;\n"
    assert simulate(text.format(start=3), ["x"])["x"][0] == 3
    with pytest.raises(InputError, match="fixed start value 2"):
        build(text.format(start=2))


def test_a_variable_that_parameters_give_starts_with_what_they_give(simulate):
    text = (
        "model Given\n  parameter Real p = 4;\n  Real x(start = 3, fixed = true);\n  Real y(start = 0, fixed = true);\n"
    )
    text += "equation\n  x = 2*p;\n  der(y) = x;\nend Given;\n"
    assert simulate(text, ["x"], start_values={"p": 1.5})["x"][0] == 3
    with pytest.raises(Exception, match="ExitInitializationMode"):
        simulate(text, ["x"])
