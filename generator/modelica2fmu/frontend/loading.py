"""Loads a model with rumoca, the front end."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

from contact_foundation.errors import InputError, Place

from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.class_syntax import Extent
from modelica2fmu.crosscheck.flat_check import added_components, check_flat_model
from modelica2fmu.crosscheck.flat_reading import FlatReading
from modelica2fmu.crosscheck.modifier_check import check_modifiers
from modelica2fmu.frontend import ir
from modelica2fmu.frontend.balance import lacks_equations, unbalanced_form, unplaced_frames
from modelica2fmu.frontend.concatenation import have_values, with_arrays_written_out
from modelica2fmu.frontend.errors import FrontEndError, front_end_error, unconnected_error
from modelica2fmu.frontend.flat_reader import read_flat_model
from modelica2fmu.frontend.lone_files import LoneFiles, apart
from modelica2fmu.frontend.runner import Answer, Request, ask
from modelica2fmu.library.source_map import SourceMap, Span, source_number

# What a folder with the Modelica Standard Library holds.
_STANDARD_PACKAGES: Final = ("Modelica", "ModelicaServices", "Complex")


def load_flat_model(
    model: str, file: Path, roots: Sequence[Path], source_map: SourceMap, remark: Callable[[str], None]
) -> ir.FlatModel:
    """Compiles ``model`` and returns its flattened form.

    Args:
        model: full Modelica name.
        file: the file that holds it; of the files beside it only those of its package structure are loaded.
        roots: library folders (those that contain packages) and single files that it uses.
        source_map: for the places in error messages.
        remark: told what the user should know of.

    Raises:
        InputError: the model does not parse or compile.
        UnsupportedModelError: it uses something that has no place in the typed form, or that the front end leaves out.
        BuildError: rumoca is not installed.
    """
    # With a package and the folder around it among the roots, rumoca would see only the package.
    resolved = {root.resolve() for root in roots}
    roots = [root for root in roots if root.resolve().parent not in resolved]
    with apart(file, roots, source_map) as given:
        request = _request(model, file, given)
        text = source_map.text(file)
        library = ClassLibrary(given.file, text, given.roots)
        missing = _check_modifiers(model, given.file, source_map, library)
        answer = ask(request, remark)
        if answer.flat is None:
            _check_connections(answer.error, request, file, remark)
            answer = _with_arrays_written_out(answer, request, file, source_map, remark)
        if answer.flat is None:
            words = replace(
                answer,
                error=given.restored(answer.error),
                diagnostics=tuple(given.restored(each) for each in answer.diagnostics),
            )
            raise missing or front_end_error(words, model, file, library) from FrontEndError(words.error)
        if source_map.text(file) != text:  # arrays were written out
            library = ClassLibrary(given.file, source_map.text(file), given.roots)
        _check(answer.flat, model, source_map, library)
        warnings = tuple(
            f"no component {name} is declared as inner, so one with its default values is added: declare it in {model}"
            for name in added_components(answer.flat, model, library)
        )
        return replace(read_flat_model(answer.flat, model, source_map), warnings=warnings)


def _check_connections(error: str, request: Request, file: Path, remark: Callable[[str], None]) -> None:
    """Raises InputError if frames that are connected to nothing are why the model lacks equations."""
    unbalanced = unbalanced_form(request) if lacks_equations(error) else None
    flat = None if unbalanced is None else ask(unbalanced, remark).flat
    frames = [] if flat is None else unplaced_frames(flat)
    if frames:
        raise unconnected_error(frames, request.model, file)


def _with_arrays_written_out(
    answer: Answer, request: Request, file: Path, source_map: SourceMap, remark: Callable[[str], None]
) -> Answer:
    """The answer about the same model with arrays written out; the error as it was where that does not help."""
    written = None if request.text is None else with_arrays_written_out(request.text)
    if written is None or written.text == request.text:
        return answer
    other = ask(replace(request, text=written.text), remark)
    if other.flat is None or not have_values(other.flat, written.numbers):
        return answer
    source_map.add_text(file, written.text)
    return other


def _check_modifiers(model: str, file: Path, source_map: SourceMap, library: ClassLibrary) -> InputError | None:
    """The error of a class that is not found; raises InputError if the user modifies what is not there."""
    own = file.parent if file.name == "package.mo" else file
    return check_modifiers(model, library, own, _places(source_map))


def _places(source_map: SourceMap) -> Callable[[Extent], Place]:
    return lambda extent: source_map.place(Span(source_number(str(extent.file)), extent.start, extent.end))


def _check(flat: dict[str, Any], model: str, source_map: SourceMap, library: ClassLibrary) -> None:
    """Restores what is fixed; raises UnsupportedModelError if the front end left out anything else."""
    for name in check_flat_model(flat, model, FlatReading(library, _places(source_map))):
        flat["variables"][name]["fixed"] = [True]


def _request(model: str, file: Path, given: LoneFiles) -> Request:
    """What loads ``file`` and compiles ``model``.

    rumoca loads only libraries that the loaded text names, not those that they name in turn. A model in a file of its
    own is therefore followed by a class that names them all; places in the text stay as they are. A model of a library
    among the roots needs that class alone.
    """
    roots = given.roots
    names = tuple(str(root) for root in roots)
    is_package = file.name == "package.mo"
    is_library = is_package and file.parent.parent.resolve() in {root.resolve() for root in roots}
    if is_package and not is_library:
        return Request(names, model, str(file), None, str(file))
    packages = [root.name for root in roots if (root / "package.mo").is_file()]
    packages += [
        name
        for root in roots
        for name in _STANDARD_PACKAGES
        if (root / name / "package.mo").is_file() or (root / f"{name}.mo").is_file()
    ]
    imports = "".join(f"  import {package};\n" for package in dict.fromkeys(packages))
    try:
        text = "" if is_library else file.read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        raise InputError(f"is not in UTF-8: {error.reason}", place=Place(file=file)) from error
    return Request(
        names,
        model,
        "libraries.mo" if is_library else str(given.file),
        f"{text}\nclass 'cmb libraries'\n{imports}end 'cmb libraries';\n",
        str(file),
    )
