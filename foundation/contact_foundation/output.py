"""Files and folders that appear whole or not at all."""

from __future__ import annotations

import errno
import os
import secrets
import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from contact_foundation.abandoned import clear_abandoned, owned
from contact_foundation.errors import InputError, Place
from contact_foundation.scratch import scratch_folder

MARKER = ".written-by-cmb"
_PREFIX = ".cmb-"
_RANDOM_BYTES = 8
_NAMES = f"{_PREFIX}{'[0-9a-f]' * 2 * _RANDOM_BYTES}"


@contextmanager
def whole_folder(target: Path) -> Iterator[Path]:
    """Yields an empty folder that replaces ``target`` when the block ends without an error.

    The folder lies beside ``target`` until then, so the change of names is atomic for each of the
    two steps; an existing ``target`` is kept if the block fails. Only a folder that such a block wrote
    before (it carries a marker file) or an empty one is ever replaced. Of a symbolic link, the folder that it
    names is replaced.

    Raises:
        InputError: ``target`` exists and something else made it.
        OSError: nothing can be written there; the error names ``target``.
    """
    real = Path(os.path.realpath(target))
    _refuse_foreign(target)
    _check_place(target)
    with _errors_about(target):
        staging = _made_beside(real, Path.mkdir)
        try:
            with owned(staging):
                yield staging
            (staging / MARKER).touch()
            _put_in_place(staging, real)
        finally:
            shutil.rmtree(staging, ignore_errors=True)


def _put_in_place(staging: Path, target: Path) -> None:
    if not target.exists():
        os.replace(staging, target)
        return
    old = _name_beside(target)
    os.replace(target, old)
    try:
        os.replace(staging, target)
    except BaseException:
        os.replace(old, target)
        raise
    shutil.rmtree(old, ignore_errors=True)


def _refuse_foreign(target: Path) -> None:
    if not target.exists():
        return
    if not target.is_dir() or (any(target.iterdir()) and not (target / MARKER).exists()):
        raise InputError(
            "exists already and was not written by cmb",
            place=Place(file=target),
            remedy="Name another output, or remove it first.",
        )


@contextmanager
def whole_file(target: Path) -> Iterator[Path]:
    """Yields a path to write to that replaces ``target`` when the block ends without an error.

    A new file has the permissions that the process gives to new files, an existing one keeps its own. Of a symbolic
    link, the file that it names is replaced. A device or pipe is not replaced: what was written goes into it then.

    Raises:
        OSError: nothing can be written there; the error names ``target``.
    """
    _refuse_folder(target)
    _check_place(target)
    real = Path(os.path.realpath(target))
    with _errors_about(target):
        if _is_special(target):
            with scratch_folder("output") as folder:
                staging = folder / "output"
                staging.touch()
                yield staging
                with staging.open("rb") as source, target.open("wb") as stream:
                    shutil.copyfileobj(source, stream)
            return
        staging = _made_beside(real, Path.touch)
        try:
            with owned(staging):
                yield staging
            if real.exists():
                staging.chmod(real.stat().st_mode & 0o777)
            os.replace(staging, real)
        finally:
            staging.unlink(missing_ok=True)


def check_folder(target: Path) -> None:
    """Looks whether ``whole_folder(target)`` can write: for before the long work whose result goes there.

    Raises:
        InputError: ``target`` exists and something else made it, or nothing can be written where it shall lie.
    """
    _refuse_foreign(target)
    _input_error_if_refused(_check_place, target)


def check_file(target: Path) -> None:
    """Looks whether ``whole_file(target)`` can write: for before the long work whose result goes there.

    Raises:
        InputError: ``target`` is a folder, or nothing can be written where it shall lie.
    """
    _input_error_if_refused(_refuse_folder, target)
    _input_error_if_refused(_check_place, target)


def _input_error_if_refused(check: Callable[[Path], None], target: Path) -> None:
    try:
        check(target)
    except OSError as error:
        raise InputError(str(error.strerror), place=Place(file=target), remedy="Name another output.") from error


def _is_special(target: Path) -> bool:
    """Whether this is a device or a pipe; links such as /dev/stdout may lead to one that has no path."""
    return target.exists() and not target.is_file() and not target.is_dir()


def _refuse_folder(target: Path) -> None:
    if target.is_dir():
        raise IsADirectoryError(errno.EISDIR, "is a folder, not a file", str(target))


def _check_place(target: Path) -> None:
    """Raises OSError if nothing can be written at ``target``; folders above it may be missing."""
    if _is_special(target):
        if not os.access(target, os.W_OK):
            raise PermissionError(errno.EACCES, "cannot be written to", str(target))
        return
    folder = next(parent for parent in Path(os.path.realpath(target)).parents if parent.exists())
    if not folder.is_dir():
        raise NotADirectoryError(errno.ENOTDIR, f"{folder} is no folder", str(target))
    if not os.access(folder, os.W_OK | os.X_OK):
        raise _no_place(folder, target)


def _no_place(folder: Path, target: Path) -> PermissionError:
    return PermissionError(errno.EACCES, f"nothing can be written into the folder {folder}", str(target))


def _made_beside(target: Path, make: Callable[[Path], None]) -> Path:
    """A new file or folder in the folder of ``target``, which is made too."""
    staging = _name_beside(target)
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        clear_abandoned(target.parent, _NAMES, _is_whole)
        make(staging)
    except (FileNotFoundError, PermissionError) as error:  # file systems whose permissions do not say it
        raise _no_place(target.parent, target) from error
    return staging


def _is_whole(entry: Path) -> bool:
    """A folder that carries the marker is never removed: it may be an earlier output that was being replaced."""
    return (entry / MARKER).exists()


def _name_beside(target: Path) -> Path:
    """A new hidden name in the folder of ``target``, short whatever that is called."""
    return target.with_name(f"{_PREFIX}{secrets.token_hex(_RANDOM_BYTES)}")


@contextmanager
def _errors_about(target: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        if error.filename is None:
            error.filename = str(target)
        raise
