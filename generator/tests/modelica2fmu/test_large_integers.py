"""Integers beyond the largest of FMI: refused at their line, or an error that names them, never another number."""

from __future__ import annotations

import pytest
from contact_foundation.errors import InputError
from fmpy import simulate_fmu

COUNTED = """model Counted
  Integer n(start = 0, fixed = true);
  Real x(start = 1, fixed = true);
  parameter Real scale = 1e10;
equation
  der(x) = 1;
  when time > 0.5 then
    n = integer(scale*x);
  end when;
end Counted;
"""


def test_a_constant_is_refused(translated):
    with pytest.raises(InputError) as caught:
        translated("model Fixed\n  Integer n = 10000000000;\n  Real x = n*time;\nend Fixed;\n")
    assert "n is 10000000000, beyond the largest Integer, 2147483647" in caught.value.message
    assert caught.value.place.line == 2


@pytest.mark.parametrize("mode", ["ModelExchange", "CoSimulation"])
def test_one_that_grows_in_the_run_ends_it(build, capfd, mode):
    report = build(COUNTED)
    with pytest.raises(Exception, match="fmi2"):
        simulate_fmu(str(report.fmu), fmi_type=mode, stop_time=1.0)
    assert "the Integer n would be 1.5e+10, beyond the largest, 2147483647" in capfd.readouterr().out


@pytest.mark.parametrize("mode", ["ModelExchange", "CoSimulation"])
def test_the_largest_is_kept(build, mode):
    report = build(COUNTED)
    start = {"scale": 2147483647.0 / 1.5}
    result = simulate_fmu(str(report.fmu), fmi_type=mode, stop_time=1.0, start_values=start, output=["n"])
    assert abs(int(result["n"][-1]) - 2147483647) <= 1


def test_what_an_external_function_returns_is_kept(simulate):
    result = simulate(
        "model Absolute\n"
        "  function absolute\n    input Integer n;\n    output Integer y;\n"
        '    external "C" y = abs(n) annotation(Include = "#include <stdlib.h>");\n  end absolute;\n'
        "  Integer k(start = -3, fixed = true);\n  Integer n = absolute(k);\n"
        "equation\n  when time > 0.5 then\n    k = -7;\n  end when;\nend Absolute;\n",
        ["n"],
    )
    assert result["n"][0] == 3
    assert result["n"][-1] == 7
