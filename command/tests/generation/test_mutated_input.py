"""Inputs damaged at random: used as they are, or refused with file and place; never a traceback, nothing left behind.

``CMB_MUTATIONS=N`` draws N of each kind, and ``CMB_MUTATION_SEED`` begins elsewhere.
"""

from __future__ import annotations

import os
import random
import re
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from cmb.main import main
from contact_data import core_subset
from contact_foundation.errors import CmbError
from fmu_regression.scene.scene_file import load_scene
from modelica2fmu.library.standard_library import StandardLibrary
from modelica2fmu.translation import translate

COUNT = int(os.environ.get("CMB_MUTATIONS", "12"))
FIRST_SEED = int(os.environ.get("CMB_MUTATION_SEED", "0"))

NUMBERS = (
    "nan",
    "-inf",
    "-1",
    "0",
    "1e400",
    "1e30",
    "1e-320",
    "",
    "1,5",
    "0x10",
    "\uff11",
    "9" * 400,
    "1_0",
    "--1",
    "1e",
)
WORDS = (
    "model",
    "end",
    "\u00fcber",
    "a b",
    "a/b",
    "../../x",
    "",
    "x" * 5000,
    "\U0001f916",
    "true",
    "-",
    "'q'",
    "ground",
)
WHOLE = (b"", b"\n", b"\0" * 64, b"\xff\xfe<\0r\0", b"\xef\xbb\xbf<robot/>", b"<" * 5000, b"[[[" * 800, b"{" * 3000)

QUOTED = (
    b'"equation"',
    '"\u5173\u8282 \u00e9"'.encode(),
    b'"world"',
    b'"Modelica"',
    b'"a&quot;b&#10;c"',
    b'"0 0 0"',
    b'"-1 1e-30 1"',
)

TETRAHEDRON = """solid t
facet normal 0 0 0
outer loop
vertex 0 0 0
vertex 0.1 0 0
vertex 0 0.1 0
endloop
endfacet
facet normal 0 0 0
outer loop
vertex 0 0 0
vertex 0 0.1 0
vertex 0 0 0.1
endloop
endfacet
facet normal 0 0 0
outer loop
vertex 0 0 0
vertex 0 0 0.1
vertex 0.1 0 0
endloop
endfacet
facet normal 0 0 0
outer loop
vertex 0.1 0 0
vertex 0 0 0.1
vertex 0 0.1 0
endloop
endfacet
endsolid t
"""
INERTIAL = (
    '<inertial><origin xyz="0.02 0 0"/><mass value="0.5"/>'
    '<inertia ixx="1e-3" iyy="1e-3" izz="1e-3" ixy="0" ixz="0" iyz="0"/></inertial>'
)
INPUTS: dict[str, dict[str, str]] = {
    "robot.urdf": {
        "robot.urdf": f"""<robot name="arm">
<link name="base"><visual><geometry><box size="0.2 0.2 0.1"/></geometry></visual></link>
<link name="upper">{INERTIAL}<visual><origin rpy="0 1.57 0"/><geometry><mesh filename="t.stl" scale="1 1 1"/>
</geometry></visual></link>
<link name="lower">{INERTIAL}<collision><geometry><cylinder radius="0.02" length="0.2"/></geometry></collision></link>
<joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><origin xyz="0 0 0.3" rpy="0 0 0"/>
<axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="3" velocity="2"/><dynamics damping="0.1" friction="0.05"/>
</joint>
<joint name="elbow" type="continuous"><parent link="upper"/><child link="lower"/><origin xyz="0 0 0.4"/>
<axis xyz="1 0 0"/>
<mimic joint="shoulder" multiplier="2" offset="0.1"/></joint>
</robot>""",
        "t.stl": TETRAHEDRON,
        "actuators.toml": '[[actuator]]\njoint = "shoulder"\ncomponent = "Torque"\nparameters = { tau_max = 3.0 }\n',
    },
    "machine.xml": {
        "machine.xml": """<assembly xmlns="urn:contactmultibody:assembly:1" name="Pendulum">
<units length="mm" mass="kg" angle="deg"/>
<gravity>0 0 -9.81</gravity>
<materials><material name="steel" youngsModulus="2.1e11" poissonsRatio="0.3" restitution="0.5"/></materials>
<ground><plane name="floor" material="steel"/></ground>
<parts><part name="rod" material="steel">
<pose><position>0 0 300</position><axisAngle axis="0 1 0" angle="90"/></pose>
<massProperties><mass>0.5</mass><centerOfMass>100 0 0</centerOfMass>
<inertia about="centerOfMass" axes="part" products="tensor" xx="80" yy="1700" zz="1700" xy="0" xz="0" yz="0"/>
</massProperties>
<geometry file="rod.wrl" node="rod" coordinates="node" length="mm"/>
</part></parts>
<joints><joint name="hinge" type="revolute" parent="ground" child="rod">
<origin>0 0 300</origin><axis>0 1 0</axis><limits lower="-90" upper="120"/><start position="90" speed="0"/></joint>
</joints>
<contacts default="all" stiffness="1e6"/>
</assembly>""",
        "rod.wrl": """#VRML V2.0 utf8
PROTO Bar [ field SFVec3f size 200 20 20 ] { Shape { geometry Box { size IS size } } }
DEF rod Transform { translation 100 0 0 children [ Bar { }
Shape { appearance Appearance { material Material { diffuseColor 0.5 0.5 0.5 } } geometry IndexedFaceSet {
coord Coordinate { point [ 0 0 20, 10 0 20, 0 10 20, 0 0 40 ] } coordIndex [ 0 2 1 -1 0 1 3 -1 1 2 3 -1 0 3 2 -1 ] }
} ] }
""",
    },
    "scene.xml": {
        "scene.xml": """<mujoco model="scene"><compiler angle="degree" autolimits="true"/>
<option gravity="0 0 -9.81" timestep="0.002"/>
<default><geom density="500" friction="0.8 0.1 0.1"/><default class="leg"><joint damping="0.2" range="-60 60"/>
</default></default>
<asset><mesh name="t" file="t.stl" scale="2 2 2"/></asset>
<worldbody><geom name="floor" type="plane" size="1 1 0.1"/>
<body name="trunk" pos="0 0 0.5"><freejoint/><geom type="box" size="0.1 0.1 0.05"/>
<body name="leg" pos="0.1 0 0" euler="0 10 0" childclass="leg"><joint name="hip" axis="0 1 0"/>
<geom type="capsule" fromto="0 0 0 0 0 -0.2" size="0.02"/>
<geom type="mesh" mesh="t" pos="0 0 -0.3"/></body></body></worldbody>
<actuator><motor joint="hip" gear="5" ctrlrange="-1 1"/></actuator></mujoco>""",
        "t.stl": TETRAHEDRON,
    },
    "world.sdf": {
        "world.sdf": """<sdf version="1.9"><model name="cart"><pose>0 0 0.2 0 0 0</pose>
<link name="base"><inertial><mass>2</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>
<collision name="c"><geometry><box><size>0.4 0.2 0.1</size></box></geometry></collision></link>
<link name="wheel"><pose relative_to="base">0.1 0.15 0 1.57 0 0</pose><inertial><mass>0.3</mass></inertial>
<collision name="c"><geometry><mesh><uri>t.stl</uri></mesh></geometry><surface><friction><ode><mu>0.7</mu></ode>
</friction></surface></collision></link>
<joint name="axle" type="revolute"><parent>base</parent><child>wheel</child><axis><xyz expressed_in="base">0 1 0</xyz>
<limit><lower>-1e16</lower><upper>1e16</upper></limit><dynamics><damping>0.1</damping></dynamics></axis></joint>
</model></sdf>""",
        "t.stl": TETRAHEDRON,
    },
    "export.xml": {
        "export.xml": """<SimscapeMultibodyImportXML version="2.0" xmlns="urn:mathworks:SimscapeMultibody:import">
<Created by="" from="CAD"/><ModelUnits mass="kilogram" length="millimeter"/><DataUnits mass="kilogram" length="meter"/>
<RootAssembly name="Root" uid="Root"><InstanceTree>
<Instance name="base" uid="base" entityUid="base" grounded="true"><Transform><Rotation>1 0 0 0 1 0 0 0 1</Rotation>
<Translation>0 0 0</Translation></Transform></Instance>
<Instance name="arm" uid="arm" entityUid="arm"><Transform><Rotation>1 0 0 0 1 0 0 0 1</Rotation>
<Translation>0.5 0 0</Translation></Transform></Instance></InstanceTree>
<Constraints><Concentric name="axis"><ConstraintGeometry geomType="line"><InstancePath><Uid>base</Uid></InstancePath>
<Position>0.5 0 0</Position><Axis>0 0 1</Axis></ConstraintGeometry><ConstraintGeometry geomType="line"><InstancePath>
<Uid>arm</Uid></InstancePath><Position>0 0 0</Position><Axis>0 0 1</Axis></ConstraintGeometry></Concentric>
<Coincident name="face"><ConstraintGeometry geomType="plane"><InstancePath><Uid>base</Uid></InstancePath>
<Position>0 0 0</Position><Axis>0 0 1</Axis></ConstraintGeometry><ConstraintGeometry geomType="plane"><InstancePath>
<Uid>arm</Uid></InstancePath><Position>0 0 0</Position><Axis>0 0 -1</Axis></ConstraintGeometry></Coincident>
</Constraints><Joints></Joints></RootAssembly><Assemblies></Assemblies><Parts>
<Part name="base" uid="base"><MassProperties><Mass>2</Mass><CenterOfMass>0.5 0 0</CenterOfMass>
<Inertia>0.01 0.2 0.2 0 0 0</Inertia></MassProperties></Part>
<Part name="arm" uid="arm"><MassProperties><Mass>1</Mass><CenterOfMass>0.2 0 0</CenterOfMass>
<Inertia>0.01 0.05 0.05 0 0 0</Inertia></MassProperties></Part></Parts></SimscapeMultibodyImportXML>""",
    },
}

MODEL = """model Tank "Fills and empties"
  constant Real pi = 3.141592653589793;
  parameter Integer n(min=1) = 3 "Cells";
  parameter Real area[n](each unit="m2") = fill(0.5, n);
  Real level[n](each start=1.0, each fixed=true, each unit="m");
  Real flow[n + 1](each unit="m3/s");
  discrete Integer count(start=0, fixed=true);
  Boolean high = level[1] > 1.2;
  function valve "Flow by level"
    input Real h; input Real k = 2.0; output Real q;
  protected Real root;
  algorithm
    root := if h > 0 then sqrt(h) else 0;
    for i in 1:2 loop q := k*root/i; end for;
  end valve;
equation
  flow[1] = 1 + 0.5*sin(2*pi*time);
  for i in 1:n loop
    area[i]*der(level[i]) = flow[i] - flow[i + 1];
    flow[i + 1] = valve(level[i], k=1.5);
  end for;
  when high then count = pre(count) + 1; end when;
  assert(level[n] < 100, "overflows at " + String(time));
  annotation(experiment(StopTime=2, Tolerance=1e-6));
end Tank;
"""


def mutated(text: bytes, draw: random.Random) -> bytes:
    """A text with one or two changes drawn at random."""
    for _ in range(draw.choice((1, 1, 2))):
        text = draw.choice(CHANGES)(text, draw)
    return text


def cut(text: bytes, draw: random.Random) -> bytes:
    return text[: draw.randrange(len(text) + 1)]


def without_slice(text: bytes, draw: random.Random) -> bytes:
    begin = draw.randrange(len(text) + 1)
    return text[:begin] + text[begin + draw.randrange(1, 60) :]


def doubled_slice(text: bytes, draw: random.Random) -> bytes:
    begin = draw.randrange(len(text) + 1)
    piece = text[begin : begin + draw.randrange(1, 200)]
    place = draw.randrange(len(text) + 1)
    return text[:place] + piece + text[place:]


def other_byte(text: bytes, draw: random.Random) -> bytes:
    place = draw.randrange(len(text) + 1)
    return text[:place] + bytes([draw.randrange(256)]) + text[place + 1 :]


def other_token(pattern: bytes, choices: tuple[str, ...]) -> Callable[[bytes, random.Random], bytes]:
    def change(text: bytes, draw: random.Random) -> bytes:
        found = list(re.finditer(pattern, text))
        if not found:
            return text
        token = draw.choice(found)
        other = draw.choice((*choices, draw.choice(found)[0].decode("latin-1")))
        return text[: token.start()] + other.encode() + text[token.end() :]

    return change


def other_value(text: bytes, draw: random.Random) -> bytes:
    """A value in quotes that another one of the file stands for: names twice, circles, lengths of other things."""
    found = list(re.finditer(rb'"[^"\n]*"', text))
    if not found:
        return text
    value = draw.choice(found)
    return text[: value.start()] + draw.choice((*QUOTED, draw.choice(found)[0])) + text[value.end() :]


def other_whole(text: bytes, draw: random.Random) -> bytes:
    return draw.choice((*WHOLE, text.decode("latin-1").encode("utf-16"), text.replace(b"\n", b"\r\n"), text + text))


CHANGES = (
    cut,
    without_slice,
    doubled_slice,
    other_byte,
    other_token(rb"-?\d[\d.e+-]*", NUMBERS),
    other_token(rb"-?\d[\d.e+-]*", NUMBERS),
    other_token(rb"[A-Za-z_][A-Za-z_0-9]*", WORDS),
    other_token(rb"[A-Za-z_][A-Za-z_0-9]*", WORDS),
    other_value,
    other_value,
    other_whole,
)


@pytest.mark.parametrize("seed", range(FIRST_SEED, FIRST_SEED + COUNT))
@pytest.mark.parametrize("name", INPUTS)
def test_damaged_description(tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str, seed: int) -> None:
    draw = random.Random(f"{name} {seed}")
    folder = tmp_path / "source"
    folder.mkdir()
    for file, text in INPUTS[name].items():
        (folder / file).write_text(text, encoding="utf-8")
    damaged = folder / draw.choice(list(INPUTS[name]))
    kind = draw.random()
    if kind < 0.05:
        damaged.unlink()
        damaged.mkdir()
    elif kind < 0.1:
        damaged.unlink()
        damaged.symlink_to("/etc/hostname" if kind < 0.075 else damaged.name)
    else:
        damaged.write_bytes(mutated(damaged.read_bytes(), draw))
    output = tmp_path / "out"
    status = main(["generate", str(folder / name), "--output", str(output)])
    said = capsys.readouterr().err
    assert status in (0, 2), said
    if status == 0:
        load_scene(output / "scene.json")
        shutil.rmtree(output)
    else:
        assert "cmb: " in said, said
        assert any(file in said for file in INPUTS[name]), said
    assert [entry.name for entry in tmp_path.iterdir()] == ["source"]


@pytest.mark.parametrize("seed", range(FIRST_SEED, FIRST_SEED + COUNT))
def test_damaged_model(tmp_path: Path, seed: int) -> None:
    draw = random.Random(f"model {seed}")
    file = tmp_path / "Tank.mo"
    file.write_bytes(mutated(MODEL.encode(), draw))
    refusal: CmbError | None = None
    try:
        translate("Tank", [file], StandardLibrary(core_subset(), "", "core subset"))
    except CmbError as error:
        refusal = error
    assert refusal is None or (refusal.exit_status == 2 and "Tank" in str(refusal)), refusal
