"""Structure of the reference models; the regression cases compare their motion with another tool's."""

from __future__ import annotations

import numpy as np
import pytest
from contact_data import checkout, core_subset
from fmpy import simulate_fmu
from modelica2fmu.build import BuildOptions, BuildReport, build_fmu, translate
from modelica2fmu.library.standard_library import CORE_SUBSET, StandardLibrary, find_standard_library

REFERENCE = checkout() / "Resources" / "reference"
MODELS = REFERENCE / "ReferenceModels.mo"


@pytest.fixture(scope="module")
def built(tmp_path_factory, fmu_cache):
    reports: dict[str, BuildReport] = {}

    def run(name: str) -> BuildReport:
        if name not in reports:
            output = tmp_path_factory.mktemp("reference") / f"{name}.fmu"
            options = BuildOptions(msl=core_subset(), cache=fmu_cache)
            reports[name] = build_fmu(f"ReferenceModels.{name}", [MODELS], output, options)
        return reports[name]

    return run


def test_free_body_has_quaternion_states_and_its_rotation_stays_orthonormal(built):
    report = built("TumblingBody")
    quaternion = [f"body.Q_integrated[{number}]" for number in (1, 2, 3, 4)]
    assert [name for name in report.states if ".Q" in name] == quaternion
    names = [f"body.frame_a.R.T[{row},{column}]" for row in (1, 2, 3) for column in (1, 2, 3)]
    result = simulate_fmu(str(report.fmu), stop_time=10.0, relative_tolerance=1e-4, output=names)
    for row in result:
        matrix = np.array([row[name] for name in names]).reshape(3, 3)
        assert matrix @ matrix.T == pytest.approx(np.eye(3), abs=1e-12)


def test_tree_is_torn_to_its_degrees_of_freedom(built):
    blocks = built("DoublePendulum").simulation_blocks
    assert [(block.kind, len(block.torn)) for block in blocks] == [("linear", 2)]
    assert built("DoublePendulum").states == ("r1.phi", "r1.w", "r2.phi", "r2.w")


@pytest.mark.full
def test_hexapod_has_no_linear_system_larger_than_its_degrees_of_freedom():
    translation = translate("ReferenceModels.Hexapod.Walk", [MODELS], StandardLibrary(core_subset(), "", "core subset"))
    sizes = [len(block.torn) for block in translation.systems.simulation if hasattr(block, "torn")]
    assert max(sizes) == 24
    assert len(translation.systems.reduction.states) == 49  # 24 positions and speeds each, one quaternion more


def test_spatial_loop_of_the_standard_library_has_its_driving_joint_s_states():
    library = find_standard_library()
    if library.origin == CORE_SUBSET:
        pytest.skip("needs the complete Modelica Standard Library, whose example it is (MODELICAPATH names none)")
    translation = translate("ReferenceModels.SpatialFourBar", [MODELS], library)
    assert tuple(translation.systems.reduction.states) == ("j1.phi", "j1.w")
