"""The mechatronic model's components: drives, sensors, and the model's own inputs and outputs."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from cad2modelica.actuators.catalogue import SENSOR, ComponentClass, Signal, components_for
from cad2modelica.mechanism.model import Assembly, Assignment, Joint
from cad2modelica.modelica.names import NamePool
from cad2modelica.modelica.text import number

_WORDS = {
    "Angle": "angle",
    "AngularVelocity": "speed",
    "Torque": "torque",
    "Length": "position",
    "Velocity": "speed",
    "Force": "force",
    "ElectricPotential": "voltage",
    "ElectricCurrent": "current",
}


@dataclass(frozen=True)
class ModelSignal:
    """An input or output of the mechatronic model.

    Attributes:
        connector: that of the actuator it is connected to.
        name: in the mechatronic model.
        modifiers: of the declaration.
    """

    connector: str
    name: str
    modifiers: tuple[str, ...]
    description: str


@dataclass(frozen=True)
class Actuator:
    """One actuator as Modelica knows it.

    Attributes:
        joint: Modelica name of the joint.
        connections: own connector and the one it is connected to: flange and housing.
    """

    class_name: str
    name: str
    modifiers: tuple[str, ...]
    description: str
    joint: str
    connections: tuple[tuple[str, str], ...]
    inputs: tuple[ModelSignal, ...]
    outputs: tuple[ModelSignal, ...]


def place_actuators(
    assignments: tuple[Assignment, ...], assembly: Assembly, joint_names: dict[str, str], taken: set[str]
) -> tuple[Actuator, ...]:
    """Names and connects what the actuator file assigns.

    Drives act on the joint's axis, or through its sensor if it has one. Inputs start at the value the file gives,
    wanted angles and positions else at the joint's own start. Drives with inputs and sensors have outputs; where
    there is a sensor, it alone tells angle, speed and torque.

    Args:
        assignments: checked by ``read_assignments``.
        assembly: the mechanism.
        joint_names: Modelica name of every joint.
        taken: names of the mechanics' components.
    """
    pool = NamePool(taken)
    joints = {joint.name: joint for joint in assembly.joints}
    names = [pool.instance(item.name or _default_name(item), "actuator") for item in assignments]
    sensors = {item.joint: name for item, name in zip(assignments, names, strict=True) if item.component == SENSOR}
    told: set[tuple[str, str]] = set()
    actuators = []
    for item, name in zip(assignments, names, strict=True):
        joint = joints[item.joint]
        component = next(c for c in components_for(joint.type) if c.name == item.component)
        modelica = joint_names[joint.name]
        parameters = {**rated_parameters(joint, component, item.parameters), **item.parameters}
        sensor = sensors.get(item.joint)
        if item.component == SENSOR:
            flange = ("flange_b", f"{modelica}.axis")
        else:
            flange = ("flange", f"{sensor}.flange_a" if sensor is not None else f"{modelica}.axis")
        actuators.append(
            Actuator(
                class_name=component.class_name,
                name=name,
                modifiers=("useSupport=true", *(f"{key}={_text(value)}" for key, value in parameters.items())),
                description=f"{component.description.split(',')[0]} at {joint.name}",
                joint=modelica,
                connections=(flange, ("support", f"{modelica}.support")),
                inputs=_inputs(component, item, joint, pool),
                outputs=_outputs(component, item, sensor, told, pool),
            )
        )
    return tuple(actuators)


def rated_parameters(
    joint: Joint, component: ComponentClass, given: Mapping[str, float | bool]
) -> dict[str, float | bool]:
    """Limits of a drive that the joint's rating says: largest effort, and largest speed by the drive's gear.

    Args:
        joint: the joint.
        component: the drive.
        given: parameters that the user chose; the gear's ``ratio`` and the spindle's ``pitch`` count for the rotor.
    """
    rating = joint.rating
    if rating is None:
        return {}
    found: dict[str, float | bool] = {}
    for name in ("tau_max", "f_max"):
        if rating.effort is not None and component.parameter(name) is not None:
            found[name] = rating.effort
    if rating.speed is not None and component.parameter("w_max") is not None:
        found["w_max"] = rating.speed * _rotor_speed(component, given)
    return found


def _rotor_speed(component: ComponentClass, given: Mapping[str, float | bool]) -> float:
    """Speed of the rotor over that of the joint: the gear's ratio, or turns of the spindle, in rad, for the way."""

    def value(name: str) -> float | None:
        parameter = component.parameter(name)
        if parameter is None:
            return None
        return float(given[name]) if name in given else float(parameter.default or 1.0)

    pitch = value("pitch")
    return 2 * math.pi / pitch if pitch is not None else value("ratio") or 1.0


def _default_name(item: Assignment) -> str:
    # "hip torque" is the name of an output.
    return f"{item.joint} {'drive' if item.component.lower() in _WORDS.values() else item.component}"


def _inputs(component: ComponentClass, item: Assignment, joint: Joint, pool: NamePool) -> tuple[ModelSignal, ...]:
    signals = []
    for signal in component.inputs:
        if signal.condition is not None and not item.parameters.get(signal.condition, False):
            continue
        holds = signal.quantity in ("Angle", "Length")
        start = item.inputs.get(signal.name, joint.position if holds else 0.0)
        suffix = " reference" if signal.name.endswith("_ref") else ""
        name = pool.instance(f"{item.joint} {_WORDS[signal.quantity]}{suffix}", "input")
        modifiers = (f"start={number(start)}", *_type_modifiers(signal))
        signals.append(ModelSignal(signal.name, name, modifiers, f"{signal.description} at {item.joint}"))
    return tuple(signals)


def _outputs(
    component: ComponentClass, item: Assignment, sensor: str | None, told: set[tuple[str, str]], pool: NamePool
) -> tuple[ModelSignal, ...]:
    is_sensor = item.component == SENSOR
    if not component.inputs and not is_sensor:
        return ()
    signals = []
    for signal in component.outputs:
        word = _WORDS[signal.quantity]
        measured = word != "current"
        if measured and ((sensor is not None and not is_sensor) or (item.joint, word) in told):
            continue
        if word not in ("torque", "force", "current"):
            told.add((item.joint, word))
        name = pool.instance(f"{item.joint} {word}", "output")
        signals.append(ModelSignal(signal.name, name, _type_modifiers(signal), f"{signal.description} at {item.joint}"))
    return tuple(signals)


def _type_modifiers(signal: Signal) -> tuple[str, ...]:
    return f'final quantity="{signal.quantity}"', f'final unit="{signal.unit}"'


def _text(value: float | bool) -> str:
    return ("true" if value else "false") if isinstance(value, bool) else number(value)
