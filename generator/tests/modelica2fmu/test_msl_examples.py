"""Examples of the Modelica Standard Library run, and as rumoca simulates them, where the library is on this machine."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from cmb_base.errors import UnsupportedModelError
from fmpy import simulate_fmu
from modelica2fmu.build import BuildOptions, build_fmu


def load_examples() -> ModuleType:
    path = Path(__file__).with_name("msl_examples.py")
    specification = importlib.util.spec_from_file_location("msl_examples", path)
    assert specification is not None
    assert specification.loader is not None
    module = importlib.util.module_from_spec(specification)
    sys.modules["msl_examples"] = module
    specification.loader.exec_module(module)
    return module


examples = load_examples()
LIBRARY = examples.library_folder()
pytestmark = pytest.mark.skipif(
    LIBRARY is None, reason="needs the complete Modelica Standard Library (MODELICAPATH names none)"
)

# Those of scripts/msl_examples that rumoca simulates too; the docs have all that were tried.
MULTIBODY = "Modelica.Mechanics.MultiBody.Examples"
ROTATIONAL = "Modelica.Mechanics.Rotational.Examples"
TRANSLATIONAL = "Modelica.Mechanics.Translational.Examples"
NAMES = [
    *(
        f"{MULTIBODY}.Elementary.{name}"
        for name in (
            "DoublePendulum", "DoublePendulumInitTip", "ForceAndTorque", "FreeBody", "HeatLosses", "InitSpringConstant",
            "LineForceWithTwoMasses", "Pendulum", "SpringMassSystem",
        )
    ),
    *(
        f"{ROTATIONAL}.{name}"
        for name in ("First", "FirstGrounded", "EddyCurrentBrake", "ElasticBearing", "RollingWheel")
    ),
    *(
        f"Modelica.Blocks.Examples.{name}"
        for name in ("PID_Controller", "FilterWithRiseTime", "InverseModel", "Modulation", "SinCosEncoder")
    ),
]  # fmt: skip


@pytest.mark.parametrize("model", NAMES)
def test_example_runs_as_the_front_end_simulates_it(model, tmp_path):
    outcome = examples.attempt(model, LIBRARY, tmp_path)
    assert (outcome.result, outcome.reason) == ("runs", "")
    assert outcome.deviation is not None, outcome.remark
    assert outcome.deviation < 1e-4


def test_linear_part_of_backlash_has_its_closed_form(tmp_path):
    fmu = tmp_path / "m.fmu"
    build_fmu(f"{ROTATIONAL}.Backlash", [LIBRARY / "Modelica"], fmu, BuildOptions(msl=LIBRARY))
    result = simulate_fmu(
        str(fmu), fmi_type="CoSimulation", stop_time=1.0, relative_tolerance=1e-8, output=["springDamper.phi_rel"]
    )
    time, angle = result["time"], result["springDamper.phi_rel"]
    damping, frequency = 50 / 5 / 2, np.sqrt(20e3 / 5 - (50 / 5 / 2) ** 2)
    closed = np.exp(-damping * time) * (np.cos(frequency * time) + damping / frequency * np.sin(frequency * time))
    assert angle == pytest.approx(np.pi / 2 * closed, abs=1e-5)


def test_tables_are_refused_as_external_objects(tmp_path):
    """rumoca flattens them with their pointer as a number, which must not become an FMU."""
    fmu = tmp_path / "m.fmu"
    with pytest.raises(UnsupportedModelError, match="external object ExternalCombiTimeTable"):
        build_fmu("Modelica.Blocks.Examples.LogicalNetwork1", [LIBRARY / "Modelica"], fmu, BuildOptions(msl=LIBRARY))
    assert not fmu.exists()
