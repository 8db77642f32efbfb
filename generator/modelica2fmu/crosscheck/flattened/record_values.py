"""Whether fields of records that have a value as a whole have what that value gives them."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any, Final

from modelica2fmu.crosscheck.class_instances import ClassInstance, Component, UnknownError, Value
from modelica2fmu.crosscheck.class_syntax import Extent
from modelica2fmu.crosscheck.flattened.flat_reading import FlatReading, spans
from modelica2fmu.crosscheck.flattened.flat_variables import FlatPath, FlatVariables, is_reference, names_of
from modelica2fmu.crosscheck.flattened.node import Node

_NAME: Final = re.compile(r"(?!(?:true|false)\b)[A-Za-z_][\w.]*")
_CALL: Final = re.compile(r"\.?([A-Za-z_][\w.]*) ?\(")


class RecordValues:
    """The records of one flattened model.

    Args:
        node: what a path leads to, if there is such a component.
        variables: of the flattened model.
        reading: the sources.
    """

    def __init__(self, node: Callable[[FlatPath], Node | None], variables: FlatVariables, reading: FlatReading) -> None:
        self._node = node
        self._variables = variables
        self._reading = reading

    def check(self, path: FlatPath, variable: Mapping[str, Any]) -> None:
        """A field of a record that is bound to a call of its constructor has the argument's value."""
        length = next(
            length
            for length in range(1, len(path))
            if (node := self._node(path[:length])) is not None and node.component is not None and node.component.binding
        )
        record = self._node(path[:length])
        if record is None or record.component is None or record.component.binding is None or not record.is_certain:
            return
        value = record.component.binding
        instance = record.instance
        places = list(spans(variable["binding"]))
        self._only_the_record(path, length, places)
        self._record(path, length, record.component, variable)
        for name in path[length:]:
            extent = argument_of(self._reading, value, instance, name)
            component = instance.component(name)
            if extent is None or component is None:
                return
            value, instance = replace(value, extent=extent, modifier=None), component.type
        if not self._is_argument(path, value, places):
            is_nested = len(path) > length + 1
            if is_nested:
                raise self._reading.ignored_value(variable["name"], value, variable["binding"])
            cause = self._modified_field(path[:length])
            raise self._reading.forgotten_record(variable["name"], value, variable["binding"], cause)

    def _is_argument(self, path: FlatPath, value: Value, places: Sequence[Mapping[str, int]]) -> bool:
        """= true, if what the front end has is the argument of a constructor, or may be.

        Names get the place of the whole argument, ``mu = friction``, or what they are bound to stands in their place.
        """
        if any(self._reading.begins_in(span, value.extent) for span in places):
            return True
        text = self._reading.text(value.extent)
        if not is_reference(text):
            return False
        found = (self._reading.extent(span) for span in places)
        if any(each is not None and _lies_in(value.extent, each) for each in found):
            return True
        return not self._variables.contains(path, names_of(text)) or self._variables.is_copy(path, value, places)

    def _only_the_record(self, path: FlatPath, length: int, places: Sequence[Mapping[str, int]]) -> None:
        """A field of a record that has a value is not given another one by a modifier.

        Dymola and OpenModelica ignore such a modifier (Modelica Specification, issues 598 and 791), rumoca the record's
        value.

        Args:
            path: of the field.
            length: of the part of it that is the record's.
            places: of the value that the front end has.
        """
        classes: list[Extent] = []
        for end in range(length, len(path)):
            around, field = self._node(path[:end]), self._node(path[: end + 1])
            if around is None or field is None or field.component is None:
                return
            classes += [each.definition.extent for each in around.instance.chain()]
            own = field.component.binding
            if own is None or own.modifier is None or not self._reading.library.is_own(own.extent):
                continue
            is_taken = any(self._reading.begins_in(span, own.extent) for span in places)
            is_taken = is_taken or self._variables.is_copy(path[: end + 1], own, places, path[end + 1 :])
            if is_taken and not any(_lies_in(own.extent, each) for each in classes):
                raise self._reading.field_beside_value(".".join(path[: end + 1]), ".".join(path[:length]), own)

    def _record(self, path: FlatPath, length: int, record: Component, variable: Mapping[str, Any]) -> None:
        """A field of a record that has a value is not what it would be without that value.

        The front end forgets a record's value where an outer modifier changes some of its fields.
        """
        value, around = record.binding, self._node(path[:-1])
        places = list(spans(variable["binding"]))
        if value is None or around is None or self._node(path) is None or not places:
            return
        if self._variables.is_copy(path[:length], value, places, path[length:]):
            return
        if any(self._reading.begins_in(span, value.extent) for span in places):
            return
        left = [each.extent for each in record.overridden]
        if not self._may_be_default(value, path[:length], path[length:], places):
            left += [each.definition.extent for each in around.instance.chain()]
        if any(self._reading.begins_in(span, extent) for span in places for extent in left):
            cause = self._modified_field(path[:length])
            raise self._reading.forgotten_record(variable["name"], value, variable["binding"], cause)

    def _modified_field(self, path: FlatPath) -> Extent | None:
        """The modifier of the user's that gives a field of a record a value; ``None`` if there is none."""
        record = self._node(path)
        if record is None:
            return None
        classes = [each.definition.extent for each in record.instance.chain()]
        for name in record.instance.component_names():
            field = record.instance.component(name)
            own = None if field is None or field.binding is None else field.binding.modifier
            if own is None or not self._reading.library.is_own(own.extent):
                continue
            if not any(_lies_in(own.extent, each) for each in classes):
                return own.extent
        return None

    def _may_be_default(
        self, value: Value, path: FlatPath, names: FlatPath, places: Sequence[Mapping[str, int]]
    ) -> bool:
        """= true, if a value may give a field what the front end has, where that is the default of the declared class.

        A constructor without the argument does, and so may what is not looked into: functions, constants of packages.
        """
        text = self._reading.text(value.extent)
        if _CALL.match(text) is None:
            named = _NAME.findall(text)
            return "(" in text or not all(self._variables.contains(path, (*names_of(each), *names)) for each in named)
        try:
            instance = called_class(self._reading, value)
        except UnknownError:
            return True
        if instance is None:
            return True
        found: Component | None = None
        for name in names:
            found = instance.component(name)
            if found is None:
                return True
            instance = found.type
        if found is None or found.binding is None:
            return True
        default = found.binding.extent
        return any(self._reading.begins_in(span, default) for span in places)


def called_class(reading: FlatReading, value: Value) -> ClassInstance | None:
    """The record whose constructor a value calls; ``None`` if it is something else; raises UnknownError."""
    called = _CALL.match(reading.text(value.extent))
    if called is None:
        return None
    instance = value.scope.lookup(tuple(called[1].split(".")))
    return None if instance.definition.kind == "function" else instance


def argument_of(reading: FlatReading, value: Value, instance: ClassInstance, name: str) -> Extent | None:
    """The argument of a call of a constructor for a field, by name or by place; raises UnknownError.

    Args:
        reading: the sources.
        value: the call.
        instance: the record.
        name: of the field.
    """
    arguments = reading.library.arguments(value.extent)
    order = instance.fields()
    extent = next((extent for each, extent in arguments if each == name), None)
    if extent is None and name in order and order.index(name) < len(arguments):
        positional, found = arguments[order.index(name)]
        extent = None if positional else found
    return extent


def _lies_in(inner: Extent, outer: Extent) -> bool:
    return inner.file == outer.file and outer.start <= inner.start and inner.end <= outer.end
