"""Finds the Modelica Standard Library that a model uses."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from contact_data import core_subset
from contact_foundation.cache import user_cache
from contact_foundation.errors import InputError, Place
from contact_foundation.scratch import scratch_folder

CORE_SUBSET: Final = "core subset"
"""Origin of the project's own subset."""

_VERSION: Final = re.compile(r'\bversion\s*=\s*"([^"]+)"')
_OPENMODELICA: Final = (
    "~/.openmodelica/libraries",
    "/usr/lib/omlibrary",
    "/opt/openmodelica/lib/omlibrary",
    "/usr/local/lib/omlibrary",
)
_HEAD_BYTES: Final = 400_000
_MAJOR_VERSION: Final = 4
_MISSING_CLASS: Final = re.compile(r"(?:there is no class |unresolved \w+ (?:reference|call): ')Modelica\.")
_SUBSET: Final = (
    "Of the Modelica Standard Library only this project's core subset is used: name the whole with --msl, set "
    "MODELICAPATH, or run cmb msl install"
)
# What a folder with the Standard Library holds.
STANDARD_PARTS: Final = ("Modelica", "ModelicaServices", "Complex")


@dataclass(frozen=True)
class StandardLibrary:
    """A found library.

    Attributes:
        folder: contains the package ``Modelica`` in a folder of that name, or is that package's folder where its
            name has a version, ``Modelica 4.1.0``.
        version: as its annotation says, empty if it does not.
        origin: where it was looked for: ``--msl``, ``MODELICAPATH``, ``OpenModelica``, ``cache`` or ``core subset``.
    """

    folder: Path
    version: str
    origin: str

    def parts(self) -> dict[str, Path]:
        """Folder or file of Modelica and of the two packages beside it that it uses, as far as they are there."""
        inside = (self.folder / "Modelica").is_dir()
        base = self.folder if inside else self.folder.parent
        suffix = "" if inside else self.folder.name.removeprefix("Modelica")
        found: dict[str, Path] = {}
        for part in STANDARD_PARTS:
            names = dict.fromkeys([f"{part}{suffix}", part])
            candidates = [path for name in names for path in (base / name, base / f"{name}.mo")]
            path = next((path for path in candidates if path.is_file() or (path / "package.mo").is_file()), None)
            if path is not None:
                found[part] = path
        return found

    @contextmanager
    def root(self) -> Iterator[Path]:
        """Yields a folder in which the packages have no versions in their names, as front ends look for them."""
        if (self.folder / "Modelica").is_dir():
            yield self.folder
            return
        with scratch_folder("msl") as folder:
            for part, path in self.parts().items():
                (folder / f"{part}{path.suffix if path.is_file() else ''}").symlink_to(path.resolve())
            yield folder


def cache_folder(environment: Mapping[str, str] = os.environ) -> Path:
    """Where official releases are kept."""
    return user_cache("msl", environment)


def find_standard_library(explicit: Path | None = None, environment: Mapping[str, str] = os.environ) -> StandardLibrary:
    """The first library found: ``explicit``, MODELICAPATH, OpenModelica's folders, the cache, the core subset.

    Folders may have the version in their names, ``Modelica 4.1.0`` (Modelica Language Specification 3.6, section
    13.4). Of several versions in one place the latest is taken; versions before 4 are passed over.

    Args:
        explicit: folder that contains ``Modelica``, or that package's folder itself.
        environment: for MODELICAPATH, HOME and XDG_CACHE_HOME.

    Raises:
        InputError: there is none, or none in ``explicit``, or that is too old.
    """
    if explicit is not None:
        named = [package for package in _packages(explicit.parent) if package == explicit]
        for package in named or sorted(_packages(explicit), key=_rank, reverse=True):
            if not _is_usable(package):
                raise InputError(
                    f"version {_version(package)} of the Modelica Standard Library is too old",
                    place=Place(file=package),
                    remedy="name version 4.0 or 4.1",
                )
            return _library(package, "--msl")
        raise InputError(
            "there is no Modelica Standard Library in this folder",
            place=Place(file=explicit),
            remedy="name the folder that contains Modelica/package.mo",
        )
    for origin, folders in _places(environment):
        found = [[package for package in _packages(folder) if _is_usable(package)] for folder in folders]
        in_order = [packages for packages in found if packages]
        if in_order:
            # On a path the first folder counts; elsewhere the latest version.
            candidates = in_order[0] if origin == "MODELICAPATH" else [each for some in in_order for each in some]
            return _library(max(candidates, key=_rank), origin)
    raise InputError(
        "no Modelica Standard Library was found",
        remedy="name one with --msl, set MODELICAPATH, or run cmb msl install",
    )


@contextmanager
def told_of_the_core_subset(library: StandardLibrary) -> Iterator[None]:
    """Errors about classes of the Standard Library that are not there say so where only the core subset is used."""
    try:
        yield
    except InputError as error:
        if library.origin != CORE_SUBSET or not _MISSING_CLASS.search(error.message):
            raise
        remedy = f"{error.remedy} {_SUBSET}" if error.remedy else _SUBSET
        raise InputError(error.message, place=error.place, remedy=remedy) from error


def other_libraries(environment: Mapping[str, str] = os.environ) -> list[Path]:
    """Folders of MODELICAPATH without a Standard Library, for the other libraries of a model."""
    folders = [Path(item) for item in environment.get("MODELICAPATH", "").split(os.pathsep) if item]
    return [folder for folder in folders if folder.is_dir() and not _packages(folder)]


def _places(environment: Mapping[str, str]) -> Iterator[tuple[str, Sequence[Path]]]:
    path = environment.get("MODELICAPATH", "")
    yield "MODELICAPATH", [Path(item) for item in path.split(os.pathsep) if item]
    home = environment.get("HOME", "")
    yield "OpenModelica", [Path(item.replace("~", home, 1)) for item in _OPENMODELICA if home or "~" not in item]
    cache = cache_folder(environment)
    kept = sorted(path for path in cache.iterdir() if not path.name.startswith(".")) if cache.is_dir() else []
    yield "cache", [cache, *kept]
    yield CORE_SUBSET, [core_subset()]


def _packages(folder: Path) -> list[Path]:
    """Folders of the package Modelica in ``folder``, with or without a version in their name."""
    if not folder.is_dir():
        return []
    names = [folder / "Modelica", *sorted(folder.glob("Modelica [0-9]*"))]
    return [package for package in names if (package / "package.mo").is_file()]


def _library(package: Path, origin: str) -> StandardLibrary:
    return StandardLibrary(package if package.name != "Modelica" else package.parent, _version(package), origin)


def _version(package: Path) -> str:
    with (package / "package.mo").open("rb") as file:
        file.seek(0, os.SEEK_END)
        file.seek(max(file.tell() - _HEAD_BYTES, 0))
        text = file.read().decode("utf-8", errors="replace")
    versions = _VERSION.findall(text)
    return versions[-1] if versions else ""


def _is_usable(package: Path) -> bool:
    """False for versions that are known to be too old."""
    rank = _rank(package)
    return not rank or rank[0] >= _MAJOR_VERSION


def _rank(package: Path) -> tuple[int, ...]:
    return tuple(int(part) for part in re.findall(r"\d+", _version(package))[:3])
