"""Loads a model with rumoca, the front end."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final

from cmb_base.errors import BuildError, InputError, Place

from modelica2fmu import ir
from modelica2fmu.class_library import ClassLibrary
from modelica2fmu.class_syntax import Extent
from modelica2fmu.flat_check import check_flat_model
from modelica2fmu.flat_reader import read_flat_model
from modelica2fmu.flat_reading import FlatReading
from modelica2fmu.front_end_errors import front_end_error
from modelica2fmu.lone_files import LoneFiles, apart
from modelica2fmu.source_map import SourceMap, source_number

# What a folder with the Modelica Standard Library holds.
_STANDARD_PACKAGES: Final = ("Modelica", "ModelicaServices", "Complex")


def load_flat_model(model: str, file: Path, roots: Sequence[Path], source_map: SourceMap) -> ir.FlatModel:
    """Compiles ``model`` and returns its flattened form.

    Args:
        model: full Modelica name.
        file: the file that holds it; of the files beside it only those of its package structure are loaded.
        roots: library folders (those that contain packages) and single files that it uses.
        source_map: for the places in error messages.

    Raises:
        InputError: the model does not parse or compile.
        UnsupportedModelError: it uses something that has no place in the typed form.
        BuildError: rumoca is not installed.
    """
    try:
        import rumoca
    except ImportError as error:
        raise BuildError(
            "the Modelica front end rumoca is not installed", remedy="install it: pip install rumoca==0.10.2"
        ) from error
    # With a package and the folder around it among the roots, rumoca would see only the package.
    resolved = {root.resolve() for root in roots}
    roots = [root for root in roots if root.resolve().parent not in resolved]
    with apart(file, roots, source_map) as given:
        try:
            with without_modelicapath():
                session = rumoca.Session([str(root) for root in given.roots])
                flat: dict[str, Any] = _compile(session, model, file, given).to_dict("flat")
        except rumoca.RumocaError as error:
            raise front_end_error(rumoca, given.restored(str(error)), model, file) from error
        except BaseException as error:
            # A panic of rumoca derives from BaseException alone.
            if not isinstance(error, OSError | RuntimeError | ValueError) and type(error).__name__ != "PanicException":
                raise
            message = f"{model} cannot be compiled: {given.restored(str(error))}"
            raise InputError(message, place=Place(file=file)) from error
        _check(flat, model, file, given, source_map)
        return read_flat_model(flat, model, source_map)


def _check(flat: dict[str, Any], model: str, file: Path, given: LoneFiles, source_map: SourceMap) -> None:
    """Raises UnsupportedModelError if the front end left out a modifier or a redeclaration."""

    def place(extent: Extent) -> Place:
        return source_map.place(ir.Span(source_number(str(extent.file)), extent.start, extent.end))

    library = ClassLibrary(given.file, file.read_bytes(), given.roots)
    check_flat_model(flat, model, FlatReading(library, place))


def _compile(session: Any, model: str, file: Path, given: LoneFiles) -> Any:
    """Loads ``file`` and compiles ``model``.

    rumoca loads only libraries that the loaded text names, not those that they name in turn. A model in a file of its
    own is therefore followed by a class that names them all; places in the text stay as they are. A model of a library
    among the roots needs that class alone.
    """
    roots = given.roots
    is_package = file.name == "package.mo"
    is_library = is_package and file.parent.parent.resolve() in {root.resolve() for root in roots}
    if is_package and not is_library:
        return session.load(str(file), model=model)
    packages = [root.name for root in roots if (root / "package.mo").is_file()]
    packages += [
        name
        for root in roots
        for name in _STANDARD_PACKAGES
        if (root / name / "package.mo").is_file() or (root / f"{name}.mo").is_file()
    ]
    imports = "".join(f"  import {package};\n" for package in dict.fromkeys(packages))
    text = "" if is_library else file.read_text(encoding="utf-8")
    return session.loads(
        f"{text}\nclass 'cmb libraries'\n{imports}end 'cmb libraries';\n",
        model=model,
        filename="libraries.mo" if is_library else str(given.file),
    )


@contextmanager
def without_modelicapath() -> Iterator[None]:
    """Hides MODELICAPATH from rumoca, which would prefer a library there to the one that was chosen."""
    path = os.environ.pop("MODELICAPATH", None)
    try:
        yield
    finally:
        if path is not None:
            os.environ["MODELICAPATH"] = path
