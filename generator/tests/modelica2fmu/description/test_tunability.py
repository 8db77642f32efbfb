"""Parameters are tunable where setting them while the FMU runs has an effect."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from fmpy import read_model_description
from modelica2fmu.build import BuildReport
from modelica2fmu.description.model_description import Causality, Variability
from modelica2fmu.description.tunability import Tunability
from modelica2fmu.expand.scalar_model import ExternalCall
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


MANY_OUTPUTS = """model ManyOutputs
  function scaled
    input Real x[40];
    input Real factor;
    output Real y[40];
  external "C" scale_all(x, factor, y)
    annotation(Include="static void scale_all(const double *x, double f, double *y) {
      for (int i = 0; i < 40; ++i) y[i] = f*x[i]; }");
  end scaled;
  parameter Real factor = -1 "of the call";
  Real x[40](each start = 1, each fixed = true);
equation
  der(x) = scaled(x, factor);
end ManyOutputs;
"""


def test_a_call_is_followed_once_whatever_the_number_of_its_outputs(
    translated: Callable[[str], Translation], monkeypatch: pytest.MonkeyPatch
) -> None:
    reduced = translated(MANY_OUTPUTS).reduced
    asked = []
    inputs = ExternalCall.inputs
    monkeypatch.setattr(ExternalCall, "inputs", lambda call: asked.append(call.number) or inputs(call))
    tunability = Tunability(reduced)
    assert tunability.is_tunable("factor")
    assert len(asked) == len(set(asked)) == 1


def test_outputs_that_are_parameters_are_no_parameters(build: Callable[[str], BuildReport]) -> None:
    """FMI 2.0.5, section 2.2.7: an output is neither fixed nor tunable."""
    text = """model Given
  parameter Real k = 3;
  parameter Integer n = 2;
  output Real y = k, twice = 2*k;
  output Integer count = n;
end Given;
"""
    description = read_model_description(str(build(text).fmu), validate=True)
    found = {each.name: each.variability for each in description.modelVariables if each.causality == "output"}
    assert found == {"y": "continuous", "twice": "continuous", "count": "discrete"}
