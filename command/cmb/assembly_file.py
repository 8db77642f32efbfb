"""Which file an assembly argument means."""

from __future__ import annotations

from pathlib import Path
from typing import Final

from contact_foundation.errors import InputError, Place

ENDINGS: Final = ((".xml", ".urdf"), (".step", ".stp"))
"""Of assembly files, in groups: a later group counts only in folders that hold nothing of the groups before."""
ASSEMBLY_HELP: Final = (
    "the assembly's file (XML, URDF, MJCF, SDFormat, STEP, Simscape Multibody import XML), or its folder"
)


def find_assembly(argument: Path) -> Path:
    """The assembly's file: ``argument`` itself or the only one of the folder.

    Raises:
        InputError: there is no such file, or the folder holds none or several.
    """
    if argument.is_file():
        return argument
    if not argument.is_dir():
        raise InputError("does not exist", place=Place(file=argument), remedy=f"Name {ASSEMBLY_HELP}.")
    for group in ENDINGS:
        found = sorted(file for file in argument.iterdir() if file.suffix.lower() in group)
        if len(found) == 1:
            return found[0]
        if found:
            raise InputError(
                f"holds several assembly files: {', '.join(file.name for file in found)}",
                place=Place(file=argument),
                remedy="Name the assembly's file itself.",
            )
    raise InputError(
        f"holds no assembly file ({', '.join(ending for group in ENDINGS for ending in group)})",
        place=Place(file=argument),
        remedy="Name the assembly's file itself.",
    )
