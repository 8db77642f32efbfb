"""`cmb effects` and `cmb advise` as a user runs them."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from program import Cmb

# A ball that falls straight down beside another one that hangs in the air: friction does nothing, one of three pairs
# touches, and the ball needs one point.
SCENE = """\
model Drop "A ball falls beside a fixed one"
  inner Modelica.Mechanics.MultiBody.World world(n={0,0,-1});
  ContactMultiBody.Parts.Body ball(
    m=1, r_CM={0,0,0}, I_11=0.004, I_22=0.004, I_33=0.004,
    r_0(start={0,0,0.3}, each fixed=true), v_0(each fixed=true), angles_fixed=true, w_0_fixed=true,
    geometry=ContactMultiBody.Shapes.sphere(0.1));
  ContactMultiBody.Parts.Ground floor;
  ContactMultiBody.Parts.Ground lamp(r={2,0,1}, geometry=ContactMultiBody.Shapes.sphere(0.1));
  ContactMultiBody.ContactManager contacts(
    n=3, geometry={ball.geometry, floor.geometry, lamp.geometry},
    material={ball.material, floor.material, lamp.material}, pointCapacity=1,
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given, stiffness=fill(1e6, 3));
equation
  connect(ball.frame_a, contacts.frame[1]);
  connect(floor.frame_a, contacts.frame[2]);
  connect(lamp.frame_a, contacts.frame[3]);
  annotation (experiment(StopTime=0.4, Tolerance=1e-6, Interval=0.002));
end Drop;
"""


@pytest.mark.full
@pytest.mark.usefixtures("engine")
def test_table_of_the_incline(cmb: Cmb, tmp_path: Path) -> None:
    done = cmb("effects", "--effect", "friction", "--stop", "1", "--output", "effects.html", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    rows = {line[:22].strip(): line[22:].split() for line in done.stdout.splitlines()[1:]}
    heading = ["equations", "states", "indicators", "systems", "lines", "evaluations", "steps", "events"]
    assert rows["variant"][: len(heading)] == heading
    # Anchored friction has six states a pair, the other laws none.
    assert int(rows["everything on"][1]) - int(rows["friction none"][1]) == 6
    assert rows["friction regularised"][1] == rows["friction none"][1]
    # The box slides; friction mu = 0.3 at 17.4 degrees keeps it back by mu g cos(angle) t^2/2.
    behind = 0.5 * 0.3 * 9.81 * math.cos(math.radians(17.4))
    assert float(rows["friction none"][-2]) == pytest.approx(1000 * behind, rel=0.01)
    # The model has regularised friction.
    assert rows["as modelled"][-2:] == rows["friction regularised"][-2:]
    assert "friction=ContactMultiBody.Types.Friction.None" in (tmp_path / "effects.html").read_text()


@pytest.mark.full
@pytest.mark.usefixtures("engine")
def test_advice_on_a_users_model(cmb: Cmb, tmp_path: Path) -> None:
    (tmp_path / "Drop.mo").write_text(SCENE)
    done = cmb("advise", "Drop", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    text = done.stdout
    assert "Friction: can be less." in text
    assert "Write: contacts(friction=ContactMultiBody.Types.Friction.None)" in text
    # sqrt(2 g 0.2 m) = 1.98 m/s
    assert "Restitution: fits. 1 contact starts in this time, the fastest at 1.98 m/s (ball – floor)" in text
    assert "2 of 3 pairs stay apart" in text
    assert "without any contact: lamp" in text
    assert "Points a pair: fits. At most 1 point carries" in text
    together = text.split("All that can go, together:")[1]
    assert "event indicators 6 → 2" in together
    assert "pairs={{1,2}}" in together
    assert sorted(entry.name for entry in tmp_path.iterdir()) == ["Drop.mo"]


@pytest.mark.parametrize("command", ["effects", pytest.param("advise", marks=pytest.mark.full)])
def test_wrong_input(command: str, cmb_here: Cmb, tmp_path: Path) -> None:
    (tmp_path / "Decay.mo").write_text(
        'model Decay "Has no bodies"\n  Real x(start=1, fixed=true);\nequation\n  der(x) = -x;\nend Decay;\n'
    )
    for words, said in (
        (["No.Such.Model"], "No"),
        (["ContactMultiBody.Examples.NoSuchExample"], "NoSuchExample"),
        (["Decay"], "no ContactMultiBody.ContactManager"),
    ):
        done = cmb_here(command, *words, cwd=tmp_path)
        assert done.returncode == 2, done.stderr
        assert said in done.stderr
        assert "Traceback" not in done.stderr
        assert done.stdout == ""
    assert [entry.name for entry in tmp_path.iterdir()] == ["Decay.mo"]
