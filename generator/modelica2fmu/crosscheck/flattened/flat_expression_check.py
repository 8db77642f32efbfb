"""Holds constants and function calls in expressions of the flattened model against their sources."""

from __future__ import annotations

import ast
import math
import operator
import re
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Final

from contact_foundation.errors import UnsupportedModelError

from modelica2fmu.crosscheck.class_instances import ClassInstance, UnknownError, Value
from modelica2fmu.crosscheck.class_syntax import Extent
from modelica2fmu.crosscheck.class_tokens import UnreadableError
from modelica2fmu.crosscheck.flattened.flat_reading import FlatReading, objects, spans

_NAME: Final = re.compile(r"\.?\s*[A-Za-z_]\w*(?:\s*\.\s*[A-Za-z_]\w*)*")
_OPERATORS: Final[Mapping[type[ast.operator], Callable[[float, float], object]]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
}
_LONGEST: Final = 200
_ROUNDING: Final = 1e-12
_DEEPEST: Final = 20


@dataclass(frozen=True)
class Site:
    """Where an expression is written.

    Attributes:
        scope: class in which its names are looked up.
        extents: ranges of files; what else is in the expression was put there from elsewhere.
        path: component that it belongs to.
    """

    scope: ClassInstance
    extents: tuple[Extent, ...]
    path: tuple[str, ...]


class ExpressionCheck:
    """Checks expressions of one flattened model.

    Args:
        functions: of the flattened model.
        reading: the sources.
        inner: the class of the component that a name means in a component, ``None`` if there is none.
    """

    def __init__(
        self,
        functions: Mapping[str, Any],
        reading: FlatReading,
        inner: Callable[[tuple[str, ...], str], ClassInstance | None],
    ) -> None:
        self._functions = functions
        self._reading = reading
        self._inner = inner
        self._done: dict[tuple[str, int], ClassInstance] = {}  # keeps what the numbers stand for

    def check(self, tree: Any, site: Site, depth: int = 0) -> None:
        """Raises UnsupportedModelError where a constant or a function is not the one that is named."""
        # All parts of an expression that was put in the place of a name have that place.
        parts = Counter((span["source"], span["start"], span["end"]) for span in spans(tree))
        for item in objects(tree):
            try:
                if "Literal" in item:
                    span = item["Literal"].get("span")
                    if span and parts[span["source"], span["start"], span["end"]] == 1:
                        self._literal(item["Literal"], site)
                elif "FunctionCall" in item:
                    self._call(item["FunctionCall"], site, depth)
            except (UnknownError, UnreadableError, RecursionError):
                continue

    def _written(self, span: Mapping[str, int] | None, site: Site) -> tuple[Extent, tuple[str, ...]] | None:
        """The name that is written at a place of the site."""
        if not span or not any(self._reading.begins_in(span, extent) for extent in site.extents):
            return None
        extent = self._reading.extent(span)
        match = None if extent is None else _NAME.match(self._reading.text(extent))
        if extent is None or match is None:
            return None
        return extent, tuple(part.strip() for part in match[0].split("."))

    # --- constants ---

    def _literal(self, literal: Mapping[str, Any], site: Site) -> None:
        """A number where a name is written was put in its place."""
        written = self._written(literal["span"], site)
        if written is None or not isinstance(literal["value"], dict):
            return
        extent, name = written
        if not _NAME.fullmatch(self._reading.text(extent)) or name in (("true",), ("false",)):
            return
        (given,) = literal["value"].values()
        value = self._value_of(site.scope, name)
        if value is None or isinstance(given, str):
            return
        number = self._number(value)
        if number is not None and not math.isclose(number, float(given), rel_tol=_ROUNDING):
            raise UnsupportedModelError(
                f"{'.'.join(name)} is {number:g} in {'.'.join(site.path) or 'the model'}, but"
                f" the front end takes {given:g}",
                place=self._reading.place_of(extent),
                remedy="write the value here, or pass it on as a parameter: modified constants of packages are not"
                " always carried through",
            )

    def _value_of(self, scope: ClassInstance, name: tuple[str, ...]) -> Value | None:
        """What a constant or parameter is bound to; raises UnknownError."""
        if len(name) > 1:
            component = scope.lookup(name[:-1]).component(name[-1])
        else:
            component = next((found for each in scope.scopes() if (found := each.component(name[0]))), None)
        return None if component is None or not component.is_certain else component.binding

    def _number(self, value: Value, depth: int = 0) -> float | None:
        """The number that an expression of numbers and other constants gives; raises UnknownError."""
        text = self._reading.text(value.extent)
        if text in ("true", "false"):
            return float(text == "true")
        if depth > _DEEPEST or len(text) > _LONGEST:
            return None
        try:
            return self._evaluated(ast.parse(text.replace("^", "**"), mode="eval").body, value.scope, depth)
        except (SyntaxError, ArithmeticError, ValueError):
            return None

    def _evaluated(self, tree: ast.expr, scope: ClassInstance, depth: int) -> float | None:
        if isinstance(tree, ast.Constant) and isinstance(tree.value, int | float):
            return float(tree.value)
        if isinstance(tree, ast.Name | ast.Attribute):
            further = self._value_of(scope, tuple(ast.unparse(tree).split(".")))
            return None if further is None else self._number(further, depth + 1)
        if isinstance(tree, ast.UnaryOp) and isinstance(tree.op, ast.USub | ast.UAdd):
            operand = self._evaluated(tree.operand, scope, depth)
            return operand if operand is None or isinstance(tree.op, ast.UAdd) else -operand
        if isinstance(tree, ast.BinOp) and type(tree.op) in _OPERATORS:
            left, right = (self._evaluated(each, scope, depth) for each in (tree.left, tree.right))
            if left is not None and right is not None:
                result = _OPERATORS[type(tree.op)](left, right)
                return result if isinstance(result, float) else None
        return None

    # --- functions ---

    def _call(self, call: Mapping[str, Any], site: Site, depth: int) -> None:
        written = self._written(call.get("span"), site)
        function = self._functions.get(_called(call))
        if written is None or function is None or call.get("is_constructor") or depth > _DEEPEST:
            return
        extent, name = written
        expected = self._function(name, site)
        if expected.definition.kind not in ("function", "operator"):
            return
        label = ".".join((*site.path, *name))
        self._check_function(function, expected, label, depth)
        for argument, item in zip(call["args"], function["inputs"], strict=False):
            component = expected.component(item["name"])
            places = list(spans(argument))
            if component is None or component.binding is None or not component.is_certain or not places:
                continue
            # Within the call the argument is given, elsewhere it is the input's default.
            extents = (extent, component.binding.extent)
            is_right = any(self._reading.begins_in(span, each) for span in places for each in extents)
            if not is_right and not _NAME.fullmatch(self._reading.text(component.binding.extent)):
                raise self._reading.ignored_value(f"{item['name']} of {label}", component.binding, argument)

    def _function(self, name: tuple[str, ...], site: Site) -> ClassInstance:
        """The function that a name means; raises UnknownError."""
        try:
            return site.scope.lookup(name)
        except UnknownError:
            found = self._inner(site.path, name[0])
            if found is None:
                raise
            return found.within(name[1:])

    def _check_function(self, function: Mapping[str, Any], expected: ClassInstance, label: str, depth: int) -> None:
        key = (str(function["name"]), id(expected))
        if key in self._done:
            return
        self._done[key] = expected
        redeclaration = expected.redeclaration_around
        if redeclaration is not None and not self._is_written_in(function, expected):
            raise self._reading.ignored_redeclaration(label, redeclaration.extent)
        for each in expected.chain():
            site = Site(each, tuple(each.definition.behaviour), (label,))
            self.check(function["body"], site, depth + 1)

    def _is_written_in(self, function: Mapping[str, Any], expected: ClassInstance) -> bool:
        """= true, if inputs, outputs, assignments and the C function are those of a class."""
        for item in (*function["inputs"], *function["outputs"]):
            component = expected.component(item["name"])
            declarations = () if component is None else component.declarations
            if item.get("span") and not any(self._reading.ends_in(item["span"], extent) for extent in declarations):
                return False
        definitions = [each.definition for each in expected.chain()]
        external = function["external"]
        if external is not None:
            return any(each.c_name == external["function_name"] for each in definitions)
        extents = [extent for each in definitions for extent in each.behaviour]
        return all(
            any(self._reading.begins_in(span, extent) for extent in extents) for span in _assignments(function["body"])
        )


def _called(call: Mapping[str, Any]) -> str:
    """Name of the function that an expression or a statement calls; the latter has it where others have a target."""
    place = call["name"] if "name" in call else call["comp"]
    return str(place["name"]) if "name" in place else ".".join(part["ident"] for part in place["parts"])


def _assignments(body: Any) -> Iterator[Mapping[str, int]]:
    """Places of the targets of all assignments in statements."""
    for item in objects(body):
        if "Assignment" in item:
            span = item["Assignment"]["comp"].get("span")
            if span:
                yield span
