"""Which file an assembly argument means."""

from __future__ import annotations

from pathlib import Path

from contact_foundation.errors import InputError, Place

_ENDINGS = (".xml", ".urdf")


def find_assembly(argument: Path) -> Path:
    """The assembly's file: ``argument`` itself or the only XML or URDF file of the folder.

    Raises:
        InputError: there is no such file, or the folder holds none or several.
    """
    if argument.is_file():
        return argument
    if not argument.is_dir():
        raise InputError(
            "does not exist", place=Place(file=argument), remedy="Name the assembly's XML or URDF file, or its folder."
        )
    found = sorted(file for file in argument.iterdir() if file.suffix in _ENDINGS)
    if len(found) == 1:
        return found[0]
    names = ", ".join(file.name for file in found)
    message = f"holds several assembly files: {names}" if found else "holds no XML or URDF file"
    raise InputError(message, place=Place(file=argument), remedy="Name the assembly's file itself.")
