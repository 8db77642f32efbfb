"""Angles in the wrong unit are noted; angles that are right are not."""

from __future__ import annotations

from pathlib import Path

import pytest
from assembly_text import joint, part, write_assembly
from cad2modelica import read_assembly


def notes(folder: Path, unit: str, angles: list[str], element: str = "axisAngle") -> list[str]:
    parts = [part(f"p{k}", position=(k, 0, 0)) for k in range(len(angles))]
    hinge = joint("hinge", "revolute", "ground", "p0", axis=(0, 0, 1))
    file = write_assembly(folder / "angles.xml", parts, [hinge])
    text = file.read_text().replace('angle="rad"/>', f'angle="{unit}"/>', 1)
    for angle in angles:
        new = f'<axisAngle axis="0 0 1" angle="{angle}"/>'
        if element == "rollPitchYaw":
            new = f"<rollPitchYaw>0 {angle} 0</rollPitchYaw>"
        text = text.replace('<axisAngle axis="0.0 0.0 1.0" angle="0.0"/>', new, 1)
    file.write_text(text)
    return [note for note in read_assembly(file).notes if "angle" in note]


@pytest.mark.parametrize("element", ["axisAngle", "rollPitchYaw"])
def test_degrees_taken_for_radians(tmp_path: Path, element: str) -> None:
    (note,) = notes(tmp_path, "rad", ["1.5", "90", "-45"], element)
    assert "90 rad is 14.3 turns; are angles in degrees? 'units' says 'rad' (and 1 more)" in note
    assert note.startswith("line ")


@pytest.mark.parametrize("angle", ["1.5708", "-0.785398", "3.14159265", "0.261799387799"])
def test_radians_taken_for_degrees(tmp_path: Path, angle: str) -> None:
    (note,) = notes(tmp_path, "deg", [angle])
    assert "are angles in radians? 'units' says 'deg'" in note


@pytest.mark.parametrize("angle", ["0", "1", "1.57", "0.5", "3.1", "-75", "90", "359.99", "1.2345", "12.566371"])
def test_angles_in_degrees_that_are_right(tmp_path: Path, angle: str) -> None:
    assert notes(tmp_path, "deg", [angle]) == []


@pytest.mark.parametrize("angle", ["0", "1.5707963", "-3.14159265358979", "6.283185307", "0.1"])
def test_angles_in_radians_that_are_right(tmp_path: Path, angle: str) -> None:
    assert notes(tmp_path, "rad", [angle]) == []
