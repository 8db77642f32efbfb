"""MJCF: which ranges count, and where the least mass stands, beside MuJoCo where it is installed."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cad2modelica import read_assembly
from contact_foundation.errors import CmbError

HIDDEN = "<geom size='0.1' pos='0.3 0 0' group='4'/>"
BOUND = "<compiler boundmass='0.5' boundinertia='0.01' inertiagrouprange='0 2'/>"


def compiled(text: str, control: float = 0.0) -> Any:
    mujoco: Any = pytest.importorskip("mujoco", reason="MuJoCo is not installed: pip install mujoco")
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    data.ctrl[:] = control
    mujoco.mj_forward(model, data)
    return model, data


@pytest.mark.parametrize(
    "world",
    [
        f"<body name='b' pos='1 2 3'><freejoint/>{HIDDEN}</body>",
        f"<body name='b' pos='1 2 3' euler='10 20 30'><joint/>{HIDDEN}</body>",
        f"<frame pos='5 0 0' euler='0 0 90'><body name='b' pos='1 2 3'><joint/>{HIDDEN}</body></frame>",
        "<body name='b' pos='1 2 3'><joint/><geom size='0.1' mass='0' pos='0.3 0 0'/></body>",
        f"<body name='b' pos='1 2 3'><joint/><geom size='0.02' pos='0 0.1 0'/>{HIDDEN}</body>",
        f"<body name='b'><joint/><geom size='0.1'/><body pos='0 1 2' euler='0 50 0'>{HIDDEN}</body></body>",
        "<body name='b' pos='1 2 3'><joint/><inertial pos='0.1 0 0' mass='0.1' diaginertia='1 1 1'/></body>",
    ],
)
def test_the_least_mass_stands_where_mujoco_puts_it(tmp_path: Path, world: str) -> None:
    text = f"<mujoco>{BOUND}<worldbody>{world}</worldbody></mujoco>"
    model, data = compiled(text)
    (tmp_path / "model.xml").write_text(text)
    part = read_assembly(tmp_path / "model.xml").part("b")
    assert part.mass_properties.mass == pytest.approx(model.body_subtreemass[1], rel=1e-9)
    center = part.pose.point(part.mass_properties.center_of_mass)
    np.testing.assert_allclose(center, data.subtree_com[1], atol=1e-9)


def test_a_mass_without_a_place_is_told(tmp_path: Path) -> None:
    text = f"<mujoco>{BOUND}<worldbody><body name='b' pos='1 2 3'><freejoint/>{HIDDEN}</body></worldbody></mujoco>"
    (tmp_path / "model.xml").write_text(text)
    notes = read_assembly(tmp_path / "model.xml").notes
    assert any("boundmass" in note and "inertial" in note for note in notes)


RANGES = ("", "range='0 0'", "range='-10 20'", "range='-10 20' limited='true'", "range='-10 20' limited='false'")


@pytest.mark.parametrize("autolimits", ["true", "false"])
@pytest.mark.parametrize("given", [*RANGES, "limited='true'", "range='0 0' limited='true'"])
def test_a_range_counts_where_it_does_in_mujoco(tmp_path: Path, given: str, autolimits: str) -> None:
    mujoco: Any = pytest.importorskip("mujoco", reason="MuJoCo is not installed: pip install mujoco")
    text = (
        f"<mujoco><compiler autolimits='{autolimits}'/><worldbody><body name='b'><joint name='j' {given}/>"
        "<geom size='0.1'/></body></worldbody></mujoco>"
    )
    file = tmp_path / "model.xml"
    file.write_text(text)
    try:
        model = mujoco.MjModel.from_xml_string(text)
    except ValueError:
        with pytest.raises(CmbError):
            read_assembly(file)
        return
    (joint,) = read_assembly(file).joints
    assert (joint.limits is not None) == bool(model.jnt_limited[0])
    if joint.limits is not None:
        np.testing.assert_allclose([joint.limits.lower, joint.limits.upper], model.jnt_range[0])


def actuated(tmp_path: Path, actuator: str, autolimits: str = "true") -> Path:
    file = tmp_path / "model.xml"
    file.write_text(
        f"<mujoco><compiler autolimits='{autolimits}'/><worldbody><body name='b'>"
        "<joint name='j' range='-90 180' limited='true'/><geom size='0.1'/></body></worldbody>"
        f"<actuator>{actuator}</actuator></mujoco>"
    )
    return file


@pytest.mark.parametrize(
    "actuator",
    [
        "<position joint='j' ctrlrange='-1 2'/>",
        "<position joint='j' ctrlrange='0 0'/>",
        "<position joint='j' ctrlrange='-1 2' ctrllimited='false'/>",
        "<position joint='j' inheritrange='0.5'/>",
        "<velocity joint='j' ctrlrange='-1 2'/>",
        "<general joint='j' gainprm='9' biastype='affine' biasprm='0 -9 -1' ctrlrange='-1 2'/>",
    ],
)
def test_ranges_of_wanted_positions_are_told(tmp_path: Path, actuator: str) -> None:
    file = actuated(tmp_path, actuator)
    model, _ = compiled(file.read_text())
    told = [note for note in read_assembly(file).notes if "ctrlrange" in note]
    assert len(told) == int(model.actuator_ctrllimited[0])
    if told:
        lower, upper = model.actuator_ctrlrange[0]
        assert f"{lower:g} to {upper:g}" in told[0]


@pytest.mark.parametrize("given", ["ctrlrange='-2 2'", "ctrlrange='0 0'", "forcerange='-3 3'", "forcerange='-1 3'"])
def test_a_motor_is_limited_as_in_mujoco(tmp_path: Path, given: str) -> None:
    file = actuated(tmp_path, f"<motor joint='j' {given}/>")
    _, data = compiled(file.read_text(), control=100.0)
    assembly = read_assembly(file)
    (drive,) = assembly.drives
    assert drive.parameters.get("tau_max", 100.0) == pytest.approx(data.qfrc_actuator[0])
    assert any("is taken as" in note for note in assembly.notes) == ("-1 3" in given)


@pytest.mark.parametrize("key", ["ctrlrange", "forcerange"])
def test_ranges_without_their_flag_are_refused(tmp_path: Path, key: str) -> None:
    with pytest.raises(CmbError, match="autolimits"):
        read_assembly(actuated(tmp_path, f"<motor joint='j' {key}='-2 2'/>", autolimits="false"))
