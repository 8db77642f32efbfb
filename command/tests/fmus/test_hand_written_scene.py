"""A hand-written model gets animation, contacts and energy in its report: the FMU tells its scene."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from cmb.main import main
from contact_data import checkout
from fmu_regression.results.result import read_csv
from fmu_regression.scene.body_loads import body_loads
from fmu_regression.scene.fmu_scene import scene_of_fmu

README = checkout() / "README.md"
TWO = """model Two
  inner Modelica.Mechanics.MultiBody.World world(n={0,0,-1});
  ContactMultiBody.Parts.BodyBox box(
    r={0.2,0,0}, width=0.2, height=0.2, r_0(start={-0.1,0,0.5}, each fixed=true), v_0(each fixed=true),
    angles_fixed=true, w_0_fixed=true);
  ContactMultiBody.Parts.Ground floor(r={0,0,0.1});
  ContactMultiBody.ContactManager contacts(collider={box.collider, floor.collider});
equation
  connect(box.frame_a, contacts.frame[1]);
  connect(floor.frame_a, contacts.frame[2]);
end Two;
"""

# The box is seen from its frame_b, which is turned and lies beside its centre of mass; the step has no other frame.
SEEN_FROM_B = """model SeenFromB
  inner Modelica.Mechanics.MultiBody.World world(n={0,0,-1});
  Modelica.Mechanics.MultiBody.Joints.Prismatic slide(n={0,0,1}, s(start=0.2, fixed=true), v(fixed=true));
  Modelica.Mechanics.MultiBody.Parts.BodyShape box(m=2, r={0.1,0,0}, r_CM={0.05,0,0}, I_11=1, I_22=2, I_33=3);
  ContactMultiBody.Parts.Fixed step(r={0.1,0,0.1}, geometry=ContactMultiBody.Shapes.box({0.2,0.2,0.2}));
  ContactMultiBody.ContactManager contacts(
    n=2, geometry={ContactMultiBody.Shapes.sphere(0.02), step.geometry}, pairs={{1,2}},
    material={ContactMultiBody.Materials.Steel(), step.material});
equation
  connect(world.frame_b, slide.frame_a);
  connect(slide.frame_b, box.frame_a);
  connect(box.frame_b, contacts.frame[1]);
  connect(step.frame_b, contacts.frame[2]);
end SeenFromB;
"""


def built(folder: Path, name: str, text: str, *words: str) -> Path:
    (folder / f"{name}.mo").write_text(text)
    fmu = folder / f"{name}.fmu"
    assert main(["fmu", name, "--source", str(folder / f"{name}.mo"), "--output", str(fmu), *words]) == 0
    return fmu


@pytest.mark.parametrize("fmi", [pytest.param("2", marks=pytest.mark.full), "3"])
def test_the_readmes_drop_is_reported_as_a_generated_model(tmp_path: Path, fmi: str) -> None:
    text = README.read_text().split("```modelica\n")[1].split("```")[0]
    fmu = built(tmp_path, "Drop", text, "--fmi", fmi)
    scene = scene_of_fmu(fmu)
    ball, floor = scene.bodies
    assert (ball.variable, ball.fixed, ball.mass) == ("ball", False, 1.0)
    assert (floor.variable, floor.fixed) == ("floor", True)
    assert ball.position == pytest.approx([0, 0, 1])
    assert np.diag(ball.inertia) == pytest.approx([0.004] * 3)
    assert scene.gravity == pytest.approx([0, 0, -9.80665], abs=1e-2)
    (pair,) = scene.pairs
    assert pair.bodies == ("ball", "floor")
    assert np.abs(ball.meshes[0].vertices).max() == pytest.approx(0.1)
    csv, html = tmp_path / "drop.csv", tmp_path / "drop.html"
    assert main(["simulate", str(fmu), "--output", str(csv), "--stop", "1", "--scene", str(fmu)]) == 0
    assert main(["report", str(csv), "--scene", str(fmu), "--output", str(html)]) == 0
    page = html.read_text()
    for word in ("ball – floor", "Energy", "Impacts", "viewer"):
        assert word in page


@pytest.mark.full
def test_masses_inside_and_poses_of_fixed_bodies(tmp_path: Path) -> None:
    box, floor = scene_of_fmu(built(tmp_path, "Two", TWO)).bodies
    assert box.variable == "box"
    assert box.mass > 1
    assert box.center_of_mass == pytest.approx([0.1, 0, 0])
    assert np.diag(box.inertia) == pytest.approx([box.mass * 0.08 / 12] * 3)
    assert (floor.fixed, floor.position.tolist()) == (True, [0, 0, 0.1])


def test_an_fmu_without_contacts_has_no_scene(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    fmu = built(tmp_path, "Plain", "model Plain\n  Real x(start=1, fixed=true);\nequation\n  der(x)=-x;\nend Plain;\n")
    assert main(["simulate", str(fmu), "--output", str(tmp_path / "p.csv"), "--scene", str(fmu)]) == 2
    assert "has no contact manager" in capsys.readouterr().err


@pytest.mark.full
def test_a_manager_that_tells_no_pairs_shows_the_force_on_each_body(tmp_path: Path) -> None:
    """The box comes to rest on the floor, which then carries its weight."""
    fmu = built(tmp_path, "Two", TWO.replace("ContactManager contacts(", "CompiledContactManager contacts(n=2, "))
    scene = scene_of_fmu(fmu)
    assert (scene.colliders, scene.pairs) == (("box", "floor"), ())
    csv, html = tmp_path / "d.csv", tmp_path / "d.html"
    assert main(["simulate", str(fmu), "--output", str(csv), "--stop", "3", "--scene", str(fmu)]) == 0
    box, floor = body_loads(scene, read_csv(csv))
    weight = scene.bodies[0].mass * 9.80665
    assert box.strength[-1] == pytest.approx(weight, rel=1e-3)
    assert floor.strength == pytest.approx(box.strength)
    assert main(["report", str(csv), "--scene", str(fmu), "--output", str(html)]) == 0
    page = html.read_text()
    for word in ("Bodies touched", "the sum of all contact forces on each body", "elastic, in the contacts", "viewer"):
        assert word in page


def test_bodies_inside_a_component_are_no_scene(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A report would deny their contacts."""
    balls = "model Balls\n  ContactMultiBody.Parts.FreeBodies balls(bodyCount=2);\nend Balls;\n"
    fmu = built(tmp_path, "Balls", balls)
    assert main(["simulate", str(fmu), "--output", str(tmp_path / "d.csv"), "--scene", str(fmu)]) == 2
    message = capsys.readouterr().err
    assert "balls" in message
    assert "holds its bodies itself" in message
    assert not (tmp_path / "d.csv").exists()


@pytest.mark.full
def test_bodies_may_be_connected_by_their_frame_b(tmp_path: Path) -> None:
    fmu = built(tmp_path, "SeenFromB", SEEN_FROM_B)
    box, step = scene_of_fmu(fmu).bodies
    assert (box.variable, box.frame, box.fixed, box.mass) == ("box", "frame_b", False, 2.0)
    assert box.position == pytest.approx([0.1, 0, 0.2])
    assert box.center_of_mass == pytest.approx([-0.05, 0, 0])
    assert np.diag(box.inertia) == pytest.approx([1, 2, 3])
    assert (step.variable, step.frame, step.fixed) == ("step", "frame_b", True)
    assert step.position == pytest.approx([0.1, 0, 0.1])
    csv, html = tmp_path / "b.csv", tmp_path / "b.html"
    assert main(["simulate", str(fmu), "--output", str(csv), "--stop", "0.1", "--scene", str(fmu)]) == 0
    assert main(["report", str(csv), "--scene", str(fmu), "--output", str(html)]) == 0
    assert "box – step" in html.read_text()
