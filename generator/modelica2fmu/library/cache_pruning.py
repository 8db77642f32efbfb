"""Keeps the caches of the builder small: what was not used for long goes, and what a build is using stays."""

from __future__ import annotations

import fcntl
import os
import shutil
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Final

_DAY: Final = 24 * 3600.0
# Views of libraries and compiled objects.
_UNUSED_FOR: Final = 30 * _DAY
# The front end's files are small and many: counting them takes a second, so it is done once a day.
_FRONT_END_LIMIT: Final = 1024**3
_FRONT_END_MARGIN: Final = 3600.0
_LOCK: Final = ".lock"
_CHECKED: Final = ".pruned"
_ACCESS: Final = ".rumoca-access"


def mark_used(path: Path) -> None:
    """Notes that an entry is used now; one that is gone or read-only is no failure."""
    with suppress(OSError):
        os.utime(path)


@contextmanager
def pruned_after_use(folder: Path) -> Iterator[None]:
    """Holds a folder whose entries are read as long as the context lasts; afterwards removes what is long unused.

    Nothing is removed while another build, of this process or another one, holds the folder: each has a shared lock on
    a file in it, and who removes has the only one. A folder that cannot be written to is left as it is.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        lock = (folder / _LOCK).open("w")
        fcntl.flock(lock, fcntl.LOCK_SH)
    except OSError:
        yield
        return
    with lock:
        try:
            yield
        finally:
            with suppress(OSError):
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                prune_unused(entry for entry in folder.iterdir() if entry.name != _LOCK)


def prune_unused(entries: Iterable[Path], unused_for: float = _UNUSED_FOR) -> None:
    """Removes entries, files or folders, whose last use is long ago.

    Args:
        entries: their modification times are those of their last use (:func:`mark_used`).
        unused_for: in s.
    """
    limit = time.time() - unused_for
    for entry in entries:
        with suppress(OSError):
            if entry.lstat().st_mtime < limit:
                if entry.is_dir() and not entry.is_symlink():
                    shutil.rmtree(entry, ignore_errors=True)
                else:
                    entry.unlink()


def prune_front_end_cache(
    folder: Path, limit: int = _FRONT_END_LIMIT, margin: float = _FRONT_END_MARGIN, every: float = _DAY
) -> None:
    """Removes what rumoca has not used for the longest time until its cache is small enough.

    rumoca reads each file at once, and parses anew what is not there.

    Args:
        folder: of the cache; need not exist.
        limit: bytes of all files together.
        margin: files used in so many s stay in any case.
        every: in s; nothing is done if it was done later than that.
    """
    stamp = folder / _CHECKED
    now = time.time()
    with suppress(OSError):
        if not folder.is_dir() or (stamp.exists() and now - stamp.stat().st_mtime < every):
            return
        stamp.touch()
        total, entries = 0, []
        for name, _, files in os.walk(folder):
            for each in files:
                if each.endswith(_ACCESS) or each == _CHECKED:
                    continue
                path = Path(name, each)
                with suppress(OSError):
                    status = path.stat()
                    entries.append((max(status.st_mtime, _last_access(path)), status.st_size, path))
                    total += status.st_size
        for used, size, path in sorted(entries):
            if total <= limit or used > now - margin:
                return
            path.unlink(missing_ok=True)
            _access(path).unlink(missing_ok=True)
            total -= size


def _access(path: Path) -> Path:
    """The empty file that rumoca touches when it uses the other one."""
    return path.with_name(path.name + _ACCESS)


def _last_access(path: Path) -> float:
    with suppress(OSError):
        return _access(path).stat().st_mtime
    return 0.0
