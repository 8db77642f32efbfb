"""Diagrams: components and their names keep apart."""

from __future__ import annotations

import itertools
import re
from pathlib import Path

import pytest
from assembly_text import joint, part, write_assembly
from cad2modelica import generate
from mechanics_simulation import ROOT

LETTER = 0.6  # width of a letter by its height, as usual in sans-serif fonts
HEIGHT = 0.4  # of a name by half of its component's size: 40 of 100 in the icons' coordinates


def boxes(text: str) -> dict[str, tuple[float, float, float, float]]:
    """Every component with its name over it: left, bottom, right, top."""
    pattern = r"^  (?:inner )?[\w.]+ (\w+)\b[^;]*?extent=\{\{(-?\d+),(-?\d+)\},\{(-?\d+),(-?\d+)\}\}"
    found = {}
    for name, *numbers in re.findall(pattern, text, flags=re.MULTILINE):
        left, bottom, right, top = map(float, numbers)
        half, middle = (right - left) / 2, (left + right) / 2
        wide = max(half, len(name) * LETTER * HEIGHT * half / 2)
        found[name] = (middle - wide, bottom, middle + wide, top + HEIGHT * half)
    return found


def long_names(folder: Path) -> Path:
    """Two arms of long names, with stops and friction at all joints."""
    parts, joints = [], []
    extra = '<limits upper="1"/><friction viscous="0.1"/>'
    for side in ("left", "right"):
        before = "ground"
        for k in range(4):
            name = f"{side} telescopic segment number {k}"
            parts.append(part(name, position=(0.3 * k, 0.1, 0)))
            bearing = f"{side} spherical roller bearing {k}"
            joints.append(joint(bearing, "revolute", before, name, origin=(0.3 * k, 0, 0), axis=(0, 1, 0), extra=extra))
            before = name
    return write_assembly(folder / "long.xml", parts, joints)


@pytest.mark.parametrize("source", ["anton", "long names"])
def test_names_do_not_overlap(tmp_path: Path, source: str) -> None:
    file = ROOT / "Resources" / "cad" / "anton" / "anton.xml" if source == "anton" else long_names(tmp_path)
    package = generate(file, tmp_path / "out")
    found = boxes((package.root / "Mechanics.mo").read_text())
    assert len(found) > 30
    for (first, (a, b, c, d)), (second, (e, f, g, h)) in itertools.combinations(found.items(), 2):
        assert c <= e or g <= a or d <= f or h <= b, f"{first} and {second}"


def test_short_names_keep_the_usual_spacing(tmp_path: Path) -> None:
    parts = [part("a", position=(0.1, 0, 0)), part("b", position=(0.4, 0, 0))]
    joints = [
        joint("i", "revolute", "ground", "a", origin=(0.1, 0, 0), axis=(0, 1, 0)),
        joint("j", "revolute", "a", "b", origin=(0.4, 0, 0), axis=(0, 1, 0)),
    ]
    file = write_assembly(tmp_path / "short.xml", parts, joints)
    found = boxes((generate(file, tmp_path / "out").root / "Mechanics.mo").read_text())
    assert (found["j"][0] - found["i"][0]) % 20 == 0
    assert 40 <= found["j"][0] - found["i"][0] <= 80
