"""A block that slides on a floor as it begins to touch it, held by anchored friction in the end."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from fmpy import read_model_description, simulate_fmu
from library_compiler import LIBRARIES, REPOSITORY, standard_library
from modelica2fmu.build import BuildOptions, build_fmu
from numpy.typing import NDArray

G, MU, SPEED = 9.81, 0.5, 0.2

BLOCK = f"""
model TouchesAndSlides "Contact begins without depth and without speed along the normal, while the block slides"
  inner Modelica.Mechanics.MultiBody.World world(g={G}, n={{0,0,-1}});
  ContactMultiBody.Parts.Body slider(
    m=5, r_CM={{0,0,0}}, I_11=0.02, I_22=0.04, I_33=0.05,
    geometry=ContactMultiBody.Shapes.box({{0.3,0.2,0.1}}), material(muStatic={MU}),
    r_0(start={{0,0,0.05}}, each fixed=true), v_0(start={{{SPEED},0,0}}, each fixed=true),
    angles_fixed=true, w_0_fixed=true);
  ContactMultiBody.Parts.Ground floor(material(muStatic={MU}));
  ContactMultiBody.ContactManager contacts(
    n=2, geometry={{slider.geometry,floor.geometry}}, material={{slider.material,floor.material}},
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given, stiffness={{6e6}},
    friction=ContactMultiBody.Types.Friction.Anchored);
equation
  connect(slider.frame_a, contacts.frame[1]);
  connect(floor.frame_a, contacts.frame[2]);
  annotation (experiment(StopTime=1, Tolerance=1e-6));
end TouchesAndSlides;
"""

pytestmark = pytest.mark.skipif(
    not (REPOSITORY / "ContactMultiBody" / "Resources" / "Library" / "linux64" / "libContactMultiBody.a").is_file(),
    reason="the contact engine is not installed; run scripts/setup",
)


@pytest.fixture(scope="module", params=LIBRARIES)
def fmu(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory, fmu_cache: Path) -> Path:
    standard = standard_library(request.param)
    if standard is None:
        pytest.skip(f"Modelica Standard Library {request.param} is not on MODELICAPATH")
    folder = tmp_path_factory.mktemp("block")
    source = folder / "TouchesAndSlides.mo"
    source.write_text(BLOCK, encoding="utf-8")
    options = BuildOptions(msl=standard, cache=fmu_cache)
    report = build_fmu("TouchesAndSlides", [source, REPOSITORY / "ContactMultiBody"], folder / "slider.fmu", options)
    return report.fmu


def simulate(fmu: Path, names: list[str]) -> NDArray[np.void]:
    result: NDArray[np.void] = simulate_fmu(
        str(fmu), stop_time=1.0, output_interval=0.001, fmi_type="CoSimulation", output=names
    )
    return result


def test_it_stops_where_it_should_and_takes_few_evaluations(fmu: Path) -> None:
    result = simulate(fmu, ["slider.r_0[1]", "slider.v_0[1]", "cmbSolver.evaluations"])
    assert result["slider.r_0[1]"][-1] == pytest.approx(SPEED**2 / (2 * MU * G), rel=2e-3)
    assert abs(result["slider.v_0[1]"][-1]) < 1e-8
    # With an anchor that follows at once where nothing holds it, the first 0.1 ms alone take 15 000.
    assert result["cmbSolver.evaluations"][-1] < 5000


def test_variables_keep_within_the_bounds_of_their_types(fmu: Path) -> None:
    """A signed distance, say, is no Distance, which the Standard Library bounds by zero."""
    described = read_model_description(str(fmu)).modelVariables
    bounded = [v for v in described if v.variability == "continuous" and (v.min, v.max) != (None, None)]
    result = simulate(fmu, ["contacts.distance[1]", *(v.name for v in bounded if v.name != "contacts.distance[1]")])
    assert result["contacts.distance[1]"].min() < 0
    for variable in bounded:
        low = -np.inf if variable.min is None else float(variable.min)
        high = np.inf if variable.max is None else float(variable.max)
        assert low <= result[variable.name].min(), variable.name
        assert result[variable.name].max() <= high, variable.name
