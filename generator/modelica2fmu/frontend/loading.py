"""Loads a model with rumoca, the front end."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any, Final

from contact_foundation.errors import CmbError, InputError, Place, UnsupportedModelError
from contact_foundation.scratch import scratch_folder

from modelica2fmu.crosscheck.cardinality import check_counted_arrays, drop_miscounted_assertions
from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.class_syntax import Extent
from modelica2fmu.crosscheck.collider_order import misplaced_row
from modelica2fmu.crosscheck.component_sizes import check_component_sizes
from modelica2fmu.crosscheck.connections.connect_check import check_connect_sizes, check_connects
from modelica2fmu.crosscheck.constructor_check import check_constructors
from modelica2fmu.crosscheck.flattened.flat_check import (
    added_components,
    check_flat_model,
    copies_of_inner,
    unused_members,
)
from modelica2fmu.crosscheck.flattened.flat_reading import FlatReading, spans
from modelica2fmu.crosscheck.function_names import check_function_names
from modelica2fmu.crosscheck.modifier_check import check_modifiers
from modelica2fmu.crosscheck.number_check import check_numbers
from modelica2fmu.crosscheck.outer_class_check import check_outer_elements
from modelica2fmu.crosscheck.own_classes import model_class
from modelica2fmu.crosscheck.record_operators import check_record_operators
from modelica2fmu.frontend import ir
from modelica2fmu.frontend.balance import (
    frames_without_connect,
    is_unbalanced,
    lacks_equations,
    loose_component,
    unbalanced_form,
    unplaced_frames,
    world_without_inner,
)
from modelica2fmu.frontend.control_flow import with_control_flow
from modelica2fmu.frontend.culprit import culprit
from modelica2fmu.frontend.errors import (
    FrontEndError,
    front_end_error,
    in_plain_words,
    is_vague,
    loose_error,
    misplaced_error,
    not_inner_error,
    piece_error,
    unconnected_error,
)
from modelica2fmu.frontend.flat_reader import read_flat_model
from modelica2fmu.frontend.library_names import about_a_copy, naming, packages
from modelica2fmu.frontend.lone_files import LoneFiles, apart
from modelica2fmu.frontend.remedies import with_remedy
from modelica2fmu.frontend.rewriting.concatenation import with_arrays_written_out
from modelica2fmu.frontend.rewriting.inherited_classes import imports_of_packages, with_imports
from modelica2fmu.frontend.rewriting.package_view import package_view
from modelica2fmu.frontend.runner import Answer, Request, ask
from modelica2fmu.frontend.straight_sources import StraightSources
from modelica2fmu.frontend.syntax import syntax_error
from modelica2fmu.frontend.written_sources import Sources, mixed_up, written_sources
from modelica2fmu.library.source_map import SourceMap, Span, source_number

# rumoca's words where a class is not found, as those of a library that the package's own file does not name.
_UNRESOLVED: Final = re.compile(r"\bunresolved\b")
# The same and where a base class is not found, as one that a package inherits.
_NOT_FOUND: Final = re.compile(r"\bunresolved\b|base class not found")
# Where connected arrays have different sizes.
_SIZES_DIFFER: Final = "array dimension mismatch for `connect`"
# Of what may be written out or not: loops over what is no range, and tables in files.
_CURABLE: Final = ("for-equation range", "(tableOnFile) is unsupported")

# Where it cannot evaluate a function that a size depends on.
_UNKNOWN_SIZE: Final = "unevaluable array dimensions"

FileFinder = Callable[[str], Path]
# Of what it takes only when it is written out: concatenations, whose type is that of the dimension, and loops.
_WRITTEN_OUT_TAKEN: Final = re.compile(
    r"type mismatch: expected `?[\w.]+`?, found `?Integer|comprehension index requires an explicit range"
    r"|requires a compact dependent-domain transition|declarative algorithm requires scalar assignments"
)


@dataclass(frozen=True)
class _Loaded:
    """What the front end answered, and about what.

    Attributes:
        answer: about the model.
        request: that it answers.
        file: that holds it, as the front end got it.
        roots: as the front end got them.
    """

    answer: Answer
    request: Request
    file: Path
    roots: tuple[Path, ...]


def load_flat_model(
    model: str,
    file: Path,
    roots: Sequence[Path],
    source_map: SourceMap,
    remark: Callable[[str], None],
    find_file: FileFinder,
) -> ir.FlatModel:
    """Compiles ``model`` and returns its flattened form.

    Args:
        model: full Modelica name.
        file: the file that holds it; of the files beside it only those of its package structure are loaded.
        roots: library folders (those that contain packages) and single files that it uses.
        source_map: for the places in error messages.
        remark: told what the user should know of.
        find_file: the file that a name in the model means.

    Raises:
        InputError: the model does not parse or compile.
        UnsupportedModelError: it uses something that has no place in the typed form, or that the front end leaves out.
        BuildError: rumoca is not installed.
    """
    # With a package and the folder around it among the roots, rumoca would see only the package.
    resolved = {root.resolve() for root in roots}
    roots = [root for root in roots if root.resolve().parent not in resolved]
    with apart(file, roots, source_map) as given, scratch_folder("packages") as folder:
        text = source_map.text(file)
        library = ClassLibrary(given.file, text, given.roots)
        check_numbers(text, given.file, _places(source_map))
        missing = _check_own_text(model, source_map, library)
        sources = Sources(_request(model, file, given), given.file, given.roots, library)
        load = partial(
            _load, model, file, given, missing=missing, source_map=source_map, remark=remark, find_file=find_file
        )
        refusal = mixed_up(sources, _places(source_map))
        flat = _load_or_refuse(load, sources, source_map) if refusal is None else refusal
        if isinstance(flat, ir.FlatModel):
            return flat
        for written in written_sources(sources, file, folder, source_map):
            other = _load_or_refuse(load, written, source_map)
            if isinstance(other, ir.FlatModel):
                return other
        straight = StraightSources(sources, file, folder, source_map)
        last: CmbError = flat
        while (without := straight.after(str(last.__cause__))) is not None:
            other = _load_or_refuse(load, without, source_map)
            if isinstance(other, ir.FlatModel):
                return other
            last = other
        if refusal is not None:  # what else is wrong comes first
            load(sources)
        # What is not the front end's own goes for the functions as they are, too, and says more; so do sizes.
        says_more = not isinstance(last.__cause__, FrontEndError) or _UNKNOWN_SIZE in str(last.__cause__)
        raise last if says_more else flat


def _load_or_refuse(
    load: Callable[[Sources], ir.FlatModel], sources: Sources, source_map: SourceMap
) -> ir.FlatModel | CmbError:
    """The model or its refusal, after which the front end may be given other texts."""
    try:
        return load(sources)
    except (InputError, UnsupportedModelError) as refusal:
        source_map.forget_texts()
        return refusal


def _load(
    model: str,
    file: Path,
    given: LoneFiles,
    sources: Sources,
    *,
    missing: InputError | None,
    source_map: SourceMap,
    remark: Callable[[str], None],
    find_file: FileFinder,
) -> ir.FlatModel:
    """The flattened form of a model.

    Args:
        model: full name.
        file: that holds it.
        given: what stands for it and for other single files.
        sources: what the front end gets.
        missing: the error of a class that is not found.
        source_map: for places.
        remark: told what the user should know of.
        find_file: the file that a name in the model means.

    Raises:
        InputError: the model does not parse or compile.
        UnsupportedModelError: it is not flattened rightly.
    """
    request, library, text = sources.request, sources.library, source_map.text(file)
    with scratch_folder("package") as folder:
        loaded = _Loaded(ask(request, remark), request, sources.file, sources.roots)
        if loaded.answer.flat is None and request.text is None:
            loaded = _with_package_written_out(loaded, library, folder, source_map, remark, find_file)
        elif loaded.answer.flat is None:
            loaded = _with_text_written_out(loaded, library, file, source_map, remark, find_file)
        answer = loaded.answer
        if answer.flat is None:
            words = replace(
                answer,
                error=given.restored(answer.error),
                diagnostics=tuple(given.restored(each) for each in answer.diagnostics),
            )
            found = model_class(model, library) if request.text is None else None
            holder = file if found is None else Path(found.definition.extent.file)
            unbalanced = _unbalanced(answer.error, loaded.request, holder, source_map.text(holder), remark)
            unread = syntax_error(words, model)
            refusal = unread or missing or front_end_error(words, model, file, library)
            about = request if request.text is None else loaded.request  # a package stays one of files
            vague = unread is None and missing is None and is_vague(refusal)
            piece = culprit(answer.error, about, given.file, source_map.text(file)) if vague else None
            if piece is not None:
                place = replace(_places(source_map)(piece.extent), component=model)
                refusal = piece_error(piece, place)
            refusal = with_remedy(in_plain_words(refusal), holder)
            if unbalanced is not None:
                check_connect_sizes(model, unbalanced["variables"], library, _places(source_map))
                return replace(read_flat_model(unbalanced, model, source_map), refusal=refusal)
            raise refusal from FrontEndError(words.error)
        if loaded.file != sources.file or source_map.text(file) != text:  # arrays were written out
            library = ClassLibrary(loaded.file, source_map.text(file), loaded.roots)
        _check(answer.flat, model, source_map, library)
        check_connect_sizes(model, answer.flat["variables"], library, _places(source_map))
        misplaced = misplaced_row(answer.flat)
        if misplaced is not None:
            raise misplaced_error(misplaced, model, file)
        warnings = tuple(
            f"no component {name} is declared as inner, so one with its default values is added: declare it in {model}"
            for name in added_components(answer.flat, model, library)
        )
        for name in (*copies_of_inner(answer.flat, model, library), *unused_members(answer.flat)):
            del answer.flat["variables"][name]
        read = read_flat_model(answer.flat, model, source_map)
        flat = with_control_flow(read, source_map.place)
        return replace(flat, warnings=warnings)


def _unbalanced(
    error: str, request: Request, file: Path, written: bytes, remark: Callable[[str], None]
) -> dict[str, Any] | None:
    """The flattened form of a model that has more or fewer equations than unknowns; None if there is none.

    ``file`` holds the model, ``written`` is its text.

    Raises:
        InputError: connections, or their lack, or a world that is not ``inner`` are why.
    """
    loose = loose_component(error)
    if loose is not None:
        raise loose_error(loose, request.model, file)
    form = unbalanced_form(request) if is_unbalanced(error) else None
    if form is None:
        return None
    flat = ask(form, remark).flat
    text = written.decode("utf-8", errors="replace")
    world = world_without_inner(text)
    if world is not None:
        raise not_inner_error(world, request.model, file)
    frames = frames_without_connect(text) if flat is None else unplaced_frames(flat)
    if frames and lacks_equations(error):
        raise unconnected_error(frames, request.model, file)
    return flat


def _with_text_written_out(
    loaded: _Loaded,
    library: ClassLibrary,
    file: Path,
    source_map: SourceMap,
    remark: Callable[[str], None],
    find_file: FileFinder,
) -> _Loaded:
    """The same about the model with arrays written out and packages named.

    The error as it was where that tells nothing else.
    """
    request, answer = loaded.request, loaded.answer
    if request.text is None:
        return loaded
    imports = imports_of_packages(request.model, library, loaded.file)
    written = with_arrays_written_out(request.model, [with_imports(request.text, imports.get(loaded.file))], find_file)
    (text,) = written.texts
    if text == request.text:
        return loaded
    about = replace(request, text=text)
    other = ask(about, remark)
    if other.flat is None:
        is_taken = _WRITTEN_OUT_TAKEN.search(answer.error) is not None or _is_cured(answer, other)
        is_found = loaded.file in imports and _NOT_FOUND.search(answer.error) is not None
        tells_more = _SIZES_DIFFER in other.error or is_taken or is_found
    else:
        tells_more = written.numbers.hold_in(other.flat)
    if not tells_more:
        return loaded
    source_map.add_text(file, text)
    return replace(loaded, answer=other, request=about)


def _is_cured(answer: Answer, other: Answer) -> bool:
    """= true, if what was written out is not refused any more, but something else."""
    return any(words in answer.error and words not in other.error for words in _CURABLE)


def _check_own_text(model: str, source_map: SourceMap, library: ClassLibrary) -> InputError | None:
    """The error of a class that is not found.

    Raises:
        InputError: the user modifies or names what is not there, connects connectors of different kinds, or declares
            an outer class or variable.
    """
    own = library.own
    if own is None:
        return None
    missing = check_modifiers(model, library, own, _places(source_map))
    check_constructors(model, library, own, _places(source_map))
    check_outer_elements(model, library, own, _places(source_map))
    check_connects(model, library, own, _places(source_map))
    check_component_sizes(model, library, own, _places(source_map))
    check_record_operators(model, library, own, _places(source_map))
    check_counted_arrays(model, library, own, _places(source_map))
    return missing


def _places(source_map: SourceMap) -> Callable[[Extent], Place]:
    return lambda extent: source_map.place(Span(source_number(str(extent.file)), extent.start, extent.end))


def _with_package_written_out(
    loaded: _Loaded,
    library: ClassLibrary,
    folder: Path,
    source_map: SourceMap,
    remark: Callable[[str], None],
    find_file: FileFinder,
) -> _Loaded:
    """The same about a package's model with arrays written out, and packages and libraries named that nothing names.

    Where that does not help the error stays as it was, but for that of a library that is not named. One of a model that
    is not balanced is asked for in this form, too: classes can be added to it that say why.
    """
    package = loaded.file.parent
    imports = imports_of_packages(loaded.request.model, library, package)
    view = package_view(loaded.request.model, package, imports, folder, find_file)
    error = loaded.answer.error
    is_told_here = _UNRESOLVED.search(error) is not None or is_unbalanced(error)
    if not (view.texts or is_told_here):
        return loaded
    about = about_a_copy(loaded.request, view.package, view.root)
    other = ask(about, remark)
    if other.flat is None:
        if not (is_told_here or is_unbalanced(other.error) or _is_cured(loaded.answer, other)):
            return loaded
        view.register(source_map)
        return replace(loaded, answer=replace(other, error=view.restored(other.error)), request=about)
    if not view.numbers.hold_in(other.flat):
        return loaded
    view.register(source_map)
    return _Loaded(other, about, view.file, tuple(map(Path, about.roots)))


def _check(flat: dict[str, Any], model: str, source_map: SourceMap, library: ClassLibrary) -> None:
    """Restores what can be; raises UnsupportedModelError if the front end left out anything else."""
    reading = FlatReading(library, _places(source_map))
    corrections = check_flat_model(flat, model, reading)
    variables = flat["variables"]
    for name in corrections.fixed:
        variables[name]["fixed"] = [True]
    for name, owner in corrections.values.references.items():
        place = next(spans(variables[name]["binding"]), None)
        meant = {"name": owner, "component_ref": variables[owner]["component_ref"]}
        variables[name]["binding"] = {"VarRef": {"name": meant, "subscripts": [], "span": place}}
    for name in corrections.values.constants:
        variables[name]["evaluate"] = True
    check_function_names(flat, model, reading)
    drop_miscounted_assertions(flat, reading)


def _request(model: str, file: Path, given: LoneFiles) -> Request:
    """What loads ``file`` and compiles ``model``.

    rumoca loads only libraries that the loaded text names, not those that they name in turn. A model in a file of its
    own that names any is therefore followed by a class that names them all; places in the text stay as they are. A
    model of a library among the roots needs that class alone.
    """
    roots = given.roots
    names = tuple(str(root) for root in roots)
    is_package = file.name == "package.mo"
    is_library = is_package and file.parent.parent.resolve() in {root.resolve() for root in roots}
    if is_package and not is_library:
        return Request(names, model, str(file), None, str(file))
    try:
        text = "" if is_library else file.read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        raise InputError(f"is not in UTF-8: {error.reason}", place=Place(file=file)) from error
    libraries = packages(roots)
    beside = (original.read_text(encoding="utf-8", errors="replace") for _, original in given.names)
    if not is_library and not _name_any((text, *beside), libraries):
        libraries = []  # to load them takes longer than all else of a small model
    return Request(
        names, model, "libraries.mo" if is_library else str(given.file), f"{text}\n{naming(libraries)}", str(file)
    )


def _name_any(texts: Iterable[str], names: Sequence[str]) -> bool:
    """Whether a text has one of the names, be it in a comment."""
    named = re.compile("|".join(rf"\b{re.escape(name)}\b" for name in names) or "(?!)")
    return any(named.search(text) is not None for text in texts)
