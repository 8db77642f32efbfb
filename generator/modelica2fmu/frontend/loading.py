"""Loads a model with rumoca, the front end."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

from contact_foundation.errors import InputError, Place

from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.class_syntax import Extent
from modelica2fmu.crosscheck.flat_check import check_flat_model
from modelica2fmu.crosscheck.flat_reading import FlatReading
from modelica2fmu.frontend import ir
from modelica2fmu.frontend.errors import FrontEndError, front_end_error
from modelica2fmu.frontend.flat_reader import read_flat_model
from modelica2fmu.frontend.lone_files import LoneFiles, apart
from modelica2fmu.frontend.runner import Request, ask
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
        answer = ask(_request(model, file, given), remark)
        if answer.flat is None:
            words = replace(
                answer,
                error=given.restored(answer.error),
                diagnostics=tuple(given.restored(each) for each in answer.diagnostics),
            )
            raise front_end_error(words, model, file) from FrontEndError(words.error)
        _check(answer.flat, model, file, given, source_map)
        return read_flat_model(answer.flat, model, source_map)


def _check(flat: dict[str, Any], model: str, file: Path, given: LoneFiles, source_map: SourceMap) -> None:
    """Restores what is fixed; raises UnsupportedModelError if the front end left out anything else."""

    def place(extent: Extent) -> Place:
        return source_map.place(Span(source_number(str(extent.file)), extent.start, extent.end))

    library = ClassLibrary(given.file, file.read_bytes(), given.roots)
    for name in check_flat_model(flat, model, FlatReading(library, place)):
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
