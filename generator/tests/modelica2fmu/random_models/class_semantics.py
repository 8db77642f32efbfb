"""What modifiers, redeclarations and inheritance mean: an own reading of small Modelica classes, beside the builder's.

Modelica Language Specification 3.6, chapters 5 (lookup, inner and outer) and 7 (inheritance, modification,
redeclaration). Values are sums of multiples of other values, which is enough to tell which value went where.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

Path = tuple[str | int, ...]


class NoMeaningError(Exception):
    """A value depends on itself, or a name means nothing."""


@dataclass(frozen=True)
class Sum:
    """A number and multiples of what paths mean, ``1 + 2*a[1].k``."""

    number: float
    terms: tuple[tuple[float, Path], ...] = ()

    @property
    def text(self) -> str:
        parts = [f"{self.number:g}"] if self.number or not self.terms else []
        parts += [path_text(path) if factor == 1 else f"{factor:g}*{path_text(path)}" for factor, path in self.terms]
        return " + ".join(parts)


def path_text(path: Path) -> str:
    text = ""
    for part in path:
        text += f"[{part}]" if isinstance(part, int) else f"{'.' if text else ''}{part}"
    return text


@dataclass(frozen=True)
class Modifier:
    """What stands in parentheses after a name, and its value.

    Attributes:
        values: one, or those of the elements of an array; empty where the modifier gives none.
        children: modifiers of elements.
        redeclared: name of the class that a redeclaration gives.
        is_each: it is that of every element of an array.
    """

    values: tuple[Sum, ...] = ()
    children: tuple[tuple[str, Modifier], ...] = ()
    redeclared: str = ""
    is_each: bool = False


@dataclass(frozen=True)
class Declaration:
    """An element of a class.

    Attributes:
        kind: ``constant``, ``parameter``, ``variable``, ``component`` or ``class``.
        type_name: of components, and what classes stand for.
        size: of an array of components, 0 where it is none.
        constraint: class and modifiers of ``constrainedby``.
        sort: ``model`` or ``package`` of a class.
        scope_prefix: ``inner``, ``outer`` or nothing.
        is_absent: the condition of the component is false.
    """

    name: str
    kind: str
    modifier: Modifier = Modifier()
    type_name: str = ""
    size: int = 0
    is_replaceable: bool = False
    constraint: tuple[str, Modifier] | None = None
    sort: str = "model"
    scope_prefix: str = ""
    is_absent: bool = False
    definition: ClassDefinition | None = None
    is_redeclaration: bool = False


@dataclass
class ClassDefinition:
    """A class as it is written."""

    name: str
    sort: str
    bases: list[tuple[str, Modifier]] = field(default_factory=list)
    declarations: list[Declaration] = field(default_factory=list)


@dataclass(frozen=True)
class Scope:
    """Where names are looked up: the elements of an instance, then what surrounds the class."""

    instance: Instance
    parent: Scope | None


@dataclass(frozen=True)
class Meaning:
    """A modifier together with the scope in which its values are looked up."""

    values: tuple[Sum, ...] = ()
    scope: Scope | None = None
    children: dict[str, Meaning] = field(default_factory=dict)
    redeclared: str = ""
    redeclared_scope: Scope | None = None
    is_each: bool = False


def meaning(modifier: Modifier, scope: Scope) -> Meaning:
    return Meaning(
        modifier.values,
        scope,
        {name: meaning(child, scope) for name, child in modifier.children},
        modifier.redeclared,
        scope,
        modifier.is_each,
    )


def merged(outer: Meaning, inner: Meaning) -> Meaning:
    """Both, of which the outer one wins (7.2.4)."""
    children = dict(inner.children)
    for name, child in outer.children.items():
        children[name] = merged(child, children[name]) if name in children else child
    first = outer if outer.values else inner
    redeclaring = outer if outer.redeclared else inner
    return Meaning(
        first.values, first.scope, children, redeclaring.redeclared, redeclaring.redeclared_scope, outer.is_each
    )


def of_element(whole: Meaning, index: int) -> Meaning:
    """A modifier of an array for one of its elements (7.2.5)."""
    values = whole.values if whole.is_each or len(whole.values) < 2 else whole.values[index - 1 : index]
    children = {name: child if child.is_each else of_element(child, index) for name, child in whole.children.items()}
    return replace(whole, values=values, children=children)


@dataclass(frozen=True)
class ClassInScope:
    """A class, where it is looked up from, and the modifiers that short definitions and redeclarations give it."""

    definition: ClassDefinition
    scope: Scope | None
    meaning: Meaning = Meaning()


@dataclass(frozen=True)
class Slot:
    """An element of an instance: its declaration, all that modifies it, and where its own names are looked up."""

    declaration: Declaration
    meaning: Meaning
    scope: Scope


class Instance:
    """A class with its modifiers; also packages are such."""

    def __init__(self, of: ClassInScope, outer: Meaning, owner: Instance | None) -> None:
        self.owner = owner
        self.slots: dict[str, Slot] = {}
        self._parts: dict[tuple[str, int], Instance] = {}
        self._values: dict[tuple[str, int], float | None] = {}
        self._extend(of, outer)

    def _extend(self, of: ClassInScope, outer: Meaning) -> None:
        outer = merged(outer, of.meaning)
        scope = Scope(self, of.scope)
        for base, modifier in of.definition.bases:
            # a base class is looked up around the class, not among what it inherits (5.6.1)
            found = class_of(base, of.scope)
            self._extend(found, merged(outer, meaning(modifier, scope)))
        for declaration in of.definition.declarations:
            given = outer.children.get(declaration.name, Meaning())
            if declaration.is_redeclaration:
                before = self.slots[declaration.name]
                own = meaning(declaration.modifier, scope)
                constraint = before.declaration.constraint
                kept = before.declaration.modifier if constraint is None else constraint[1]
                own = merged(own, meaning(kept, before.scope))
                self.slots[declaration.name] = Slot(
                    replace(before.declaration, type_name=declaration.type_name), merged(given, own), scope
                )
                continue
            own = meaning(declaration.modifier, scope)
            if given.redeclared and declaration.constraint is not None:
                own = meaning(declaration.constraint[1], scope)
            elif declaration.constraint is not None:
                own = merged(own, meaning(declaration.constraint[1], scope))
            self.slots[declaration.name] = Slot(declaration, merged(given, own), scope)

    def class_of_slot(self, slot: Slot) -> ClassInScope:
        """The class that an element is, or of which it is a component."""
        if slot.declaration.definition is not None:
            return ClassInScope(slot.declaration.definition, slot.scope)
        if slot.meaning.redeclared:
            return class_of(slot.meaning.redeclared, slot.meaning.redeclared_scope)
        return class_of(slot.declaration.type_name, slot.scope)

    def part(self, name: str, index: int = 0) -> Instance:
        """The component or package of that name."""
        slot = self.slots[name]
        if slot.declaration.scope_prefix == "outer":
            return self._inner(name).part(name, index)
        if (name, index) not in self._parts:
            given = of_element(slot.meaning, index) if index else slot.meaning
            found = self.class_of_slot(slot)
            self._parts[(name, index)] = Instance(found, given, self)
        return self._parts[(name, index)]

    def value(self, name: str) -> float:
        """Of a constant, parameter or variable.

        Raises:
            NoMeaningError: it has none.
        """
        slot = self.slots[name]
        if slot.declaration.scope_prefix == "outer":
            return self._inner(name).value(name)
        if (name, 0) not in self._values:
            self._values[(name, 0)] = None
            given = slot.meaning.values
            if len(given) != 1 or slot.meaning.scope is None:
                raise NoMeaningError(name)
            self._values[(name, 0)] = evaluated(given[0], slot.meaning.scope)
        found = self._values[(name, 0)]
        if found is None:
            raise NoMeaningError(f"{name} depends on itself")
        return found

    def _inner(self, name: str) -> Instance:
        holder = self.owner
        while holder is not None:
            slot = holder.slots.get(name)
            if slot is not None and slot.declaration.scope_prefix == "inner":
                return holder
            holder = holder.owner
        raise NoMeaningError(f"no inner {name}")

    def absent(self) -> Iterator[Path]:
        """The components whose condition is false."""
        for name, slot in self.slots.items():
            if slot.declaration.is_absent:
                yield (name,)
            elif slot.declaration.kind == "component" and slot.declaration.scope_prefix != "outer":
                for index in indices(slot.declaration):
                    yield from (element(name, index) + tail for tail in self.part(name, index).absent())

    def values(self) -> Iterator[tuple[Path, float]]:
        """All values of parameters and variables, by their paths."""
        for name, slot in self.slots.items():
            declaration = slot.declaration
            is_elsewhere = declaration.is_absent or declaration.scope_prefix == "outer"
            if is_elsewhere or declaration.kind in ("class", "constant"):
                continue
            if declaration.kind == "component":
                for index in indices(declaration):
                    yield from ((element(name, index) + tail, value) for tail, value in self.part(name, index).values())
            else:
                yield (name,), self.value(name)


def indices(declaration: Declaration) -> range:
    """Those of the elements of an array of components; 0 where it is none."""
    return range(1, declaration.size + 1) if declaration.size else range(1)


def element(name: str, index: int) -> Path:
    return (name, index) if index else (name,)


def class_of(name: str, scope: Scope | None) -> ClassInScope:
    """The class that a name with dots means (5.3).

    Raises:
        NoMeaningError: there is none.
    """
    first, *rest = name.split(".")
    holder, slot = found_slot(first, scope)
    for each in rest:
        holder = holder.part(slot.declaration.name)
        if each not in holder.slots:
            raise NoMeaningError(name)
        slot = holder.slots[each]
    found = holder.class_of_slot(slot)
    own = replace(slot.meaning, redeclared="")
    return replace(found, meaning=merged(own, found.meaning))


def found_slot(name: str, scope: Scope | None) -> tuple[Instance, Slot]:
    while scope is not None:
        if name in scope.instance.slots:
            return scope.instance, scope.instance.slots[name]
        scope = scope.parent
    raise NoMeaningError(name)


def evaluated(expression: Sum, scope: Scope) -> float:
    total = expression.number
    for factor, path in expression.terms:
        holder, _ = found_slot(str(path[0]), scope)
        *heads, last = path
        while heads:
            name = str(heads.pop(0))
            index = heads.pop(0) if heads and isinstance(heads[0], int) else 0
            if name not in holder.slots:
                raise NoMeaningError(path_text(path))
            holder = holder.part(name, int(index))
        if str(last) not in holder.slots:
            raise NoMeaningError(path_text(path))
        total += factor * holder.value(str(last))
    return total
