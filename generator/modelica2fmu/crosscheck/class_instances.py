"""What a component is and which modifiers hold for it, by the rules of the language.

Modelica Language Specification 3.6: lookup 5.3, modification 7.2, redeclaration 7.3. Modifiers are kept in layers, the
outermost first; the first layer that modifies an element wins.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import Enum
from functools import cached_property
from pathlib import Path
from typing import Final

from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.class_syntax import (
    PREDEFINED,
    Base,
    ClassDefinition,
    ComponentDeclaration,
    Extent,
    Modifier,
)

_DEEPEST: Final = 60
_NOWHERE: Final = Extent(Path(), 0, 0)


class UnknownError(Exception):
    """A name is not found, or its meaning is not known here."""


class Role(Enum):
    """Where modifiers stand."""

    MODIFICATION = "modification"
    DECLARATION = "declaration"
    CLASS = "redeclared class"
    CONSTRAINT = "constraining clause"


@dataclass(frozen=True)
class Layer:
    """Modifiers with the class in which their names are looked up."""

    arguments: tuple[Modifier, ...]
    scope: ClassInstance
    role: Role = Role.MODIFICATION


@dataclass(frozen=True)
class Value:
    """What a component is bound to.

    Attributes:
        extent: the expression.
        scope: class in which its names are looked up.
        role: where it stands.
        modifier: that gives it; ``None`` for a declaration.
    """

    extent: Extent
    scope: ClassInstance
    role: Role
    modifier: Modifier | None


@dataclass(frozen=True)
class Component:
    """A component of a class instance.

    Attributes:
        type: its class with all modifiers that hold.
        declarations: where it is declared: originally and where it is redeclared.
        binding: the value that holds.
        overridden: values that it wins over.
        is_certain: = false, if the specification leaves open which modifiers remain after a redeclaration.
        redeclaration: the modifier that redeclares it.
        is_outer: = true, if another component stands for it.
        may_be_absent: = true, if it is constant, an array or conditional.
        sizes_of_type: subscripts behind its type, as in ``Real[3] x``.
    """

    type: ClassInstance
    declarations: tuple[Extent, ...]
    binding: Value | None
    overridden: tuple[Value, ...]
    is_certain: bool
    redeclaration: Modifier | None
    is_outer: bool
    may_be_absent: bool
    sizes_of_type: Extent | None


Modifiers = Sequence[tuple[Modifier, Layer]]


class Names:
    """Full names of classes.

    Args:
        library: where they are found.
    """

    def __init__(self, library: ClassLibrary) -> None:
        self.library = library
        self._top: dict[str, ClassInstance] = {}

    def find(self, name: tuple[str, ...]) -> ClassInstance:
        """The class of a full name, without modifiers; raises UnknownError."""
        if name[0] not in self._top:
            definition = self.library.top(name[0])
            if definition is None and name[0] in PREDEFINED:
                definition = ClassDefinition(name[0], "type", _NOWHERE)
            if definition is None:
                raise UnknownError(name[0])
            self._top[name[0]] = ClassInstance(self, definition, None)
        return self._top[name[0]].within(name[1:])


class ClassInstance:
    """A class where it is used: with the modifiers that hold there.

    Args:
        names: for names that are not found in it.
        definition: of the class.
        parent: the class that it is declared in.
        above: modifiers that win over those of the class.
        below: modifiers that those of a short class win over.
        inherited: what ``redeclare class extends`` extends.
        redeclaration: the modifier that redeclares it.
    """

    def __init__(
        self,
        names: Names,
        definition: ClassDefinition,
        parent: ClassInstance | None,
        above: tuple[Layer, ...] = (),
        below: tuple[Layer, ...] = (),
        inherited: ClassInstance | None = None,
        redeclaration: Modifier | None = None,
        depth: int = 0,
    ) -> None:
        if depth > _DEEPEST:
            raise UnknownError(definition.name)
        self.definition = definition
        self.parent = parent
        self.redeclaration = redeclaration
        self._names = names
        self._above = above
        self._below = below
        self._inherited = inherited
        self._depth = depth
        self._heir: ClassInstance | None = None  # that extends it
        self._is_finding_bases = False
        self._classes: dict[str, ClassInstance] = {}
        self._components: dict[str, Component | None] = {}

    def modified(self, layers: tuple[Layer, ...]) -> ClassInstance:
        """The same class with modifiers that win over those it has."""
        return ClassInstance(
            self._names,
            self.definition,
            self.parent,
            layers + self._above,
            self._below,
            self._inherited,
            self.redeclaration,
            self._depth,
        )

    @property
    def is_modified(self) -> bool:
        """= true, if modifiers from outside hold for it."""
        return bool(self._above)

    @cached_property
    def has_redeclarations(self) -> bool:
        """= true, if a modifier redeclares an element of it, or of one of its elements."""
        return any(map(_redeclares, (argument for layer in self._above for argument in layer.arguments)))

    def declared(self, definition: ClassDefinition) -> ClassInstance:
        """A class that is written in this one, without what modifies it from outside."""
        return self._instance(definition, self, (), (), None, None)

    @property
    def redeclaration_around(self) -> Modifier | None:
        """The modifier that redeclares it, or the next one that redeclares a class around it."""
        each: ClassInstance | None = self
        while each is not None and each.redeclaration is None:
            each = each.parent if each._heir is None else each._heir
        return None if each is None else each.redeclaration

    # --- inheritance ---

    @cached_property
    def bases(self) -> tuple[ClassInstance, ...]:
        """What it extends; raises UnknownError."""
        result = []
        self._is_finding_bases = True  # what is inherited does not count for the names of what is extended
        try:
            for number, base in enumerate(self.definition.bases):
                found = self._inherited if number == 0 and self._inherited is not None else self._base_class(base)
                own = Layer(base.arguments, self._scope_of_modifiers, self._role_of_modifiers)
                result.append(found.modified((*self._above, self._redeclarations, own, *self._below)))
                result[-1]._heir = self
        finally:
            self._is_finding_bases = False
        return tuple(result)

    def missing_base(self) -> Base | None:
        """The first class that it extends and that is not found; as long as there is one, no name is found in it."""
        self._is_finding_bases = True
        try:
            for number, base in enumerate(self.definition.bases):
                if number == 0 and self._inherited is not None:
                    continue
                try:
                    self._base_class(base)
                except UnknownError:
                    return base
        finally:
            self._is_finding_bases = False
        return None

    @property
    def _is_short(self) -> bool:
        return self.definition.is_short

    def _base_class(self, base: Base) -> ClassInstance:
        if not self._is_short:
            return self.lookup(base.type_name)
        if self.parent is not None:
            return self.parent.lookup(base.type_name)
        return self._names.find(base.type_name)

    @property
    def _scope_of_modifiers(self) -> ClassInstance:
        return self.parent if self._is_short and self.parent is not None else self

    @property
    def _role_of_modifiers(self) -> Role:
        is_redeclaring = self.redeclaration is not None and self.redeclaration.redeclared is self.definition
        return Role.CLASS if is_redeclaring else Role.MODIFICATION

    @property
    def _redeclarations(self) -> Layer:
        """Elements that redeclare what is inherited are modifiers of it."""
        redeclaring = (each for each in self._elements() if each.redeclares)
        return Layer(tuple(Modifier((each.name,), each.extent, redeclared=each) for each in redeclaring), self)

    def _elements(self) -> Iterator[ClassDefinition | ComponentDeclaration]:
        yield from self.definition.components.values()
        yield from self.definition.classes.values()

    def chain(self) -> Iterator[ClassInstance]:
        """The class and all that it extends; raises UnknownError."""
        yield self
        for base in self.bases:
            yield from base.chain()

    @cached_property
    def predefined(self) -> ClassInstance | None:
        """The predefined type or enumeration that it stands for, with all its modifiers; raises UnknownError."""
        if self.definition.extent is _NOWHERE or self.definition.is_enumeration:
            return self
        return next((found for base in self.bases if (found := base.predefined) is not None), None)

    def attribute(self, name: str) -> list[Value]:
        """Values that are given to an attribute of a predefined type, the one that holds first."""
        return _values(self.modifiers_of(name))

    # --- lookup ---

    def lookup(self, name: tuple[str, ...]) -> ClassInstance:
        """The class that a name means here; raises UnknownError."""
        if name[0] == "":
            return self._names.find(name[1:])
        for scope in self.scopes():
            found = scope.class_element(name[0]) or scope.imported(name[0])
            if found is not None:
                return found.within(name[1:])
        return self._names.find(name)

    def scopes(self) -> Iterator[ClassInstance]:
        """The class and those around it, in which names are looked up."""
        scope: ClassInstance | None = self
        while scope is not None:
            yield scope
            scope = None if scope.definition.is_encapsulated else scope.parent

    def within(self, name: tuple[str, ...]) -> ClassInstance:
        """The class of a name that begins in this one; raises UnknownError."""
        found = self
        for part in name:
            inner = found.class_element(part)
            if inner is None:
                raise UnknownError(part)
            found = inner
        return found

    def imported(self, name: str) -> ClassInstance | None:
        """What a name means by the imports of the class; raises UnknownError."""
        for item in self.definition.imports:
            if item.name == name:
                return self._names.find(item.path)
            if item.name is None:
                found = self._names.find(item.path).class_element(name)
                if found is not None:
                    return found
        return None

    def class_element(self, name: str) -> ClassInstance | None:
        """A class that is declared in this one or inherited, as modified and redeclared; raises UnknownError."""
        own = None if self._is_short else self._names.library.member(self.definition, name)
        if own is not None and not own.redeclares:
            if name not in self._classes:
                self._classes[name] = self._class(own, self.modifiers_of(name))
            return self._classes[name]
        if self._is_finding_bases:
            return None
        return next((found for base in self.bases if (found := base.class_element(name)) is not None), None)

    def component(self, name: str) -> Component | None:
        """A component, declared or inherited, as modified and redeclared; raises UnknownError."""
        own = self.definition.components.get(name)
        if own is not None and not own.redeclares:
            if name not in self._components:
                self._components[name] = self._component(own, self.modifiers_of(name))
            return self._components[name]
        return next((found for base in self.bases if (found := base.component(name)) is not None), None)

    def component_names(self) -> Iterator[str]:
        """Names of all components, inherited ones included; raises UnknownError."""
        for scope in self.chain():
            yield from scope.definition.components

    def fields(self) -> list[str]:
        """Names of a record's fields in the order of its constructor's inputs; raises UnknownError."""
        inherited = [name for base in self.bases for name in base.fields()]
        return list(dict.fromkeys((*inherited, *self.definition.components)))

    # --- modification ---

    def modifiers_of(self, name: str) -> Modifiers:
        """What modifies an element, the winner first."""
        return [
            (argument.of_first_name(), layer)
            for layer in self._above
            for argument in layer.arguments
            if argument.path[0] == name
        ]

    def _class(self, declared: ClassDefinition, modifiers: Modifiers) -> ClassInstance:
        number = _first_redeclaration(modifiers)
        if number is None:
            below = self._constraint(declared, ()) if declared.constraint else ()
            return self._instance(declared, self, _layers(modifiers), below, None, None)
        below = self._constraint(declared, modifiers[number:])
        modifier, layer = modifiers[number]
        element = modifier.redeclared
        if not isinstance(element, ClassDefinition):
            raise UnknownError(declared.name)
        above = _layers(modifiers[:number])
        if element.extends_inherited:
            inherited = self._class(declared, modifiers[number + 1 :])
            return self._instance(element, layer.scope, above, (), inherited, modifier)
        return self._instance(element, layer.scope, above, below, None, modifier)

    def _instance(
        self,
        definition: ClassDefinition,
        parent: ClassInstance,
        above: tuple[Layer, ...],
        below: tuple[Layer, ...],
        inherited: ClassInstance | None,
        redeclaration: Modifier | None,
    ) -> ClassInstance:
        below = below if definition.is_short else ()
        return ClassInstance(self._names, definition, parent, above, below, inherited, redeclaration, self._depth + 1)

    def _constraint(self, declared: ClassDefinition | ComponentDeclaration, modifiers: Modifiers) -> tuple[Layer, ...]:
        """Modifiers that hold in the declaration and in each redeclaration (7.3.2).

        They are those of the constraining clause, in its absence those of the original declaration.
        """
        result = Layer((), self)
        if declared.constraint is not None:
            result = Layer(declared.constraint.arguments, self, Role.CONSTRAINT)
        elif isinstance(declared, ComponentDeclaration):
            result = Layer(declared.arguments, self, Role.CONSTRAINT)
        elif declared.is_short and declared.bases:
            result = Layer(declared.bases[0].arguments, self, Role.CONSTRAINT)
        for modifier, layer in reversed(modifiers):
            if modifier.redeclared is not None and modifier.redeclared.constraint is not None:
                result = Layer(modifier.redeclared.constraint.arguments, layer.scope, Role.CONSTRAINT)
        return (result,)

    def _component(self, declared: ComponentDeclaration, modifiers: Modifiers) -> Component | None:
        if any(modifier.removes for modifier, _ in modifiers):
            return None
        number = _first_redeclaration(modifiers)
        outer, rest = modifiers[:number], modifiers[len(modifiers) if number is None else number :]
        redeclaration, layer = (None, Layer((), self)) if number is None else modifiers[number]
        element = declared if redeclaration is None else redeclaration.redeclared
        if not isinstance(element, ComponentDeclaration):
            raise UnknownError(declared.name)
        constraint = self._constraint(declared, rest) if redeclaration or declared.constraint else ()
        above = (*_layers(outer), Layer(element.arguments, layer.scope, Role.DECLARATION), *constraint)
        values = _values(outer)
        if element.value is not None:
            values.append(Value(element.value, layer.scope, Role.DECLARATION, redeclaration))
        binding = values[0] if values else None
        # Whether a value of the original declaration and modifiers in between remain is read in different ways.
        is_certain = not any(modifier.redeclared is None for modifier, _ in rest)
        if redeclaration is not None and binding is None and declared.value is not None:
            is_certain = False
        return Component(
            layer.scope.lookup(element.type_name).modified(above),
            tuple(dict.fromkeys((declared.extent, element.extent))),
            binding,
            tuple(values[1:]),
            is_certain,
            redeclaration,
            declared.is_outer,
            declared.may_be_absent,
            element.sizes_of_type,
        )


def _redeclares(modifier: Modifier) -> bool:
    return modifier.redeclared is not None or any(map(_redeclares, modifier.arguments))


def _first_redeclaration(modifiers: Modifiers) -> int | None:
    return next((number for number, (item, _) in enumerate(modifiers) if item.redeclared is not None), None)


def _layers(modifiers: Modifiers) -> tuple[Layer, ...]:
    return tuple(Layer(item.arguments, layer.scope, layer.role) for item, layer in modifiers if item.arguments)


def _values(modifiers: Modifiers) -> list[Value]:
    return [Value(item.value, layer.scope, layer.role, item) for item, layer in modifiers if item.value is not None]
