"""Variables that no derivative needs are those of the point where they are read, whatever was evaluated before."""

from __future__ import annotations

import ctypes
import math
from pathlib import Path

import numpy as np
import pytest
from fmpy import read_model_description, simulate_fmu
from modelica2fmu.build import BuildOptions, build_fmu
from test_kept_jacobian import move, opened

SHOWN = """model Shown
  Real x(start=1, fixed=true), swing, energy, caught(start=0, fixed=true);
equation
  der(x) = -x + time;
  swing = sin(3*x);
  energy = swing^2 + x;
  when time > 0.5 then
    caught = pre(energy);
  end when;
end Shown;
"""


def energy_at(x: float) -> float:
    return math.sin(3 * x) ** 2 + x


def test_they_follow_the_states_though_derivatives_were_asked_before(tmp_path: Path, fmu_cache: Path) -> None:
    instance, _, _ = opened(SHOWN, "Shown", tmp_path, fmu_cache)
    description = read_model_description(str(tmp_path / "Shown"))
    energy = next(v.valueReference for v in description.modelVariables if v.name == "energy")
    rate = (ctypes.c_double * 1)()
    for x in (0.2, 0.7, 0.2, -1.0):
        move(instance, x)
        instance.getDerivatives(rate, 1)
        assert rate[0] == -x
        state = instance.getFMUState()
        assert instance.getReal([energy])[0] == pytest.approx(energy_at(x), rel=1e-15)
        move(instance, 5.0)
        instance.getDerivatives(rate, 1)
        instance.setFMUState(state)
        assert instance.getReal([energy])[0] == pytest.approx(energy_at(x), rel=1e-15)


@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
def test_events_catch_them_as_they_were_before(tmp_path: Path, fmu_cache: Path, kind: str) -> None:
    source = tmp_path / "Shown.mo"
    source.write_text(SHOWN)
    fmu = build_fmu("Shown", [source], tmp_path / "Shown.fmu", BuildOptions(cache=fmu_cache)).fmu
    result = simulate_fmu(
        str(fmu), fmi_type=kind, stop_time=1.0, output_interval=0.25, relative_tolerance=1e-8, output=["x", "caught"]
    )
    x = 2 * math.exp(-0.5) - 0.5
    assert np.isclose(result["caught"][-1], energy_at(x), rtol=1e-5)
