"""An initialization that has no solution names the equation, with file and line, and the unknowns."""

from __future__ import annotations

import numpy as np
import pytest
from fmpy import simulate_fmu

UNREACHABLE = """model Unreachable "Two bars of one metre cannot reach three metres"
  Real phi(start = 0.3), psi(start = -0.4);
  parameter Real reach = 3;
  Real x(start = 0, fixed = true);
equation
  der(x) = phi + psi;
  cos(phi) + cos(psi) = reach;
  sin(phi) + sin(psi) = 0.1;
end Unreachable;
"""


def test_unsolvable_loop_names_its_equation(build, capfd):
    report = build(UNREACHABLE)
    with pytest.raises(Exception, match="ExitInitializationMode"):
        simulate_fmu(str(report.fmu), fmi_type="CoSimulation", stop_time=1.0)
    message = capfd.readouterr().out
    assert "Unreachable.mo, line 7" in message
    assert "phi = " in message


def test_solvable_loop_of_the_same_form_is_solved(simulate):
    result = simulate(UNREACHABLE, ["phi", "psi"], start_values={"reach": 1.5})
    assert np.cos(result["phi"]) + np.cos(result["psi"]) == pytest.approx(1.5, abs=1e-9)
