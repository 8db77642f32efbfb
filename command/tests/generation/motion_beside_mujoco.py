"""Compares the motion of robots without contact with MuJoCo's (PyPI's ``mujoco``), as a table.

Use ``python command/tests/generation/motion_beside_mujoco.py ROBOT.urdf [...] [--cache FOLDER] [--stop 1]``. Geometry,
limits, friction and followers are taken out of each description, for what they do differs between the programs; its
root is held, and every joint that turns is turned to a random angle, the same whenever it is asked. Then it falls from
rest, here at a tolerance of 1e-9, in MuJoCo by the Runge-Kutta method of fourth order with steps of 0.1 ms.
"""

from __future__ import annotations

import argparse
import re
import sys
import tempfile
import zlib
from pathlib import Path
from typing import Any

import numpy as np
from cad2modelica import GenerateOptions, generate
from cad2modelica.geometry.spatial import rotation_about, rotation_of_roll_pitch_yaw
from contact_data import modelica_library
from contact_foundation.errors import CmbError
from fmu_regression.scene.scene_file import load_scene
from fmu_regression.simulate.simulation import simulate
from lxml import etree
from modelica2fmu.build import BuildOptions, build_fmu
from scipy.spatial.transform import Rotation

STEP = 1e-4  # s
LEFT_OUT = ("visual", "collision", "dynamics", "limit", "mimic", "transmission", "gazebo", "safety_controller")
TURNS = ("revolute", "continuous")


def in_a_pose(file: Path, target: Path) -> str:
    """Writes what both programs read alike, in a random pose; returns the name of the root."""
    tree = etree.parse(str(file))
    root = tree.getroot()
    for element in list(root.iter(*LEFT_OUT)):
        element.getparent().remove(element)
    random = np.random.default_rng(zlib.crc32(file.name.encode()))
    children = set()
    for joint in root.iterchildren("joint"):
        children.add(joint.find("child").get("link"))
        if joint.get("type") in TURNS:
            joint.set("type", "continuous")
            _turn(joint, random.uniform(-1.0, 1.0))
        elif joint.get("type") == "prismatic":
            etree.SubElement(joint, "limit", lower="-1e6", upper="1e6", effort="0", velocity="0")
    compiler = etree.SubElement(etree.SubElement(root, "mujoco"), "compiler")
    for name, value in (("strippath", "true"), ("fusestatic", "true"), ("discardvisual", "true")):
        compiler.set(name, value)
    tree.write(str(target))
    return next(link.get("name") for link in root.iterchildren("link") if link.get("name") not in children)


def _turn(joint: Any, angle: float) -> None:
    origin = joint.find("origin")
    if origin is None:
        origin = etree.SubElement(joint, "origin")
    angles = np.array([float(word) for word in origin.get("rpy", "0 0 0").split()])
    axis = joint.find("axis")
    direction = np.array([float(word) for word in (axis.get("xyz") if axis is not None else "1 0 0").split()])
    turned = rotation_of_roll_pitch_yaw(angles) @ rotation_about(direction / np.linalg.norm(direction), angle)
    origin.set("rpy", " ".join(f"{word:.17g}" for word in Rotation.from_matrix(turned).as_euler("xyz")))


def mujoco_motion(file: Path, names: list[str], times: np.ndarray) -> np.ndarray:
    """Joint coordinates at times, which are whole multiples of the step."""
    import mujoco

    model = mujoco.MjModel.from_xml_path(str(file))
    model.opt.timestep = STEP
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_RK4
    model.opt.gravity[:] = (0.0, 0.0, -9.81)
    model.dof_armature[:] = 0.0
    model.dof_damping[:] = 0.0
    model.dof_frictionloss[:] = 0.0
    model.jnt_limited[:] = 0
    data = mujoco.MjData(model)
    known = {_plain(model.joint(number).name): number for number in range(model.njnt)}
    addresses = [model.jnt_qposadr[known[_plain(name)]] for name in names]
    found = np.zeros((len(times), len(names)))
    for row, time in enumerate(times):
        while data.time < time - STEP / 2:
            mujoco.mj_step(model, data)
        found[row] = data.qpos[addresses]
    return found


def _plain(name: str) -> str:
    """A joint's name as it is common to the description and to the generated model."""
    return re.sub("[^a-z0-9]", "", name.lower())


def compared(file: Path, folder: Path, cache: Path | None, stop: float) -> str:
    """A row of the table."""
    target = folder / f"{file.stem}.urdf"
    held = in_a_pose(file, target)
    has_mass = etree.parse(str(target)).find(f"link[@name='{held}']/inertial") is not None
    options = GenerateOptions(ground=(held,) if has_mass else (), couple=False)
    package = generate(target, folder / "package", options)
    scene = load_scene(package.scene)
    build_fmu(package.mechatronics, (package.root, modelica_library()), folder / "robot.fmu", BuildOptions(cache=cache))
    result = simulate(
        folder / "robot.fmu",
        signals=[joint.variable for joint in scene.joints],
        stop=stop,
        tolerance=1e-9,
        interval=stop / 10,
        max_step=stop / 100,
    )
    places = np.searchsorted(result.time, np.linspace(0.0, stop, 11) - 1e-9)
    ours = np.column_stack([result.signals[joint.variable][places] for joint in scene.joints])
    theirs = mujoco_motion(target, [joint.name for joint in scene.joints], result.time[places])
    moved, off = float(np.abs(ours - ours[0]).max()), float(np.abs(ours - theirs).max())
    return f"| {file.name} | {len(scene.joints)} | {moved:.2f} | {off:.1e} |"


def main() -> int:
    """Writes the table; what cannot be compared is told in its row."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("robots", type=Path, nargs="+")
    parser.add_argument("--cache", type=Path)
    parser.add_argument("--stop", type=float, default=1.0)
    arguments = parser.parse_args()
    sys.stdout.write("| robot | joints | largest way, rad or m | largest deviation, rad or m |\n|---|---|---|---|\n")
    for file in arguments.robots:
        with tempfile.TemporaryDirectory(prefix="cmb-motion-") as folder:
            try:
                row = compared(file, Path(folder), arguments.cache, arguments.stop)
            except (CmbError, ValueError, KeyError) as error:
                row = f"| {file.name} | | | {' '.join(str(error).split())[:200]} |"
        sys.stdout.write(row + "\n")
        sys.stdout.flush()
    return 0


if __name__ == "__main__":
    sys.exit(main())
