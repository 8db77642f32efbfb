"""A hard case's scene as Modelica text; all that is no part of its structure is a parameter.

Kinds of scenes: a ball or a turned box strikes the floor obliquely; a rod slides on its end and jams (Painlevé); the
topmost box of a stack falls on the others; a box lies deep in the floor, a ball in the box; a hexagonal prism falls on
another with faces that are nearly parallel; the first ball of a row strikes the others, without gravity.
"""

from __future__ import annotations

from typing import Final

from hard_cases.bodies import FLOOR, GRAVITY, Shape, has_gravity, motions, pairs, shapes
from hard_cases.knobs import HardCase, Structure

MODEL: Final = "HardCase"
_TYPES = "ContactMultiBody.Types"
_MATERIAL = "ContactMultiBody.Materials.Material(restitution=e, muStatic=mu, muDynamic=mu)"


def scene_text(structure: Structure) -> str:
    """The model."""
    bodies = shapes(structure)
    floor = has_gravity(structure)
    names = [f"body{k + 1}" for k in range(len(bodies))] + (["floor"] if floor else [])
    touching = [(a, b if b != FLOOR else len(bodies) + 1) for a, b in pairs(structure)]
    contacts = [
        f"n={len(names)}",
        f"collider={{{','.join(f'{name}.collider' for name in names)}}}",
        f"pairs={{{','.join(f'{{{a},{b}}}' for a, b in touching)}}}",
        f"stiffnessChoice={_TYPES}.StiffnessChoice.Given",
        f"stiffness=fill(K, {len(touching)})",
        f"normalLaw={_TYPES}.NormalLaw.{structure.law}",
        f"friction={_TYPES}.Friction.{structure.friction}",
    ]
    if structure.law == "SpringDamper":
        contacts.append(f"damping=fill(c, {len(touching)})")
    elif structure.restitution == "None":
        contacts += ["useRestitution=false", f"steadyRate=fill(D, {len(touching)})"]
    else:
        contacts.append(f"restitutionMethod={_TYPES}.RestitutionMethod.{structure.restitution}")
    number = len(bodies)
    return _TEXT.format(
        model=MODEL,
        number=number,
        gravity=GRAVITY if floor else 0.0,
        bodies="\n".join(_body(k + 1, shape) for k, shape in enumerate(bodies)),
        floor=f"  ContactMultiBody.Parts.Ground floor(material={_MATERIAL});" if floor else "",
        contacts=",\n    ".join(contacts),
        kinetic=" + ".join(
            f"(m[{k}]*(body{k}.v_0*body{k}.v_0) + body{k}.w_a*(body{k}.I*body{k}.w_a))/2" for k in range(1, number + 1)
        ),
        potential=" + ".join(f"m[{k}]*g*body{k}.r_0[3]" for k in range(1, number + 1)),
        momentum=" + ".join(f"m[{k}]*body{k}.v_0" for k in range(1, number + 1)),
        connections="\n".join(f"  connect({name}.frame_a, contacts.frame[{k + 1}]);" for k, name in enumerate(names)),
    )


def start_values(case: HardCase, damping: float, steady_rate: float) -> dict[str, float]:
    """What is set on the FMU for a run.

    Args:
        case: the run.
        damping: of SpringDamper, N.s/m.
        steady_rate: of the damping where restitution is not used, s/m.
    """
    values = {"K": case.stiffness, "e": case.restitution, "mu": case.mu}
    if case.structure.law == "SpringDamper":
        values["c"] = damping
    elif case.structure.restitution == "None":
        values["D"] = steady_rate
    for k, motion in enumerate(motions(case)):
        values[f"m[{k + 1}]"] = motion.mass
        values |= _vector(f"r[{k + 1},", motion.position)
        values |= _vector(f"v[{k + 1},", motion.velocity)
        values |= _vector(f"angles[{k + 1},", motion.angles)
    return values


def signals(structure: Structure) -> tuple[str, ...]:
    """What is recorded."""
    bodies = range(1, len(shapes(structure)) + 1)
    return (
        "kinetic",
        "potential",
        "elastic",
        *(f"momentum[{i}]" for i in (1, 2, 3)),
        *(f"body{k}.r_0[{i}]" for k in bodies for i in (1, 2, 3)),
        *(f"contacts.distance[{k + 1}]" for k in range(len(pairs(structure)))),
    )


def _vector(prefix: str, values: tuple[float, float, float]) -> dict[str, float]:
    return {f"{prefix}{i + 1}]": float(value) for i, value in enumerate(values)}


def _body(number: int, shape: Shape) -> str:
    i_11, i_22, i_33 = shape.moments
    n = number
    return (
        f"  ContactMultiBody.Parts.Body body{n}(m=m[{n}], r_CM={{0,0,0}}, I_11=m[{n}]*{i_11!r}, I_22=m[{n}]*{i_22!r}, "
        f"I_33=m[{n}]*{i_33!r},\n"
        f"    geometry=ContactMultiBody.Shapes.{shape.text}, material={_MATERIAL},\n"
        f"    r_0(start=r[{n},:], each fixed=true), v_0(start=v[{n},:], each fixed=true),\n"
        f"    angles_fixed=true, angles_start=angles[{n},:], w_0_fixed=true, animation=false);"
    )


_TEXT = """model {model} "A hard case of contact"
  import SI = Modelica.Units.SI;
  constant SI.Acceleration g={gravity};
  parameter Real K(unit="N/m")=1e6 "Stiffness of every pair";
  parameter Real e(unit="1")=0.5 "Coefficient of restitution";
  parameter Real mu(unit="1")=0.5 "Coefficient of friction";
  parameter Real c(unit="N.s/m")=1 "Damping of springs with dampers";
  parameter Real D(unit="s/m")=0.5 "Damping without restitution";
  parameter SI.Mass m[{number}]=fill(1, {number}) "Mass of each body";
  parameter SI.Position r[{number}, 3]=fill(0, {number}, 3) "Where each starts";
  parameter SI.Velocity v[{number}, 3]=fill(0, {number}, 3) "How fast";
  parameter SI.Angle angles[{number}, 3]=fill(0, {number}, 3) "How turned";
  inner Modelica.Mechanics.MultiBody.World world(g=g, n={{0,0,-1}}, enableAnimation=false);
{bodies}
{floor}
  ContactMultiBody.ContactManager contacts(
    {contacts});
  SI.Energy kinetic "Of all bodies";
  SI.Energy potential "Of all bodies";
  SI.Energy elastic "Stored in the contacts";
  SI.Momentum momentum[3] "Of all bodies";
equation
  kinetic = {kinetic};
  potential = {potential};
  elastic = contacts.elasticEnergy;
  momentum = {momentum};
{connections}
  annotation (experiment(StopTime=1, Tolerance=1e-6, Interval=0.01));
end {model};
"""
