"""Parameters are tunable where setting them while the FMU runs has an effect."""

from __future__ import annotations

from collections.abc import Callable

from modelica2fmu.description import Causality, Variability
from modelica2fmu.translation import Translation

MODEL = """model Tunable
  parameter Real rate = 2 "used by an equation";
  parameter Real half = rate/2 "computed from a used one";
  parameter Real begin = 1 "a start value only";
  parameter Real twice = 2*begin "computed from a start value";
  parameter Real guess = 3 "in an initial equation only";
  parameter Real level = 0.5 "in a relation only";
  parameter Real back = 0.25 "in a reinit only";
  parameter Real period = 0.1 "of sample";
  parameter Real through = 4 "used through another parameter";
  parameter Real factor = 3*through;
  parameter Real idle = 5 "used by nothing";
  parameter Integer count = 2;
  parameter Real scaled = 2.5*count "of a fixed one";
  Real x(start = begin, fixed = true);
  Real y;
  Real shown = half;
  discrete Real ticks(start = 0, fixed = true);
initial equation
  y = guess;
equation
  der(x) = -rate*x + scaled;
  der(y) = -factor*y;
  when x < level then
    reinit(x, back);
  end when;
  when sample(0, period) then
    ticks = pre(ticks) + 1;
  end when;
end Tunable;
"""


def test_parameters_are_tunable_where_they_act(translated: Callable[[str], Translation]) -> None:
    variables = {v.name: v for v in translated(MODEL).description.variables}
    tunable = {name for name, v in variables.items() if v.variability is Variability.TUNABLE}
    fixed = {name for name, v in variables.items() if v.variability is Variability.FIXED}
    assert tunable >= {"rate", "half", "level", "back", "through", "factor", "shown"}
    assert fixed >= {"begin", "twice", "guess", "idle", "count", "scaled"}
    assert variables["half"].causality is Causality.CALCULATED_PARAMETER
