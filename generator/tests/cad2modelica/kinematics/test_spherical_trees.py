"""Spherical joints in open chains, built as FMUs: between parts that are turned every way, and as a heavy top."""

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
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

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


@pytest.mark.full
@pytest.mark.parametrize("name", NAMES)
def test_moves_as_free_bodies_with_constraint_forces_do(motions: tuple[Motion, Motion], name: str) -> None:
    found, expected = motions
    assert expected.gap < 1e-8
    np.testing.assert_allclose(found.position[name], expected.position[name], atol=1e-6)
    np.testing.assert_allclose(found.rotation[name], expected.rotation[name], atol=1e-6)
    assert np.ptp(expected.position[name], axis=0).max() > 0.05


@pytest.mark.full
def test_heavy_top_against_eulers_equations(tmp_path: Path, fmu_cache: Path) -> None:
    """A body about a fixed point, integrated in its own axes."""
    center, mass, moments, time = np.array([0.1, -0.05, 0.2]), 2.0, (0.02, 0.03, 0.04), 0.5
    start = Rotation.from_rotvec(0.7 * np.array([0, 0.6, 0.8]))
    top = part("top", position=(11, 0, 1), turn=((0, 0.6, 0.8), 0.7), mass=mass, center=center, inertia=moments)
    ball = joint("ball", "spherical", "ground", "top", origin=(11, 0, 1), start='angularVelocity="1 -2 5"')
    package = generate(write_assembly(tmp_path / "top.xml", [top], [ball]), tmp_path / "out")
    sources = [package.root, ROOT / "ContactMultiBody"]
    fmu = build_fmu(package.mechanics, sources, tmp_path / "top.fmu", BuildOptions(cache=fmu_cache)).fmu
    words = [[f"top.frame_a.R.T[{i},{j}]" for j in (1, 2, 3)] for i in (1, 2, 3)]
    output = [word for row in words for word in row]
    rows = simulate_fmu(str(fmu), stop_time=time, relative_tolerance=1e-9, output_interval=time, output=output)
    inertia = np.diag(moments) + mass * (center @ center * np.eye(3) - np.outer(center, center))

    def rates(_time: float, state: np.ndarray) -> np.ndarray:
        x, y, z, w = state[:4]
        spin = state[4:]
        moment = np.cross(center, mass * Rotation.from_quat(state[:4]).inv().apply([0, 0, -9.81]))
        change = np.linalg.solve(inertia, moment - np.cross(spin, inertia @ spin))
        turning = 0.5 * np.append(w * spin + np.cross([x, y, z], spin), -spin @ [x, y, z])
        return np.concatenate([turning, change])

    begin = np.concatenate([start.as_quat(), start.inv().apply([1, -2, 5])])
    solution = solve_ivp(rates, (0, time), begin, method="DOP853", rtol=1e-11, atol=1e-12)
    expected = Rotation.from_quat(solution.y[:4, -1]).as_matrix().T
    found = [[rows[word][-1] for word in row] for row in words]
    np.testing.assert_allclose(found, expected, atol=1e-6)
