"""What the library's text must hold so that tools that merge equal variables compute what it says.

OpenModelica 1.28 replaces variables that a plain equation equates, also in arrays that are arguments or results of
functions, and passes ``pre`` of an array as its present values; ``ContactMultiBody.Internal.Unaliased`` says more.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from enum import Enum, auto

from modelica_syntax import Component, Equation, Expression, ModelicaClass

LINKED = frozenset({"ContactMultiBody"})
"""Entries that ``Library`` annotations may have: those for which a file lies in the package's Resources."""


class Role(Enum):
    """What a variable is to a function that is not inlined."""

    ARGUMENT = auto()
    RESULT = auto()
    ONE_OF_SEVERAL = auto()


@dataclass(frozen=True)
class Finding:
    """A place that breaks a rule."""

    class_name: str
    rule: str
    what: str

    def __str__(self) -> str:
        return f"{self.class_name}: {self.rule}: {self.what}"


def findings(classes: Mapping[str, ModelicaClass]) -> list[Finding]:
    """What in these classes, by full name, breaks a rule."""
    found: set[Finding] = set()
    for name, definition in classes.items():
        if definition.kind in ("model", "block"):
            found.update(_Model(name, classes).findings())
        elif definition.kind == "function":
            found.update(_linked(name, definition))
    return sorted(found, key=str)


def _linked(name: str, definition: ModelicaClass) -> Iterator[Finding]:
    match = re.search(r"\bLibrary = (\{[^}]*\}|\"[^\"]*\")", definition.external)
    for entry in re.findall(r'"([^"]*)"', match[1]) if match else []:
        if entry not in LINKED:
            yield Finding(name, "an entry of Library is no file of the package", entry)


def _walk(expression: Expression) -> Iterator[Expression]:
    yield expression
    for part in expression.parts:
        yield from _walk(part)


def _plain_references(expression: Expression) -> list[Expression] | None:
    """The references that an expression is made of if it only arranges, negates or sums them; None if it computes."""
    if expression.kind == "ref":
        return [expression]
    if expression.kind == "literal":
        return []
    arranges = expression.kind in ("array", "comprehension") or (
        expression.kind == "call" and expression.text in ("sum", "cat", "zeros", "fill", "vector", "transpose")
    )
    if arranges or (expression.kind == "unary" and expression.text in "+-"):
        parts = [_plain_references(part) for part in expression.parts]
        return None if None in parts else [ref for part in parts for ref in part or []]
    return None


class _Model:
    """A model with what it inherits from other classes that are looked at."""

    def __init__(self, name: str, classes: Mapping[str, ModelicaClass]) -> None:
        self._classes = classes
        self._chain = list(self._inherited(name))
        self._components: dict[str, Component] = {}
        for _, definition in self._chain:
            self._components.update(definition.components)
        self._roles: dict[str, set[Role]] = {}
        for owner, equation in self._equations():
            self._note_roles(owner, equation)

    def roles(self, path: str) -> set[Role]:
        """Roles of a variable, also of one in a component whose class is looked at."""
        return self._roles.get(path, set()) | self._roles_in_component(path)

    def findings(self) -> Iterator[Finding]:
        for owner, equation in self._equations():
            yield from self._merged(owner, equation)
            yield from self._whole_pre(owner, equation)
            yield from self._inlined(owner, equation)
            yield from self._several(owner, equation)

    # --- the model --------------------------------------------------------------------------------------------------

    def _inherited(self, name: str) -> Iterator[tuple[str, ModelicaClass]]:
        definition = self._classes[name]
        for base in definition.bases:
            found = self._resolve(base, name)
            if found is not None:
                yield from self._inherited(found)
        yield name, definition

    def _resolve(self, name: str, owner: str) -> str | None:
        """Full name of a class that is looked at; None if it is another one."""
        first, _, rest = name.partition(".")
        imported = self._classes[owner].imports.get(first)
        if imported is not None:
            name = imported + ("." + rest if rest else "")
        scope = owner.split(".")
        candidates = (".".join([*scope[:length], name]) for length in range(len(scope), -1, -1))
        return next((candidate for candidate in candidates if candidate in self._classes), None)

    def _equations(self) -> Iterator[tuple[str, Equation]]:
        """Equations, declaration equations of variables among them, with the class they are written in."""
        for owner, definition in self._chain:
            yield from ((owner, equation) for equation in definition.equations)
            for component in definition.components.values():
                if component.binding is not None and not component.is_fixed:
                    yield owner, Equation(Expression("ref", component.name), component.binding, initial=False)

    def _library_function(self, call: Expression, owner: str) -> ModelicaClass | None:
        name = self._resolve(call.text, owner) if call.kind == "call" else None
        definition = self._classes[name] if name is not None else None
        return definition if definition is not None and definition.kind == "function" else None

    def _function(self, call: Expression, owner: str) -> ModelicaClass | None:
        """The function a call is of, if it is looked at, and arrays go in or out."""
        definition = self._library_function(call, owner)
        if definition is None:
            return None
        outputs = [c for c in definition.components.values() if "output" in c.prefixes]
        inputs = [c for c in definition.components.values() if "input" in c.prefixes]
        return definition if len(outputs) > 1 or any(c.dimensions for c in inputs + outputs) else None

    def _note_roles(self, owner: str, equation: Equation) -> None:
        sides = [side for side in (equation.left, equation.right) if side is not None]
        for node in (node for side in sides for node in _walk(side)):
            if self._function(node, owner) is not None:
                for argument in node.parts:
                    for reference in _plain_references(argument) or []:
                        self._note(reference, Role.ARGUMENT)
        if equation.right is not None and self._function(equation.right, owner) is not None:
            if equation.left.kind == "tuple":
                for part in equation.left.parts:
                    self._note(part, Role.ONE_OF_SEVERAL)
            else:
                self._note(equation.left, Role.RESULT)

    def _note(self, reference: Expression, role: Role) -> None:
        component = self._components.get(reference.text)
        if reference.kind != "ref" or component is None or component.is_fixed:
            return
        if component.dimensions or role is Role.ONE_OF_SEVERAL:
            self._roles.setdefault(reference.text, set()).add(role)

    def _roles_in_component(self, path: str) -> set[Role]:
        first, _, rest = path.partition(".")
        component = self._components.get(first)
        owner = next((name for name, definition in self._chain if first in definition.components), None)
        if not rest or component is None or owner is None:
            return set()
        type_name = self._resolve(component.type_name, owner)
        if type_name is None or self._classes[type_name].kind not in ("model", "block"):
            return set()
        return _Model(type_name, self._classes).roles(rest)

    # --- the rules --------------------------------------------------------------------------------------------------

    def _unscaled(self, expression: Expression) -> Expression:
        """An expression without factors and divisors that may be the constant 1."""
        if expression.kind == "unary" and expression.text in "+-":
            return Expression("unary", expression.text, (self._unscaled(expression.parts[0]),))
        if expression.kind == "binary" and expression.text in "*/":
            left, right = expression.parts
            if self._is_constant(right):
                return self._unscaled(left)
            if expression.text == "*" and self._is_constant(left):
                return self._unscaled(right)
        return expression

    def _is_constant(self, expression: Expression) -> bool:
        component = self._components.get(expression.text)
        return expression.kind == "ref" and component is not None and bool(component.prefixes & {"final", "constant"})

    def _merged(self, owner: str, equation: Equation) -> Iterator[Finding]:
        """No element or slice of an argument or a result is equated with another variable."""
        left = _plain_references(equation.left) if equation.left.kind != "tuple" else None
        right = _plain_references(self._unscaled(equation.right)) if equation.right is not None else None
        if not left or right is None:
            return
        varying = [ref for ref in right if self._varies(ref)]
        if not varying and not any(ref.subscripts for ref in left):
            return  # an array that is constant as a whole
        for reference in [*left, *varying]:
            if self.roles(reference.text):
                yield Finding(
                    owner, "an argument or result of a function is equated with another variable", reference.text
                )

    def _varies(self, reference: Expression) -> bool:
        first = reference.text.split(".")[0]
        return first in self._components and not self._components[first].is_fixed

    def _whole_pre(self, owner: str, equation: Equation) -> Iterator[Finding]:
        """No pre() of a whole array, but as the left side of an initial equation."""
        sides = [equation.right] if equation.initial else [equation.left, equation.right]
        for node in (node for side in sides if side is not None for node in _walk(side)):
            if node.kind == "call" and node.text == "pre" and node.parts[0].kind == "ref":
                component = self._components.get(node.parts[0].text)
                subscripts = node.parts[0].parts
                whole = component is not None and component.dimensions > len(subscripts)
                if whole or any(part.kind in ("colon", "range") for part in subscripts):
                    yield Finding(owner, "pre() of a whole array", node.parts[0].text)

    def _inlined(self, owner: str, equation: Equation) -> Iterator[Finding]:
        """Functions of arrays that equations call say that they are not to be inlined."""
        sides = [side for side in (equation.left, equation.right) if side is not None]
        for node in (node for side in sides for node in _walk(side)):
            definition = self._function(node, owner)
            if definition is not None and not definition.external and "Inline = false" not in definition.annotations:
                yield Finding(owner, "a function of arrays does not say Inline=false", node.text)

    def _several(self, owner: str, equation: Equation) -> Iterator[Finding]:
        """Results of a call with several are protected, and nothing but arguments of functions."""
        if equation.left.kind == "tuple":
            for part in equation.left.parts:
                component = self._components.get(part.text)
                if component is not None and not component.is_protected:
                    yield Finding(owner, "one of several results is not protected", part.text)
        else:
            yield from self._used(owner, equation.left)
        if equation.right is not None:
            yield from self._used(owner, equation.right)

    def _used(self, owner: str, expression: Expression) -> Iterator[Finding]:
        if self._library_function(expression, owner) is not None:
            for argument in expression.parts:
                if _plain_references(argument) is None:
                    yield from self._used(owner, argument)
            return
        if expression.kind == "ref" and Role.ONE_OF_SEVERAL in self.roles(expression.text):
            yield Finding(owner, "one of several results is used otherwise than as an argument", expression.text)
        for part in expression.parts:
            yield from self._used(owner, part)
