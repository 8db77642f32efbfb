"""A report never denies what was not recorded, and never takes another model's scene."""

from __future__ import annotations

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
