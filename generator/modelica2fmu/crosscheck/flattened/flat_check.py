"""Compares the front end's flattened model with what the language says about its components and modifiers.

rumoca 0.10 leaves some modifiers and redeclarations out without a word. Each variable, equation and function of the
flattened model carries the place it was written at; so does each component of an instance tree that is made from the
sources independently (``class_instances``). Where the two name different places, the model is refused.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final

from contact_foundation.errors import UnsupportedModelError

from modelica2fmu.crosscheck.class_instances import ClassInstance, Component, Names, Role, UnknownError
from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.class_syntax import Modifier, is_array
from modelica2fmu.crosscheck.class_tokens import UnreadableError
from modelica2fmu.crosscheck.component_sizes import RECORDS
from modelica2fmu.crosscheck.flattened.array_pieces import is_piece, remedy_of_pieces, remedy_of_rows
from modelica2fmu.crosscheck.flattened.evaluated_values import NOTHING_EVALUATED, EvaluatedValues, evaluated_values
from modelica2fmu.crosscheck.flattened.flat_expression_check import ExpressionCheck, Site
from modelica2fmu.crosscheck.flattened.flat_reading import FlatReading, WrittenPlaces, named, spans
from modelica2fmu.crosscheck.flattened.flat_variables import (
    FlatPath,
    FlatVariables,
    is_reference,
    names_of,
    without_subscripts,
)
from modelica2fmu.crosscheck.flattened.node import Node
from modelica2fmu.crosscheck.flattened.record_values import RecordValues
from modelica2fmu.crosscheck.own_classes import model_class

_EQUATIONS: Final = ("equations", "initial_equations")
_ALGORITHMS: Final = ("algorithms", "initial_algorithms")
_ALGORITHM_OF: Final = "algorithm from "


@dataclass(frozen=True)
class Corrections:
    """What is to be mended in a flattened model.

    Attributes:
        fixed: variables that are so by a modifier which the front end left out.
        values: numbers that the front end put in place of names.
    """

    fixed: tuple[str, ...] = ()
    values: EvaluatedValues = NOTHING_EVALUATED


def check_flat_model(flat: Mapping[str, Any], model: str, reading: FlatReading) -> Corrections:
    """Holds a flattened model against its sources, as far as the names in them are found.

    Args:
        flat: as the front end gives it.
        model: full name.
        reading: the sources.

    Raises:
        UnsupportedModelError: the front end left out another modifier, or a redeclaration.
    """
    root = model_class(model, reading.library)
    return Corrections() if root is None else _FlatCheck(flat, root, reading).run()


def added_components(flat: Mapping[str, Any], model: str, library: ClassLibrary) -> list[str]:
    """Components that a model does not declare, but that outer ones in it need (Modelica 3.6, section 5.4).

    Args:
        flat: the flattened model.
        model: full name.
        library: the sources.
    """
    try:
        declared = set(Names(library).find(tuple(model.split("."))).component_names())
    except (UnknownError, UnreadableError):
        return []
    heads = (variable["component_ref"]["parts"][0]["ident"] for variable in flat["variables"].values())
    return [head for head in dict.fromkeys(heads) if head not in declared]


def copies_of_inner(flat: Mapping[str, Any], model: str, library: ClassLibrary) -> list[str]:
    """Variables that the front end makes of outer parameters beside the inner ones, and that nothing names.

    Args:
        flat: the flattened model.
        model: full name.
        library: the sources.
    """
    root = model_class(model, library)
    if root is None:
        return []
    outer = [name for name, variable in flat["variables"].items() if _is_outer(root, variable)]
    found = {without_subscripts(name) for name in named(flat)} if outer else set()
    return [name for name in outer if without_subscripts(name) not in found]


def unused_members(flat: Mapping[str, Any]) -> list[str]:
    """Variables that expandable connectors declare and nothing names, which they are without (Modelica 3.6, 9.1.3)."""
    declared = [
        name
        for name, variable in flat["variables"].items()
        if variable["from_expandable_connector"] and variable["binding"] is None
    ]
    found = {without_subscripts(name) for name in named(flat)} if declared else set()
    return [name for name in declared if without_subscripts(name) not in found]


def _is_outer(root: ClassInstance, variable: Mapping[str, Any]) -> bool:
    """= true, if a variable is an outer component itself, no part of one."""
    instance, component = root, None
    try:
        for part in variable["component_ref"]["parts"]:
            component = instance.component(part["ident"])
            if component is None:
                return False
            instance = component.type
        return component is not None and component.is_outer and instance.predefined is not None
    except (UnknownError, UnreadableError, RecursionError):
        return False


class _FlatCheck:
    """One flattened model."""

    def __init__(self, flat: Mapping[str, Any], root: ClassInstance, reading: FlatReading) -> None:
        self._flat = flat
        self._reading = reading
        self._nodes: dict[FlatPath, Node | None] = {(): Node(root, None)}
        self._expressions = ExpressionCheck(flat["functions"], reading, self._inner)
        self._variables = FlatVariables(flat, reading)
        self._records = RecordValues(self._node, self._variables, reading)
        self._not_fixed: list[str] = []

    def run(self) -> Corrections:
        """What can be mended; raises UnsupportedModelError at the first other difference."""
        for path, variables in self._variables.by_path.items():
            for variable in variables:
                self._as_far_as_known(self._variable, path, variable)
        for kind in _EQUATIONS:
            for equation in self._flat[kind]:
                self._as_far_as_known(self._equation, equation)
        for kind in _ALGORITHMS:
            for algorithm in self._flat[kind]:
                self._as_far_as_known(self._algorithm, algorithm)
        filled = {path[:length] for path in self._variables.by_path for length in range(len(path) + 1)}
        for path in [path for path, node in self._nodes.items() if node is not None]:
            self._as_far_as_known(self._empty, path, filled)
            if path in filled:
                self._as_far_as_known(self._without_equations, path)
        values = evaluated_values(self._flat, self._node, self._variables, self._reading)
        return Corrections(tuple(self._not_fixed), values)

    @staticmethod
    def _as_far_as_known(check: Callable[..., None], *arguments: Any) -> None:
        try:
            check(*arguments)
        except (UnknownError, UnreadableError, RecursionError):
            return

    # --- components ---

    def _node(self, path: FlatPath) -> Node | None:
        """What a path leads to; ``None`` if there is no such component; raises UnknownError."""
        if path not in self._nodes:
            around = self._node(path[:-1])
            component = None if around is None else around.instance.component(path[-1])
            if around is None or component is None:
                self._nodes[path] = None
            else:
                has_value = around.component is not None and around.component.binding is not None
                self._nodes[path] = Node(
                    component.type,
                    component,
                    around.is_certain and component.is_certain,
                    around.has_value or has_value,
                )
        return self._nodes[path]

    def _inner(self, path: FlatPath, name: str) -> ClassInstance | None:
        """The class of the component that a name means in another one, where it is an outer one that of its inner."""
        for length in range(len(path), -1, -1):
            node = self._node((*path[:length], name))
            if node is not None and node.component is not None and not node.component.is_outer:
                return node.instance
        return None

    def _redeclaration(self, path: FlatPath) -> Modifier | None:
        """The innermost redeclaration on the way to a component."""
        for length in range(len(path), 0, -1):
            node = self._nodes.get(path[:length])
            if node is not None and node.component is not None:
                for found in (node.component.redeclaration, node.instance.redeclaration_around):
                    if found is not None:
                        return found
        return None

    def _other_class(self, path: FlatPath) -> UnsupportedModelError | None:
        """The component has another class in the flattened model; ``None`` if nothing was to be replaced."""
        found = self._redeclaration(path)
        return None if found is None else self._reading.ignored_redeclaration(".".join(path), found.extent)

    # --- variables ---

    def _variable(self, path: FlatPath, variable: Mapping[str, Any]) -> None:
        node = self._node(path)
        span = variable["source_span"]
        if node is None or node.component is None:
            if self._node(path[:-1]) is not None and (error := self._other_class(path[:-1])) is not None:
                raise error
            return
        if span and not any(self._reading.ends_in(span, extent) for extent in node.component.declarations):
            if (error := self._other_class(path)) is not None:
                raise error
            return
        self._folded(path, variable)
        if node.has_value:
            self._records.check(path, variable)
        elif node.is_certain and node.instance.predefined is not None:
            self._pieces(node.component, node.instance.predefined, variable)
            self._binding(path, node.component, variable)
            if node.component.binding is None:
                self._attributes(node.component, node.instance.predefined, variable)

    def _folded(self, path: FlatPath, variable: Mapping[str, Any]) -> None:
        """Elements of an array of components are components, not elements of the variables of one.

        The front end makes one of an array whose size it does not know, as of ``size(k, 1)``: products of its variables
        become those of vectors. Libraries have some that nothing depends on, as the lines of visualizers.
        """
        for length, part in enumerate(variable["component_ref"]["parts"][:-1], 1):
            node = self._node(path[:length])
            component = None if node is None else node.component
            if node is None or component is None or part["subs"] or node.instance.definition.kind in RECORDS:
                continue
            declared = component.declarations[0]
            if not self._reading.library.is_own(declared):
                continue
            if is_array(component.sizes_of_type, self._reading.text(declared)):
                raise self._reading.folded_array(part["ident"], declared)

    def _pieces(self, component: Component, predefined: ClassInstance, variable: Mapping[str, Any]) -> None:
        """An element of an array of components has its own piece of an array that modifies all of them."""
        if not any(part["subs"] for part in variable["component_ref"]["parts"][:-1]):
            return
        for value, given in (
            (component.binding, "binding"),
            *((each, "start") for each in predefined.attribute("start")[:1]),
        ):
            if value is None:
                continue
            remedy = remedy_of_pieces(self._reading.text(value.extent))
            found = (self._reading.extent(span) for span in spans(variable[given]))
            places = [each for each in found if each is not None]
            if not is_piece(places, value.extent):
                continue
            if remedy is None and not variable["dims"]:
                first = min(each.start for each in places if value.extent.holds(each.file, each.start))
                remedy = remedy_of_rows(self._reading.library.text(value.extent), first - value.extent.start)
            if remedy is not None:
                raise self._reading.misread_array(variable["name"], value.extent, remedy)

    def _binding(self, path: FlatPath, component: Component, variable: Mapping[str, Any]) -> None:
        value, given = component.binding, variable["binding"]
        if value is None:
            return
        places = list(spans(given))
        if any(self._reading.begins_in(span, value.extent) for span in places):
            self._expressions.check(given, Site(value.scope, (value.extent,), path[:-1]))
        elif not self._variables.is_copy(path, value, places):
            redeclaration = self._redeclaration(path)
            if redeclaration is None or value.role in (Role.CONSTRAINT, Role.CLASS):
                raise self._reading.ignored_value(variable["name"], value, given)
            wanted = self._reading.shown(value.extent)
            consequence = f", which would be {self._reading.taken(given)} in place of {wanted}"
            raise self._reading.ignored_redeclaration(variable["name"], redeclaration.extent, consequence)

    def _attributes(self, component: Component, predefined: ClassInstance, variable: Mapping[str, Any]) -> None:
        """Start value and fixed; both may be those of another variable which an equation makes equal."""
        starts = predefined.attribute("start")
        places = list(spans(variable["start"]))
        is_right = any(self._reading.begins_in(span, value.extent) for span in places for value in starts[:1])
        if starts and not is_right and not is_reference(self._reading.text(starts[0].extent)):
            left = [*(value.extent for value in starts[1:]), *component.declarations]
            for span in places:
                if any(self._reading.begins_in(span, each) or self._reading.ends_in(span, each) for each in left):
                    raise self._reading.ignored_value(f"start of {variable['name']}", starts[0], variable["start"])
        is_fixed = any(variable["fixed"] or ())
        given = predefined.attribute("fixed")
        texts = [self._reading.text(value.extent) for value in given]
        if texts[:1] == ["true"] and not is_fixed:
            self._not_fixed.append(variable["name"])
        elif texts[:1] == ["false"] and is_fixed and "true" in texts:
            raise self._reading.ignored_value(f"fixed of {variable['name']}", given[0], None)

    # --- equations ---

    def _equation(self, equation: Mapping[str, Any]) -> None:
        origin = equation["origin"]
        span = equation["span"]
        if not isinstance(origin, dict) or "ComponentEquation" not in origin or not span:
            return
        if _has_lost_its_right_side(equation):
            raise self._reading.lost_right_side(span)
        path = names_of(origin["ComponentEquation"]["component"])
        node = self._node(path)
        if node is None:
            return
        own = self._is_own(path, node.instance, span, equation["residual"])
        if not own and not self._is_value(node.instance, span) and (error := self._other_class(path)) is not None:
            raise error

    def _algorithm(self, algorithm: Mapping[str, Any]) -> None:
        origin, span = algorithm["origin"], algorithm["span"]
        if not isinstance(origin, str) or not origin.startswith(_ALGORITHM_OF) or not span:
            return
        path = names_of(origin.removeprefix(_ALGORITHM_OF))
        node = self._node(path)
        if node is None:
            return
        own = self._is_own(path, node.instance, span, algorithm["statements"])
        if not own and (error := self._other_class(path)) is not None:
            raise error

    def _is_own(self, path: FlatPath, instance: ClassInstance, span: Mapping[str, int], tree: Any) -> bool:
        """= true, if what is at the place is written in the component's class; its names are checked then."""
        own = False
        for each in instance.chain():
            extents = tuple(each.definition.behaviour)
            if any(self._reading.begins_in(span, extent) for extent in extents):
                own = True
                self._expressions.check(tree, Site(each, extents, path))
        return own

    def _is_value(self, instance: ClassInstance, span: Mapping[str, int]) -> bool:
        """= true, if the equation is made from the value of a component."""
        for name in instance.component_names():
            component = instance.component(name)
            if component is not None:
                extents = [*component.declarations, *([component.binding.extent] if component.binding else [])]
                if any(self._reading.begins_in(span, extent) for extent in extents):
                    return True
        return False

    # --- what is not there ---

    @cached_property
    def _written(self) -> WrittenPlaces:
        return WrittenPlaces(self._flat, self._reading.library)

    def _without_equations(self, path: FlatPath) -> None:
        """A component that is redeclared as a class with equations has some of them."""
        node = self._nodes[path]
        if node is None or node.component is None:
            return
        if node.component.redeclaration is None and node.instance.redeclaration_around is None:
            return
        for each in node.instance.chain():
            equations = each.definition.equations
            if equations and not any(self._written.any_in(extent) for extent in equations):
                error = self._other_class(path)
                if error is not None:
                    raise error

    def _empty(self, path: FlatPath, filled: set[FlatPath]) -> None:
        """A component that is redeclared as a class with variables has some."""
        node = self._nodes[path]
        if node is None or node.instance.predefined is not None:
            return
        for name in node.instance.component_names():
            inner = (*path, name)
            found = None if inner in filled else self._node(inner)
            if found is None or found.component is None or not self._has_variables(found.component):
                continue
            is_replaced = found.component.redeclaration is not None or found.instance.redeclaration_around is not None
            if is_replaced and (error := self._other_class(inner)) is not None:
                raise error

    def _has_variables(self, component: Component) -> bool:
        if component.may_be_absent or component.is_outer:
            return False
        if component.type.predefined is not None:
            return True
        inner = (component.type.component(name) for name in component.type.component_names())
        return any(self._has_variables(each) for each in inner if each is not None)


def _has_lost_its_right_side(equation: Mapping[str, Any]) -> bool:
    """= true, for ``der(v[i]) = ...`` in a for-loop where rumoca wrote 0, with the place of the loop, on the right."""
    residual = equation["residual"].get("Binary")
    if residual is None or "Literal" not in residual["rhs"]:
        return False
    right = residual["rhs"]["Literal"]
    left = residual["lhs"].get("BuiltinCall")
    return left is not None and left["function"] == "Der" and bool(right.get("span") == equation["span"])
