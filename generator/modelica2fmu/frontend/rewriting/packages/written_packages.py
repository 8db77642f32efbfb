"""Writes packages that extend others with modifiers out, with all that they inherit.

rumoca 0.10 knows one value of a constant, that of its declaration or of one of the packages that inherit it. Where each
package declares its own constants, and the classes that use them, it keeps them apart.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Final

from modelica2fmu.crosscheck.class_instances import ClassInstance, Names, UnknownError
from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.class_syntax import Extent
from modelica2fmu.crosscheck.class_tokens import UnreadableError
from modelica2fmu.frontend.rewriting.packages.called_names import calls_in_full
from modelica2fmu.frontend.rewriting.packages.changed_packages import changes_what_it_inherits
from modelica2fmu.frontend.rewriting.packages.chosen_packages import ChosenPackages
from modelica2fmu.frontend.rewriting.packages.constraining_clauses import clauses_repeated
from modelica2fmu.frontend.rewriting.packages.inherited_elements import InheritedElements
from modelica2fmu.frontend.rewriting.packages.text_edits import CannotError, Edit, edited

_MOST_PASSES: Final = 12
_MOST_GROWTH: Final = 2_000_000  # letters


def packages_written_out(model: str, library: ClassLibrary, *, with_clauses: bool = False) -> dict[Path, str]:
    """Other texts of the same lines, by file; none where nothing is written out.

    Args:
        model: full name.
        library: the sources.
        with_clauses: = true, if modifiers of constraining clauses are repeated, too.
    """
    texts: dict[Path, str] = {}
    for _ in range(_MOST_PASSES):
        try:
            edits = _edits(model, library, with_clauses)
        except (UnknownError, UnreadableError, RecursionError):
            break
        if not edits:
            return texts
        for file, of_file in edits.items():
            texts[file] = edited(library, library.whole(file), of_file)
        library = library.with_texts(texts)
        if sum(map(len, texts.values())) > _MOST_GROWTH:
            break
    return {}


def _edits(model: str, library: ClassLibrary, with_clauses: bool) -> dict[Path, list[Edit]]:
    edits: dict[Path, list[Edit]] = {}
    top = Names(library).find((model.split(".")[0],))
    library.read_members(top.definition)
    written: list[Extent] = []
    for package in _packages(top):
        extent = package.definition.extent
        try:
            found = InheritedElements(library, package).edits()
        except (CannotError, UnknownError, UnreadableError, RecursionError):
            continue
        if found and not any(_overlap(extent, each) for each in written):
            edits.setdefault(extent.file, []).extend(found)
            written.append(extent)
    if edits:
        return edits
    chosen = ChosenPackages(library)
    chosen.collect(top)
    others = chosen.edits or calls_in_full(library, top)
    return clauses_repeated(library, top.definition) if with_clauses and not others else others


def _overlap(first: Extent, second: Extent) -> bool:
    return first.file == second.file and first.start < second.end and second.start < first.end


def _packages(around: ClassInstance) -> Iterator[ClassInstance]:
    """The packages in a class that change what they inherit, inner ones first."""
    for definition in list(around.definition.classes.values()):
        yield from _packages(around.declared(definition))
    if around.definition.kind == "package" and changes_what_it_inherits(around.definition):
        yield around
