"""Nonlinear systems whose solution is followed from step to step, through steps that are taken back."""

from __future__ import annotations

import numpy as np
import pytest

# z changes its sign where y is an odd multiple of a quarter turn; y turns at up to four times the speed of its mean.
TURNS = """model Turns
  parameter Real speed = 10;
  Real mean(start = 0, fixed = true);
  Real y(start = 0.1);
  Real z;
  Integer count(start = 0, fixed = true);
  Boolean high = z > 0;
equation
  der(mean) = speed;
  y + 0.7*sin(y) + 0.2*sin(z) = mean;
  z = cos(y) + 0.1*z*z*z;
  when change(high) then
    count = pre(count) + 1;
  end when;
end Turns;
"""


@pytest.mark.parametrize("interval", [0.01, 0.05])
@pytest.mark.parametrize("speed", [4, 7.3, 10.4, 12.6])
def test_a_solution_that_turns_is_followed(simulate, speed, interval):
    """Steps may be too long to follow it; then it goes on from where the communication step began."""
    result = simulate(
        TURNS,
        ["count", "y", "z", "mean", "high"],
        stop=20,
        tolerance=1e-6,
        interval=interval,
        fmi_type="CoSimulation",
        start_values={"speed": speed},
    )
    y, z = result["y"], result["z"]
    np.testing.assert_allclose(y + 0.7 * np.sin(y) + 0.2 * np.sin(z), result["mean"], atol=1e-8)
    np.testing.assert_array_equal(result["count"], np.floor(y / np.pi + 0.5))
    assert np.all(np.diff(y) > 0)
