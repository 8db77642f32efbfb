"""Classes with the packages that modifiers redeclare in them, written out as classes of their own.

rumoca 0.10 takes ``Part a(redeclare package Stuff = Steel)`` where ``Steel`` extends what constrains ``Stuff``, and has
the classes of ``Stuff`` as they are in the default. A copy of ``Part`` that names ``Steel`` it takes as it is.
"""

from __future__ import annotations

from pathlib import Path

from modelica2fmu.crosscheck.class_instances import ClassInstance, UnknownError
from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.class_syntax import Base, ClassDefinition, ComponentDeclaration, Extent, Modifier
from modelica2fmu.crosscheck.class_tokens import Token, UnreadableError
from modelica2fmu.frontend.rewriting.packages.name_references import declared_names, places_of_names, references
from modelica2fmu.frontend.rewriting.packages.text_edits import (
    CannotError,
    Edit,
    edited,
    full_name,
    in_one_line,
    lies_in,
)


class ChosenPackages:
    """Collects what to write otherwise.

    Args:
        library: the sources.

    Attributes:
        edits: by file.
    """

    def __init__(self, library: ClassLibrary) -> None:
        self.edits: dict[Path, list[Edit]] = {}
        self._library = library
        self._copies: dict[tuple[Extent, str], str] = {}

    def collect(self, around: ClassInstance) -> None:
        """All that components and bases in a class, and in those within it, redeclare."""
        definition = around.definition
        elements: list[ComponentDeclaration | Base] = [*definition.components.values()]
        if not definition.is_short and not definition.extends_inherited:
            elements += definition.bases
        for declared in elements:
            self._one_of(around, declared)
        for each in list(definition.classes.values()):
            self.collect(around.declared(each))

    def _one_of(self, around: ClassInstance, declared: ComponentDeclaration | Base) -> None:
        for argument in declared.arguments:
            try:
                if self._use(around, declared, argument):
                    return
            except (CannotError, UnknownError, UnreadableError, RecursionError):
                continue

    def _use(self, scope: ClassInstance, declared: ComponentDeclaration | Base, argument: Modifier) -> bool:
        chosen = argument.redeclared
        if not isinstance(chosen, ClassDefinition) or chosen.kind != "package" or not chosen.is_short:
            return False
        target = self._target(scope, chosen)
        place = self._type_name(scope.definition, declared)
        without = self._without(declared, argument)
        name = self._copy(scope.lookup(declared.type_name), argument.path[0], target)
        self._edit(declared.extent.file, [Edit(*place, name), without])
        return True

    def _edit(self, file: Path, edits: list[Edit]) -> None:
        self.edits.setdefault(file, []).extend(edits)

    # --- what is chosen ---

    def _target(self, scope: ClassInstance, chosen: ClassDefinition) -> str:
        """The package, as it can be named everywhere."""
        base = chosen.bases[0]
        found = scope.lookup(base.type_name)
        while found.definition.is_short and found.bases and not found.definition.bases[0].arguments:
            found = found.bases[0]
        arguments = ""
        if base.arguments:
            first, last = base.arguments[0].extent, base.arguments[-1].extent
            if any(argument.arguments or argument.redeclared for argument in base.arguments):
                raise CannotError
            for argument in base.arguments:
                tokens = [] if argument.value is None else self._library.tokens(argument.value)
                if any(token.kind == "name" for token in tokens):
                    raise CannotError
            arguments = f"({self._library.text(Extent(first.file, first.start, last.end))})"
        return f"{full_name(found)}{arguments}"

    # --- copies ---

    def _copy(self, used: ClassInstance, package: str, target: str) -> str:
        """The full name of a class with the package in place of the one that it declares."""
        definition = used.definition
        name = f"{definition.name}_{package}_{''.join(c if c.isalnum() else '_' for c in target)}"
        path = full_name(used).rpartition(".")[0]
        key = definition.extent, name
        if key not in self._copies:
            edits = [*self._renamed(definition, name), *self._named(definition, package, target)]
            own = definition.classes.get(package)
            if definition.is_short or definition.folder is not None or not self._library.is_own(definition.extent):
                raise CannotError
            if own is not None and own.is_replaceable:
                element = _element(definition, own.extent)
                edits.append(Edit(element.start, element.end, f"package {package} = {target}"))
            else:
                edits.append(self._with_base(used, package, target))
            around = used.parent
            if around is None or name not in around.definition.classes:
                text = in_one_line(edited(self._library, definition.extent, edits))
                whole = definition.extent if around is None else _element(around.definition, definition.extent)
                place = whole.start
                self._edit(definition.extent.file, [Edit(place, place, f"{text}; ")])
            self._copies[key] = name
        return f"{path}.{name}"

    def _with_base(self, used: ClassInstance, package: str, target: str) -> Edit:
        """The same of what the class extends."""
        for base, found in zip(used.definition.bases, used.bases, strict=True):
            if found.class_element(package) is not None:
                name = self._copy(used.lookup(base.type_name), package, target)
                return Edit(*self._type_name(used.definition, base), name)
        raise CannotError(package)

    def _renamed(self, definition: ClassDefinition, name: str) -> list[Edit]:
        tokens = self._library.tokens(definition.extent)
        places = (next(each for each in tokens if each.text == definition.name), tokens[-1])
        start = definition.extent.start
        return [Edit(start + token.start, start + token.end, name) for token in places]

    def _named(self, definition: ClassDefinition, package: str, target: str) -> list[Edit]:
        """The package by its full name; with modifiers it has none."""
        if target.endswith(")"):
            return []
        start = definition.extent.start
        tokens = self._library.tokens(definition.extent)
        declared = places_of_names(tokens, (place - start for place in declared_names((definition,))))
        found = (each for each in references(tokens, declared) if each.name == package)
        return [Edit(start + each.start, start + each.end, target) for each in found]

    # --- places ---

    def _type_name(self, definition: ClassDefinition, declared: ComponentDeclaration | Base) -> tuple[int, int]:
        """Where the name of its class stands."""
        extent = declared.extent if isinstance(declared, Base) else _element(definition, declared.extent)
        tokens = self._library.tokens(extent)
        if isinstance(declared, Base):
            last = len([part for part in declared.type_name if part]) * 2 - 2 + (tokens[0].text == ".")
        else:
            if sum(lies_in(each.extent, extent) for each in definition.components.values()) > 1:
                raise CannotError(declared.name)
            last = next(at for at, each in enumerate(tokens) if extent.start + each.start == declared.extent.start) - 1
            if tokens[last].text == "]":
                last = max(at for at in range(last) if tokens[at].text == "[") - 1
        first = _first_of_name(tokens, last)
        return extent.start + tokens[first].start, extent.start + tokens[last].end

    def _without(self, declared: ComponentDeclaration | Base, argument: Modifier) -> Edit:
        """Takes an argument away, and the comma behind or before it, or the parentheses around it."""
        number = declared.arguments.index(argument)
        start, end = argument.extent.start, argument.extent.end
        if number + 1 < len(declared.arguments):
            return Edit(start, declared.arguments[number + 1].extent.start, "")
        if number > 0:
            return Edit(declared.arguments[number - 1].extent.end, end, "")
        tokens = self._library.tokens(declared.extent)
        offset = declared.extent.start
        opened = max(token.start for token in tokens if offset + token.end <= start and token.text == "(")
        closed = min(token.end for token in tokens if offset + token.start >= end and token.text == ")")
        return Edit(offset + opened, offset + closed, "")


def _element(definition: ClassDefinition, extent: Extent) -> Extent:
    for each in definition.elements:
        if lies_in(extent, each):
            return each
    raise CannotError(definition.name)


def _first_of_name(tokens: list[Token], last: int) -> int:
    first = last
    while first > 1 and tokens[first - 1].text == "." and tokens[first - 2].kind == "name":
        first -= 2
    return first - 1 if first > 0 and tokens[first - 1].text == "." else first
