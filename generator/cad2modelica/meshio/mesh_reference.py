"""Mesh files that a robot description names, in the forms that are in use, and which of them may be read.

Read are files in the description's own folder, in the ROS package that holds it, in packages beside or above it, and in
folders that the user opens; nothing else, whatever the description says.
"""

from __future__ import annotations

import os.path
import re
from collections.abc import Sequence
from pathlib import Path, PurePosixPath

from contact_foundation.errors import InputError, Place

from cad2modelica.source.file_reference import resolve_inside

PACKAGE_SCHEMES = ("package://", "model://")
FILE_SCHEME = "file://"
PACKAGE_FILE = "package.xml"
LEVELS_OF_PACKAGES = 5

_SCHEME = re.compile(r"[A-Za-z][A-Za-z0-9+.\-]*:")
_PACKAGE_NAME = re.compile(rb"<name>\s*([^<\s]+)\s*</name>")
_PACKAGE_BYTES = 100_000  # of a package.xml, whose name stands near its beginning


class MeshReferences:
    """Finds the files that one description names.

    Args:
        description: the description's file.
        opened: folders that the user opens, as ``SourceChoices.package_paths``.
    """

    def __init__(self, description: Path, opened: Sequence[Path]) -> None:
        self._folder = description.parent
        self._description = description.resolve()
        self._above = self._description.parents[:LEVELS_OF_PACKAGES]
        self._opened = [folder.resolve() for folder in opened]

    def find(self, reference: str, place: Place) -> Path:
        """The file that a reference means: a path, with or without ``file://``, or ``package://NAME/``, ``model://NAME/``.

        Raises:
            InputError: there is no such file, or it lies in no folder that is open.
        """
        text = reference.replace("\\", "/")
        if not text or "\0" in text:
            raise InputError(f"{reference!r} is not a file name", place=place, remedy="Name a mesh file.")
        for scheme in PACKAGE_SCHEMES:
            if text.startswith(scheme):
                path = text.removeprefix(scheme)  # Gazebo takes model:///NAME too
                return self._in_package(path.lstrip("/") if scheme == "model://" else path, reference, place)
        path = text.removeprefix(FILE_SCHEME)
        if path.startswith("/"):
            return self._absolute(path, reference, place)
        if _SCHEME.match(path):
            raise InputError(
                f"{reference!r} is not a relative path",
                place=place,
                remedy="Name a file by a relative path with forward slashes, or by package://NAME/FILE.",
            )
        return self._relative(path, place)

    def _relative(self, path: str, place: Place) -> Path:
        if ".." not in PurePosixPath(path).parts and os.path.exists(self._folder / path):
            return resolve_inside(self._folder, path, place)
        target = Path(os.path.normpath(self._description.parent / path))
        for folder in (*self._own_package(), *self._opened):
            if target.is_relative_to(folder) and os.path.isfile(target):
                return resolve_inside(folder, target.relative_to(folder).as_posix(), place)
        found = self._below_opened(PurePosixPath(path).parts, place)
        if found is not None:
            return found
        if any(target.is_relative_to(folder) for folder in (self._description.parent, *self._own_package())):
            raise _missing(path, f"which does not exist in {self._folder}", place)
        raise InputError(
            f"{path!r} leaves the assembly's folder",
            place=place,
            remedy=f"Open the folder that holds the file, if it is to be trusted: --package-path {target.parent}",
        )

    def _absolute(self, path: str, reference: str, place: Place) -> Path:
        target = Path(os.path.normpath(path))
        for folder in (self._description.parent, *self._own_package(), *self._opened):
            if target.is_relative_to(folder) and os.path.isfile(target):
                return resolve_inside(folder, target.relative_to(folder).as_posix(), place)
        # A path of another machine: what follows the name of an opened folder counts.
        parts = target.parts
        for folder in self._opened:
            for index in (index for index, part in enumerate(parts) if part == folder.name):
                inner = PurePosixPath(*parts[index + 1 :]).as_posix()
                if os.path.isfile(folder / inner):
                    return resolve_inside(folder, inner, place)
        raise InputError(
            f"{reference!r} is not a relative path, and lies in no folder that is open",
            place=place,
            remedy="Open the folder that holds the file, if it is to be trusted: --package-path FOLDER",
        )

    def _in_package(self, path: str, reference: str, place: Place) -> Path:
        package, _, inner = path.partition("/")
        if package in ("", ".", ".."):
            raise InputError(f"{reference!r} names no package", place=place, remedy="Write package://NAME/FILE.")
        # The package's own folder if the description lies in it, else one beside; then what the user opens.
        folders = [ancestor for ancestor in self._description.parents if ancestor.name == package]
        folders += [own for own in self._own_package() if _says_it_is(own, package)]
        folders += [ancestor / package for ancestor in self._above if os.path.isdir(ancestor / package)]
        for opened in self._opened:
            folders += [opened] if opened.name == package or _says_it_is(opened, package) else []
            folders += [opened / package] if os.path.isdir(opened / package) else []
        if ".." in PurePosixPath(inner).parts:
            return resolve_inside(next(iter(folders), self._folder), inner, place)  # which refuses it
        folders += [folder for folder in (self._folder, *self._opened) if os.path.isfile(folder / inner)]
        holding = next((folder for folder in folders if os.path.isfile(folder / inner)), None)
        if holding is not None:
            return resolve_inside(holding, inner, place)
        if folders:
            raise _missing(inner, f"which does not exist in {folders[0]}", place)
        raise InputError(
            f"names the package {package!r}, which does not exist: no folder of that name, also by its {PACKAGE_FILE}, "
            f"holds {self._description.name}, or lies beside it or one of the {LEVELS_OF_PACKAGES} folders above",
            place=place,
            remedy=f"Name the folder {package}, or the one that holds it: --package-path FOLDER",
        )

    def _own_package(self) -> list[Path]:
        """The folder of the ROS package that the description lies in."""
        return [folder for folder in self._above if (folder / PACKAGE_FILE).is_file()][:1]

    def _below_opened(self, parts: Sequence[str], place: Place) -> Path | None:
        """A file of an opened folder, by what a reference says behind its ``..``."""
        last = max((index for index, part in enumerate(parts) if part == ".."), default=-1)
        inner = PurePosixPath(*parts[last + 1 :]).as_posix()
        for folder in self._opened:
            if os.path.isfile(folder / inner):
                return resolve_inside(folder, inner, place)
        return None


def _says_it_is(folder: Path, package: str) -> bool:
    """Whether a folder's package.xml gives the name of a package, whatever the folder is called."""
    try:
        with (folder / PACKAGE_FILE).open("rb") as file:
            found = _PACKAGE_NAME.search(file.read(_PACKAGE_BYTES))
    except OSError:
        return False
    return found is not None and found[1] == package.encode()


def _missing(name: str, where: str, place: Place) -> InputError:
    return InputError(
        f"names the file {name!r}, {where}",
        place=place,
        remedy="Copy the file there, correct the name (upper and lower case count), or name the folder that holds it: "
        "--package-path FOLDER",
    )
