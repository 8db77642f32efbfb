"""What the front end is given of a model whose packages are written out."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from contact_foundation.errors import Place, UnsupportedModelError

from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.class_syntax import Extent
from modelica2fmu.crosscheck.package_constants import has_mixed_constants, mixed_constants
from modelica2fmu.frontend.library_names import about_a_copy
from modelica2fmu.frontend.rewriting.package_view import package_with
from modelica2fmu.frontend.rewriting.packages.called_names import ambiguous_constructor
from modelica2fmu.frontend.rewriting.packages.written_packages import packages_written_out
from modelica2fmu.frontend.runner import Request
from modelica2fmu.library.source_map import SourceMap


@dataclass(frozen=True)
class Sources:
    """What the front end gets.

    Attributes:
        request: about the model.
        file: that holds the model.
        roots: the libraries.
        library: the same for the second reading.
        texts: other texts of files that it gets, by the user's file.
    """

    request: Request
    file: Path
    roots: tuple[Path, ...]
    library: ClassLibrary
    texts: Mapping[Path, str] = field(default_factory=dict)


def mixed_up(given: Sources, place_of: Callable[[Extent], Place]) -> UnsupportedModelError | None:
    """The refusal of what the front end mixes up without a word.

    Args:
        given: the sources.
        place_of: the place of a range of a file.
    """
    model = given.request.model
    found = ambiguous_constructor(model, given.library)
    if found is None:
        return mixed_constants(model, given.library, place_of)
    name, extent = found
    return UnsupportedModelError(
        f"several classes have a record {name}, and the front end takes the fields of one of them for all",
        place=replace(place_of(extent), component=model),
        remedy=f"call its constructor by a name with dots, as in Package.{name}(1), or give them different names",
    )


def written_sources(given: Sources, file: Path, folder: Path, source_map: SourceMap) -> Iterator[Sources]:
    """The same with packages written out that extend others with modifiers, then with constraining clauses, too.

    What does not help is left out.

    Args:
        given: the sources as they are.
        file: the user's file that holds the model.
        folder: an empty one.
        source_map: is told what the front end gets.
    """
    if given.library.own is None:
        return
    before: dict[Path, str] = {}
    for with_clauses in (False, True):
        model = given.request.model
        texts = packages_written_out(model, given.library, with_clauses=with_clauses)
        written = given.library.with_texts(texts)
        if texts == before or has_mixed_constants(model, written) or ambiguous_constructor(model, written):
            continue
        before = texts
        own = texts if given.request.text is None else {file: texts[given.file]}
        yield with_texts(given, own, folder / str(with_clauses), source_map)


def with_texts(given: Sources, texts: Mapping[Path, str], folder: Path, source_map: SourceMap) -> Sources:
    """The same with other texts of the user's files.

    Args:
        given: the sources as they are.
        texts: by file, that of the model's file if it is a single one.
        folder: an empty one.
        source_map: is told what the front end gets.
    """
    if given.request.text is None:
        return _of_package(given, texts, folder, source_map)
    ((file, text),) = texts.items()
    return _of_file(given, file, text, source_map)


def _of_file(given: Sources, file: Path, text: str, source_map: SourceMap) -> Sources:
    before = source_map.text(file).decode("utf-8", errors="replace")
    source_map.add_text(file, text)
    asked = replace(given.request, text=text + (given.request.text or "").removeprefix(before))
    return Sources(asked, given.file, given.roots, given.library.with_texts({given.file: text}), {file: text})


def _of_package(given: Sources, texts: Mapping[Path, str], folder: Path, source_map: SourceMap) -> Sources:
    view = package_with(texts, given.file.parent, folder)
    view.register(source_map)
    about = about_a_copy(given.request, view.package, view.root)
    roots = tuple(map(Path, about.roots))
    return Sources(about, view.file, roots, ClassLibrary(view.file, source_map.text(given.file), roots), texts)
