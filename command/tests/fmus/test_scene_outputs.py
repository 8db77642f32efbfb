"""`--outputs`: what a scene does is recorded by tools that know nothing of it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from cmb.main import main
from contact_foundation.errors import InputError
from fmpy import read_model_description, simulate_fmu
from modelica2fmu.scene.outputs import OutputGroup, output_groups

DROP = """model Drop
  inner Modelica.Mechanics.MultiBody.World world(n={0,0,-1});
  ContactMultiBody.Parts.Body ball(
    m=2, r_CM={0.01,0,0}, I_11=0.004, I_22=0.004, I_33=0.004,
    r_0(start={0,0,1}, each fixed=true), v_0(start={0.5,0,0}, each fixed=true),
    angles_fixed=true, w_0_fixed=true, w_0_start={0,3,0},
    geometry=ContactMultiBody.Shapes.sphere(0.1));
  ContactMultiBody.Parts.Ground floor;
  ContactMultiBody.ContactManager contacts(collider={ball.collider, floor.collider});
equation
  connect(ball.frame_a, contacts.frame[1]);
  connect(floor.frame_a, contacts.frame[2]);
end Drop;
"""


def built(folder: Path, *words: str, text: str = DROP) -> Path:
    name = text.split(None, 2)[1]
    (folder / f"{name}.mo").write_text(text)
    fmu = folder / f"{name}.fmu"
    assert main(["fmu", name, "--source", str(folder / f"{name}.mo"), "--output", str(fmu), *words]) == 0
    return fmu


@pytest.mark.parametrize("fmi", [pytest.param("2", marks=pytest.mark.full), "3"])
def test_another_importer_records_the_scene(tmp_path: Path, fmi: str) -> None:
    fmu = built(tmp_path, "--outputs", "all", "--fmi", fmi)
    outputs = [
        v.name for v in read_model_description(str(fmu), validate=True).modelVariables if v.causality == "output"
    ]
    result = simulate_fmu(str(fmu), stop_time=1.0, output_interval=0.01)  # records outputs by its own choice
    assert set(outputs) == set(result.dtype.names) - {"time"}
    time = result["time"]
    falling = time < 0.42
    center = result["ball.frame_a.r_0[1]"] + 0.01 * result["ball.frame_a.R.T[1,1]"]
    assert center[falling] == pytest.approx(0.01 + 0.5 * time[falling], abs=1e-5)
    assert result["contacts.normalForce[1]"].max() > 100
    assert result["contacts.distance[1]"][0] == pytest.approx(0.9)
    # The spin carries the centre of mass round: its speed at the start is v + w x r.
    speed = np.array([0.5, 0, -3 * 0.01])
    kinetic = 0.5 * 2 * speed @ speed + 0.5 * 0.004 * 9
    assert result["cmbScene.kineticEnergy"][0] == pytest.approx(kinetic, rel=1e-9)
    assert result["cmbScene.potentialEnergy"][0] == pytest.approx(2 * 9.80665 * 1.0, rel=1e-9)
    energy = sum(result[name] for name in ("cmbScene.kineticEnergy", "cmbScene.potentialEnergy"))
    assert energy[falling] == pytest.approx(energy[0], rel=1e-6)
    assert (energy + result["contacts.elasticEnergy"]).max() < energy[0] * (1 + 1e-5)


@pytest.mark.full
def test_groups_are_chosen_one_by_one(tmp_path: Path) -> None:
    fmu = built(tmp_path, "--outputs", "poses")
    names = {v.name for v in read_model_description(str(fmu)).modelVariables if v.causality == "output"}
    positions = {f"ball.frame_a.r_0[{i}]" for i in (1, 2, 3)}
    assert names == positions | {f"ball.frame_a.R.T[{i},{j}]" for i in (1, 2, 3) for j in (1, 2, 3)}


def test_what_is_not_there_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = "model Plain\n  Real x(start = 1, fixed = true);\nequation\n  der(x) = -x;\nend Plain;\n"
    (tmp_path / "Plain.mo").write_text(text)
    words = ["fmu", "Plain", "--source", str(tmp_path / "Plain.mo"), "--output", str(tmp_path / "p.fmu")]
    assert main([*words, "--outputs", "forces"]) == 2
    assert "Plain: the model has no contact manager" in capsys.readouterr().err
    assert not (tmp_path / "p.fmu").exists()
    assert main([*words, "--outputs", "forces,torques"]) == 2
    assert "'torques' is no group of outputs" in capsys.readouterr().err


def test_names_of_groups() -> None:
    assert output_groups("forces, poses") == (OutputGroup.POSES, OutputGroup.FORCES)
    assert output_groups("all") == tuple(OutputGroup)
    with pytest.raises(InputError):
        output_groups("")
