"""Finds the Modelica Standard Library that a model uses."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from cmb_base.cache import user_cache
from cmb_base.errors import InputError, Place

_VERSION: Final = re.compile(r'\bversion\s*=\s*"([^"]+)"')
_OPENMODELICA: Final = (
    "~/.openmodelica/libraries",
    "/usr/lib/omlibrary",
    "/opt/openmodelica/lib/omlibrary",
    "/usr/local/lib/omlibrary",
)
_HEAD_BYTES: Final = 400_000


@dataclass(frozen=True)
class StandardLibrary:
    """A found library.

    Attributes:
        folder: contains the package ``Modelica`` (in a folder of that name).
        version: as its annotation says, empty if it does not.
        origin: where it was looked for: ``--msl``, ``MODELICAPATH``, ``OpenModelica``, ``cache`` or ``core subset``.
    """

    folder: Path
    version: str
    origin: str


def cache_folder(environment: Mapping[str, str] = os.environ) -> Path:
    """Where official releases are kept."""
    return user_cache("msl", environment)


def core_subset() -> Path:
    """The project's own MultiBody core subset."""
    return Path(__file__).resolve().parents[2] / "Resources" / "MultiBodyCore"


def find_standard_library(explicit: Path | None = None, environment: Mapping[str, str] = os.environ) -> StandardLibrary:
    """The first library found: ``explicit``, MODELICAPATH, OpenModelica's folders, the cache, the core subset.

    Args:
        explicit: folder that contains ``Modelica``, or that package's folder itself.
        environment: for MODELICAPATH, HOME and XDG_CACHE_HOME.

    Raises:
        InputError: there is none, or none in ``explicit``.
    """
    if explicit is not None:
        for folder in (explicit, explicit.parent):
            for package in _packages(folder):
                if folder == explicit or package == explicit:
                    return _library(package, "--msl")
        raise InputError(
            "there is no Modelica Standard Library in this folder",
            place=Place(file=explicit),
            remedy="name the folder that contains Modelica/package.mo",
        )
    for origin, folders in _places(environment):
        found = [package for folder in folders for package in _packages(folder)]
        if found:
            return _library(max(found, key=_rank) if origin != "MODELICAPATH" else found[0], origin)
    raise InputError(
        "no Modelica Standard Library was found",
        remedy="name one with --msl, set MODELICAPATH, or run cmb msl install",
    )


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
    yield "cache", [cache, *(sorted(cache.iterdir()) if cache.is_dir() else [])]
    yield "core subset", [core_subset()]


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


def _rank(package: Path) -> tuple[int, ...]:
    return tuple(int(part) for part in re.findall(r"\d+", _version(package))[:3])
