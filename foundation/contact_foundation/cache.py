"""The user's cache folder: what is in it may vanish at any time and can be computed again."""

from __future__ import annotations

import os
import pwd
from collections.abc import Mapping
from pathlib import Path


def user_cache(name: str, environment: Mapping[str, str] = os.environ) -> Path:
    """The folder for entries of one kind, below XDG_CACHE_HOME or ``~/.cache``; it need not exist.

    Args:
        name: kind of the entries.
        environment: for XDG_CACHE_HOME and HOME. By the XDG Base Directory Specification a relative XDG_CACHE_HOME
            does not count; nor does a relative or empty HOME. A user without a home has a folder that cannot exist.
    """
    given = Path(environment.get("XDG_CACHE_HOME", ""))
    base = given if given.is_absolute() else _home(environment) / ".cache"
    return base / "contactmultibody" / name


def _home(environment: Mapping[str, str]) -> Path:
    given = Path(environment.get("HOME", ""))
    if given.is_absolute():
        return given
    try:
        return Path(pwd.getpwuid(os.getuid()).pw_dir)
    except KeyError:  # a user without an entry, as in containers
        return Path("/nonexistent")
