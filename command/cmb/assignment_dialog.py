"""Questions and answers that assign components to joints, on plain text streams."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeVar

from cad2modelica.actuators.catalogue import IDEAL, SENSOR, ComponentClass, Parameter, Signal, components_for
from cad2modelica.actuators.file import finite_number, parameter_value
from cad2modelica.actuators.placement import rated_parameters
from cad2modelica.mechanism.model import Assignment, Joint
from contact_foundation.errors import InputError

Ask = Callable[[str], str]
Tell = Callable[[str], None]
Item = TypeVar("Item")

_BOOLEANS = {"true": True, "yes": True, "false": False, "no": False}


class Dialog:
    """Assigns components to joints until the user is done.

    Args:
        joints: those that can be driven, by name.
        assignments: what is assigned already.
        ask: shows a question and returns the answer; raises EOFError at the end of the input.
        tell: shows a line.
    """

    def __init__(self, joints: dict[str, Joint], assignments: Sequence[Assignment], ask: Ask, tell: Tell) -> None:
        self._joints = joints
        self._assignments = list(assignments)
        self._ask = ask
        self._tell = tell

    def run(self) -> tuple[Assignment, ...] | None:
        """The assignments at the end; None if the user gave up.

        Raises:
            InputError: the input ended in the middle of an assignment.
        """
        while True:
            self._show_joints()
            try:
                answer = self._ask("Joint (number or name; empty: write and end; q: end without writing): ").strip()
            except EOFError:
                answer = ""
            if answer == "q":
                return None
            if not answer:
                return tuple(self._assignments)
            joint = _chosen(answer, list(self._joints.values()), lambda item: item.name)
            if joint is None:
                self._tell(f"There is no joint {answer!r} to drive.")
                continue
            try:
                self._assign(joint)
            except EOFError:
                raise InputError(
                    f"the input ended in the middle of the assignment of joint {joint.name!r}: nothing was written",
                    remedy="Answer all questions; an empty line takes the default.",
                ) from None

    def _show_joints(self) -> None:
        width = max(len(name) for name in self._joints)
        for number, joint in enumerate(self._joints.values(), start=1):
            given = ", ".join(item.component for item in self._assignments if item.joint == joint.name) or "-"
            way = f"{joint.parent} -> {joint.child}"
            self._tell(f"{number:4}  {joint.name:{width}}  {joint.type.value:9}  {way}: {given}")

    def _assign(self, joint: Joint) -> None:
        components = components_for(joint.type)
        for number, component in enumerate(components, start=1):
            self._tell(f"{number:4}  {component.name:13}  {component.description}")
        while True:
            answer = self._ask("Component (number or name; -: remove all from the joint; empty: back): ").strip()
            if not answer:
                return
            if answer == "-":
                self._assignments = [item for item in self._assignments if item.joint != joint.name]
                return
            chosen = _chosen(answer, components, lambda item: item.name)
            if chosen is not None:
                self._add(joint, chosen)
                return
            self._tell(f"There is no component {answer!r} for a {joint.type.value} joint.")

    def _add(self, joint: Joint, component: ComponentClass) -> None:
        parameters: dict[str, float | bool] = {}
        for parameter in component.parameters:
            value = self._parameter(parameter, rated_parameters(joint, component, parameters).get(parameter.name))
            if value is not None:
                parameters[parameter.name] = value
        inputs: dict[str, float] = {}
        for signal in component.inputs:
            if signal.condition is None or parameters.get(signal.condition, False):
                number = self._input(signal)
                if number is not None:
                    inputs[signal.name] = number
        if component.name in (IDEAL, SENSOR):  # of these a joint has one
            same = (joint.name, component.name)
            self._assignments = [item for item in self._assignments if (item.joint, item.component) != same]
        self._assignments.append(Assignment(joint.name, component.name, None, parameters, inputs))

    def _parameter(self, parameter: Parameter, rated: float | bool | None) -> float | bool | None:
        default = parameter.default if parameter.default is not None else "none"
        default = f"{rated:g}, the joint's limit" if rated is not None else default
        while True:
            answer = self._ask(f"  {parameter.name} - {parameter.description} ({parameter.unit}) [{default}]: ").strip()
            if not answer:
                return None
            try:
                return parameter_value(parameter, _value(answer))
            except ValueError as error:
                self._tell(f"  {parameter.name} {error}.")

    def _input(self, signal: Signal) -> float | None:
        while True:
            answer = self._ask(f"  input {signal.name} - {signal.description} in {signal.unit} [default]: ").strip()
            if not answer:
                return None
            try:
                return finite_number(_value(answer))
            except ValueError as error:
                self._tell(f"  {signal.name} {error}.")


def _chosen(answer: str, items: Sequence[Item], name: Callable[[Item], str]) -> Item | None:
    """The item of that name or number, counted from 1."""
    by_name = next((item for item in items if name(item) == answer), None)
    if by_name is not None or not answer.isdecimal() or not 1 <= int(answer) <= len(items):
        return by_name
    return items[int(answer) - 1]


def _value(text: str) -> float | bool | str:
    if text.lower() in _BOOLEANS:
        return _BOOLEANS[text.lower()]
    try:
        return float(text)
    except ValueError:
        return text
