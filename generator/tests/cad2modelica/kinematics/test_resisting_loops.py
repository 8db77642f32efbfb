"""Planar loops in which every joint has friction or stops: the one that closes the loop brakes as all others do."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from assembly_text import joint, part, write_assembly
from cad2modelica import generate
from mechanics_simulation import simulate

CRANK, COUPLER = 0.3, 0.5
MASSES = (0.7, 1.1, 0.9)
INERTIA = 0.01
VISCOUS = 0.05
SPEED = 2.0


def parallelogram(folder: Path, inside: str, turn: float, *, closing: str = "") -> Path:
    """Two cranks and a coupler in the horizontal plane, all parts turned about a slanted axis in their own."""
    slant, moments = ((1, 2, 2), turn), (INERTIA, INERTIA, INERTIA)
    ends = {"left": (0, 0, 0), "right": (COUPLER, 0, 0), "coupler": (0, CRANK, 0)}
    parts = [
        part(name, position=ends[name], turn=slant, mass=mass, inertia=moments)
        for name, mass in zip(ends, MASSES, strict=True)
    ]
    hinges = [("pivot", "ground", "left", (0, 0, 0)), ("elbow", "left", "coupler", (0, CRANK, 0))]
    hinges += [("wrist", "coupler", "right", (COUPLER, CRANK, 0)), ("stand", "ground", "right", (COUPLER, 0, 0))]
    begin = {"pivot": f'position="0" speed="{SPEED}"'}
    what = {"stand": closing or inside}
    joints = [
        joint(
            name,
            "revolute",
            first,
            second,
            origin=origin,
            axis=(0, 0, 1),
            start=begin.get(name, ""),
            extra=what.get(name, inside),
        )
        for name, first, second, origin in hinges
    ]
    return write_assembly(folder / "loop.xml", parts, joints, gravity=(0, 0, -9.81), name="Loop")


@pytest.mark.full
@pytest.mark.parametrize("turn", [0.0, 0.9])
def test_friction_of_all_joints_brakes(tmp_path: Path, turn: float) -> None:
    """All four turn as fast as the crank: J w' = -4 d w."""
    package = generate(parallelogram(tmp_path, f'<friction viscous="{VISCOUS}"/>', turn), tmp_path / "out")
    assert any("'stand' closes a planar loop and keeps its coordinate" in note for note in package.notes)
    found = simulate(tmp_path / "out", package.mechanics, 0.5, 0.05)
    moment = 2 * INERTIA + MASSES[2] * CRANK**2  # both cranks turn about their own centres; the coupler's only shifts
    expected = SPEED * np.exp(-4 * VISCOUS / moment * found.time)
    assert expected[-1] < 0.5 * SPEED
    np.testing.assert_allclose(found.columns["pivot.w"], expected, atol=2e-6)
    np.testing.assert_allclose(found.columns["stand.w"], expected, atol=2e-6)
    np.testing.assert_allclose(found.columns["elbow.w"], -expected, atol=2e-6)


@pytest.mark.full
def test_stops_of_the_closing_joint_act(tmp_path: Path) -> None:
    limits = '<limits lower="-1" upper="0.2"/>'
    wide = '<limits lower="-3" upper="3"/>'
    package = generate(parallelogram(tmp_path, wide, 0.4, closing=limits), tmp_path / "out")
    found = simulate(tmp_path / "out", package.mechanics, 0.5, 0.01)
    assert 0.2 < found.columns["stand.phi"].max() < 0.25
    assert found.columns["pivot.w"][-1] < 0
    np.testing.assert_allclose(found.columns["pivot.phi"], found.columns["stand.phi"], atol=1e-6)


def test_plain_joint_still_closes_the_loop_as_a_constraint(tmp_path: Path) -> None:
    file = parallelogram(tmp_path, f'<friction viscous="{VISCOUS}"/>', 0.0)
    text = file.read_text()
    before, after = text.rsplit(f'<friction viscous="{VISCOUS}"/>', 1)
    file.write_text(before + after)
    mechanics = (generate(file, tmp_path / "out").root / "Mechanics.mo").read_text()
    assert "RevolutePlanarLoopConstraint stand(" in mechanics
    assert "LoopClosure" not in mechanics
