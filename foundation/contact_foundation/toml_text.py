"""TOML from unknown hands."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

from contact_foundation.errors import InputError, Place

MAXIMUM_BYTES = 5_000_000
"""Size of the largest file that is read; hand-written files are far below."""


def read_toml(path: Path, what: str = "a TOML file") -> dict[str, Any]:
    """The content of a TOML file.

    Args:
        path: the file.
        what: what the file should be, such as "a case", for messages.

    Raises:
        InputError: it cannot be read, is larger than ``MAXIMUM_BYTES``, no UTF-8 text or no TOML.
    """
    place, remedy = Place(file=path), f"Name {what}."
    try:
        with path.open("rb") as stream:
            data = stream.read(MAXIMUM_BYTES + 1)
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror}", place=place, remedy=remedy) from error
    if len(data) > MAXIMUM_BYTES:
        raise InputError(f"is larger than {MAXIMUM_BYTES // 1_000_000} MB", place=place, remedy=remedy)
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError as error:
        raise InputError("is no UTF-8 text", place=place, remedy=remedy) from error
    return parse_toml(text, path)


def parse_toml(text: str, path: Path) -> dict[str, Any]:
    """The content of a text that stands, or stood, in a file.

    Raises:
        InputError: it is no TOML.
    """
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"is no TOML: {error}", place=Place(file=path), remedy="Correct that place.") from error
    except RecursionError as error:
        raise InputError("is nested too deeply", place=Place(file=path), remedy="Correct the file.") from error
