"""Actuators of the mechatronic model: they act on the joints they are given to, and wrong files are refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from assembly_text import joint, part, write_assembly
from cad2modelica import GenerateOptions, generate
from cmb_base.errors import InputError
from mechanics_simulation import simulate

FLYWHEELS = """
[[actuator]]
joint = "first"
kind = "damper"
damping = 0.2
[[actuator]]
joint = "second"
kind = "springDamper"
stiffness = 2.0
damping = 0.0
[[actuator]]
joint = "sled"
kind = "damper"
damping = 3.0
[[actuator]]
joint = "fourth"
kind = "torque"
name = "motor 4"
"""


def assembly(folder: Path) -> Path:
    """Three wheels about their own axes and a sled, without gravity."""
    wheel = {"inertia": (0.1, 0.1, 0.1), "mass": 2.0}
    parts = [part(name, **wheel) for name in ("a", "b", "c", "d")]
    joints = [
        joint("first", "revolute", "ground", "a", axis=(0, 0, 1), start='speed="5"'),
        joint("second", "revolute", "ground", "b", axis=(0, 0, 1), start='position="0.3"'),
        joint("sled", "prismatic", "ground", "c", axis=(1, 0, 0), start='speed="4"'),
        joint("fourth", "revolute", "ground", "d", axis=(0, 0, 1), start='speed="1"'),
    ]
    return write_assembly(folder / "wheels.xml", parts, joints, gravity=(0, 0, 0), name="Wheels")


def test_actuators_act(tmp_path: Path) -> None:
    """Closed forms: decay exp(-d t / J), oscillation cos(sqrt(c / J) t), sled exp(-d t / m), constant torque."""
    file = assembly(tmp_path)
    (tmp_path / "actuators.toml").write_text(FLYWHEELS)
    package = generate(file, tmp_path / "out")
    text = (package.root / "Mechatronics.mo").read_text()
    assert "RealInput fourthTorque" in text
    assert "Torque motor4(" in text
    plant = "within Wheels;\nmodel Driven\n  Mechatronics plant(fourthTorque=0.4);\nend Driven;\n"
    (package.root / "Driven.mo").write_text(plant)
    (package.root / "package.order").write_text("Mechanics\nMechatronics\nGeometry\nDriven\n")
    found = simulate(tmp_path / "out", "Wheels.Driven", 1.0, 0.1)
    time = found.time
    np.testing.assert_allclose(found.columns["plant.first.w"], 5 * np.exp(-0.2 / 0.1 * time), atol=1e-7)
    np.testing.assert_allclose(found.columns["plant.second.phi"], 0.3 * np.cos(np.sqrt(2 / 0.1) * time), atol=1e-7)
    np.testing.assert_allclose(found.columns["plant.sled.v"], 4 * np.exp(-3 / 2 * time), atol=1e-7)
    np.testing.assert_allclose(found.columns["plant.fourth.phi"], time + 0.4 / 0.1 * time**2 / 2, atol=1e-7)


def test_written_once(tmp_path: Path) -> None:
    file = assembly(tmp_path)
    first = (generate(file, tmp_path / "out").root / "Mechatronics.mo").read_text()
    assert "extends Mechanics;" in first
    (tmp_path / "actuators.toml").write_text(FLYWHEELS)
    package = generate(file, tmp_path / "out")
    assert (package.root / "Mechatronics.mo").read_text() == first
    assert any("actuators.toml" in note and "Mechatronics" in note for note in package.notes)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("[[actuator]]\njoint = 'x'\nkind = 'torque'", "no such joint"),
        ("[[actuator]]\njoint = 'sled'\nkind = 'torque'", "does not suit"),
        ("[[actuator]]\njoint = 'first'\nkind = 'magic'", "does not suit"),
        ("[[actuator]]\njoint = 'first'\nkind = 'damper'", "needs damping"),
        ("[[actuator]]\njoint = 'first'\nkind = 'damper'\ndamping = -1", "not negative"),
        ("[[actuator]]\njoint = 'first'\nkind = 'damper'\ndamping = nan", "not negative"),
        ("[[actuator]]\njoint = 'first'\nkind = 'torque'\ngain = 3", "no meaning"),
        (2 * "[[actuator]]\njoint = 'first'\nkind = 'torque'\n", "another actuator"),
        ("actuator = 3", "[[actuator]]"),
        ("[[actuator]", "not TOML"),
        ("", "names no actuator"),
    ],
)
def test_wrong_files(tmp_path: Path, text: str, words: str) -> None:
    file = assembly(tmp_path)
    chosen = tmp_path / "drives.toml"
    chosen.write_text(text)
    with pytest.raises(InputError) as caught:
        generate(file, tmp_path / "out", GenerateOptions(actuators=chosen))
    assert words in str(caught.value)
    assert str(chosen) in str(caught.value)
    assert not (tmp_path / "out").exists()
