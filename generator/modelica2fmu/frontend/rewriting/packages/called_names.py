"""Functions and records of the same name in several packages, called by their full names.

rumoca 0.10 takes one of those that are called by their names alone for all of them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Final, NamedTuple

from modelica2fmu.crosscheck.class_instances import ClassInstance, UnknownError
from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.class_syntax import ClassDefinition, Extent
from modelica2fmu.crosscheck.class_tokens import UnreadableError
from modelica2fmu.crosscheck.own_classes import model_class
from modelica2fmu.frontend.rewriting.packages.changed_packages import changes_what_it_inherits
from modelica2fmu.frontend.rewriting.packages.name_references import declared_names, places_of_names, references
from modelica2fmu.frontend.rewriting.packages.text_edits import CannotError, Edit, full_name

_CALLED: Final = frozenset({"function", "record"})
_RECORD: Final = re.compile(rb"\brecord\s+(\w+)\b(?!\s*;)")


class _Call(NamedTuple):
    """A name that is called: what it means, the range of the name, and the full name if there is one."""

    name: str
    declared: Extent
    place: Extent
    full: str | None


def calls_in_full(library: ClassLibrary, top: ClassInstance) -> dict[Path, list[Edit]]:
    """Edits by file; none where a name means the same everywhere.

    Args:
        library: the sources.
        top: a class with all in it.
    """
    edits: dict[Path, list[Edit]] = {}
    for call in _ambiguous_calls(library, top, _CALLED):
        if call.full is not None:
            edits.setdefault(call.place.file, []).append(Edit(call.place.start, call.place.end, call.full))
    return edits


def ambiguous_constructor(model: str, library: ClassLibrary) -> tuple[str, Extent] | None:
    """The name and the place of a call of a record's constructor whose name another record has, too.

    Args:
        model: full name.
        library: the sources.
    """
    records = _RECORD.findall(library.own_text)
    if len(set(records)) == len(records):
        return None
    top = model_class(model.split(".")[0], library)
    calls = [] if top is None else _ambiguous_calls(library, top, frozenset({"record"}))
    return next(((each.name, each.place) for each in calls), None)


def _ambiguous_calls(library: ClassLibrary, top: ClassInstance, kinds: frozenset[str]) -> list[_Call]:
    several = {name for name, found in _declared(top.definition, kinds, {}).items() if len(found) > 1}
    if not several:
        return []
    extended = set(_extended(top))
    calls = [each for scope in _scopes(top) for each in _calls(library, scope, several, extended)]
    meant: dict[str, set[Extent]] = {}
    for call in calls:
        meant.setdefault(call.name, set()).add(call.declared)
    return [call for call in calls if len(meant[call.name]) > 1]


def _declared(
    definition: ClassDefinition, kinds: frozenset[str], found: dict[str, set[Extent]]
) -> dict[str, set[Extent]]:
    """Where functions and records are declared, by their names."""
    for each in definition.classes.values():
        if each.kind in kinds:
            found.setdefault(each.name, set()).add(each.extent)
        _declared(each, kinds, found)
    return found


def _scopes(around: ClassInstance) -> Iterator[ClassInstance]:
    """A class and those in it that have names of their own."""
    if not around.definition.is_short:
        yield around
        for each in list(around.definition.classes.values()):
            yield from _scopes(around.declared(each))


def _extended(top: ClassInstance) -> Iterator[Extent]:
    """The packages that others extend with modifiers: what is declared in them may mean something else there."""
    for scope in _scopes(top):
        for each in (scope, *(scope.declared(short) for short in scope.definition.classes.values() if short.is_short)):
            if each.definition.kind != "package" or not changes_what_it_inherits(each.definition):
                continue
            try:
                yield from (base.definition.extent for base in each.bases)
            except (UnknownError, UnreadableError, RecursionError):
                continue


def _calls(library: ClassLibrary, scope: ClassInstance, names: set[str], extended: set[Extent]) -> Iterator[_Call]:
    """The calls in a class, but for those in classes within it."""
    definition = scope.definition
    start = definition.extent.start
    tokens = library.tokens(definition.extent)
    within = [each.extent for each in definition.classes.values() if not each.is_short]
    opened = {token.start for token, following in pairwise(tokens) if following.text == "("}
    declared = places_of_names(tokens, (place - start for place in declared_names((definition,))))
    for name, first, end in references(tokens, declared):
        place = Extent(definition.extent.file, start + first, start + end)
        if name not in names or first not in opened or any(each.holds(place.file, place.start) for each in within):
            continue
        try:
            found = scope.lookup((name,))
        except (UnknownError, UnreadableError, RecursionError):
            continue
        if found.definition.kind in _CALLED:
            yield _Call(name, found.definition.extent, place, _full(found, extended))


def _full(found: ClassInstance, extended: set[Extent]) -> str | None:
    each = found.parent
    while each is not None:
        if each.definition.extent in extended:
            return None
        each = each.parent
    if found.definition.is_replaceable:
        return None
    try:
        return full_name(found)
    except CannotError:
        return None
