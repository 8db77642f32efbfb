"""Joint accelerations of generated robots as FMUs: against closed forms and against Pinocchio."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from cad2modelica import GenerateOptions, generate, read_assembly
from cad2modelica.kinematics.joint_twists import joint_twists
from cad2modelica.mechanism.model import Assembly, JointType
from cad2modelica.modelica.names import NamePool
from contact_data import core_subset
from fmpy import simulate_fmu
from lxml import etree
from mechanics_simulation import ROOT
from modelica2fmu.build import BuildOptions, build_fmu

ROBOTS = ("ur5_robot.urdf", "panda.urdf", "kinova.urdf", "z1.urdf", "allegro_left_hand.urdf")
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


@dataclass(frozen=True)
class Motion:
    """Coordinates, rates and accelerations of joints, each of shape (times, joints)."""

    position: np.ndarray
    speed: np.ndarray
    acceleration: np.ndarray


def fall(file: Path, joints: list[str], folder: Path, cache: Path, options: GenerateOptions) -> Motion:
    """Generates a robot, builds its mechanics as an FMU, and lets it fall from joint position zero."""
    assembly = read_assembly(file)
    kinds = {joint.name: joint.type for joint in assembly.joints}
    package = generate(file, folder / "package", options)
    sources = [package.root, ROOT / "ContactMultiBody"]
    report = build_fmu(package.mechanics, sources, folder / "robot.fmu", BuildOptions(msl=core_subset(), cache=cache))
    names = [NamePool().instance(name) for name in joints]
    turning = [kinds[name] is JointType.REVOLUTE for name in joints]
    output = [f"{name}.{'phi' if turns else 's'}" for name, turns in zip(names, turning, strict=True)]
    output += [f"{name}.{'w' if turns else 'v'}" for name, turns in zip(names, turning, strict=True)]
    output += [f"{name}.a" for name in names]
    result = simulate_fmu(
        str(report.fmu),
        fmi_type="CoSimulation",
        stop_time=STOP,
        output_interval=STOP / 4,
        relative_tolerance=1e-8,
        output=output,
    )
    assert result["time"][-1] == pytest.approx(STOP)
    rows = np.array([[row[name] for name in output] for row in result])
    assert np.isfinite(rows).all()
    return Motion(*np.split(rows, 3, axis=1))


@pytest.mark.full
def test_double_pendulum_falls_as_its_mass_matrix_says(tmp_path: Path, fmu_cache: Path) -> None:
    file = tmp_path / "pendulum.urdf"
    file.write_text(PENDULUM)
    # Both links lie along x: M a = Q with moments about the axes y.
    far = 0.5 + 0.2
    coupling = 0.01 + 0.7 * 0.2 * far
    mass = [[0.02 + 0.25**2 + 0.01 + 0.7 * far**2, coupling], [coupling, 0.01 + 0.7 * 0.2**2]]
    expected = np.linalg.solve(mass, [9.81 * (0.25 + 0.7 * far), 9.81 * 0.7 * 0.2])
    np.testing.assert_allclose(
        fall(file, ["r1", "r2"], tmp_path, fmu_cache, GenerateOptions()).acceleration[0], expected, rtol=1e-6
    )


def without_geometry_and_friction(file: Path, target: Path) -> Path:
    """Pinocchio's forward dynamics know neither contacts nor the friction of joints."""
    tree = etree.parse(str(file))
    for element in list(tree.iter("visual", "collision", "dynamics")):
        element.getparent().remove(element)
    tree.write(str(target))
    return target


@pytest.mark.parametrize("name", ROBOTS)
def test_robot_in_circulation_falls_as_pinocchio_says(tmp_path: Path, fmu_cache: Path, name: str) -> None:
    """At the start and on the way: Pinocchio's accelerations at the FMU's own coordinates and rates."""
    if "CMB_ROBOTS" not in os.environ:
        pytest.skip("CMB_ROBOTS names no folder of robot descriptions")
    pinocchio = pytest.importorskip("pinocchio", reason="the oracle, PyPI's pin, is not installed")
    original = next(iter(sorted(Path(os.environ["CMB_ROBOTS"]).rglob(name))), None)
    if original is None:
        pytest.skip(f"CMB_ROBOTS holds no {name}")
    file = without_geometry_and_friction(original, tmp_path / name)
    model = pinocchio.buildModelFromUrdf(str(file))  # holds the root
    # The first joint is Pinocchio's own, of the world.
    names, joints = list(model.names)[1:], list(model.joints)[1:]
    assert all(joint.nv == 1 for joint in joints)
    held = tuple(part.name for part in read_assembly(file).parts if part.name == model.frames[1].name)
    # Pinocchio lets joints move by themselves that are to follow others.
    motion = fall(file, names, tmp_path, fmu_cache, GenerateOptions(ground=held, couple=False))
    data = model.createData()
    for position, speed, found in zip(motion.position, motion.speed, motion.acceleration, strict=True):
        q, v, a = pinocchio.neutral(model), np.zeros(model.nv), np.zeros(model.nv)
        for joint, coordinate, rate, acceleration in zip(joints, position, speed, found, strict=True):
            # Joints without limits have cosine and sine as coordinates.
            q[joint.idx_q : joint.idx_q + joint.nq] = (
                coordinate if joint.nq == 1 else (np.cos(coordinate), np.sin(coordinate))
            )
            v[joint.idx_v] = rate
            a[joint.idx_v] = acceleration
        expected = pinocchio.aba(model, data, q, v, np.zeros(model.nv))
        np.testing.assert_allclose(a, expected, rtol=1e-6, atol=1e-6 * np.abs(expected).max())


def mass_matrix(assembly: Assembly, names: list[str]) -> np.ndarray:
    """Of the scalar joints alone, at the start, from what was read: kinetic energy of unit rates."""
    before = {joint.child: joint for joint in assembly.joints}
    total = np.zeros((len(names), len(names)))
    for part in assembly.parts:
        rates = np.zeros((6, len(names)))  # angular velocity, and velocity of the centre of mass
        center = part.pose.point(part.mass_properties.center_of_mass)
        name = part.name
        while name in before:
            joint = before[name]
            if joint.name in names:
                (twist,) = joint_twists(joint)
                velocity = twist[3:] + np.cross(twist[:3], center)
                rates[:, names.index(joint.name)] = np.concatenate([twist[:3], velocity])
            name = joint.parent
        inertia = part.pose.rotation @ part.mass_properties.inertia @ part.pose.rotation.T
        total += part.mass_properties.mass * rates[3:].T @ rates[3:] + rates[:3].T @ inertia @ rates[:3]
    return total


def test_mass_matrices_of_all_robots_are_those_of_pinocchio() -> None:
    """All descriptions below CMB_ROBOTS that Pinocchio reads; what was repaired or left out is in the notes."""
    if "CMB_ROBOTS" not in os.environ:
        pytest.skip("CMB_ROBOTS names no folder of robot descriptions")
    pinocchio = pytest.importorskip("pinocchio", reason="the oracle, PyPI's pin, is not installed")
    different = []
    compared = 0
    for file in sorted(Path(os.environ["CMB_ROBOTS"]).rglob("*.urdf")):
        try:
            model = pinocchio.buildModelFromUrdf(str(file), pinocchio.JointModelFreeFlyer())
        except ValueError:
            continue
        assembly = read_assembly(file)
        repaired = any("raised to" in note or "inertia without mass" in note for note in assembly.notes)
        ours = {joint.name for joint in assembly.joints}
        joints = [
            (name, joint.idx_v)
            for name, joint in zip(list(model.names)[2:], list(model.joints)[2:], strict=True)
            if joint.nv == 1 and name in ours
        ]
        columns = [column for _, column in joints]
        data = model.createData()
        q = pinocchio.neutral(model)
        starts = {
            joint.name: joint.position for joint in assembly.joints
        }  # other than zero where a joint follows others
        for name, joint in zip(list(model.names)[2:], list(model.joints)[2:], strict=True):
            start = starts.get(name, 0.0)
            if joint.nv == 1:
                q[joint.idx_q : joint.idx_q + joint.nq] = start if joint.nq == 1 else (np.cos(start), np.sin(start))
        matrix = pinocchio.crba(model, data, q)
        expected = (np.triu(matrix) + np.triu(matrix, 1).T)[np.ix_(columns, columns)]
        found = mass_matrix(assembly, [name for name, _ in joints])
        mass = sum(part.mass_properties.mass for part in assembly.parts)
        compared += 1
        assert mass == pytest.approx(pinocchio.computeTotalMass(model), rel=1e-12, abs=1e-12), file.name
        tolerance = 1e-9 * np.abs(expected).max(initial=0.0)
        if not repaired and np.abs(found - expected).max(initial=0.0) > tolerance:
            different.append(file.name)
    assert different == []
    assert compared > 0
