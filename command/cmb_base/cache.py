"""The user's cache folder: what is in it may vanish at any time and can be computed again."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path


def user_cache(name: str, environment: Mapping[str, str] = os.environ) -> Path:
    """The folder for entries of one kind, below XDG_CACHE_HOME or ``~/.cache``; it need not exist.

    Args:
        name: kind of the entries.
        environment: for XDG_CACHE_HOME and HOME. By the XDG Base Directory Specification a relative XDG_CACHE_HOME
            does not count.
    """
    given = Path(environment.get("XDG_CACHE_HOME", ""))
    base = given if given.is_absolute() else Path(environment.get("HOME", "~")).expanduser() / ".cache"
    return base / "contactmultibody" / name
