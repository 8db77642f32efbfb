"""Input files are looked for before the packages that read them are loaded, which takes a second."""

from __future__ import annotations

from pathlib import Path

from contact_foundation.errors import InputError, Place


def check_input(*paths: Path | None) -> None:
    """Raises InputError for the first path that does not exist; None stands for what was left out."""
    for path in paths:
        if path is not None and not path.exists():
            raise InputError("does not exist", place=Place(file=path), remedy="Correct the path.")
