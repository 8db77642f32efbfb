"""Actuators of the mechatronic model: which joint is driven how, from a TOML file.

```toml
[[actuator]]
joint = "shoulder"       # name in the CAD assembly
kind = "torque"          # torque, force: driven by an input; damper, springDamper: passive
name = "shoulderMotor"   # optional
damping = 0.5            # N.m.s/rad or N.s/m: damper, springDamper
stiffness = 100.0        # N.m/rad or N/m: springDamper
```
"""

from __future__ import annotations

import math
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from cmb_base.errors import Place

from cad2modelica.loops import LoopAnalysis
from cad2modelica.model import Assembly, Joint, JointType
from cad2modelica.modelica_names import NamePool
from cad2modelica.modelica_text import number
from cad2modelica.problems import Problems

FILE_NAME = "actuators.toml"
MAXIMUM_BYTES = 2**20

_ROTATIONAL, _TRANSLATIONAL = "Modelica.Mechanics.Rotational", "Modelica.Mechanics.Translational"
_DRIVEN = {
    ("torque", JointType.REVOLUTE): (f"{_ROTATIONAL}.Sources.Torque", "tau", "torque"),
    ("force", JointType.PRISMATIC): (f"{_TRANSLATIONAL}.Sources.Force", "f", "force"),
}
_PASSIVE = {"damper": ("Damper", ("damping",)), "springDamper": ("SpringDamper", ("stiffness", "damping"))}
_PARAMETERS = {"damping": "d", "stiffness": "c"}
_KINDS = ("torque", "force", *_PASSIVE)


@dataclass(frozen=True)
class Actuator:
    """One actuator as Modelica knows it.

    Attributes:
        joint: Modelica name of the joint.
        flanges: the actuator's connectors at the joint's axis and at its housing.
        input: the actuator's input connector and the name of the model's input; None for passive ones.
    """

    class_name: str
    name: str
    modifiers: tuple[str, ...]
    description: str
    joint: str
    flanges: tuple[str, str]
    input: tuple[str, str] | None


def read_actuators(
    file: Path, assembly: Assembly, loops: LoopAnalysis, joint_names: dict[str, str], taken: set[str]
) -> tuple[Actuator, ...]:
    """Reads an actuator file.

    Args:
        file: the TOML file.
        assembly: the mechanism.
        loops: its loops; planar loop constraints cannot be driven.
        joint_names: Modelica name of every joint.
        taken: names of the mechanics' components.

    Raises:
        InputError: the file is wrong; a ``ProblemList`` if several problems were found.
    """
    place = Place(file=file)
    problems = Problems(str(file))
    actuators: list[Actuator] = []
    pool = NamePool(taken)
    joints = {joint.name: joint for joint in assembly.joints}
    driven: set[str] = set()
    for entry in _entries(file, problems):
        joint = joints.get(entry.get("joint", ""))
        where = Place(file=file, component=f"actuator of joint {entry.get('joint')!r}")
        if joint is None:
            known = ", ".join(sorted(joints)[:30]) or "none"
            problems.add("there is no such joint", where, f"Joints of the assembly: {known}.")
        elif joint.name in driven:
            problems.add("the joint has another actuator", where, "Give one actuator a joint.")
        elif joint.name in loops.planar_constraints:
            problems.add(
                "the joint closes a planar loop and has no coordinate", where, "Drive another joint of the loop."
            )
        else:
            driven.add(joint.name)
            actuator = _actuator(entry, joint, joint_names[joint.name], pool, problems, where)
            actuators += [actuator] if actuator is not None else []
    if not actuators:
        problems.add("names no actuator", place, "Add a table [[actuator]], or remove the file.")
    problems.raise_if_any()
    return tuple(actuators)


def _entries(file: Path, problems: Problems) -> list[dict[str, Any]]:
    data = file.read_bytes()[: MAXIMUM_BYTES + 1]
    try:
        content = tomllib.loads(data.decode("utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        problems.add(f"is not TOML: {error}", Place(file=file), "Correct the file.")
        problems.raise_if_any()
        return []
    unknown = sorted(set(content) - {"actuator"})
    entries: Any = content.get("actuator", [])
    if unknown or not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
        problems.add("only tables [[actuator]] are known", Place(file=file), "Correct the file.")
        problems.raise_if_any()
    return list(entries)


def _actuator(
    entry: dict[str, Any], joint: Joint, joint_name: str, pool: NamePool, problems: Problems, place: Place
) -> Actuator | None:
    kind = entry.get("kind", "")
    if joint.type not in (JointType.REVOLUTE, JointType.PRISMATIC):
        problems.add(f"a {joint.type.value} joint cannot be driven", place, "Drive revolute and prismatic joints.")
        return None
    wanted = _PASSIVE[kind][1] if kind in _PASSIVE else ()
    unknown = sorted(set(entry) - {"joint", "kind", "name", *wanted})
    if unknown:
        problems.add(f"{', '.join(unknown)} has no meaning for kind {kind!r}", place, "Remove it.")
        return None
    default = f"{joint.name} {kind if kind in _PASSIVE else 'drive'}"
    name = pool.instance(str(entry.get("name", default)), "actuator")
    if kind in _PASSIVE:
        values = [entry.get(key) for key in wanted]
        numbers = [float(v) for v in values if isinstance(v, int | float) and not isinstance(v, bool)]
        if len(numbers) != len(wanted) or not all(math.isfinite(v) and v >= 0 for v in numbers):
            problems.add(f"a {kind} needs {' and '.join(wanted)}, not negative", place, "Add the numbers.")
            return None
        modifiers = [f"{_PARAMETERS[key]}={number(value)}" for key, value in zip(wanted, numbers, strict=True)]
        domain = _ROTATIONAL if joint.type is JointType.REVOLUTE else _TRANSLATIONAL
        return Actuator(
            f"{domain}.Components.{_PASSIVE[kind][0]}",
            name,
            tuple(modifiers),
            f"{kind} at {joint.name}",
            joint_name,
            ("flange_b", "flange_a"),
            None,
        )
    found = _DRIVEN.get((kind, joint.type))
    if found is None:
        problems.add(
            f"kind {kind!r} does not suit a {joint.type.value} joint", place, f"Known kinds: {', '.join(_KINDS)}."
        )
        return None
    class_name, connector, quantity = found
    signal = pool.instance(f"{joint.name} {quantity}", "input")
    return Actuator(
        class_name,
        name,
        ("useSupport=true",),
        f"{kind} drive of {joint.name}",
        joint_name,
        ("flange", "support"),
        (connector, signal),
    )
