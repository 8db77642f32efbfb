"""Random small machines as Modelica text: bodies at joints and springs, grounds that shake, turn or yield."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass, field
from typing import Final

from contact_promises.soak.bodies import Body, random_body
from contact_promises.soak.grounds import Ground, random_ground
from contact_promises.soak.scenes import (
    Contacts,
    Parts,
    Scene,
    body_modifiers,
    contact_power,
    describe,
    energy,
    free_body,
    geometry,
    random_contacts,
)

_MULTIBODY: Final = "Modelica.Mechanics.MultiBody"
_HOLDS: Final = ("free", "hung", "hung", "sliding", "round")
_GROUNDS: Final = ("still", "shaken", "turned", "sprung")
_APART: Final = 0.02
"""Distance in m that a body at another one's link keeps at the start."""


@dataclass
class _Machine:
    """What is written so far."""

    source: random.Random
    contacts: Contacts
    declarations: list[str] = field(default_factory=list)
    connections: list[str] = field(default_factory=list)
    energies: list[str] = field(default_factory=list)
    lost: list[str] = field(default_factory=list)
    given: list[str] = field(default_factory=list)

    def within(self, low: float, high: float) -> str:
        return f"{self.source.uniform(low, high):.5g}"

    def declare(self, kind: str, name: str, modifiers: str) -> None:
        self.declarations.append(f"  {kind} {name}({modifiers});")

    def connect(self, first: str, second: str) -> None:
        self.connections.append(f"  connect({first}, {second});")

    def shift(self, name: str, frame: str, way: tuple[float, float, float]) -> str:
        """A frame beside another one."""
        text = ",".join(f"{each:.6g}" for each in way)
        self.declare(f"{_MULTIBODY}.Parts.FixedTranslation", name, f"r={{{text}}}, animation=false")
        self.connect(frame, f"{name}.frame_a")
        return f"{name}.frame_b"

    def joint(self, kind: str, name: str, modifiers: str, frame: str) -> str:
        """A frame that moves against another one."""
        self.declare(f"{_MULTIBODY}.Joints.{kind}", name, f"{modifiers}, animation=false")
        self.connect(frame, f"{name}.frame_a")
        return f"{name}.frame_b"

    def spring(self, joint: str, stiffness: float, damping: float, rest: float) -> None:
        """Between the flanges of a prismatic joint."""
        name = f"{joint}Spring"
        modifiers = f"c={stiffness:.6g}, d={damping:.6g}, s_rel0={rest:.6g}"
        self.declare("Modelica.Mechanics.Translational.Components.SpringDamper", name, modifiers)
        self.connect(f"{name}.flange_a", f"{joint}.support")
        self.connect(f"{name}.flange_b", f"{joint}.axis")
        self.energies.append(f"{stiffness:.6g}*({joint}.s - {rest:.6g})^2/2")
        self.lost.append(f"{damping:.6g}*{joint}.v^2")


def random_machine(seed: int) -> Scene:
    """The machine of a seed; the same on every machine."""
    source = random.Random(f"machine {seed}")
    bodies = [random_body(source) for _ in range(source.choice((1, 1, 2)))]
    ground = random_ground(source)
    machine = _Machine(source, random_contacts(source, bodies, ground))
    is_linked = len(bodies) > 1 and source.random() < 0.5
    height, holds = bodies[0].radius + source.uniform(0.005, 0.1), [source.choice(_HOLDS)]
    _hold(machine, holds[0], 1, bodies[0], height, is_linked)
    if is_linked:
        holds.append("linked")
        _link(machine, *bodies)
    elif len(bodies) > 1:
        height += bodies[0].radius + bodies[1].radius + source.uniform(0.005, 0.1)
        holds.append(source.choice(_HOLDS))
        _hold(machine, holds[1], 2, bodies[1], height, False)
    carrier = _ground(machine, ground, len(bodies) + 1)
    numbers = range(1, len(bodies) + 1)
    moving = [(f"body{i}", body.mass) for i, body in enumerate(bodies, 1)]
    powers = [contact_power(f"body{i}", i) for i in numbers]
    if carrier == "sprung":
        powers.append(contact_power("floor", len(bodies) + 1))
    parts = Parts(
        machine.declarations,
        machine.connections,
        [*(f"body{i}.frame_a" for i in numbers), "floor.frame_a"],
        [*(energy(name, mass) for name, mass in moving), *machine.energies],
        powers,
        machine.lost,
        machine.given,
    )
    names = [f"{hold}.{body.shape.split('(')[0]}" for hold, body in zip(holds, bodies, strict=True)]
    return describe(seed, parts, machine.contacts, names, f"{carrier}.{ground.kind}")


def _hold(machine: _Machine, kind: str, number: int, body: Body, height: float, upright: bool) -> None:
    """A body, its centre at a height, and what holds it in the world."""
    source, name, joint = machine.source, f"body{number}", f"joint{number}"
    if kind == "free":
        machine.declarations.append(free_body(source, number, body, height, machine.contacts.material, upright))
        return
    machine.declare("ContactMultiBody.Parts.Body", name, body_modifiers(body, machine.contacts.material))
    frame, arm = f"{name}.frame_a", source.uniform(0.05, 0.3)
    if kind == "sliding":
        base = machine.shift(f"base{number}", "world.frame_b", (0.0, 0.0, height))
        axis = f"{{{machine.within(-0.5, 0.5)},{machine.within(-0.5, 0.5)},-1}}"
        is_sprung = source.random() < 0.5
        start = _start("s", "v", "0", machine.within(-0.5, 2.0))
        modifiers = f"n={axis}, useAxisFlange={str(is_sprung).lower()}, {start}"
        machine.connect(machine.joint("Prismatic", joint, modifiers, base), frame)
        if is_sprung:
            machine.spring(joint, source.uniform(10.0, 500.0), source.uniform(0.0, 3.0), source.uniform(0.0, 0.1))
        return
    first, second = (0.0, 0.0) if upright else (source.uniform(-1.0, 1.0), source.uniform(-0.5, 0.5))
    if kind == "hung":
        second = 0.0
        axis = f"{{{machine.within(-1.0, 1.0)},1,0}}"
        start = _start("phi", "w", f"{first:.5g}", machine.within(-8.0, 8.0))
        modifiers, joint_kind = f"n={axis}, {start}", "Revolute"
    else:
        speeds = ",".join(machine.within(-8.0, 8.0) for _ in range(3))
        modifiers = (
            f"enforceStates=true, angles_fixed=true, angles_start={{{first:.5g},{second:.5g},0}}, "
            f"w_rel_a_fixed=true, w_rel_a_start={{{speeds}}}"
        )
        joint_kind = "Spherical"
    pivot = height + arm * math.cos(first) * math.cos(second)
    base = machine.shift(f"base{number}", "world.frame_b", (0.0, 0.0, pivot))
    end = machine.joint(joint_kind, joint, modifiers, base)
    machine.connect(machine.shift(f"arm{number}", end, (0.0, 0.0, -arm)), frame)


def _link(machine: _Machine, first: Body, second: Body) -> None:
    """The second body at a joint above the first."""
    source = machine.source
    machine.declare("ContactMultiBody.Parts.Body", "body2", body_modifiers(second, machine.contacts.material))
    reach = first.radius + second.radius + _APART
    base = machine.shift("base2", "body1.frame_a", (0.0, 0.0, reach))
    start = _start("phi", "w", machine.within(-0.3, 0.3), machine.within(-5.0, 5.0))
    arm = source.uniform(0.05, 0.2)
    end = machine.joint("Revolute", "joint2", f"n={{1,{machine.within(-1.0, 1.0)},0}}, {start}", base)
    machine.connect(machine.shift("arm2", end, (0.0, 0.0, arm)), "body2.frame_a")


def _start(position: str, rate: str, at: str, speed: str) -> str:
    return f"{position}(start={at}, fixed=true), {rate}(start={speed}, fixed=true)"


def _ground(machine: _Machine, ground: Ground, number: int) -> str:
    """The ground and what moves it; returns which."""
    source, material = machine.source, machine.contacts.material
    kind = source.choice(_GROUNDS)
    if kind == "still":
        machine.declare("ContactMultiBody.Parts.Ground", "floor", f"{geometry(ground)}material={material}")
        return kind
    mass = source.uniform(1.0, 20.0)
    shape = ground.shape or "ContactMultiBody.Shapes.halfSpace()"
    moment = 0.02 * mass
    floor = Body(shape.removeprefix("ContactMultiBody.Shapes."), mass, (moment, moment, moment), 0.0)
    machine.declare("ContactMultiBody.Parts.Body", "floor", body_modifiers(floor, material))
    frame = "floor.frame_a"
    if kind == "sprung":
        modifiers = f"n={{0,0,1}}, useAxisFlange=true, {_start('s', 'v', '0', '0')}"
        machine.connect(machine.joint("Prismatic", "carrier", modifiers, "world.frame_b"), frame)
        stiffness = 10.0 ** source.uniform(3.0, 5.0)
        machine.spring(
            "carrier", stiffness, source.uniform(0.0, 0.2) * math.sqrt(stiffness * mass), mass * 9.81 / stiffness
        )
        machine.energies.append(energy("floor", mass))
        return kind
    is_turned = kind == "turned"
    axis = "{0,0,1}" if is_turned else f"{{{machine.within(-1.0, 1.0)},0,1}}"
    kind_of_joint, modifiers = "Revolute" if is_turned else "Prismatic", f"n={axis}, useAxisFlange=true"
    machine.connect(machine.joint(kind_of_joint, "carrier", modifiers, "world.frame_b"), frame)
    amplitude, frequency = ((0.2, 1.0), (0.5, 2.0)) if is_turned else ((0.002, 0.01), (2.0, 10.0))
    machine.declare(
        "Modelica.Blocks.Sources.Sine",
        "wave",
        f"amplitude={machine.within(*amplitude)}, f={machine.within(*frequency)}",
    )
    library = "Rotational" if is_turned else "Translational"
    machine.declare(f"Modelica.Mechanics.{library}.Sources.Position", "drive", "exact=true")
    machine.connect("wave.y", f"drive.{'phi' if is_turned else 's'}_ref")
    machine.connect("drive.flange", "carrier.axis")
    machine.given.append(contact_power("floor", number))
    return kind
