"""A built FMU that is driven into an assertion: what it says, and the way back."""

from __future__ import annotations

import pytest
from contact_foundation.errors import SimulationError
from fmu_regression.fmi.description import read_description
from fmu_regression.fmi.fmu import open_fmu
from interactive_drive.machine.controls import choose_controls
from interactive_drive.machine.machine import Machine

ROPE = """model Rope
  input Real force(unit="N", min=-10, max=10) "Pull on a mass of 1 kg";
  parameter Real d(unit="N.s/m", min=0.1, max=10) = 1;
  output Real x(unit="m", start=0, fixed=true);
  output Real v(unit="m/s", start=0, fixed=true);
equation
  der(x) = v;
  der(v) = force - d*v;
  assert(x < 1, "the rope is torn at x = " + String(x));
end Rope;
"""


@pytest.mark.parametrize("version", ["2", "3"])
def test_an_assertion_is_told_and_the_state_before_it_is_gone_back_to(cmb_here, tmp_path, version):
    (tmp_path / "Rope.mo").write_text(ROPE)
    fmu = tmp_path / "Rope.fmu"
    done = cmb_here("fmu", "Rope", "--source", tmp_path / "Rope.mo", "--output", fmu, "--fmi", version)
    assert done.returncode == 0, done.stderr
    controls = choose_controls(read_description(fmu))
    assert [(control.name, control.low, control.high) for control in controls] == [("force", -10, 10), ("d", 0.1, 10)]
    with open_fmu(fmu) as opened, Machine(opened, ["x", "v"], 0.01) as machine:
        machine.set({"force": 3.0})
        for _ in range(50):
            machine.step()
        good, before = machine.save(), machine.row()
        with pytest.raises(SimulationError, match=r"stopped after t = 0\.94 s(?s:.*)the rope is torn at x = 1"):
            for _ in range(100):
                machine.step()
        machine.restore(good)
        assert machine.time == pytest.approx(0.5)
        assert machine.row() == pytest.approx(before)
        machine.set({"force": -1.0, "d": 2.0})  # and drives elsewhere
        for _ in range(50):
            machine.step()
        assert machine.row()[1] == pytest.approx(before[1] * 2.718281828**-1 - 0.5 * (1 - 2.718281828**-1), abs=1e-3)
        machine.free(good)
