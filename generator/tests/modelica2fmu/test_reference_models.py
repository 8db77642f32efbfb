"""Multibody models against trajectories of another Modelica tool (Resources/reference)."""

from __future__ import annotations

import csv
import os
from pathlib import Path

import numpy as np
import pytest
from fmpy import read_model_description, simulate_fmu
from modelica2fmu.build import BuildOptions, BuildReport, build_fmu, translate
from modelica2fmu.standard_library import StandardLibrary, core_subset, find_standard_library

REFERENCE = Path(__file__).resolve().parents[3] / "Resources" / "reference"
MODELS = REFERENCE / "ReferenceModels.mo"


def real_library() -> Path | None:
    """A complete Modelica Standard Library on this machine."""
    library = find_standard_library()
    return None if library.origin == "core subset" else library.folder


@pytest.fixture(scope="module")
def built(tmp_path_factory, fmu_cache):
    reports: dict[str, BuildReport] = {}

    def run(name: str, library: Path | None = None) -> BuildReport:
        if name not in reports:
            output = tmp_path_factory.mktemp("reference") / f"{name}.fmu"
            options = BuildOptions(msl=library or core_subset(), cache=fmu_cache)
            reports[name] = build_fmu(f"ReferenceModels.{name}", [MODELS], output, options)
        return reports[name]

    return run


def trajectory(name: str) -> tuple[list[str], np.ndarray]:
    with (REFERENCE / f"{name}.csv").open(newline="") as file:
        rows = list(csv.reader(file))
    values = np.array([[float(item) for item in row] for row in rows[1:]])
    times, counts = np.unique(values[:, 0], return_counts=True)
    single = set(times[counts == 1])  # at events the reference has two rows
    return rows[0], values[[time in single for time in values[:, 0]]]


def largest_error(report: BuildReport, name: str, fmi_type: str, tolerance: float, stop: float | None = None) -> float:
    """Largest error of all signals over each one's range."""
    names, reference = trajectory(name)
    experiment = read_model_description(str(report.fmu)).defaultExperiment
    end = stop or float(experiment.stopTime)
    result = simulate_fmu(
        str(report.fmu), fmi_type=fmi_type, stop_time=end, relative_tolerance=tolerance, output=names[1:],
        output_interval=float(experiment.stepSize),
    )  # fmt: skip
    reference = reference[reference[:, 0] <= end + 1e-9]
    worst = 0.0
    for column, signal in enumerate(names[1:], start=1):
        span = np.ptp(reference[:, column])
        mine = np.interp(reference[:, 0], result["time"], result[signal])
        on_grid = np.min(np.abs(result["time"][None, :] - reference[:, :1]), axis=1) < 1e-9
        assert np.count_nonzero(on_grid) > 0.9 * len(reference)
        worst = max(worst, float(np.max(np.abs(mine - reference[:, column])[on_grid])) / (span or 1.0))
    return worst


# The planar loop needs the tighter tolerance: at 1e-9 its integration error alone is 1e-5 of the range.
@pytest.mark.parametrize("fmi_type", ["ModelExchange", "CoSimulation"])
@pytest.mark.parametrize("name", ["TumblingBody", "OffsetBody", "DoublePendulum", "SlidingBlock", "PlanarFourBar"])
def test_trajectory_is_that_of_the_reference(built, name, fmi_type):
    assert largest_error(built(name), name, fmi_type, 1e-10) < 1e-6


def test_spatial_loop_of_the_standard_library(built):
    library = real_library()
    if library is None:
        pytest.skip("needs the complete Modelica Standard Library, whose example it is (MODELICAPATH names none)")
    report = built("SpatialFourBar", library)
    assert report.states == ("j1.phi", "j1.w")
    assert largest_error(report, "SpatialFourBar", "CoSimulation", 1e-10) < 1e-6


def event_times(times: np.ndarray, counter: np.ndarray) -> np.ndarray:
    return times[1:][np.diff(counter) > 0]


def test_impacts_of_the_bouncing_ball_come_in_time(built):
    with (REFERENCE / "BouncingBall.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    expected = event_times(
        np.array([float(row["time"]) for row in rows]), np.array([float(row["bounces"]) for row in rows])
    )
    result = simulate_fmu(
        str(built("BouncingBall").fmu), fmi_type="ModelExchange", stop_time=3.0, relative_tolerance=1e-10,
        output=["bounces"], output_interval=0.01, record_events=True,
    )  # fmt: skip
    mine = event_times(result["time"], result["bounces"])
    assert len(mine) == len(expected)
    assert mine == pytest.approx(expected, abs=1e-6)


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


def test_hexapod_has_no_linear_system_larger_than_its_degrees_of_freedom():
    translation = translate("ReferenceModels.Hexapod.Walk", [MODELS], StandardLibrary(core_subset(), "", "core subset"))
    sizes = [len(block.torn) for block in translation.systems.simulation if hasattr(block, "torn")]
    assert max(sizes) == 24
    assert len(translation.systems.reduction.states) == 49  # 24 positions and speeds each, one quaternion more


@pytest.mark.skipif(os.environ.get("CMB_SLOW_TESTS") != "1", reason="compiles for half a minute: CMB_SLOW_TESTS=1")
def test_hexapod_walks_as_the_reference_does(built):
    report = built("Hexapod.Walk")
    assert largest_error(report, "Hexapod.Walk", "CoSimulation", 1e-5, stop=1.0) < 1e-3
    feet = [f"{leg}.foot.fn" for leg in ("a1", "a2", "a3", "b1", "b2", "b3")]
    result = simulate_fmu(
        str(report.fmu), fmi_type="CoSimulation", stop_time=2.0, relative_tolerance=1e-5, output=feet,
        output_interval=0.005,
    )  # fmt: skip
    names, reference = trajectory("Hexapod.Walk")
    expected = sum(reference[:, names.index(name)].mean() for name in feet)
    assert sum(result[name].mean() for name in feet) == pytest.approx(expected, rel=0.005)
