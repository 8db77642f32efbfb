"""Joint accelerations of generated robots at their start, as FMUs: against closed forms and against Pinocchio."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
from cad2modelica import generate
from cad2modelica.modelica_names import NamePool
from fmpy import simulate_fmu
from mechanics_simulation import ROOT
from modelica2fmu.build import BuildOptions, build_fmu
from modelica2fmu.standard_library import core_subset

ROBOTS = ("ur5_robot.urdf", "panda.urdf", "kinova.urdf")
STOP = 0.2
PENDULUM = """<robot name="pendulum">
  <link name="world"/>
  <joint name="r1" type="continuous"><parent link="world"/><child link="b1"/><axis xyz="0 1 0"/></joint>
  <link name="b1"><inertial><origin xyz="0.25 0 0"/><mass value="1"/>
    <inertia ixx="1e-3" iyy="0.02" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="r2" type="revolute">
    <parent link="b1"/><child link="b2"/><origin xyz="0.5 0 0"/><axis xyz="0 1 0"/></joint>
  <link name="b2"><inertial><origin xyz="0.2 0 0"/><mass value="0.7"/>
    <inertia ixx="1e-3" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
</robot>
"""


def accelerations(file: Path, joints: list[str], folder: Path) -> np.ndarray:
    """Of revolute and prismatic joints at the start; the FMU is simulated on, and must stay finite."""
    package = generate(file, folder / "package")
    sources = [package.root, ROOT / "ContactMultiBody"]
    report = build_fmu(package.mechanics, sources, folder / "robot.fmu", BuildOptions(msl=core_subset()))
    output = [f"{NamePool().instance(name)}.a" for name in joints]
    result = simulate_fmu(
        str(report.fmu), fmi_type="CoSimulation", stop_time=STOP, output_interval=STOP / 4, output=output
    )
    assert result["time"][-1] == pytest.approx(STOP)
    rows = np.array([[row[name] for name in output] for row in result])
    assert np.isfinite(rows).all()
    return rows[0]


def test_double_pendulum_falls_as_its_mass_matrix_says(tmp_path: Path) -> None:
    file = tmp_path / "pendulum.urdf"
    file.write_text(PENDULUM)
    # Both links lie along x: M a = Q with moments about the axes y.
    far = 0.5 + 0.2
    coupling = 0.01 + 0.7 * 0.2 * far
    mass = [[0.02 + 0.25**2 + 0.01 + 0.7 * far**2, coupling], [coupling, 0.01 + 0.7 * 0.2**2]]
    expected = np.linalg.solve(mass, [9.81 * (0.25 + 0.7 * far), 9.81 * 0.7 * 0.2])
    np.testing.assert_allclose(accelerations(file, ["r1", "r2"], tmp_path), expected, rtol=1e-6)


@pytest.mark.parametrize("name", ROBOTS)
def test_robot_in_circulation_falls_as_pinocchio_says(tmp_path: Path, name: str) -> None:
    if "CMB_ROBOTS" not in os.environ:
        pytest.skip("CMB_ROBOTS names no folder of robot descriptions")
    pinocchio = pytest.importorskip("pinocchio", reason="the oracle, PyPI's pin, is not installed")
    file = next(iter(sorted(Path(os.environ["CMB_ROBOTS"]).rglob(name))), None)
    if file is None:
        pytest.skip(f"CMB_ROBOTS holds no {name}")
    model = pinocchio.buildModelFromUrdf(str(file))
    zero = np.zeros(model.nv)
    expected = pinocchio.aba(model, model.createData(), pinocchio.neutral(model), zero, zero)
    # The first joint is Pinocchio's own, of the world.
    joints = list(zip(list(model.names)[1:], list(model.joints)[1:], strict=True))
    assert all(joint.nv == 1 for _, joint in joints)
    expected = np.array([expected[joint.idx_v] for _, joint in joints])
    found = accelerations(file, [label for label, _ in joints], tmp_path)
    np.testing.assert_allclose(found, expected, rtol=1e-6, atol=1e-6 * np.abs(expected).max())
