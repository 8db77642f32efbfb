"""`cmb run` tells what was chosen and left out, which nobody would look for in a page."""

from __future__ import annotations

from pathlib import Path

from program import Cmb

BALL = """<robot name="ball"><link name="a">
  <inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
  <visual><geometry><box size="0 0 0"/></geometry></visual></link></robot>"""


def test_notes_stand_before_the_summary(cmb_here: Cmb, tmp_path: Path) -> None:
    (tmp_path / "ball.urdf").write_text(BALL)
    done = cmb_here("run", "ball.urdf", "--stop", "0.01", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    notes, summary = done.stdout.split("Ball.Mechatronics:", 1)
    assert "- link 'a' is the root and moves freely; --ground a holds it\n" in notes
    assert "- link 'a': visual geometry left out:" in notes
    assert "0.01 s simulated" in summary
