"""The main job: the hammer from its CAD export to contact forces."""

from __future__ import annotations

import shutil
import tomllib
import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from fmpy.validation import validate_fmu
from fmu_regression.cases.case import load_case
from fmu_regression.cases.runner import Verdict, run_case
from fmu_regression.compare.checks import SignalCheck
from fmu_regression.fmi.binding import Mode
from fmu_regression.fmi.description import read_description
from fmu_regression.report.case_summary import text_table
from fmu_regression.results.result import SimulationResult, read_csv
from fmu_regression.scene.energy import energy_balance
from fmu_regression.scene.impacts import find_impacts
from fmu_regression.scene.scene_file import Scene, load_scene
from fmu_regression.scene.signals import signals_for
from fmu_regression.simulate.simulation import simulate
from lxml import html
from program import HAMMER, HANGS, Cmb

TRAJECTORY = Path(__file__).with_name("hammer_trajectory.toml")


@pytest.fixture(scope="module")
def scene(hammer: Path) -> Scene:
    return load_scene(hammer / "model" / "scene.json")


@pytest.fixture(scope="module")
def result(hammer: Path) -> SimulationResult:
    return read_csv(hammer / "result.csv")


@pytest.fixture(scope="module")
def expected() -> dict[str, object]:
    """First impact of the free double pendulum, integrated by SciPy at tolerance 1e-10 (make_expected.py)."""
    impact = tomllib.loads((HAMMER / "expected.toml").read_text())["first_impact"]
    assert isinstance(impact, dict)
    return impact


def first_touch(result: SimulationResult, scene: Scene, *bodies: str) -> float:
    pair = next(pair for pair in scene.pairs if set(pair.bodies) == set(bodies))
    touching = result[f"{scene.manager}.normalForce[{pair.index}]"] > 0
    return float(result.time[np.argmax(touching)])


def test_everything_is_written(hammer: Path) -> None:
    assert {"model", "hammer.fmu", "result.csv", "report.html"} <= {entry.name for entry in hammer.iterdir()}
    assert {"package.mo", "Mechanics.mo", "Mechatronics.mo"} <= {
        f.name for f in (hammer / "model" / "Hammer").iterdir()
    }


@pytest.mark.parametrize("tolerance", [1e-6, 1e-8])
def test_first_impact_comes_when_the_double_pendulum_says(
    hammer: Path, scene: Scene, expected: dict[str, object], tolerance: float
) -> None:
    fmu = hammer / "hammer.fmu"
    run = simulate(fmu, signals=signals_for(scene, read_description(fmu)), stop=0.35, tolerance=tolerance)
    assert first_touch(run, scene, "hammerHead", "anvil") == pytest.approx(expected["time"], abs=1e-5)


def test_motion_before_the_impact(result: SimulationResult) -> None:
    for row in tomllib.loads((HAMMER / "expected.toml").read_text())["before_impact"]:
        for joint in ("shoulder", "elbow"):
            angle = np.interp(row["time"], result.time, result[f"{joint}.phi"])
            assert angle == pytest.approx(row[joint], abs=2e-5)


@pytest.mark.parametrize("mode", ["me", "cs"])
def test_trajectories_are_those_of_openmodelica(hammer: Path, mode: Mode) -> None:
    case = load_case(TRAJECTORY)
    # By co-simulation events show at communication points only.
    checks = tuple(check for check in case.checks if mode == "me" or isinstance(check, SignalCheck))
    result = run_case(replace(case, modes=(mode,), checks=checks), hammer / "hammer.fmu", time_limit=HANGS)
    assert result.verdict is Verdict.PASSED, text_table([result])


def test_energy_never_rises(scene: Scene, result: SimulationResult) -> None:
    balance = energy_balance(scene, result)
    assert balance.elastic is not None
    # Bevelled hulls press on each other by shares that are not quite a gradient (docs/engine/limits.md): while the
    # head settles on the anvil the sum rises by 1.0e-6 of the start, at any tolerance of the integrator.
    assert balance.largest_rise <= 2e-6 * abs(balance.total[0])


def test_restitution_at_the_first_impact(scene: Scene, result: SimulationResult) -> None:
    impacts = find_impacts(scene, result)
    blow = next(impact for impact in impacts if set(impact.pair.bodies) == {"hammerHead", "anvil"})
    assert blow.pair.restitution == pytest.approx(0.4)
    # The weight and the arm's inertia act during the contact too, so a few per cent are lost.
    assert blow.restitution == pytest.approx(0.4, abs=0.02)


def test_the_ball_ends_on_the_floor(scene: Scene, result: SimulationResult) -> None:
    height = result["ball.frame_a.r_0[3]"]
    assert height[0] == pytest.approx(0.142, abs=1e-3)
    assert height[-1] == pytest.approx(0.022, abs=1e-4)
    assert first_touch(result, scene, "ball", "floorPlane") > 0.3


def test_the_report_is_one_file_that_works_offline(hammer: Path) -> None:
    page = html.parse(str(hammer / "report.html"))
    links = [value for _, _, value, _ in page.getroot().iterlinks()]
    assert not [link for link in links if link.startswith(("http:", "https:", "//"))]
    assert "hammer head" in page.getroot().text_content()
    assert "restitution" in (hammer / "summary.txt").read_text()


@pytest.mark.full
def test_the_fmu_is_valid(hammer: Path) -> None:
    assert validate_fmu(str(hammer / "hammer.fmu")) == []


def test_the_fmu_runs_elsewhere(hammer: Path, tmp_path: Path, result: SimulationResult) -> None:
    moved = tmp_path / "somewhere else"
    with zipfile.ZipFile(hammer / "hammer.fmu") as archive:
        archive.extractall(moved)
    repacked = shutil.make_archive(str(tmp_path / "moved"), "zip", moved)
    fmu = Path(repacked).rename(tmp_path / "moved.fmu")
    run = simulate(fmu, signals=["shoulder.phi"], stop=0.3, mode="cs")
    assert run["shoulder.phi"][-1] == pytest.approx(np.interp(0.3, result.time, result["shoulder.phi"]), abs=1e-4)


@pytest.mark.full
def test_the_same_input_gives_the_same_bytes(hammer: Path, cmb: Cmb, tmp_path: Path) -> None:
    done = cmb("generate", HAMMER, "--output", tmp_path / "model")
    assert done.returncode == 0, done.stderr
    first, second = hammer / "model", tmp_path / "model"
    files = sorted(path.relative_to(first) for path in first.rglob("*") if path.is_file())
    assert files == sorted(path.relative_to(second) for path in second.rglob("*") if path.is_file())
    assert [f for f in files if (first / f).read_bytes() != (second / f).read_bytes()] == []
    done = cmb("fmu", "Hammer.Mechatronics", "--source", second / "Hammer", "--output", tmp_path / "again.fmu")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "again.fmu").read_bytes() == (hammer / "hammer.fmu").read_bytes()
