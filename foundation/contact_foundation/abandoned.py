"""What killed processes left half-written: it is known by a lock, which ends with the process that holds it."""

from __future__ import annotations

import fcntl
import os
import shutil
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

_NEW = 60.0  # s; what is younger may not be locked yet


@contextmanager
def owned(staging: Path) -> Iterator[None]:
    """Holds a lock on what is being written; it ends with the process, however that ends."""
    descriptor = os.open(staging, os.O_RDONLY)
    try:
        with suppress(OSError):  # a file system without locks: what is left behind there stays
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        yield
    finally:
        os.close(descriptor)


def clear_abandoned(folder: Path, pattern: str, keep: Callable[[Path], bool] = lambda _: False) -> None:
    """Removes what killed processes of this user left behind: not new, locked by nobody.

    Args:
        folder: where to look.
        pattern: of the names; whatever has one of them was locked by :func:`owned`.
        keep: true for what stays in any case.
    """
    with suppress(OSError):
        for entry in folder.glob(pattern):
            with suppress(OSError):
                status = entry.lstat()
                is_new = time.time() - status.st_ctime < _NEW
                if is_new or status.st_uid != os.geteuid() or entry.is_symlink() or keep(entry):
                    continue
                descriptor = os.open(entry, os.O_RDONLY)
                try:
                    fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
                    shutil.rmtree(entry) if entry.is_dir() else entry.unlink()
                finally:
                    os.close(descriptor)
