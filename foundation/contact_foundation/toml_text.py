"""TOML from unknown hands."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

from contact_foundation.errors import InputError, Place


def read_toml(path: Path) -> dict[str, Any]:
    """The content of a TOML file.

    Raises:
        InputError: it is no UTF-8 text or no TOML.
        OSError: it cannot be read.
    """
    try:
        text = path.read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        raise InputError("is no UTF-8 text", place=Place(file=path), remedy="Name a TOML file.") from error
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
