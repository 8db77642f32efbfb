"""Writes the contents of geometry files into descriptors, so that an FMU needs no file of the machine it was made on.

Descriptors are the strings that describe shapes to the contact engine (docs/architecture.md). They may name mesh
files by ``file=``; the engine itself, loaded from the model's libraries, reads these.
"""

from __future__ import annotations

import ctypes
import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Final

from contact_foundation.errors import InputError

from modelica2fmu.expand.scalar_model import ExternalCall
from modelica2fmu.symbolic.expression import Node

_ENGINE: Final = "libcontactmultibody.so"
_ROOM: Final = 1 << 21  # bytes, for most descriptors
_NAMES_A_FILE: Final = re.compile(r"cmb/\d+ \S+ (?:[^;]* )?file=")
_FILE: Final = re.compile(r'(?<=\bfile=)(?:"(?P<quoted>[^"]*)"|(?P<bare>[^\s;"]+))')


def write_out_geometry(
    calls: Sequence[ExternalCall], library_directories: Sequence[Path], file: Callable[[str], Path]
) -> list[ExternalCall]:
    """The calls with descriptors that name no files.

    Args:
        calls: external calls of a model; those without such descriptors stay as they are.
        library_directories: where the engine's library is looked for.
        file: the file that a name in a model means.

    Raises:
        InputError: a file cannot be read or is no mesh, or the engine is missing.
    """
    written: dict[str, str] = {}  # several calls have the same descriptor, and reading a mesh takes a second

    def without_files(value: float | str | Node) -> float | str | Node:
        if not (isinstance(value, str) and _names_file(value)):
            return value
        if value not in written:
            written[value] = _written_out(value, library_directories, file)
        return written[value]

    return [
        replace(
            call,
            args=tuple(replace(argument, values=tuple(map(without_files, argument.values))) for argument in call.args),
        )
        if any(_names_file(value) for argument in call.args for value in argument.values)
        else call
        for call in calls
    ]


def _names_file(value: object) -> bool:
    return isinstance(value, str) and _NAMES_A_FILE.search(value) is not None


def _written_out(descriptor: str, library_directories: Sequence[Path], file: Callable[[str], Path]) -> str:
    def absolute(match: re.Match[str]) -> str:
        return f'"{file(match["quoted"] or match["bare"]).absolute()}"'

    library = next((path for folder in library_directories if (path := folder / _ENGINE).is_file()), None)
    if library is None:
        raise InputError(
            f"{_ENGINE} is missing, which reads the geometry files of the model",
            remedy="build and install the contact engine first",
        )
    engine = ctypes.CDLL(str(library))
    engine.cmb_inline_files.argtypes = [
        ctypes.c_char_p,
        ctypes.c_char_p,
        ctypes.c_char_p,
        ctypes.c_size_t,
        ctypes.POINTER(ctypes.c_size_t),
    ]
    engine.cmb_last_error.restype = ctypes.c_char_p
    text = _FILE.sub(absolute, descriptor).encode()
    length = ctypes.c_size_t(0)
    room = ctypes.create_string_buffer(_ROOM)
    for _ in range(2):  # the second time with the room that the first asked for
        if engine.cmb_inline_files(text, b"/", room, len(room), ctypes.byref(length)) != 0:
            raise InputError(f"geometry: {engine.cmb_last_error().decode(errors='replace')}")
        if length.value <= len(room):
            break
        room = ctypes.create_string_buffer(length.value)
    return room.value.decode()
