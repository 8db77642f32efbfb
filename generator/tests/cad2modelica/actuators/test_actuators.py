"""Actuators of the mechatronic model: they act on the joints they are given to, and wrong files are refused."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
import rumoca
from assembly_text import joint, part, write_assembly
from cad2modelica import GenerateOptions, generate
from cad2modelica.actuators.catalogue import components_for
from cad2modelica.mechanism.model import JointType
from contact_data import modelica_library
from contact_foundation.errors import InputError
from mechanics_simulation import CORE, ROOT, simulate

FLYWHEELS = """
[[actuator]]
joint = "first"
component = "Friction"
parameters = { d = 0.2 }
[[actuator]]
joint = "second"
component = "SpringDamper"
parameters = { c = 2 }
[[actuator]]
joint = "sled"
component = "Friction"
[actuator.parameters]
d = 3.0
[[actuator]]
joint = "fourth"
component = "Torque"
name = "motor 4"
[[actuator]]
joint = "fourth"
component = "Sensor"
[[actuator]]
joint = "fifth"
component = "Servo"
parameters = { c = 40, d = 2, useSpeedReference = true }
inputs = { phi_ref = 0.5 }
[[actuator]]
joint = "lift"
component = "Position"
"""


def assembly(folder: Path) -> Path:
    """Wheels about their own axes and two slides, without gravity."""
    wheel = {"inertia": (0.1, 0.1, 0.1), "mass": 2.0}
    parts = [part(name, **wheel) for name in ("a", "b", "c", "d", "e", "f")]
    joints = [
        joint("first", "revolute", "ground", "a", axis=(0, 0, 1), start='speed="5"'),
        joint("second", "revolute", "ground", "b", axis=(0, 0, 1), start='position="0.3"'),
        joint("sled", "prismatic", "ground", "c", axis=(1, 0, 0), start='speed="4"'),
        joint("fourth", "revolute", "ground", "d", axis=(0, 0, 1), start='speed="1"'),
        joint("fifth", "revolute", "ground", "e", axis=(0, 1, 0)),
        joint("lift", "prismatic", "ground", "f", axis=(0, 0, 1), start='position="0.7"'),
    ]
    return write_assembly(folder / "wheels.xml", parts, joints, gravity=(0, 0, 0), name="Wheels")


def test_actuators_act(tmp_path: Path) -> None:
    """Closed forms: decay, oscillation, constant torque, step response; the lift stays where it starts."""
    file = assembly(tmp_path)
    (tmp_path / "actuators.toml").write_text(FLYWHEELS)
    package = generate(file, tmp_path / "out")
    text = (package.root / "Mechatronics.mo").read_text()
    assert "Torque motor4(" in text
    inputs = "fourthTorqueReference=0.4, fifthAngleReference=0.5, fifthSpeedReference=0, liftPositionReference=0.7"
    plant = f"within Wheels;\nmodel Driven\n  Mechatronics plant({inputs});\nend Driven;\n"
    (package.root / "Driven.mo").write_text(plant)
    (package.root / "package.order").write_text("Mechanics\nMechatronics\nGeometry\nDriven\n")
    found = simulate(tmp_path / "out", "Wheels.Driven", 1.0, 0.1)
    time = found.time
    np.testing.assert_allclose(found.columns["plant.first.w"], 5 * np.exp(-0.2 / 0.1 * time), atol=1e-7)
    np.testing.assert_allclose(found.columns["plant.second.phi"], 0.3 * np.cos(np.sqrt(2 / 0.1) * time), atol=1e-7)
    np.testing.assert_allclose(found.columns["plant.sled.v"], 4 * np.exp(-3 / 2 * time), atol=1e-7)
    np.testing.assert_allclose(found.columns["plant.fourth.phi"], time + 0.4 / 0.1 * time**2 / 2, atol=1e-7)
    np.testing.assert_allclose(found.columns["plant.fourthAngle"], found.columns["plant.fourth.phi"], atol=1e-12)
    np.testing.assert_allclose(found.columns["plant.fourthTorque"], 0.4, atol=1e-12)
    damped = 20 * np.sqrt(0.75)
    wave = np.cos(damped * time) + 0.5 / np.sqrt(0.75) * np.sin(damped * time)
    np.testing.assert_allclose(found.columns["plant.fifthAngle"], 0.5 * (1 - np.exp(-10 * time) * wave), atol=1e-7)
    np.testing.assert_allclose(found.columns["plant.liftPosition"], 0.7, atol=1e-9)


def test_inputs_and_outputs_of_the_model(tmp_path: Path) -> None:
    file = assembly(tmp_path)
    (tmp_path / "actuators.toml").write_text(FLYWHEELS)
    text = (generate(file, tmp_path / "out").root / "Mechatronics.mo").read_text()
    inputs = dict(re.findall(r"RealInput (\w+)\(start=([\d.]+)", text))
    assert inputs == {
        "fourthTorqueReference": "0",
        "fifthAngleReference": "0.5",
        "fifthSpeedReference": "0",
        "liftPositionReference": "0.7",
    }
    outputs = re.findall(r"RealOutput (\w+)\(", text)
    assert sorted(outputs) == sorted(
        [f"fourth{word}" for word in ("Angle", "Speed", "Torque")]
        + [f"fifth{word}" for word in ("Angle", "Speed", "Torque")]
        + [f"lift{word}" for word in ("Position", "Speed", "Force")]
    )
    assert text.count("connect(motor4.flange, fourthSensor.flange_a)") == 1
    assert text.count("useAxisFlange=true") == 6


def test_actuators_do_not_cover_each_other(tmp_path: Path) -> None:
    file = assembly(tmp_path)
    (tmp_path / "actuators.toml").write_text(FLYWHEELS)
    root = generate(file, tmp_path / "out").root
    text = "".join((root / name).read_text() for name in ("Mechanics.mo", "Mechatronics.mo"))
    found = re.findall(r"Placement\(transformation\(extent=\{\{(-?\d+),(-?\d+)\},\{(-?\d+),(-?\d+)\}\}", text)
    extents = [tuple(map(int, extent)) for extent in found]
    assert len(extents) > 30
    for index, (a, b, c, d) in enumerate(extents):
        for e, f, g, h in extents[:index]:
            assert c <= e or g <= a or d <= f or h <= b


@pytest.mark.parametrize("kind", [JointType.REVOLUTE, JointType.PRISMATIC])
def test_catalogue_agrees_with_the_compiler(tmp_path: Path, kind: JointType) -> None:
    """Parameters, inputs and outputs as an independent front end finds them in the flattened component."""
    components = components_for(kind)
    assert {"Position", "Servo", "CascadeServo", "Sensor", "EndStop"} <= {item.name for item in components}
    (tmp_path / "libraries").mkdir()
    (tmp_path / "libraries" / "ContactMultiBody").symlink_to(ROOT / "ContactMultiBody")
    fixed = "Modelica.Mechanics." + components[0].domain + ".Components.Fixed"
    lines, joins = [], []
    for number, item in enumerate(components):
        inputs = ", ".join(f"{signal.name}=0" for signal in item.inputs if signal.condition is None)
        lines += [f"  {item.class_name} c{number}({inputs});"]
        if item.name == "Position":  # a held flange would fight it
            continue
        lines += [f"  {fixed} f{number};"]
        joins += [f"  connect(c{number}.{'flange_b' if item.name == 'Sensor' else 'flange'}, f{number}.flange);"]
    model = tmp_path / "All.mo"
    model.write_text("\n".join(["model All", *lines, "equation", *joins, "end All;\n"]))
    session = rumoca.Session([str(CORE), str(tmp_path / "libraries")])
    variables = session.load(str(model), model="All").to_dict("flat")["variables"]
    for number, item in enumerate(components):
        own = {name.removeprefix(f"c{number}.") for name in variables if name.startswith(f"c{number}.")}
        assert {parameter.name for parameter in item.parameters} <= own, item.name
        assert {signal.name for signal in item.outputs} <= own
        assert {signal.name for signal in item.inputs if signal.condition is None} <= own
        source = (modelica_library() / "Actuators" / item.domain / f"{item.name}.mo").read_text()
        assert item.description in source


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("[[actuator]]\njoint = 'x'\ncomponent = 'Torque'", "no such joint"),
        ("[[actuator]]\njoint = 'sled'\ncomponent = 'Torque'", "is none for a prismatic joint"),
        ("[[actuator]]\njoint = 'first'\ncomponent = 'Magic'", "is none for a revolute joint"),
        ("[[actuator]]\njoint = 'first'\nkind = 'torque'", "kind has no meaning"),
        ("[[actuator]]\njoint = 'first'\ncomponent = 'Friction'\nparameters = { d = -1 }", "not be negative"),
        ("[[actuator]]\njoint = 'first'\ncomponent = 'Friction'\nparameters = { d = nan }", "finite number"),
        ("[[actuator]]\njoint = 'first'\ncomponent = 'Friction'\nparameters = { d = true }", "finite number"),
        ("[[actuator]]\njoint = 'first'\ncomponent = 'Motor'\nparameters = { R = 0 }", "must be positive"),
        ("[[actuator]]\njoint = 'first'\ncomponent = 'Motor'\nparameters = { useInductance = 1 }", "true or false"),
        (
            "[[actuator]]\njoint = 'first'\ncomponent = 'CascadeServo'\nparameters = { useInductance = true }",
            "is no par",
        ),
        ("[[actuator]]\njoint = 'first'\ncomponent = 'Torque'\nparameters = { gain = 3 }", "is no parameter of Torque"),
        ("[[actuator]]\njoint = 'first'\ncomponent = 'Torque'\ninputs = { phi_ref = 3 }", "is no input of Torque"),
        ("[[actuator]]\njoint = 'first'\ncomponent = 'Torque'\nname = 3", "not a text"),
        (2 * "[[actuator]]\njoint = 'first'\ncomponent = 'Position'\n", "another Position"),
        (2 * "[[actuator]]\njoint = 'first'\ncomponent = 'Sensor'\n", "another Sensor"),
        ("actuator = 3", "[[actuator]]"),
        ("[[actuator]]\njoint = ['first']\ncomponent = 'Torque'", "the name of the joint is no text"),
        ("[[actuator]]\ncomponent = 'Torque'", "the name of the joint is no text"),
        ("[[actuator]]\njoint = 'first'\ncomponent = ['Torque']", "is none for a revolute joint"),
        (f"[[actuator]]\njoint = 'first'\ncomponent = 'Friction'\nparameters = {{ d = {'9' * 400} }}", "at most 1e+30"),
        pytest.param("a = " + "[" * 100_000, "nested too deeply", id="deep"),
        ("[[actuator]", "no TOML"),
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
