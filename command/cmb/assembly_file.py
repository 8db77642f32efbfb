"""Which XML file an assembly argument means."""

from __future__ import annotations

from pathlib import Path

from cmb_base.errors import InputError, Place


def find_assembly(argument: Path) -> Path:
    """The assembly's XML file: ``argument`` itself or the only XML file of the folder.

    Raises:
        InputError: there is no such file, or the folder holds none or several.
    """
    if argument.is_file():
        return argument
    if not argument.is_dir():
        raise InputError(
            "does not exist", place=Place(file=argument), remedy="Name the assembly's XML file or its folder."
        )
    found = sorted(argument.glob("*.xml"))
    if len(found) == 1:
        return found[0]
    message = "holds no XML file" if not found else "holds several XML files: " + ", ".join(file.name for file in found)
    raise InputError(message, place=Place(file=argument), remedy="Name the assembly's XML file itself.")
