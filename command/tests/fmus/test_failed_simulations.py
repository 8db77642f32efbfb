"""Simulations that fail say what failed and why in a few lines, and what is out of bounds is refused."""

from __future__ import annotations

from pathlib import Path

import pytest
from cmb.main import main
from contact_foundation.errors import InputError
from fmpy import simulate_fmu
from modelica2fmu.build import BuildOptions, build_fmu

BLOWS_UP = "model Blow\n  Real x(start = 1, fixed = true);\nequation\n  der(x) = x^2;\nend Blow;\n"
DEAD_CENTRE = """model Dead
  Real x(start = 0, fixed = true), y(start = 1);
equation
  der(x) = 1;
  x^2 + y^2 = 1;
end Dead;
"""
BODY = """model Weight
  type Mass = Real(unit = "kg", min = 0);
  model Part
    parameter Mass m;
    parameter Integer teeth(max = 3) = 2;
    Real v(start = 0, fixed = true);
  equation
    m*der(v) = -9.81*m + teeth;
  end Part;
  Part part(
    m = 2);
end Weight;
"""


def written(folder: Path, text: str) -> Path:
    file = folder / f"{text.split(None, 2)[1]}.mo"
    file.write_text(text)
    return file


@pytest.fixture(scope="module")
def weight(tmp_path_factory: pytest.TempPathFactory, fmu_cache: Path) -> Path:
    folder = tmp_path_factory.mktemp("weight")
    build_fmu("Weight", [written(folder, BODY)], folder / "w.fmu", BuildOptions(cache=fmu_cache))
    return folder / "w.fmu"


@pytest.fixture(scope="module")
def blow(tmp_path_factory: pytest.TempPathFactory, fmu_cache: Path) -> Path:
    folder = tmp_path_factory.mktemp("blow")
    return build_fmu("Blow", [written(folder, BLOWS_UP)], folder / "b.fmu", BuildOptions(cache=fmu_cache)).fmu


@pytest.mark.parametrize("mode", ["me", "cs"])
def test_a_solution_that_grows_without_bound(
    tmp_path: Path, blow: Path, capfd: pytest.CaptureFixture[str], mode: str
) -> None:
    assert main(["simulate", str(blow), "--output", str(tmp_path / "b.csv"), "--stop", "2", "--mode", mode]) == 1
    said = capfd.readouterr()
    told = said.out + said.err
    assert len(told.splitlines()) <= 2
    assert "x = " in told
    for word in ("/home", "CV_", "sundials", "cvode.c"):
        assert word not in told


@pytest.fixture(scope="module")
def dead(tmp_path_factory: pytest.TempPathFactory, fmu_cache: Path) -> Path:
    folder = tmp_path_factory.mktemp("dead")
    return build_fmu("Dead", [written(folder, DEAD_CENTRE)], folder / "d.fmu", BuildOptions(cache=fmu_cache)).fmu


@pytest.mark.parametrize("mode", ["me", "cs"])
def test_a_dead_centre_is_told_as_one(tmp_path: Path, dead: Path, capfd: pytest.CaptureFixture[str], mode: str) -> None:
    assert main(["simulate", str(dead), "--output", str(tmp_path / "d.csv"), "--stop", "2", "--mode", mode]) == 1
    told = capfd.readouterr().err
    assert "is singular at time" in told
    assert "the equation in Dead.mo, line 5, holds" in told
    assert "dead centre" in told
    assert "status 2" not in told


@pytest.mark.parametrize(
    ("old", "new", "line", "said"),
    [
        ("m = 2", "m = -1", 11, "part.m is -1 kg, less than its min of 0"),
        ("teeth(max = 3) = 2", "teeth(max = 3) = 4", 5, "part.teeth is 4, more than its max of 3"),
    ],
)
def test_bounds_at_build(tmp_path: Path, old: str, new: str, line: int, said: str) -> None:
    with pytest.raises(InputError) as caught:
        build_fmu("Weight", [written(tmp_path, BODY.replace(old, new))], tmp_path / "w.fmu")
    assert caught.value.message == said
    assert caught.value.place is not None
    assert (caught.value.place.file, caught.value.place.line) == (tmp_path / "Weight.mo", line)


@pytest.mark.parametrize(
    ("name", "value", "said"),
    [("part.m", -1.0, "part.m cannot be set to -1: its min is 0"), ("part.teeth", 4, "part.teeth cannot be set to 4")],
)
def test_bounds_in_the_fmu(weight: Path, name: str, value: float, said: str) -> None:
    told: list[str] = []

    def log(_environment: object, _name: bytes, _status: int, _category: bytes, message: bytes) -> None:
        told.append(message.decode())

    with pytest.raises(Exception, match=r"fmi2Set"):
        simulate_fmu(
            str(weight), stop_time=1.0, start_values={name: value}, logger=log, apply_default_start_values=True
        )
    assert any(said in message for message in told)


def test_values_within_bounds_are_taken(weight: Path) -> None:
    result = simulate_fmu(str(weight), stop_time=1.0, start_values={"part.m": 0.5, "part.teeth": 3}, output=["part.v"])
    assert result["part.v"][-1] == pytest.approx(-9.81 + 3 / 0.5, abs=1e-6)
