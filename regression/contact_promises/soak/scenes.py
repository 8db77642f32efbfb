"""Random small scenes as Modelica text: bodies, grounds, shapes, speeds, materials, laws, friction, restitution."""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from contact_promises.soak.bodies import Body, random_body
from contact_promises.soak.grounds import Ground, random_ground

MODEL: Final = "SoakScene"
STOP: Final = 0.6
"""Time in s: the bodies fall by some centimetres, strike, slide or roll, and strike again."""

_FRICTION = ("None", "Regularised", "Anchored")
_RESTITUTION = ("ImpactSpeed", "Memoryless", "none")
_LAWS = ("Exact", "HuntCrossley", "Flores", "SpringDamper")
_TYPES = "ContactMultiBody.Types"


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


@dataclass(frozen=True)
class Contacts:
    """The contact manager of a scene, the material of all bodies, and what was chosen for it."""

    text: str
    material: str
    law: str
    friction: str
    restitution: str


@dataclass(frozen=True)
class Parts:
    """What a scene is made of, without its contact manager; terms are Modelica expressions.

    Attributes:
        declarations: of bodies, ground and what holds them.
        connections: lines.
        frames: what is connected to the contact manager, the ground last.
        energies: kinetic and potential ones, in J.
        powers: what the contacts do to what the energies are of, in W.
        lost: what dampers take, in W.
        given: what drives of the ground give, in W.
    """

    declarations: Sequence[str]
    connections: Sequence[str]
    frames: Sequence[str]
    energies: Sequence[str]
    powers: Sequence[str]
    lost: Sequence[str] = ()
    given: Sequence[str] = ()


def random_scene(seed: int) -> Scene:
    """Free bodies above a ground that stands; the same for a seed on every machine."""
    source = random.Random(seed)
    bodies = [random_body(source) for _ in range(source.choice((1, 1, 2)))]
    ground = random_ground(source)
    contacts = random_contacts(source, bodies, ground)
    declarations, height = [], 0.0
    for number, body in enumerate(bodies, 1):
        height += body.radius + source.uniform(0.005, 0.1)
        declarations.append(free_body(source, number, body, height, contacts.material))
        height += body.radius
    numbers = range(1, len(bodies) + 1)
    parts = Parts(
        [*declarations, f"  ContactMultiBody.Parts.Ground floor({geometry(ground)}material={contacts.material});"],
        [],
        [*(f"body{i}.frame_a" for i in numbers), "floor.frame_a"],
        [energy(f"body{number}", body.mass) for number, body in enumerate(bodies, 1)],
        [contact_power(f"body{number}", number) for number in numbers],
    )
    return describe(seed, parts, contacts, [body.shape.split("(")[0] for body in bodies], ground.kind)


def describe(seed: int, parts: Parts, contacts: Contacts, bodies: Sequence[str], ground: str) -> Scene:
    """The scene of these parts."""
    frames = [f"  connect({frame}, contacts.frame[{i}]);" for i, frame in enumerate(parts.frames, 1)]
    text = _TEXT.format(
        declarations="\n".join(parts.declarations),
        contacts=contacts.text,
        energy=" + ".join(parts.energies),
        power=" + ".join([*parts.powers, *parts.lost]),
        given=" + ".join(parts.given) or "0",
        connections="\n".join([*parts.connections, *frames]),
        stop=STOP,
    )
    return Scene(seed, text, tuple(bodies), ground, contacts.law, contacts.friction, contacts.restitution)


def random_contacts(source: random.Random, bodies: Sequence[Body], ground: Ground) -> Contacts:
    """The manager of contacts between the bodies and the ground, which is the last of its frames."""
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
    names = [*(f"body{i}" for i in range(1, len(bodies) + 1)), "floor"]
    arguments = [
        f"n={len(names)}",
        *(f"{each}={{{','.join(f'{name}.{each}' for name in names)}}}" for each in ("geometry", "material", "inertia")),
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
    return Contacts(",\n    ".join(arguments), material, law, friction, restitution)


def geometry(ground: Ground) -> str:
    """Modifier of a ground's shape, with its comma; none for the half-space that is there without."""
    return f"geometry={ground.shape}, " if ground.shape else ""


def body_modifiers(body: Body, material: str) -> str:
    """Mass, inertia, shape and material."""
    i_11, i_22, i_33 = body.moments
    return (
        f"m={body.mass:.6g}, r_CM={{0,0,0}}, I_11={i_11:.8g}, I_22={i_22:.8g}, I_33={i_33:.8g},\n"
        f"    geometry=ContactMultiBody.Shapes.{body.shape}, material={material},\n    animation=false"
    )


def free_body(
    source: random.Random, number: int, body: Body, height: float, material: str, upright: bool = False
) -> str:
    """Declaration of a body that flies and turns."""

    def three(limit: float) -> str:
        return ",".join(f"{source.uniform(-limit, limit):.5g}" for _ in range(3))

    return (
        f"  ContactMultiBody.Parts.Body body{number}({body_modifiers(body, material)},\n"
        f"    r_0(start={{0,0,{height:.6g}}}, each fixed=true), v_0(start={{{three(2.0)}}}, each fixed=true),\n"
        f"    angles_fixed=true, angles_start={{{three(0.0 if upright else 3.0)}}}, "
        f"w_0_fixed=true, w_0_start={{{three(15.0)}}});"
    )


def energy(name: str, mass: float) -> str:
    """Kinetic and potential energy of a body, in J."""
    return f"{mass:.6g}*({name}.v_0*{name}.v_0/2 + world.g*{name}.r_0[3]) + {name}.w_a*({name}.I*{name}.w_a)/2"


def contact_power(name: str, number: int) -> str:
    """What a body does to the contacts, in W, as a term of a sum."""
    f = f"contacts.frame[{number}]"
    return f"{f}.f*Modelica.Mechanics.MultiBody.Frames.resolve2({name}.frame_a.R, {name}.v_0) + {f}.t*{name}.w_a"


_TEXT = """model SoakScene "Random bodies above a floor"
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={{0,0,-1}}, enableAnimation=false);
{declarations}
  ContactMultiBody.ContactManager contacts(
    {contacts});
  Modelica.Units.SI.Energy mechanical "Kinetic and potential energy, without what drives gave";
  Modelica.Units.SI.Energy elastic "Stored in the contacts";
  Modelica.Units.SI.Energy work(start=0, fixed=true) "Done by the contacts, without what drives gave";
  Modelica.Units.SI.Energy given(start=0, fixed=true) "By drives of the ground, through contacts";
equation
  mechanical = {energy} - given;
  elastic = contacts.elasticEnergy;
  der(work) = -({power}) - der(given);
  der(given) = {given};
{connections}
  annotation (experiment(StopTime={stop:g}, Tolerance=1e-6, Interval=0.001));
end SoakScene;
"""
