"""Random mechanisms: read as they were drawn, and moved by the FMU as free bodies with constraint forces move.

``CMB_MECHANISMS=N`` draws N to be simulated, and ``CMB_MECHANISM_SEED`` begins elsewhere.
"""

from __future__ import annotations

import json
import os
from pathlib import Path

import numpy as np
import pytest
from cad2modelica import generate, read_assembly
from cad2modelica.mechanism.model import Joint
from constrained_bodies import ConstrainedBodies
from contact_data import core_subset
from fmpy import simulate_fmu
from mechanics_simulation import ROOT
from modelica2fmu.build import BuildOptions, build_fmu
from random_mechanism import INSTANCE, Drawn, draw_mechanism

FIRST_SEED = int(os.environ.get("CMB_MECHANISM_SEED", "0"))
COUNT = int(os.environ.get("CMB_MECHANISMS", "12"))


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


@pytest.mark.full
@pytest.mark.parametrize("seed", range(FIRST_SEED, FIRST_SEED + COUNT))
def test_mechanism_moves_as_free_bodies_with_constraint_forces_do(tmp_path: Path, seed: int, fmu_cache: Path) -> None:
    drawn = draw_mechanism(seed)
    names = read(drawn, tmp_path)
    package = generate(tmp_path / "drawn.xml", tmp_path / "out")
    sources, options = [package.root, ROOT / "ContactMultiBody"], BuildOptions(cache=fmu_cache, msl=core_subset())
    fmu = build_fmu(package.mechanics, sources, tmp_path / "drawn.fmu", options).fmu
    variables = {body["label"]: body["variable"] for body in json.loads(package.scene.read_text())["bodies"]}
    output = [f"{variable}.frame_a.r_0[{k}]" for variable in variables.values() for k in (1, 2, 3)]
    output += [f"{v}.frame_a.R.T[{i},{j}]" for v in variables.values() for i in (1, 2, 3) for j in (1, 2, 3)]
    times = np.linspace(0.0, 0.5 * np.sqrt(drawn.size / 9.81), 5)
    rows = simulate_fmu(str(fmu), stop_time=times[-1], relative_tolerance=1e-9, output_interval=times[1], output=output)
    begin = np.concatenate([np.concatenate(drawn.motion[part.name]) for part in drawn.assembly.parts])
    expected = ConstrainedBodies(drawn.assembly).integrate(begin, list(times))
    for part in drawn.assembly.parts:
        frame = f"{variables[names[part.name]]}.frame_a"
        origin = np.column_stack([rows[f"{frame}.r_0[{k}]"] for k in (1, 2, 3)])
        turn = np.array([[rows[f"{frame}.R.T[{i},{j}]"] for j in (1, 2, 3)] for i in (1, 2, 3)]).transpose(2, 1, 0)
        center = origin + turn @ part.mass_properties.center_of_mass
        np.testing.assert_allclose(center, expected.position[part.name], atol=1e-6 * drawn.size, err_msg=part.name)
        np.testing.assert_allclose(turn, expected.rotation[part.name], atol=1e-6, err_msg=part.name)
