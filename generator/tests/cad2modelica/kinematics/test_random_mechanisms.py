"""Random mechanisms: read as they were drawn, and moved by the FMU as free bodies with constraint forces move.

``CMB_MECHANISMS=N`` draws N to be simulated, and ``CMB_MECHANISM_SEED`` begins elsewhere.
"""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from cad2modelica import generate, read_assembly
from cad2modelica.mechanism.model import Joint
from constrained_bodies import ConstrainedBodies, Motion
from contact_data import core_subset
from fmpy import simulate_fmu
from fmpy.fmi1 import FMICallException
from mechanics_simulation import ROOT
from modelica2fmu.build import BuildOptions, build_fmu
from random_mechanism import INSTANCE, Drawn, draw_mechanism

FIRST_SEED = int(os.environ.get("CMB_MECHANISM_SEED", "0"))
COUNT = int(os.environ.get("CMB_MECHANISMS", "12"))
NEAR = 1e-4  # of positions by the mechanism's size, and of rotations, at a tolerance of 1e-8


def read(drawn: Drawn, folder: Path) -> dict[str, str]:
    """Compares what is read with what was drawn; returns the names of the parts that were read."""
    file = folder / "drawn.xml"
    file.write_text(drawn.text, encoding="utf-8")
    assembly = read_assembly(file)
    parts = {part.name.removeprefix(INSTANCE): part for part in assembly.parts}
    assert parts.keys() == {part.name for part in drawn.assembly.parts}
    near = 1e-9 * drawn.size
    for part in drawn.assembly.parts:
        found, given = parts[part.name].mass_properties, part.mass_properties
        np.testing.assert_allclose(parts[part.name].pose.position, part.pose.position, atol=10 * near)
        np.testing.assert_allclose(parts[part.name].pose.rotation, part.pose.rotation, atol=1e-9)
        assert found.mass == pytest.approx(given.mass, rel=1e-12)
        np.testing.assert_allclose(found.center_of_mass, given.center_of_mass, atol=near)
        np.testing.assert_allclose(found.inertia, given.inertia, atol=1e-9 * np.abs(given.inertia).max())
    joints = {joint.name.removeprefix(INSTANCE): joint for joint in assembly.joints}
    assert joints.keys() == {joint.name for joint in drawn.assembly.joints}
    for joint in drawn.assembly.joints:
        assert joints[joint.name].type is joint.type
        for key in ("axis", "second_axis", "angular_velocity"):
            expected = getattr(joint, key)
            assert (expected is None) == (getattr(joints[joint.name], key) is None)
            if expected is not None:
                np.testing.assert_allclose(getattr(joints[joint.name], key), expected, atol=1e-9)
        np.testing.assert_allclose(joints[joint.name].origin, joint.origin, atol=10 * near)
        np.testing.assert_allclose(_scalars(joints[joint.name]), _scalars(joint), atol=1e-9, rtol=1e-9)
    return {name: part.name for name, part in parts.items()}


def _scalars(joint: Joint) -> list[float]:
    return [joint.position, joint.speed, joint.pitch]


@pytest.mark.parametrize("seed", range(FIRST_SEED, FIRST_SEED + 60))
def test_mechanism_is_read_as_it_was_drawn(tmp_path: Path, seed: int) -> None:
    read(draw_mechanism(seed), tmp_path)


@dataclass(frozen=True)
class Built:
    """A drawn mechanism's FMU, and the variables of its frames by the part."""

    drawn: Drawn
    fmu: Path
    frame: dict[str, str]

    def expected(self, times: Sequence[float]) -> Motion:
        """As free bodies with constraint forces move."""
        begin = np.concatenate([np.concatenate(self.drawn.motion[part.name]) for part in self.drawn.assembly.parts])
        return ConstrainedBodies(self.drawn.assembly).integrate(begin, times)

    def error(self, expected: Motion, last: float, mode: str, tolerance: float, said: list[str]) -> float:
        """The largest in centres of mass, by the mechanism's size, and in rotations; ``said`` gets messages."""
        signals = [f"{each}.r_0[{k}]" for each in self.frame.values() for k in (1, 2, 3)]
        signals += [f"{each}.R.T[{i},{j}]" for each in self.frame.values() for i in (1, 2, 3) for j in (1, 2, 3)]
        interval = last / (len(next(iter(expected.position.values()))) - 1)
        rows = simulate_fmu(
            str(self.fmu), fmi_type=mode, stop_time=last, relative_tolerance=tolerance, output_interval=interval,
            output=signals, logger=lambda *words: said.append(words[-1].decode()),
        )  # fmt: skip
        errors = []
        for part in self.drawn.assembly.parts:
            frame = self.frame[part.name]
            origin = np.column_stack([rows[f"{frame}.r_0[{k}]"] for k in (1, 2, 3)])
            turn = np.array([[rows[f"{frame}.R.T[{i},{j}]"] for j in (1, 2, 3)] for i in (1, 2, 3)]).transpose(2, 1, 0)
            center = origin + turn @ part.mass_properties.center_of_mass
            errors.append(np.abs(center - expected.position[part.name]).max() / self.drawn.size)
            errors.append(np.abs(turn - expected.rotation[part.name]).max())
        return float(max(errors))


def build(seed: int, folder: Path, cache: Path) -> Built:
    """Draws, generates and builds."""
    drawn = draw_mechanism(seed)
    names = read(drawn, folder)
    package = generate(folder / "drawn.xml", folder / "out")
    sources, options = [package.root, ROOT / "ContactMultiBody"], BuildOptions(cache=cache, msl=core_subset())
    fmu = build_fmu(package.mechanics, sources, folder / "drawn.fmu", options).fmu
    variables = {body["label"]: body["variable"] for body in json.loads(package.scene.read_text())["bodies"]}
    frames = {part.name: f"{variables[names[part.name]]}.frame_a" for part in drawn.assembly.parts}
    return Built(drawn, fmu, frames)


@pytest.mark.full
@pytest.mark.parametrize("seed", range(FIRST_SEED, FIRST_SEED + COUNT))
def test_mechanism_moves_as_free_bodies_with_constraint_forces_do(tmp_path: Path, seed: int, fmu_cache: Path) -> None:
    built = build(seed, tmp_path, fmu_cache)
    times = np.linspace(0.0, 0.5 * np.sqrt(built.drawn.size / 9.81), 5)
    assert built.error(built.expected(list(times)), times[-1], "CoSimulation", 1e-9, []) < 1e-6


@pytest.mark.full
@pytest.mark.parametrize("seed", range(FIRST_SEED + 100, FIRST_SEED + 100 + COUNT))
def test_mechanism_moves_on_so_or_stops_at_a_dead_centre(tmp_path: Path, seed: int, fmu_cache: Path) -> None:
    """Long enough to swing to and fro, and through dead centres."""
    built = build(seed, tmp_path, fmu_cache)
    times = np.linspace(0.0, 4.0 * np.sqrt(built.drawn.size / 9.81), 41)
    expected = built.expected(list(times))
    for mode in ("CoSimulation", "ModelExchange"):
        said: list[str] = []
        try:
            error = built.error(expected, times[-1], mode, 1e-8, said)
            if error > NEAR:  # some motions magnify errors; those shrink with the tolerance
                assert built.error(expected, times[-1], mode, 1e-10, said) < max(NEAR, 0.2 * error), mode
        except FMICallException:
            assert any("followed" in each for each in said), said
