"""Random small scenes as Modelica text: bodies, grounds, shapes, speeds, materials, laws, friction, restitution."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass
from typing import Final

from contact_promises.soak.grounds import Ground, random_ground

MODEL: Final = "SoakScene"
STOP: Final = 0.6
"""Time in s: the bodies fall by some centimetres, strike, slide or roll, and strike again."""

_FRICTION = ("None", "Regularised", "Anchored")
_RESTITUTION = ("ImpactSpeed", "Memoryless", "none")
_LAWS = ("Exact", "HuntCrossley", "Flores", "SpringDamper")
_TYPES = "ContactMultiBody.Types"


@dataclass(frozen=True)
class Body:
    """A body: call of its shape, mass in kg, principal moments in kg.m2, radius of its bounding sphere in m."""

    shape: str
    mass: float
    moments: tuple[float, float, float]
    radius: float


@dataclass(frozen=True)
class Scene:
    """A scene: its seed, its Modelica text, and what it is made of; the ground's kind is that of its shape."""

    seed: int
    text: str
    bodies: tuple[str, ...]
    ground: str
    law: str
    friction: str
    restitution: str


def random_scene(seed: int) -> Scene:
    """The scene of a seed; the same on every machine."""
    source = random.Random(seed)
    bodies = [_random_body(source) for _ in range(source.choice((1, 1, 2)))]
    ground = random_ground(source)
    law = source.choice(_LAWS)
    friction = source.choice(_FRICTION)
    restitution = source.choice(_RESTITUTION)
    material = (
        f"ContactMultiBody.Materials.Material(restitution={source.choice((0.0, 0.2, 0.5, 0.8)):g}, "
        f"muStatic={source.uniform(0.1, 1.2):.4g}, muDynamic={source.uniform(0.05, 0.8):.4g})"
    )
    pairs = len(bodies) * (len(bodies) + 1) // 2
    stiffness = 10.0 ** source.uniform(4.0, 7.0)
    lightest = min(body.mass for body in bodies)
    contacts = [
        f"n={len(bodies) + 1}",
        "geometry={" + ",".join(f"body{i}.geometry" for i in range(1, len(bodies) + 1)) + ",floor.geometry}",
        "material={" + ",".join(f"body{i}.material" for i in range(1, len(bodies) + 1)) + ",floor.material}",
        "inertia={" + ",".join(f"body{i}.inertia" for i in range(1, len(bodies) + 1)) + ",floor.inertia}",
        f"pointCapacity={ground.points}",
        f"stiffnessChoice={_TYPES}.StiffnessChoice.Given",
        f"stiffness=fill({stiffness:.6g}, {pairs})",
        f"damping=fill({0.2 * (stiffness * lightest) ** 0.5:.6g}, {pairs})",
        f"normalLaw={_TYPES}.NormalLaw.{law}",
        f"friction={_TYPES}.Friction.{friction}",
        "useRestitution=false"
        if restitution == "none"
        else f"restitutionMethod={_TYPES}.RestitutionMethod.{restitution}",
    ]
    declarations, height = [], 0.0
    for number, body in enumerate(bodies, 1):
        height += body.radius + source.uniform(0.005, 0.1)
        declarations.append(_declaration(source, number, body, height, material))
        height += body.radius
    text = _TEXT.format(
        bodies="\n".join(declarations),
        ground=_ground_geometry(ground),
        material=material,
        contacts=",\n    ".join(contacts),
        energy=" + ".join(_energy(number, body.mass) for number, body in enumerate(bodies, 1)),
        power=" - ".join(_power(number) for number in range(1, len(bodies) + 1)),
        connections="\n".join(f"  connect(body{i}.frame_a, contacts.frame[{i}]);" for i in range(1, len(bodies) + 1)),
        floor=len(bodies) + 1,
        stop=STOP,
    )
    names = tuple(body.shape.split("(")[0] for body in bodies)
    return Scene(seed, text, names, ground.kind, law, friction, restitution)


def _ground_geometry(ground: Ground) -> str:
    return f"geometry={ground.shape}, " if ground.shape else ""


def _random_body(source: random.Random) -> Body:
    kind = source.choice(("sphere", "box", "capsule", "cylinder", "cone", "ellipsoid"))
    mass = 10.0 ** source.uniform(-1.5, 0.7)
    if kind == "sphere":
        r = source.uniform(0.02, 0.1)
        return Body(f"sphere({r:.4g})", mass, (0.4 * mass * r**2,) * 3, r)
    if kind in ("capsule", "cylinder"):
        r, length = source.uniform(0.01, 0.05), source.uniform(0.03, 0.2)
        across = mass * (3.0 * r**2 + length**2) / 12.0
        return Body(f"{kind}({r:.4g}, {length:.4g})", mass, (across, across, mass * r**2 / 2.0), r + length / 2.0)
    if kind == "cone":  # its frame in its centre of mass
        r, length = source.uniform(0.02, 0.07), source.uniform(0.03, 0.15)
        across = mass * (12.0 * r**2 + 3.0 * length**2) / 80.0
        shape = f"cone({r:.4g}, {length:.4g}, position={{0,0,{length / 4.0:.6g}}})"
        return Body(shape, mass, (across, across, 0.3 * mass * r**2), max(0.75 * length, math.hypot(r, length / 4.0)))
    x, y, z = (source.uniform(0.03, 0.15) for _ in range(3))
    share = 12.0 if kind == "box" else 20.0
    moments = tuple(mass * s / share for s in (y**2 + z**2, x**2 + z**2, x**2 + y**2))
    radius = (x**2 + y**2 + z**2) ** 0.5 / 2.0
    return Body(f"{kind}({{{x:.4g},{y:.4g},{z:.4g}}})", mass, (moments[0], moments[1], moments[2]), radius)


def _declaration(source: random.Random, number: int, body: Body, height: float, material: str) -> str:
    def three(limit: float) -> str:
        return ",".join(f"{source.uniform(-limit, limit):.5g}" for _ in range(3))

    i_11, i_22, i_33 = body.moments
    return (
        f"  ContactMultiBody.Parts.Body body{number}(m={body.mass:.6g}, r_CM={{0,0,0}}, "
        f"I_11={i_11:.8g}, I_22={i_22:.8g}, I_33={i_33:.8g},\n"
        f"    geometry=ContactMultiBody.Shapes.{body.shape}, material={material},\n"
        f"    r_0(start={{0,0,{height:.6g}}}, each fixed=true), v_0(start={{{three(2.0)}}}, each fixed=true),\n"
        f"    angles_fixed=true, angles_start={{{three(3.0)}}}, w_0_fixed=true, w_0_start={{{three(15.0)}}},\n"
        "    animation=false);"
    )


def _energy(number: int, mass: float) -> str:
    b = f"body{number}"
    return f"{mass:.6g}*({b}.v_0*{b}.v_0/2 + world.g*{b}.r_0[3]) + {b}.w_a*({b}.I*{b}.w_a)/2"


def _power(number: int) -> str:
    b, f = f"body{number}", f"contacts.frame[{number}]"
    return f"{f}.f*Modelica.Mechanics.MultiBody.Frames.resolve2({b}.frame_a.R, {b}.v_0) - {f}.t*{b}.w_a"


_TEXT = """model SoakScene "Random bodies above a floor"
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={{0,0,-1}}, enableAnimation=false);
{bodies}
  ContactMultiBody.Parts.Ground floor({ground}material={material});
  ContactMultiBody.ContactManager contacts(
    {contacts});
  Modelica.Units.SI.Energy mechanical "Kinetic and potential energy";
  Modelica.Units.SI.Energy elastic "Stored in the contacts";
  Modelica.Units.SI.Energy work(start=0, fixed=true) "Done by the contacts";
equation
  mechanical = {energy};
  elastic = contacts.elasticEnergy;
  der(work) = -{power};
{connections}
  connect(floor.frame_a, contacts.frame[{floor}]);
  annotation (experiment(StopTime={stop:g}, Tolerance=1e-6, Interval=0.001));
end SoakScene;
"""
