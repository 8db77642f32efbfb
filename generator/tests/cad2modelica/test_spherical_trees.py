"""Spherical joints in open chains, between parts that are turned every way: built as an FMU, against free bodies."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from assembly_text import joint, part, write_assembly
from cad2modelica import generate, read_assembly
from constrained_bodies import ConstrainedBodies, Motion
from fmpy import simulate_fmu
from mechanics_simulation import ROOT
from modelica2fmu.build import BuildOptions, build_fmu

TIMES = np.linspace(0.0, 0.4, 5)
NAMES = ("arm", "first", "second", "third", "beside")


@pytest.fixture(scope="module")
def motions(tmp_path_factory: pytest.TempPathFactory, fmu_cache: Path) -> tuple[Motion, Motion]:
    """An arm, a chain of three ball joints behind it and one beside: of the FMU, and as expected."""
    folder = tmp_path_factory.mktemp("balls")
    random = np.random.default_rng(3)
    places = {name: random.standard_normal(3) for name in NAMES}
    parts = [
        part(
            name,
            position=places[name],
            turn=(random.standard_normal(3), float(random.uniform(1.5, 3.0))),
            center=random.uniform(-0.2, 0.2, 3),
            inertia=(0.06, 0.07, 0.08),
        )
        for name in NAMES
    ]
    chain = zip(("arm", "first", "second", "arm"), NAMES[1:], strict=True)
    joints = [joint("hinge", "revolute", "ground", "arm", axis=(1, 2, 0), start='position="0.4"')]
    joints += [joint(f"ball{k}", "spherical", a, b, origin=places[b] + [0, 0, 0.3]) for k, (a, b) in enumerate(chain)]
    file = write_assembly(folder / "balls.xml", parts, joints, name="Balls")
    package = generate(file, folder / "out")
    sources = [package.root, ROOT / "ContactMultiBody"]
    fmu = build_fmu(package.mechanics, sources, folder / "balls.fmu", BuildOptions(cache=fmu_cache)).fmu
    names = {body["label"]: body["variable"] for body in json.loads(package.scene.read_text())["bodies"]}
    place = {n: [f"{v}.frame_a.r_0[{i}]" for i in (1, 2, 3)] for n, v in names.items()}
    turn = {n: [[f"{v}.frame_a.R.T[{i},{j}]" for i in (1, 2, 3)] for j in (1, 2, 3)] for n, v in names.items()}
    output = [word for n in names for row in (place[n], *turn[n]) for word in row]
    rows = simulate_fmu(
        str(fmu), stop_time=float(TIMES[-1]), relative_tolerance=1e-9, output_interval=float(TIMES[1]), output=output
    )
    assembly = read_assembly(file)
    rotation = {n: np.array([[rows[word] for word in row] for row in turn[n]]).transpose(2, 0, 1) for n in names}
    center = {n: assembly.part(n).mass_properties.center_of_mass for n in names}
    position = {n: np.column_stack([rows[word] for word in place[n]]) + rotation[n] @ center[n] for n in names}
    return Motion(position, rotation, 0.0), ConstrainedBodies(assembly).simulate({}, list(TIMES))


@pytest.mark.parametrize("name", NAMES)
def test_moves_as_free_bodies_with_constraint_forces_do(motions: tuple[Motion, Motion], name: str) -> None:
    found, expected = motions
    assert expected.gap < 1e-8
    np.testing.assert_allclose(found.position[name], expected.position[name], atol=1e-6)
    np.testing.assert_allclose(found.rotation[name], expected.rotation[name], atol=1e-6)
    assert np.ptp(expected.position[name], axis=0).max() > 0.05
