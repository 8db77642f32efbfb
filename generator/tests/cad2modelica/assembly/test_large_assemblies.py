"""Large assemblies: nothing recurses along chains, nothing is lost."""

from __future__ import annotations

import re
import sys
from pathlib import Path

from assembly_text import joint, part, write_assembly
from cad2modelica import generate
from synthetic_assembly import write_chains


def test_chain_longer_than_the_recursion_limit(tmp_path: Path) -> None:
    count = sys.getrecursionlimit() + 100
    parts = [part(f"link {number}", position=(0, 0, -number)) for number in range(count)]
    joints = [
        joint(
            f"pin {number}",
            "revolute",
            f"link {number - 1}" if number else "ground",
            f"link {number}",
            origin=(0, 0, -number),
            axis=(0, 1, 0),
        )
        for number in range(count)
    ]
    package = generate(write_assembly(tmp_path / "chain.xml", parts, joints, name="Chain"), tmp_path / "out")
    text = (package.root / "Mechanics.mo").read_text()
    assert len(re.findall(r"Joints\.Revolute \w+\(", text)) == count
    assert len(re.findall(r"Parts\.Body \w+\(", text)) == count


def test_synthetic_chains_keep_only_pairs_that_can_meet(tmp_path: Path) -> None:
    """Chains of 120 mm, 500 mm apart, 1.9 m over the floor: boxes meet within their own chain alone."""
    package = generate(write_chains(tmp_path, 40, 3), tmp_path / "out")
    text = (package.root / "Mechanics.mo").read_text()
    pairs = re.search(r"pairs=\{(.*)\}", text)
    assert pairs is not None
    assert len(re.findall(r"\{\d+,\d+\}", pairs[1])) == 13  # first and third of 13 chains of three
