"""An FMU of FMI 3.0 does what that of FMI 2.0 does, from the command line to the CSV."""

from __future__ import annotations

from pathlib import Path

import pytest
from fmu_regression.fmi.description import read_description
from fmu_regression.results.result import read_csv
from program import Cmb

MODEL = "ContactMultiBody.Examples.BallOnFloor"


@pytest.fixture(scope="module")
def fmus(cmb: Cmb, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    folder = tmp_path_factory.mktemp("versions")
    for version in ("2", "3"):
        done = cmb("fmu", MODEL, "--fmi", version, "--output", f"ball{version}.fmu", cwd=folder)
        assert done.returncode == 0, done.stderr
    return {version: folder / f"ball{version}.fmu" for version in ("2", "3")}


def test_the_descriptions_say_the_same(fmus: dict[str, Path]) -> None:
    two, three = (read_description(fmus[version]) for version in ("2", "3"))
    assert (two.fmi, three.fmi) == ("2.0", "3.0")
    assert two.states == three.states
    assert two.indicator_count == three.indicator_count > 0
    assert (two.stop, two.tolerance, two.interval) == (three.stop, three.tolerance, three.interval)
    own = {name for name in three.variables if name not in two.variables}
    assert own == {"time", *(f"cmbIndicator[{k + 1}]" for k in range(three.indicator_count))}
    for name, variable in two.variables.items():
        other = three.variables[name]
        assert (other.kind, other.unit) == (variable.kind, variable.unit)


@pytest.mark.full
@pytest.mark.parametrize("mode", ["me", pytest.param("cs", marks=pytest.mark.full)])
def test_the_trajectories_are_the_same(mode: str, fmus: dict[str, Path], cmb: Cmb, tmp_path: Path) -> None:
    signals = ("ball.r_0[3]", "ball.v_0[3]", "contacts.touches[1]", "contacts.normalForce[1]")
    results = []
    for version, fmu in fmus.items():
        words = [word for signal in signals for word in ("--signal", signal)]
        words += ["--set", "e=0.5", "--set", "contacts.stiffness[1]=2e6", "--time-limit", "60"]
        output = tmp_path / f"{version}.csv"
        done = cmb("simulate", fmu, "--mode", mode, "--stop", "1.5", "--output", output, *words, cwd=tmp_path)
        assert done.returncode == 0, done.stderr
        results.append(read_csv(output))
    two, three = results
    assert two.time.tobytes() == three.time.tobytes()
    for signal in signals:
        assert two[signal].tobytes() == three[signal].tobytes()
    assert two["contacts.touches[1]"].max() == 1
