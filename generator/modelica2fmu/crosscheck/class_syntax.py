"""The parts of a Modelica class that its instances depend on: what is declared, inherited, modified, redeclared."""

from __future__ import annotations

import re
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Final

PREDEFINED: Final = frozenset({"Real", "Integer", "Boolean", "String", "ExternalObject", "StateSelect", "Clock"})

_SIZED: Final = re.compile(r"\w+\s*\[")


@dataclass(frozen=True)
class Extent:
    """A range of bytes of a file."""

    file: Path
    start: int
    end: int

    def holds(self, file: Path | None, position: int) -> bool:
        """= true, if a byte of a file lies in it."""
        return self.file == file and self.start <= position < self.end


@dataclass(frozen=True)
class Modifier:
    """An argument of a modification: ``k = 3``, ``x(start = 1)``, ``redeclare B x(k = 2)``, ``break x``.

    Attributes:
        path: names from the modified element inwards.
        arguments: in the parentheses.
        value: behind the equals sign.
        redeclared: what a redeclaration declares.
        removes: = true, if it is ``break``.
        is_dotted: = true, if it was written behind a dot.
    """

    path: tuple[str, ...]
    extent: Extent
    arguments: tuple[Modifier, ...] = ()
    value: Extent | None = None
    redeclared: ComponentDeclaration | ClassDefinition | None = None
    removes: bool = False
    is_dotted: bool = False

    def of_first_name(self) -> Modifier:
        """The same as a modifier of its first name: ``a(k = 3)`` for ``a.k = 3``."""
        if len(self.path) == 1:
            return self
        inner = replace(self, path=self.path[1:], is_dotted=True)
        return Modifier(self.path[:1], self.extent, (inner.of_first_name(),))


@dataclass(frozen=True)
class Constraint:
    """A constraining clause."""

    type_name: tuple[str, ...]
    arguments: tuple[Modifier, ...]
    extent: Extent


@dataclass(frozen=True)
class ComponentDeclaration:
    """A declared component.

    Attributes:
        name: of the component.
        type_name: as written; begins with an empty name where a full name is written with a leading dot.
        arguments: its modifiers.
        value: its binding.
        constraint: its constraining clause, where it is replaceable.
        redeclares: = true, if an element redeclares an inherited component.
        is_inner: = true, if it stands for outer ones.
        is_outer: = true, if another component stands for it.
        is_input: = true, if it is declared as an input.
        is_parameter: = true, if it is declared as a parameter or constant.
        sizes_of_type: subscripts behind its type, as in ``Real[3] x``.
        may_be_absent: = true, if it is constant, an array or conditional.
    """

    name: str
    type_name: tuple[str, ...]
    extent: Extent
    arguments: tuple[Modifier, ...] = ()
    value: Extent | None = None
    is_inner: bool = False
    is_outer: bool = False
    is_input: bool = False
    is_parameter: bool = False
    sizes_of_type: Extent | None = None
    redeclares: bool = False
    may_be_absent: bool = False
    constraint: Constraint | None = None


def is_array(sizes_of_type: Extent | None, text: str) -> bool:
    """= true, if a component is declared with subscripts, behind its type or in its text from its name on."""
    return sizes_of_type is not None or _SIZED.match(text) is not None


@dataclass(frozen=True)
class Base:
    """What a class extends, or what a short class stands for."""

    type_name: tuple[str, ...]
    arguments: tuple[Modifier, ...]
    extent: Extent


@dataclass(frozen=True)
class Import:
    """``import name = path;``; without name all of the package ``path``."""

    name: str | None
    path: tuple[str, ...]


@dataclass
class ClassDefinition:
    """A class.

    Attributes:
        bases: in order; of a short class the one that it stands for.
        is_short: = true, if it is ``class Name = Base(...)``.
        extends_inherited: = true, if it is ``redeclare class extends Name``; the first of ``bases`` has its modifiers.
        is_enumeration: = true, if it is an enumeration.
        is_outer: = true, if another class stands for it.
        elements: what stands before each semicolon among its elements: imports, bases, classes, components.
        behaviour: sections with equations and algorithms.
        equations: equations, assignments and when-clauses that stand in these directly, in no if or for.
        blocks: if and for with what is in them, but for those within others.
        c_name: the C function that an external function calls.
        folder: of a package, with files of more classes.
    """

    name: str
    kind: str
    extent: Extent
    bases: list[Base] = field(default_factory=list)
    components: dict[str, ComponentDeclaration] = field(default_factory=dict)
    classes: dict[str, ClassDefinition] = field(default_factory=dict)
    imports: list[Import] = field(default_factory=list)
    elements: list[Extent] = field(default_factory=list)
    behaviour: list[Extent] = field(default_factory=list)
    equations: list[Extent] = field(default_factory=list)
    blocks: list[Extent] = field(default_factory=list)
    c_name: str | None = None
    is_short: bool = False
    extends_inherited: bool = False
    is_enumeration: bool = False
    is_outer: bool = False
    is_encapsulated: bool = False
    is_partial: bool = False
    is_replaceable: bool = False
    redeclares: bool = False
    constraint: Constraint | None = None
    folder: Path | None = None
