"""``actuators.toml``: which components of ContactMultiBody.Actuators stand at which joints.

```toml
[[actuator]]
joint = "shoulder"                          # name in the assembly
component = "Motor"                         # of ContactMultiBody.Actuators, for the joint's type
name = "shoulder motor"                     # optional
parameters = { ratio = 50.0, i_max = 8.0 }  # optional: the component's, in SI units
inputs = { u = 12.0 }                       # optional: values of its inputs while nothing else drives them
```
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from contact_foundation.errors import Place
from contact_foundation.output import whole_file
from contact_foundation.toml_text import read_toml

from cad2modelica.actuators.catalogue import IDEAL, SENSOR, ComponentClass, Parameter, components_for
from cad2modelica.kinematics.loops import LoopAnalysis
from cad2modelica.mechanism.model import Assembly, Assignment, Joint
from cad2modelica.source.number_limits import LARGEST, is_usable
from cad2modelica.source.problems import Problems
from cad2modelica.structure.renames import Renamed, closest

FILE_NAME = "actuators.toml"
_KEYS = ("joint", "component", "name", "parameters", "inputs")
HEADER = """# Components of ContactMultiBody.Actuators at the joints of {assembly}; values in SI units.
# `cmb assign` changes this file by questions and answers, `cmb generate` writes the mechatronic model from it.
"""


def read_assignments(
    file: Path, assembly: Assembly, loops: LoopAnalysis, renamed: Mapping[str, Renamed] | None = None
) -> tuple[Assignment, ...]:
    """Reads an actuator file and checks it against the assembly and the library.

    Args:
        file: the file.
        assembly: what it is for.
        loops: of the assembly.
        renamed: joints that seem to have another name since an earlier generation, for messages.

    Raises:
        InputError: the file is wrong; a ``ProblemList`` if several problems were found.
    """
    problems = Problems(str(file))
    found: list[Assignment] = []
    joints = {joint.name: joint for joint in assembly.joints}
    entries = _entries(file, problems)
    for entry in entries:
        place = Place(file=file, component=f"actuator of joint {entry.get('joint')!r}")
        name = entry.get("joint")
        joint = joints.get(name) if isinstance(name, str) else None
        if joint is None:
            message, hint = _unknown_joint(name, joints, renamed or {})
            known = ", ".join(sorted(drivable_joints(assembly, loops))[:30]) or "none"
            remedy = (
                f"{hint}Joints of {assembly.file.name} that can be driven: {known}. --actuators names another file."
            )
            problems.add(message, place, remedy)
            continue
        assignment = _assignment(entry, joint, loops, problems, place)
        found += [assignment] if assignment is not None else []
    check_together(found, problems, file)
    if not entries:
        problems.add("names no actuator", Place(file=file), "Add a table [[actuator]], or remove the file.")
    problems.raise_if_any()
    return tuple(found)


def _unknown_joint(name: object, joints: Iterable[str], renamed: Mapping[str, Renamed]) -> tuple[str, str]:
    """What is wrong with the name of a joint, and which one is likely meant; the latter may be empty."""
    if not isinstance(name, str):
        return "the name of the joint is no text", ""
    message, guess = "there is no such joint", renamed.get(name)
    if guess is not None:
        message += f"; renamed {guess.name!r}, it seems: {guess.reason}"
    likely = guess.name if guess is not None else closest(name, joints)
    return message, f"Write joint = {_text(likely)}, if that is meant. " if likely is not None else ""


@dataclass(frozen=True)
class NamedJoints:
    """Joints that the entries of an actuator file name, whether they exist or not."""

    file: Path
    names: tuple[str, ...]


def named_joints(file: Path) -> NamedJoints:
    """The joints that an actuator file names.

    Raises:
        InputError: the file is no list of actuators.
    """
    entries = _entries(file, Problems(str(file)))
    return NamedJoints(file, tuple(entry["joint"] for entry in entries if isinstance(entry.get("joint"), str)))


def drivable_joints(assembly: Assembly, loops: LoopAnalysis) -> dict[str, Joint]:
    """Joints with an axis to drive, by name: revolute, screw and prismatic ones that keep their coordinate."""
    return {
        joint.name: joint
        for joint in assembly.joints
        if components_for(joint.type) and joint.name not in loops.planar_constraints
    }


def check_together(assignments: Iterable[Assignment], problems: Problems, file: Path) -> None:
    """Records what single entries cannot show: two sensors or two forced motions at one joint."""
    seen: set[tuple[str, str]] = set()
    for assignment in assignments:
        key = (assignment.joint, assignment.component)
        if key in seen and assignment.component in (SENSOR, IDEAL):
            place = Place(file=file, component=f"actuator of joint {assignment.joint!r}")
            problems.add(f"the joint has another {assignment.component}", place, "Remove one of them.")
        seen.add(key)


def write_assignments(file: Path, assembly: str, assignments: Iterable[Assignment]) -> None:
    """Writes an actuator file, whole or not at all; the same assignments give the same bytes."""
    tables = []
    for item in assignments:
        lines = ["[[actuator]]", f"joint = {_text(item.joint)}", f"component = {_text(item.component)}"]
        lines += [f"name = {_text(item.name)}"] if item.name is not None else []
        for key, values in (("parameters", item.parameters), ("inputs", item.inputs)):
            pairs = ", ".join(f"{name} = {_value(value)}" for name, value in values.items())
            lines += [f"{key} = {{ {pairs} }}"] if values else []
        tables.append("\n".join(lines) + "\n")
    with whole_file(file) as staging:
        staging.write_text(HEADER.format(assembly=assembly) + "\n" + "\n".join(tables), encoding="utf-8")


def parameter_value(parameter: Parameter, value: object) -> float | bool:
    """A parameter's value, checked.

    Raises:
        ValueError: it is none; the message completes "<name> ...".
    """
    if parameter.boolean:
        if not isinstance(value, bool):
            raise ValueError("must be true or false")
        return value
    number = finite_number(value)
    if parameter.minimum is not None and (number < parameter.minimum or (parameter.positive and number == 0)):
        raise ValueError("must be positive" if parameter.positive else "must not be negative")
    return number


def finite_number(value: object) -> float:
    """A finite number of at most ``LARGEST``.

    Raises:
        ValueError: it is none.
    """
    if isinstance(value, bool) or not isinstance(value, int | float) or not is_usable(_as_float(value)):
        raise ValueError(f"must be a finite number, of at most {LARGEST:g}")
    return float(value)


def _as_float(value: int | float) -> float:
    """The number; infinity for a whole one that is beyond all."""
    try:
        return float(value)
    except OverflowError:
        return math.inf


def _entries(file: Path, problems: Problems) -> list[dict[str, Any]]:
    content = read_toml(file, "an actuator file")
    unknown = sorted(set(content) - {"actuator"})
    entries: Any = content.get("actuator", [])
    if unknown or not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
        problems.add("only tables [[actuator]] are known", Place(file=file), "Correct the file.")
        problems.raise_if_any()
    return list(entries)


def _assignment(
    entry: dict[str, Any], joint: Joint, loops: LoopAnalysis, problems: Problems, place: Place
) -> Assignment | None:
    if joint.name in loops.planar_constraints:
        problems.add("the joint closes a planar loop and has no coordinate", place, "Drive another joint of the loop.")
        return None
    known = {component.name: component for component in components_for(joint.type)}
    if not known:
        problems.add(
            f"a {joint.type.value} joint cannot be driven", place, "Drive revolute, screw or prismatic joints."
        )
        return None
    unknown = sorted(set(entry) - set(_KEYS))
    if unknown:
        problems.add(f"{', '.join(unknown)} has no meaning here", place, f"Known keys: {', '.join(_KEYS)}.")
        return None
    chosen = entry.get("component")
    component = known.get(chosen) if isinstance(chosen, str) else None
    if component is None:
        problems.add(
            f"component {chosen!r} is none for a {joint.type.value} joint",
            place,
            f"There are: {', '.join(known)}.",
        )
        return None
    if not isinstance(entry.get("name", ""), str):
        problems.add("the name is not a text", place, "Put it in quotes.")
        return None
    parameters = _parameters(component, entry.get("parameters", {}), problems, place)
    names = [signal.name for signal in component.inputs]
    inputs = _inputs(names, entry.get("inputs", {}), component, problems, place)
    if parameters is None or inputs is None:
        return None
    return Assignment(joint.name, component.name, entry.get("name"), parameters, inputs)


def _parameters(
    component: ComponentClass, given: object, problems: Problems, place: Place
) -> dict[str, float | bool] | None:
    if not isinstance(given, dict):
        problems.add("parameters is no table", place, "Write parameters = { name = value }.")
        return None
    values: dict[str, float | bool] = {}
    wrong = False
    for name, value in given.items():
        parameter = component.parameter(name)
        try:
            if parameter is None:
                known = ", ".join(item.name for item in component.parameters) or "none"
                raise ValueError(f"is no parameter of {component.name}; there are: {known}")
            values[name] = parameter_value(parameter, value)
        except ValueError as error:
            problems.add(f"{name} {error}", place, "Correct the parameter.")
            wrong = True
    return None if wrong else values


def _inputs(
    names: list[str], given: object, component: ComponentClass, problems: Problems, place: Place
) -> dict[str, float] | None:
    if not isinstance(given, dict):
        problems.add("inputs is no table", place, "Write inputs = { name = value }.")
        return None
    values: dict[str, float] = {}
    for name, value in given.items():
        try:
            if name not in names:
                raise ValueError(f"is no input of {component.name}; there are: {', '.join(names) or 'none'}")
            values[name] = finite_number(value)
        except ValueError as error:
            problems.add(f"{name} {error}", place, "Correct the input.")
            return None
    return values


def _text(value: str) -> str:
    """A TOML basic string."""
    escaped = value.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + "".join(c if c >= " " and c != "\x7f" else f"\\u{ord(c):04x}" for c in escaped) + '"'


def _value(value: float | bool) -> str:
    return ("true" if value else "false") if isinstance(value, bool) else repr(float(value))
