"""Finds what the external C functions of a model need: include texts, folders and libraries."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from contact_foundation.errors import InputError

SCHEME: Final = "modelica://"


@dataclass(frozen=True)
class ExternalCode:
    """What the external C functions of the model need to compile and link.

    Attributes:
        includes: texts of Include annotations, in order, each once; the generated C has them already.
        include_directories: existing folders for ``#include``.
        libraries: names as in the Library annotation (``m``, ``contact_multibody``), in link order.
        library_directories: existing folders that hold them, or whose sub-folders for platforms do (Modelica 3.6,
            section 12.9.4).
        modules: file names of shared objects in these folders that the libraries load while the model runs.
    """

    includes: tuple[str, ...] = ()
    include_directories: tuple[Path, ...] = ()
    libraries: tuple[str, ...] = ()
    library_directories: tuple[Path, ...] = ()
    modules: tuple[str, ...] = ()


def find_external_code(
    annotations: Iterable[tuple[str, tuple[str, ...]]], roots: Sequence[Path], package: str
) -> ExternalCode:
    """Resolves the annotations of external functions.

    Args:
        annotations: names (Include, IncludeDirectory, Library, LibraryDirectory) with their texts.
        roots: folders that contain the packages.
        package: top-level package of the model, whose Resources folders are used where no annotation names one.

    Raises:
        InputError: a folder that an annotation names does not exist.
    """
    includes: dict[str, None] = {}
    include_directories: dict[Path, None] = {}
    libraries: dict[str, None] = {}
    library_directories: dict[Path, None] = {}
    for name, texts in annotations:
        for text in texts:
            if name == "Include":
                includes[text] = None
            elif name == "Library":
                libraries[text] = None
            elif name == "IncludeDirectory":
                include_directories[_folder(text, roots)] = None
            elif name == "LibraryDirectory":
                library_directories[_folder(text, roots)] = None
    for root in roots:
        resources = root / package / "Resources"
        if (resources / "Include").is_dir():
            include_directories.setdefault(resources / "Include")
        if (resources / "Library").is_dir():
            library_directories.setdefault(resources / "Library")
    return ExternalCode(
        includes=tuple(includes),
        include_directories=tuple(include_directories),
        libraries=tuple(libraries),
        library_directories=tuple(library_directories),
    )


def _folder(uri: str, roots: Sequence[Path]) -> Path:
    if not uri.lower().startswith(SCHEME):
        path = Path(uri.removeprefix("file://"))
        if path.is_dir():
            return path
        raise InputError(f"the folder {uri} of an external function does not exist")
    found = resource_path(uri, roots)
    if found is not None and found.is_dir():
        return found
    raise InputError(
        f"the folder {uri} of an external function does not exist",
        remedy="build and install the library's C part into its Resources folder first",
    )


def resource_path(uri: str, roots: Sequence[Path]) -> Path | None:
    """The file or folder that a ``modelica://`` name means, None where there is none.

    Args:
        uri: the name.
        roots: folders that contain the packages, or are packages themselves.

    Raises:
        InputError: the name leaves its package.
    """
    relative = Path(uri[len(SCHEME) :])
    if ".." in relative.parts:
        raise InputError(f"{uri} leaves its package")
    for root in roots:
        # A root is the folder of a package itself or one that holds packages.
        base = root.parent if relative.parts and root.name == relative.parts[0] else root
        if (path := base / relative).exists():
            return path
    return None
