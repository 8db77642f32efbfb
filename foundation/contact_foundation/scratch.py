"""Temporary folders that do not outlive their process for long, however it ends."""

from __future__ import annotations

import os
import secrets
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from contact_foundation.abandoned import clear_abandoned, owned

_RANDOM_BYTES = 8


@contextmanager
def scratch_folder(purpose: str) -> Iterator[Path]:
    """Yields a new folder among the system's temporary ones, which is removed when the block ends.

    Those of processes that were killed are removed first.

    Args:
        purpose: part of the folder's name, for who finds it.
    """
    place = Path(tempfile.gettempdir())
    clear_abandoned(place, f"cmb-*-{'[0-9a-f]' * 2 * _RANDOM_BYTES}")
    folder = place / f"cmb-{purpose}-{secrets.token_hex(_RANDOM_BYTES)}"
    os.mkdir(folder, 0o700)
    try:
        with owned(folder):
            yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)
