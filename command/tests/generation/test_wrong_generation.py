"""Choices of a generation that cannot be, told plainly: names of packages, distances, folders instead of meshes."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from cmb.main import main
from program import HAMMER

LINK = (
    '<link name="a"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
    "{}</link>"
)


def robot(folder: Path, inner: str) -> Path:
    file = folder / "robot.urdf"
    file.write_text(f'<robot name="r">{LINK.format(inner)}</robot>')
    return file


def refusal(capsys: pytest.CaptureFixture[str], output: Path, *words: str) -> str:
    assert main(["generate", *words, "--output", str(output)]) == 2
    assert not output.exists()
    return capsys.readouterr().err


@pytest.mark.parametrize("name", ["Modelica", "ContactMultiBody", "2Robots", "my robot", "model"])
def test_package_name_that_cannot_be_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str) -> None:
    said = refusal(capsys, tmp_path / "out", str(robot(tmp_path, "")), "--package", name)
    assert f"{name!r} cannot be the package's name" in said
    assert "such as" in said


def test_position_beyond_reach_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    box = '<visual><origin xyz="1e29 0 0"/><geometry><box size="1 1 1"/></geometry></visual>'
    said = refusal(capsys, tmp_path / "out", str(robot(tmp_path, box)))
    assert "geometry of part 'a' is 1e+29 m away" in said


def test_folder_in_the_place_of_a_mesh_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "mesh.stl").mkdir()
    mesh = '<visual><geometry><mesh filename="mesh.stl"/></geometry></visual>'
    assert "is a folder, not a file" in refusal(capsys, tmp_path / "out", str(robot(tmp_path, mesh)))


def test_no_warning_of_python_reaches_the_user(tmp_path: Path) -> None:
    program = "import sys, warnings; import cmb.main as m; r = m.build_parser\n"
    program += "def warn():\n    warnings.warn('raw', RuntimeWarning)\n    return r()\n"
    program += "m.build_parser = warn\nsys.exit(m.main(sys.argv[1:]))"
    words = [sys.executable, "-c", program, "generate", str(HAMMER / "absent.xml"), "--output", str(tmp_path / "out")]
    done = subprocess.run(words, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 2
    assert "Warning" not in done.stderr
    asked = subprocess.run(
        [words[0], "-W", "always", *words[1:]], capture_output=True, text=True, timeout=120, check=False
    )
    assert "RuntimeWarning: raw" in asked.stderr
