"""Assertions of functions are checked where the functions are called, and there alone."""

from __future__ import annotations

import numpy as np
import pytest

CLASSES = """model M
  function branch
    input Real x;
    output Real y;
  algorithm
    y := x;
    if x > 5 then
      assert(false, "in the branch");
    end if;
  end branch;
  function below
    input Real x;
    output Real y;
  algorithm
    assert(x < 5, "below " + String(x));
    y := x;
  end below;
  function leaving
    input Real x;
    output Real y;
  algorithm
    y := x;
    for i in 1:2 loop
      if x > 5 then
        return;
      end if;
    end for;
    assert(x < 5.5, "behind the return");
  end leaving;
  {text}
end M;
"""


@pytest.mark.parametrize(
    ("text", "message", "fmi_type"),
    [
        ("Real y = branch(time);", "in the branch", "ModelExchange"),
        ("Real y = branch(time);", "in the branch", "CoSimulation"),
        ("Real y = below(time);", "below 5", "ModelExchange"),
        ("Real y(start = 0, fixed = true); equation der(y) = below(2*time);", "below 5", "CoSimulation"),
        ("Real y; equation if time > 1 then y = below(time); else y = 0; end if;", "below 5", "CoSimulation"),
    ],
)
def test_they_stop_the_simulation(text, message, fmi_type, simulate, capfd):
    with pytest.raises(Exception, match="fmi2"):
        simulate(CLASSES.format(text=text), ["y"], stop=6, fmi_type=fmi_type, debug_logging=False)
    assert message in capfd.readouterr().out


@pytest.mark.parametrize(
    "text",
    [
        "Real y = if time < 4.5 then below(time) else 4.5;",
        "Real y; equation if time < 4.5 then y = branch(below(time)); else y = 4.5; end if;",
        "parameter Boolean on = false; Real y = if on then below(time) else min(time, 4.5);",
    ],
)
def test_they_do_not_where_the_function_is_not_called(text, simulate):
    result = simulate(CLASSES.format(text=text), ["y"], stop=6)
    np.testing.assert_allclose(result["y"], np.minimum(result["time"], 4.5), atol=1e-9)


def test_not_behind_a_return(simulate):
    result = simulate(CLASSES.format(text="Real y = leaving(time);"), ["y"], stop=6)
    np.testing.assert_allclose(result["y"], result["time"])
