"""Whether a binary is whole: loading one that was cut short would end the program without a word."""

from __future__ import annotations

import struct
from pathlib import Path
from typing import Final

from contact_foundation.errors import InputError, Place

_ELF: Final = b"\x7fELF"
_HEADER_64: Final = struct.Struct("<40xQ10xHH")  # e_shoff, e_shentsize, e_shnum
_WIDE: Final = 2


def require_whole(binary: Path, fmu: Path) -> None:
    """Refuses a shared library (ELF, 64 bit) that ends before its table of sections, which comes last, does.

    Args:
        binary: the unpacked library; one that does not exist or of another format is left to the loader.
        fmu: named in errors.

    Raises:
        InputError: the library is cut short.
    """
    try:
        with binary.open("rb") as stream:
            header = stream.read(64)
        size = binary.stat().st_size
    except OSError:
        return
    if not header.startswith(_ELF) or len(header) < _HEADER_64.size or header[4] != _WIDE:
        return
    offset, entry, count = _HEADER_64.unpack_from(header)
    if size < offset + entry * count:
        raise InputError(
            f"the FMU's binary is damaged: {binary.name} has {size} of {offset + entry * count} bytes",
            place=Place(file=fmu),
            remedy="Build the FMU anew.",
        )
