"""Writes fixtures/two_loops.xml: eight bodies and nine joints that make two planar loops and an open chain."""

from __future__ import annotations

from pathlib import Path

from assembly_text import joint, part, write_assembly

ACROSS = (0, 1, 0)
POINTS = {
    "a": (0, 0, 0),
    "b": (0.1, 0, 0.2),
    "c": (0.3, 0, 0.25),
    "d": (0.4, 0, 0),
    "e": (0.35, 0, 0.4),
    "f": (0.7, 0, 0.3),
    "g": (0.6, 0, 0),
}


def write(file: Path) -> Path:
    """A frame, a four-bar linkage, a second loop on its coupler, and an arm with a hand on the second lever."""
    parts = [
        part("frame").replace("<part ", '<part grounded="true" '),
        part("crank", center=(0.05, 0, 0.1)),
        part("coupler", position=POINTS["b"], center=(0.15, 0, 0.08)),
        part("rocker", position=POINTS["d"], center=(-0.05, 0, 0.12)),
        part("link", position=POINTS["e"], center=(0.17, 0, -0.05)),
        part("lever", position=POINTS["g"], center=(0.05, 0, 0.15)),
        part("arm", position=(0.7, 0.1, 0.3), center=(0.1, 0, 0)),
        part("hand", position=(0.9, 0.1, 0.3), mass=0.3),
    ]
    joints = [
        joint("crank bearing", "revolute", "frame", "crank", origin=POINTS["a"], axis=ACROSS, start='speed="1.5"'),
        joint("crank pin", "revolute", "crank", "coupler", origin=POINTS["b"], axis=ACROSS),
        joint("coupler pin", "revolute", "coupler", "rocker", origin=POINTS["c"], axis=ACROSS),
        joint("rocker bearing", "revolute", "frame", "rocker", origin=POINTS["d"], axis=ACROSS),
        joint("link pin", "revolute", "coupler", "link", origin=POINTS["e"], axis=ACROSS),
        joint("lever pin", "revolute", "link", "lever", origin=POINTS["f"], axis=ACROSS),
        joint("lever bearing", "revolute", "frame", "lever", origin=POINTS["g"], axis=ACROSS),
        joint("shoulder", "revolute", "lever", "arm", origin=(0.7, 0.1, 0.3), axis=(0, 0, 1)),
        joint("rail", "prismatic", "arm", "hand", origin=(0.9, 0.1, 0.3), axis=(1, 0, 0)),
    ]
    return write_assembly(file, parts, joints, name="TwoLoops")


if __name__ == "__main__":
    write(Path(__file__).parent / "fixtures" / "two_loops.xml")
