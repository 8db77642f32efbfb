"""Declarations with the modifiers that hold for them where a package inherits them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from modelica2fmu.crosscheck.class_instances import ClassInstance, Layer, Modifiers
from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.class_syntax import ComponentDeclaration, Extent, Modifier
from modelica2fmu.frontend.rewriting.packages.full_names import FullNames
from modelica2fmu.frontend.rewriting.packages.text_edits import CannotError, Edit, edited


class ModifiedText:
    """Writes modifiers into what they modify.

    Args:
        library: the sources.
        names: as they are written in the package.
    """

    def __init__(self, library: ClassLibrary, names: FullNames) -> None:
        self._library = library
        self._names = names

    def of_component(self, declared: ComponentDeclaration, modifiers: Modifiers) -> Iterator[Edit]:
        """The value and the arguments of a component; the modifier that wins comes first."""
        values = [(item.value, layer.scope) for item, layer in modifiers if item.value is not None]
        value = f" = {self._text(*values[0])}" if values else ""
        arguments = self._arguments(declared.arguments, modifiers)
        if isinstance(arguments, str):
            at = self._behind_name(declared)
            if declared.value is None:
                yield Edit(at, at, f"{arguments}{value}")
                return
            if arguments:
                yield Edit(at, at, arguments)
        else:
            yield from arguments
            if declared.value is None:
                yield Edit(declared.extent.end, declared.extent.end, value)
                return
        if value:
            yield Edit(self._equals_sign(declared), declared.value.end, value)

    def of_type(self, written: Extent, arguments: tuple[Modifier, ...], modifiers: Modifiers) -> Iterator[Edit]:
        """The arguments of the class that a short one stands for.

        Args:
            written: the class and its arguments.
            arguments: these.
            modifiers: that hold for it.
        """
        if any(item.value is not None for item, _ in modifiers):
            raise CannotError
        found = self._arguments(arguments, modifiers)
        if not isinstance(found, str):
            yield from found
        elif found:
            yield Edit(written.end, written.end, found)

    def _arguments(self, declared: tuple[Modifier, ...], modifiers: Modifiers) -> str | list[Edit]:
        """Edits of arguments that there are, or all of them with their parentheses where there are none."""
        given: dict[str, tuple[Modifier, Layer]] = {}
        for item, layer in modifiers:
            for argument in item.arguments:
                if len(argument.path) > 1 or argument.path[0] in given:
                    raise CannotError
                given[argument.path[0]] = argument, layer
        texts = {name: self._text(item.extent, layer.scope, (item,)) for name, (item, layer) in given.items()}
        if not declared:
            return f"({', '.join(texts.values())})" if texts else ""
        edits = []
        for argument in declared:
            if argument.path[0] not in texts:
                continue
            winner, _ = given[argument.path[0]]
            if len(argument.path) > 1 or argument.arguments or winner.arguments or winner.redeclared:
                raise CannotError
            edits.append(Edit(argument.extent.start, argument.extent.end, texts.pop(argument.path[0])))
        if texts:
            end = declared[-1].extent.end
            edits.append(Edit(end, end, "".join(f", {text}" for text in texts.values())))
        return edits

    def _text(self, extent: Extent, scope: ClassInstance, elements: Sequence[Modifier] = ()) -> str:
        return edited(self._library, extent, self._names.edits(extent, scope, elements))

    def _behind_name(self, declared: ComponentDeclaration) -> int:
        """Where the arguments of a component without arguments would begin."""
        return declared.extent.end if declared.value is None else self._equals_sign(declared)

    def _equals_sign(self, declared: ComponentDeclaration) -> int:
        """Where what stands between a component and its value begins."""
        if declared.value is None:
            raise CannotError
        tokens = self._library.tokens(declared.extent)
        length = declared.value.start - declared.extent.start
        return declared.extent.start + max(token.start for token in tokens if token.end <= length)
