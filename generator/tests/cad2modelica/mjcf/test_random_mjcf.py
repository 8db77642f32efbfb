"""Random models beside MuJoCo: mass matrix and weight at the start, and what acts at hinges and slides.

``CMB_MODELS=N`` draws N, and ``CMB_MODEL_SEED`` begins elsewhere.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cad2modelica import read_assembly
from cad2modelica.kinematics.joint_twists import joint_twists
from cad2modelica.mechanism.model import Assembly, Joint, JointType
from random_mjcf import draw_model

FIRST_SEED = int(os.environ.get("CMB_MODEL_SEED", "0"))
COUNT = int(os.environ.get("CMB_MODELS", "60"))
NEAR = 2e-5  # MuJoCo keeps meshes in single precision


def columns(assembly: Assembly, joint: Joint) -> list[np.ndarray]:
    """Twists of MuJoCo's rates: those of balls and free bodies turn about the body's axes."""
    if joint.type.is_scalar:
        return joint_twists(joint)
    pose = assembly.part(joint.child).pose
    free = joint.type is JointType.FREE
    origin = pose.position if free else joint.origin
    turns = [np.concatenate([axis, np.cross(origin, axis)]) for axis in pose.rotation.T]
    return [*(np.concatenate([np.zeros(3), axis]) for axis in np.eye(3) if free), *turns]


def mass_and_weight(assembly: Assembly, rates: list[tuple[Joint, np.ndarray]]) -> tuple[np.ndarray, np.ndarray]:
    matrix, weight = np.diag([joint.rotor_inertia for joint, _ in rates]), np.zeros(len(rates))
    before = {joint.child: joint for joint in assembly.joints}
    for part in assembly.parts:
        name, moved = part.name, set[str]()
        while name in before:
            moved.add(before[name].name)
            name = before[name].parent
        twists = np.array([twist * (joint.name in moved) for joint, twist in rates]).reshape(-1, 6)
        center = part.pose.point(part.mass_properties.center_of_mass)
        turning, moving = twists[:, :3], twists[:, 3:] + np.cross(twists[:, :3], center)
        inertia = part.pose.rotation @ part.mass_properties.inertia @ part.pose.rotation.T
        matrix += part.mass_properties.mass * moving @ moving.T + turning @ inertia @ turning.T
        weight += moving @ (part.mass_properties.mass * assembly.gravity)
    return matrix, weight


@pytest.mark.parametrize("seed", range(FIRST_SEED, FIRST_SEED + COUNT))
def test_model_is_what_mujoco_makes_of_it(tmp_path: Path, seed: int) -> None:
    mujoco: Any = pytest.importorskip("mujoco", reason="MuJoCo is not installed: pip install mujoco")
    file = tmp_path / "model.xml"
    file.write_text(draw_model(seed))
    model = mujoco.MjModel.from_xml_path(str(file))
    if model.nv == 0:
        pytest.skip("nothing moves in this model")
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    expected = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, expected)
    assembly = read_assembly(file)
    joints = {joint.name: joint for joint in assembly.joints}
    numbers = range(model.njnt)
    found = [joints[mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_JOINT, number)] for number in numbers]
    rates = [(joint, twist) for joint in found for twist in columns(assembly, joint)]
    for rate, (joint, _) in enumerate(rates):
        if not joint.type.is_scalar:  # left out here, with a note
            expected[rate, rate] -= model.dof_armature[rate]
    matrix, weight = mass_and_weight(assembly, rates)
    np.testing.assert_allclose(matrix, expected, atol=NEAR * np.abs(expected).max())
    np.testing.assert_allclose(weight, -data.qfrc_bias, atol=NEAR * max(np.abs(weight).max(), 1.0))
    lost = any("armature left out" in note for note in assembly.notes)  # automatic springs count it
    for number, joint in zip(numbers, found, strict=True):
        if joint.type.is_scalar and not (lost and "springdamper" in file.read_text()):
            np.testing.assert_allclose(what_acts(joint), expected_to_act(model, number), rtol=NEAR, atol=1e-7)


def what_acts(joint: Joint) -> list[float]:
    spring, friction, limits = joint.spring, joint.friction, joint.limits
    return [
        joint.position,
        joint.rotor_inertia,
        *((spring.stiffness, spring.rest) if spring is not None else (0.0, 0.0)),
        *((friction.viscous, friction.dry) if friction is not None else (0.0, 0.0)),
        *((limits.lower or 0.0, limits.upper or 0.0) if limits is not None else (0.0, 0.0)),
    ]


def expected_to_act(model: Any, number: int) -> list[float]:
    rate, place = model.jnt_dofadr[number], model.jnt_qposadr[number]
    stiffness = float(np.ravel(model.jnt_stiffness[number])[0])
    return [
        model.qpos0[place],
        model.dof_armature[rate],
        stiffness,
        model.qpos_spring[place] if stiffness > 0 else 0.0,
        float(np.ravel(model.dof_damping[rate])[0]),
        model.dof_frictionloss[rate],
        *(model.jnt_range[number] if model.jnt_limited[number] else (0.0, 0.0)),
    ]
