"""A report never denies what was not recorded, and never takes another model's scene."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from cmb.main import main
from contact_foundation.errors import InputError
from fmu_regression.report.simulation_report import write_report
from fmu_regression.results.result import SimulationResult, write_csv
from synthetic import hammer, write_scene


def without(result: SimulationResult, *words: str) -> SimulationResult:
    kept = {name: values for name, values in result.signals.items() if not any(word in name for word in words)}
    return SimulationResult(time=result.time, signals=kept, model=result.model)


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (("r_0", "R.T"), "frame_a.r_0[1]"),
        (("R.T",), "frame_a.R.T[1,1]"),
        (("normalForce", "distance"), "contacts.normalForce[1]"),
        (("",), "frame_a.r_0[1]"),
    ],
)
def test_missing_signals_are_named(tmp_path: Path, words: tuple[str, ...], named: str) -> None:
    content, result = hammer(rows=20)
    scene = write_scene(content, tmp_path / "scene.json")
    with pytest.raises(InputError) as caught:
        write_report(without(result, *words), scene, tmp_path / "report.html")
    assert named in str(caught.value)
    assert f"--scene {scene}" in str(caught.value)
    assert not (tmp_path / "report.html").exists()


def test_force_or_distance_is_enough(tmp_path: Path) -> None:
    content, result = hammer(rows=20)
    scene = write_scene(content, tmp_path / "scene.json")
    for word in ("distance", "normalForce"):
        write_report(without(result, word), scene, tmp_path / f"{word}.html")


def test_scene_of_another_model_is_refused(tmp_path: Path) -> None:
    content, result = hammer(rows=20)
    renamed = [{**body, "variable": f"other_{body['variable']}"} for body in content["bodies"]]
    other = write_scene({**content, "bodies": renamed}, tmp_path / "other.json")
    with pytest.raises(InputError, match="belongs to another model"):
        write_report(result, other, tmp_path / "report.html")
    fewer = {**content["contacts"], "pairs": content["contacts"]["pairs"][:1]}
    assert len(content["contacts"]["pairs"]) == 1
    more = dict(result.signals) | {"contacts.normalForce[2]": result["contacts.normalForce[1]"].copy()}
    scene = write_scene({**content, "contacts": fewer}, tmp_path / "fewer.json")
    with pytest.raises(InputError, match=r"normalForce\[2\]"):
        write_report(SimulationResult(time=result.time, signals=more), scene, tmp_path / "report.html")


def test_program_tells_it_with_status_2(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    content, result = hammer(rows=20)
    scene = write_scene(content, tmp_path / "scene.json")
    write_csv(without(result, "frame_a"), tmp_path / "h.csv")
    words = ["report", str(tmp_path / "h.csv"), "--scene", str(scene), "--output", str(tmp_path / "report.html")]
    assert main(words) == 2
    said = capsys.readouterr().err
    assert "the result h: has no" in said
    assert "cmb simulate FMU --scene" in said


def test_number_that_is_none_is_told_with_its_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "a.csv").write_text("time,x\n0,1\n1,NaN\n")
    assert main(["report", str(tmp_path / "a.csv"), "--output", str(tmp_path / "a.html")]) == 2
    assert "a.csv:3: 'NaN' stands where a number belongs" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("signal", "value", "said"),
    [
        ("frame_a.r_0[3]", 1e29, "frame_a.r_0[3] is 1e+29 at"),
        ("frame_a.r_0[1]", -math.inf, "frame_a.r_0[1] is -inf at"),
        ("frame_a.R.T[2,2]", 1e29, "frame_a.R.T at"),
        ("frame_a.R.T[2,2]", 0.0, "is no rotation"),
        ("contacts.normalForce[1]", math.inf, "contacts.normalForce[1] is inf at"),
    ],
)
def test_numbers_that_no_body_has_are_refused(tmp_path: Path, signal: str, value: float, said: str) -> None:
    content, result = hammer(rows=20)
    scene = write_scene(content, tmp_path / "scene.json")
    changed = with_value(result, signal, 7, value)
    with pytest.raises(InputError) as caught:
        write_report(changed, scene, tmp_path / "report.html")
    assert said in str(caught.value)
    assert f"{result.time[7]:.9g} s" in str(caught.value)
    assert not (tmp_path / "report.html").exists()


def test_jump_that_the_speeds_do_not_explain_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    content, result = hammer(rows=20)
    scene = write_scene(content, tmp_path / "scene.json")
    assert write_report(result, scene, tmp_path / "right.html") == ()
    write_csv(with_value(result, "frame_a.r_0[3]", 7, 1e6), tmp_path / "h.csv")
    words = ["report", str(tmp_path / "h.csv"), "--scene", str(scene), "--output", str(tmp_path / "report.html")]
    assert main(words) == 0
    said = capsys.readouterr().err
    assert "jumps by 1e+06 m between" in said
    assert "and 1 more such jump" in said
    assert "jumps by 1e+06 m" in (tmp_path / "report.html").read_text()


def with_value(result: SimulationResult, ending: str, row: int, value: float) -> SimulationResult:
    """The result with one number of the first signal of that ending replaced."""
    signals = {name: values.copy() for name, values in result.signals.items()}
    signals[next(name for name in signals if name.endswith(ending))][row] = value
    return SimulationResult(time=result.time.copy(), signals=signals, model=result.model)
