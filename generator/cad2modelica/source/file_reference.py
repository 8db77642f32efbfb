"""References from one file to another that must stay inside the assembly's folder."""

from __future__ import annotations

import os.path
import re
from pathlib import Path, PurePosixPath

from contact_foundation.errors import InputError, Place


def resolve_inside(folder: Path, reference: str, place: Place) -> Path:
    """The file that a reference means.

    Args:
        folder: the assembly's folder.
        reference: a relative path with forward slashes.
        place: where the reference stands.

    Raises:
        InputError: the reference is absolute, a URL, leaves the folder (also through a symbolic link), or
            there is no such file.
    """
    path = PurePosixPath(reference)
    remedy = f"Name a file in {folder.absolute()} by a relative path with forward slashes."
    if not reference or "\0" in reference or "\\" in reference:
        raise InputError(f"{reference!r} is not a file name", place=place, remedy=remedy)
    if path.is_absolute() or re.match(r"[A-Za-z][A-Za-z0-9+.\-]*:", reference):
        raise InputError(f"{reference!r} is not a relative path", place=place, remedy=remedy)
    if ".." in path.parts:
        raise InputError(f"{reference!r} leaves the assembly's folder", place=place, remedy=remedy)
    target = folder / path
    if os.path.isdir(target):
        raise InputError(f"{reference!r} is a folder, not a file", place=place, remedy="Name the file in it.")
    if not os.path.isfile(target):  # a name that is too long for any file is none, too
        raise InputError(
            f"names the file {reference!r}, which does not exist in {folder}",
            place=place,
            remedy="Copy the file there or correct the name (upper and lower case count).",
        )
    if not target.resolve().is_relative_to(folder.resolve()):
        raise InputError(
            f"{reference!r} leaves the assembly's folder through a symbolic link", place=place, remedy=remedy
        )
    return target
