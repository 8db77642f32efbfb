"""Values of parameters that the front end computes though they depend on others that can be set on an FMU.

rumoca 0.10 puts numbers in place of names and expressions in the fields of final records: with ``final parameter
Inertia inertia(m = m)`` the mass of the record is what ``m`` was at translation, and so is ``w = 2*m`` in the record.
Who sets ``m`` would then set one of two. Where the sources name one variable, its name takes the number's place again;
what else a number was computed from becomes a constant.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final

from modelica2fmu.crosscheck.class_instances import ClassInstance, UnknownError, Value
from modelica2fmu.crosscheck.class_tokens import UnreadableError
from modelica2fmu.crosscheck.flattened.flat_reading import FlatReading, named
from modelica2fmu.crosscheck.flattened.flat_variables import FlatPath, FlatVariables, is_reference, names_of, parts_of
from modelica2fmu.crosscheck.flattened.node import Node
from modelica2fmu.crosscheck.flattened.record_values import argument_of, called_class

_NAME: Final = re.compile(r"(?<![\w.])(?!(?:true|false|and|or|not|if|then|else|elseif|each|for|in)\b)[A-Za-z_][\w.]*")
_STRING: Final = re.compile(r'"(?:[^"\\]|\\.)*"')
_PARAMETER: Final = "Parameter"


@dataclass(frozen=True)
class EvaluatedValues:
    """What is to be mended.

    Attributes:
        references: of variables with a number: the one that they have their value from.
        constants: parameters that numbers were computed from, and those that these depend on.
    """

    references: Mapping[str, str]
    constants: frozenset[str]


NOTHING_EVALUATED: Final = EvaluatedValues({}, frozenset())


@dataclass(frozen=True)
class _Written:
    """What is written as the value of a variable.

    Attributes:
        text: an expression.
        depth: the length of the path of the component in which its names mean something, if it is found.
        field: of the record that the expression is, if the variable is one.
    """

    text: str
    depth: int | None
    field: FlatPath = ()


def evaluated_values(
    flat: Mapping[str, Any], node: Callable[[FlatPath], Node | None], variables: FlatVariables, reading: FlatReading
) -> EvaluatedValues:
    """The values of a flattened model that are numbers and should not be.

    Args:
        flat: as the front end gives it.
        node: what a path leads to, if there is such a component; raises UnknownError.
        variables: of the flattened model.
        reading: the sources.
    """
    return _Search(flat, node, variables, reading).run()


class _Search:
    def __init__(
        self,
        flat: Mapping[str, Any],
        node: Callable[[FlatPath], Node | None],
        variables: FlatVariables,
        reading: FlatReading,
    ) -> None:
        self._flat: Mapping[str, Mapping[str, Any]] = flat["variables"]
        self._types: Mapping[str, str] = flat["variable_type_names"]
        self._is_final: Mapping[str, bool] = flat["variable_final_flags"]
        self._node = node
        self._variables = variables
        self._reading = reading
        self._references: dict[str, str] = {}
        self._constants: set[str] = set()

    def run(self) -> EvaluatedValues:
        computed = []
        for path, variables in self._variables.by_path.items():
            for variable in variables:
                written = self._evaluated(path, variable)
                if written is None:
                    continue
                owner = self._owner(variable, written)
                if owner is None:
                    computed.append((variable["name"], written))
                else:
                    self._references[variable["name"]] = owner
        for name, written in computed:
            self._hold(self._named(name, written))
        return EvaluatedValues(self._references, frozenset(self._constants))

    # --- what is written ---

    def _evaluated(self, path: FlatPath, variable: Mapping[str, Any]) -> _Written | None:
        """What is written where a parameter has numbers, if that names anything."""
        binding = variable["binding"]
        if _PARAMETER not in variable["variability"]:
            return None
        if binding is None or any(True for _ in self._named_in(binding)):
            return None
        try:
            written = self._written(path)
        except (UnknownError, UnreadableError, RecursionError):
            return None
        return written if written is not None and _NAME.search(_STRING.sub("", written.text)) else None

    def _written(self, path: FlatPath) -> _Written | None:
        for length in range(1, len(path) + 1):
            node = self._node(path[:length])
            if node is None or node.component is None:
                return None
            if node.component.binding is not None:
                return self._in_record(path, length, node.component.binding, node.instance)
        return None

    def _in_record(self, path: FlatPath, length: int, value: Value, instance: ClassInstance) -> _Written | None:
        """What is written as a field of a record with a value; ``length`` is that of the record's path."""
        text, depth = self._reading.text(value.extent), self._depth(path, value.scope)
        if length == len(path) or is_reference(text):
            return _Written(text, depth, path[length:])
        called = called_class(self._reading, value)
        if called is None:
            return _Written(text, depth)
        extent = argument_of(self._reading, value, instance, path[length])
        inner = called.component(path[length])
        if inner is None:
            return None
        if extent is not None:
            return self._in_record(path, length + 1, Value(extent, value.scope, value.role, None), inner.type)
        if inner.binding is None or length + 1 < len(path):
            return None
        return _Written(self._reading.text(inner.binding.extent), length)

    def _depth(self, path: FlatPath, scope: ClassInstance) -> int | None:
        """The length of the path of the component in whose class, or a base of it, names are looked up."""
        for length in range(len(path) - 1, -1, -1):
            node = self._node(path[:length])
            if node is not None and any(each is scope for each in node.instance.chain()):
                return length
        return None

    # --- what that means ---

    def _owner(self, variable: Mapping[str, Any], written: _Written) -> str | None:
        """The parameter that a name means, where a variable has its value from one.

        Final ones of other types than Real may be what the structure of the model goes by.
        """
        name = variable["name"]
        is_structural = self._types.get(name, "Real") != "Real" and (self._is_final.get(name) or variable["evaluate"])
        if is_structural or written.depth is None or "[" in written.text or not is_reference(written.text):
            return None
        owner = ".".join((*parts_of(name)[: written.depth], *names_of(written.text), *written.field))
        other = self._flat.get(owner)
        if other is None or owner == name or other["dims"] != variable["dims"]:
            return None
        return owner if self._types.get(owner) == self._types.get(name) else None

    def _named(self, name: str, written: _Written) -> Iterator[str]:
        """The variables that an expression may depend on."""
        path = tuple(names_of(name))
        depth = len(path) - 1 if written.depth is None else written.depth
        field = written.field if is_reference(written.text) else ()
        for each in _NAME.findall(_STRING.sub("", written.text)):
            for length in range(depth, -1, -1):  # of outer components, and where it is not known where names are meant
                head = (*path[:length], *names_of(each), *field)
                found = self._within.get(head)
                if found:
                    yield from found
                    break

    @cached_property
    def _within(self) -> Mapping[FlatPath, list[str]]:
        """The variables of all components, and each by its own path."""
        found: dict[FlatPath, list[str]] = {}
        for path, variables in self._variables.by_path.items():
            names = [variable["name"] for variable in variables]
            for length in range(1, len(path) + 1):
                found.setdefault(path[:length], []).extend(names)
        return found

    def _hold(self, names: Iterator[str]) -> None:
        """Takes parameters as constants, and those that their own values are computed from."""
        stack = list(names)
        while stack:
            name = stack.pop()
            variable = self._flat.get(name)
            if variable is None or name in self._constants:
                continue
            self._constants.add(name)
            if name in self._references:
                stack.append(self._references[name])
                continue
            stack.extend(self._named_in(variable["binding"]))
            path = tuple(names_of(name))
            written = self._evaluated(path, variable)
            if written is not None:
                stack.extend(self._named(name, written))

    def _named_in(self, tree: Any) -> Iterator[str]:
        """The variables that an expression of the front end names, arrays where it names elements."""
        for name in named(tree):
            if name in self._flat:
                yield name
            else:  # an element of an array, a literal of an enumeration, or a constant
                yield from (each["name"] for each in self._variables.by_path.get(names_of(name), ()))
