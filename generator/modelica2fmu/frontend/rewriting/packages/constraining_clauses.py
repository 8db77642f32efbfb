"""Modifiers of constraining clauses, repeated in the declaration.

They hold for the declaration as well (Modelica 3.6, 7.3.2), where rumoca 0.10 leaves them out.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.class_syntax import ClassDefinition, ComponentDeclaration, Constraint, Extent, Modifier
from modelica2fmu.frontend.rewriting.packages.text_edits import Edit


def clauses_repeated(library: ClassLibrary, definition: ClassDefinition) -> dict[Path, list[Edit]]:
    """Edits by file: in a class and in those within it."""
    edits: dict[Path, list[Edit]] = {}
    for each in _classes(definition):
        elements: list[ClassDefinition | ComponentDeclaration] = [*each.components.values(), *each.classes.values()]
        for declared in elements:
            if declared.constraint is not None and declared.constraint.arguments:
                found = _repeated(library, declared, declared.constraint)
                edits.setdefault(declared.extent.file, []).extend(found)
    return {file: found for file, found in edits.items() if found}


def _classes(definition: ClassDefinition) -> Iterator[ClassDefinition]:
    yield definition
    for each in definition.classes.values():
        yield from _classes(each)


def _repeated(
    library: ClassLibrary, declared: ClassDefinition | ComponentDeclaration, constraint: Constraint
) -> Iterator[Edit]:
    given: tuple[Modifier, ...]
    if isinstance(declared, ComponentDeclaration):
        given = declared.arguments
        end = declared.extent.end if declared.value is None else None
    elif declared.is_short and declared.bases:
        given = declared.bases[0].arguments
        end = declared.bases[0].extent.end
    else:
        return
    known = {argument.path[0] for argument in given}
    missing = [argument for argument in constraint.arguments if argument.path[0] not in known]
    if not missing:
        return
    text = ", ".join(library.text(argument.extent) for argument in missing)
    if given:
        yield Edit(given[-1].extent.end, given[-1].extent.end, f", {text}")
        return
    place = end if end is not None else _before_value(library, declared.extent)
    yield Edit(place, place, f"({text})")


def _before_value(library: ClassLibrary, extent: Extent) -> int:
    """Behind the name of a component without arguments, and its subscripts."""
    depth = 0
    for token in library.tokens(extent):
        depth += (token.text in "([{") - (token.text in ")]}")
        if token.text in ("=", ":=") and not depth:
            return extent.start + token.start
    return extent.end
