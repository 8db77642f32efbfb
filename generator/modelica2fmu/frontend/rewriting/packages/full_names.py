"""Names of one package's text as they mean the same in another package.

Modelica Language Specification 3.6, 5.3: what a class inherits is looked up where it was written. In the package that
inherits it, the names that are found around its origin, or by its imports, are therefore written in full.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from modelica2fmu.crosscheck.class_instances import ClassInstance, Names
from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.class_syntax import Base, ClassDefinition, ComponentDeclaration, Extent, Modifier
from modelica2fmu.frontend.rewriting.packages.name_references import (
    declared_names,
    iterators,
    places_of_names,
    references,
)
from modelica2fmu.frontend.rewriting.packages.text_edits import CannotError, Edit, full_name

Element = ClassDefinition | ComponentDeclaration | Base | Modifier


class FullNames:
    """Of what is written in a package that inherits it.

    Args:
        library: the sources.
        root: the package.
    """

    def __init__(self, library: ClassLibrary, root: ClassInstance) -> None:
        self._library = library
        self._names = Names(library)
        self._root = root
        self._chain = list(root.chain())
        self._known: dict[tuple[int, str], tuple[ClassInstance, str | None]] = {}

    def edits(self, extent: Extent, scope: ClassInstance, elements: Sequence[Element] = ()) -> Iterator[Edit]:
        """What to write in full.

        Args:
            extent: a range of a file.
            scope: the class that it is written in.
            elements: what is declared or modified there.

        Raises:
            CannotError: a name has no full one.
            UnknownError: a class that is extended is not found.
        """
        tokens = self._library.tokens(extent)
        starts = (start - extent.start for start in declared_names(elements))
        loops = iterators(tokens)
        classes = [each for each in elements if isinstance(each, ClassDefinition)]
        scopes = [found for each in classes for found in _scopes(scope, each)]
        for name, start, end in references(tokens, places_of_names(tokens, starts)):
            place = extent.start + start
            around = [each for each in scopes if each.definition.extent.holds(extent.file, place)]
            full = self._in_full(around[-1] if around else scope, name)
            if full is not None and name in loops:
                raise CannotError(name)
            if full is not None:
                yield Edit(place, extent.start + end, full)

    def _in_full(self, scope: ClassInstance, name: str) -> str | None:
        """The full name of what a name means; ``None`` where the name will do."""
        is_inside = any(self._is_in_chain(each) for each in scope.scopes())
        is_within_element = not self._is_in_chain(scope)
        for each in scope.scopes():
            is_within_element &= not self._is_in_chain(each)
            if _declares(each, name):
                return None if is_inside else self._of_element(each, name)
            imported = self._imported(each, name)
            if imported is not None:
                return None if is_inside and is_within_element else f".{'.'.join(imported)}"
            if self._is_in_chain(each):
                is_inside = False
        if not _declares(self._root, name):
            return None
        if self._library.top(name) is None:
            return None  # an iterator, or a function of the language
        return f".{name}"

    def _is_in_chain(self, instance: ClassInstance) -> bool:
        return any(each is instance for each in self._chain)

    def _imported(self, scope: ClassInstance, name: str) -> tuple[str, ...] | None:
        for item in scope.definition.imports:
            if item.name == name:
                return item.path
            if item.name is None and _declares(self._names.find(item.path), name):
                return (*item.path, name)
        return None

    def _of_element(self, holder: ClassInstance, name: str) -> str | None:
        if self._found_from_root(name) is holder.definition:
            return None
        if holder.definition.kind != "package":
            raise CannotError(name)
        return f"{full_name(holder)}.{name}"

    def _found_from_root(self, name: str) -> ClassDefinition | None:
        """The class in which a name is found in the package."""
        for each in self._root.scopes():
            if _declares(each, name):
                return each.definition
            if self._imported(each, name) is not None:
                return None
        return None


def _declares(scope: ClassInstance, name: str) -> bool:
    return scope.class_element(name) is not None or scope.component(name) is not None


def _scopes(around: ClassInstance, definition: ClassDefinition) -> Iterator[ClassInstance]:
    """Classes of a text that names are looked up in, outer ones first; short ones have no names of their own."""
    if definition.is_short:
        return
    scope = around.declared(definition)
    yield scope
    for each in definition.classes.values():
        yield from _scopes(scope, each)
