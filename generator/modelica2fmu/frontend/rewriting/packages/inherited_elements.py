"""The elements that a package inherits, as it would declare them itself."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from modelica2fmu.crosscheck.class_instances import ClassInstance, Modifiers
from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.class_syntax import Base, ClassDefinition, ComponentDeclaration, Extent
from modelica2fmu.frontend.rewriting.packages.full_names import FullNames
from modelica2fmu.frontend.rewriting.packages.modified_text import ModifiedText
from modelica2fmu.frontend.rewriting.packages.text_edits import CannotError, Edit, edited, in_one_line, lies_in

_Declared = ClassDefinition | ComponentDeclaration


class InheritedElements:
    """Writes a package out.

    Args:
        library: the sources.
        root: the package.
    """

    def __init__(self, library: ClassLibrary, root: ClassInstance) -> None:
        self._library = library
        self._root = root
        self._names = FullNames(library, root)
        self._modified = ModifiedText(library, self._names)
        self._versions: dict[str, list[_Declared]] = {}
        self._done = set[Extent]()
        for each in reversed(list(root.chain())):
            for element in _elements(each.definition):
                known = self._versions.setdefault(element.name, [])
                if element not in known:
                    known.append(element)

    def edits(self) -> list[Edit]:
        """What to change in the package's own text.

        Raises:
            CannotError: it cannot be written out.
            UnknownError: a class that is extended is not found.
        """
        definition = self._root.definition
        if definition.is_short:
            return [self._long_for_short(definition)]
        edits = []
        for element in definition.elements:
            base = _base_in(definition, element)
            if base is not None:
                inherited = "; ".join(self._elements_of(self._root.bases[definition.bases.index(base)]))
                if inherited:
                    edits.append(self._in_place(element, inherited))
                continue
            for each in _declared_in(definition, element):
                if each.redeclares:
                    edits += self._redeclaring(each, element)
                if self._new_name(each) != each.name:
                    raise CannotError(each.name)
        return edits

    def _long_for_short(self, definition: ClassDefinition) -> Edit:
        inherited = "; ".join(self._elements_of(self._root.bases[0]))
        prefix = "partial " if definition.is_partial else ""
        text = f"{prefix}package {definition.name} {inherited}; end {definition.name}"
        return self._in_place(definition.extent, text)

    def _in_place(self, extent: Extent, text: str) -> Edit:
        """The text with as many line breaks as there were."""
        return Edit(extent.start, extent.end, text + "\n" * self._library.text(extent).count("\n"))

    # --- elements ---

    def _elements_of(self, base: ClassInstance) -> Iterator[str]:
        """Those of a base class and of what it extends."""
        definition = base.definition
        if definition.kind != "package" or definition.folder is not None or definition.behaviour:
            raise CannotError(definition.name)
        if definition.is_short:
            yield from self._elements_of(base.bases[0])
        for extent in definition.elements:
            if extent in self._done or self._library.tokens(extent)[0].text == "import":
                continue
            extended = _base_in(definition, extent)
            if extended is not None:
                yield from self._elements_of(base.bases[definition.bases.index(extended)])
                continue
            self._done.add(extent)
            for element in _declared_in(definition, extent):
                modifiers = self._modifiers(base, element)
                if modifiers is None or self._is_replaced(element):
                    continue
                if isinstance(element, ClassDefinition):
                    yield in_one_line(self._class(base, element, extent, modifiers))
                else:
                    yield in_one_line(self._component(base, element, extent, modifiers))

    def _modifiers(self, base: ClassInstance, element: _Declared) -> Modifiers | None:
        """What modifies an element, but for elements that redeclare it; ``None`` if it is removed."""
        own = self._versions[element.name]
        modifiers = [
            (item, layer) for item, layer in base.modifiers_of(element.name) if not _is_one_of(item.redeclared, own)
        ]
        return None if any(item.removes for item, _ in modifiers) else modifiers

    def _is_replaced(self, element: _Declared) -> bool:
        """= true, if a redeclaration stands for it that does not extend it."""
        versions = self._versions[element.name]
        number = versions.index(element)
        if any(not each.redeclares for each in versions[1:]):
            raise CannotError(element.name)
        following = versions[number + 1 : number + 2]
        if following and _constrains(element):
            raise CannotError(element.name)
        return any(not (isinstance(each, ClassDefinition) and each.extends_inherited) for each in following)

    def _new_name(self, element: _Declared) -> str:
        """That of what a redeclaration extends; of all else its own one."""
        versions = self._versions[element.name]
        number = versions.index(element)
        return element.name if number == len(versions) - 1 else f"{element.name}_inherited{number + 1}"

    # --- classes ---

    def _class(self, base: ClassInstance, definition: ClassDefinition, extent: Extent, modifiers: Modifiers) -> str:
        replacement = next((item.redeclared for item, _ in modifiers if item.redeclared is not None), None)
        if replacement is not None:
            return self._replaced(definition, extent, modifiers)
        edits = list(self._names.edits(extent, base, (definition,)))
        if modifiers and not definition.is_short:
            raise CannotError(definition.name)
        if modifiers:
            (short,) = definition.bases or (None,)
            if short is None:
                raise CannotError(definition.name)
            edits = self._with(edits, self._modified.of_type(short.extent, short.arguments, modifiers))
        if definition.redeclares:
            edits += self._redeclaring(definition, extent)
        edits += self._renamed(definition)
        return edited(self._library, extent, edits)

    def _replaced(self, definition: ClassDefinition, extent: Extent, modifiers: Modifiers) -> str:
        """The class by which a modifier replaces one."""
        item, layer = modifiers[0]
        element = item.redeclared
        if not isinstance(element, ClassDefinition) or len(self._versions[definition.name]) > 1:
            raise CannotError(definition.name)
        if _constrains(definition):
            raise CannotError(definition.name)
        head = "replaceable " if self._library.tokens(extent)[0].text == "replaceable" else ""
        return head + edited(self._library, element.extent, self._names.edits(element.extent, layer.scope, (element,)))

    def _renamed(self, definition: ClassDefinition) -> Iterator[Edit]:
        name = self._new_name(definition)
        if name == definition.name:
            return
        if definition.is_short or definition.c_name is not None:
            raise CannotError(definition.name)
        tokens = self._library.tokens(definition.extent)
        for token in (next(each for each in tokens if each.text == definition.name), tokens[-1]):
            yield Edit(definition.extent.start + token.start, definition.extent.start + token.end, name)

    def _redeclaring(self, element: _Declared, extent: Extent) -> Iterator[Edit]:
        """A redeclaration as a declaration."""
        tokens = self._library.tokens(extent)
        prefix = next((token for token in tokens[:3] if token.text == "redeclare"), None)
        if prefix is not None:
            yield Edit(extent.start + prefix.start, extent.start + prefix.end, "")
        versions = self._versions[element.name]
        number = versions.index(element)
        if number == 0:  # what it redeclares is not written out
            raise CannotError(element.name)
        before = versions[number - 1]
        if isinstance(element, ComponentDeclaration):
            if element.value is None and isinstance(before, ComponentDeclaration) and before.value is not None:
                raise CannotError(element.name)
        elif element.extends_inherited:
            yield from self._extending(element, self._new_name(before))

    def _extending(self, definition: ClassDefinition, name: str) -> Iterator[Edit]:
        """``function extends f(a = 1)`` as ``function f extends f_inherited1(a = 1);``."""
        start = definition.extent.start
        tokens = self._library.tokens(definition.extent)
        at = next(number for number, token in enumerate(tokens) if token.text == "extends")
        yield Edit(start + tokens[at].start, start + tokens[at].end, "")
        behind = start + tokens[at + 1].end
        arguments = definition.bases[0].arguments
        end = behind
        text = ""
        if arguments:
            opened = tokens[at + 2]
            end = next(start + each.end for each in tokens if start + each.start >= arguments[-1].extent.end)
            text = self._library.text(Extent(definition.extent.file, start + opened.start, end))
        yield Edit(behind, end, f" extends {name}{text};")

    # --- components ---

    def _component(
        self, base: ClassInstance, declared: ComponentDeclaration, extent: Extent, modifiers: Modifiers
    ) -> str:
        if any(item.redeclared is not None for item, _ in modifiers):
            raise CannotError(declared.name)
        first = min(each.extent.start for each in _declared_in(base.definition, extent))
        head = replace(extent, end=first)
        edits = list(self._names.edits(head, base))
        if declared.redeclares:
            edits += self._redeclaring(declared, extent)
        named = list(self._names.edits(declared.extent, base, (declared,)))
        named = self._with(named, self._modified.of_component(declared, modifiers))
        return edited(self._library, head, edits) + edited(self._library, declared.extent, named)

    @staticmethod
    def _with(names: Sequence[Edit], modified: Iterator[Edit]) -> list[Edit]:
        """Edits of names that are not replaced, and of what is modified."""
        edits = list(modified)
        kept = [each for each in names if not any(edit.start <= each.start < edit.end for edit in edits)]
        return kept + edits


def _elements(definition: ClassDefinition) -> Iterator[_Declared]:
    yield from definition.components.values()
    yield from definition.classes.values()


def _is_one_of(element: _Declared | None, elements: Sequence[_Declared]) -> bool:
    return any(element is each for each in elements)


def _constrains(element: _Declared) -> bool:
    """= true, if modifiers of a declaration hold for what redeclares it, too."""
    if element.constraint is not None:
        return bool(element.constraint.arguments)
    if isinstance(element, ComponentDeclaration):
        return bool(element.arguments)
    return element.is_short and any(base.arguments for base in element.bases)


def _base_in(definition: ClassDefinition, extent: Extent) -> Base | None:
    return next((base for base in definition.bases if lies_in(base.extent, extent)), None)


def _declared_in(definition: ClassDefinition, extent: Extent) -> list[_Declared]:
    classes = [each for each in definition.classes.values() if lies_in(each.extent, extent)]
    return [*classes, *(each for each in definition.components.values() if lies_in(each.extent, extent))]
