"""Files and folders that appear whole or not at all."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from cmb_base.errors import InputError, Place

MARKER = ".written-by-cmb"


@contextmanager
def whole_folder(target: Path) -> Iterator[Path]:
    """Yields an empty folder that replaces ``target`` when the block ends without an error.

    The folder lies beside ``target`` until then, so the change of names is atomic for each of the
    two steps; an existing ``target`` is kept if the block fails. Only a folder that such a block wrote
    before (it carries a marker file) or an empty one is ever replaced.

    Raises:
        InputError: ``target`` exists and something else made it.
    """
    _refuse_foreign(target)
    target.parent.mkdir(parents=True, exist_ok=True)
    staging = Path(tempfile.mkdtemp(prefix=f".{target.name}.", dir=target.parent))
    try:
        staging.chmod(0o755)
        yield staging
        (staging / MARKER).touch()
        if target.exists():
            old = Path(tempfile.mkdtemp(prefix=f".{target.name}.old.", dir=target.parent))
            os.replace(target, old / target.name)
            os.replace(staging, target)
            shutil.rmtree(old, ignore_errors=True)
        else:
            os.replace(staging, target)
    finally:
        shutil.rmtree(staging, ignore_errors=True)


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
    """Yields a path to write to that replaces ``target`` when the block ends without an error."""
    target.parent.mkdir(parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(prefix=f".{target.name}.", dir=target.parent)
    os.close(handle)
    staging = Path(name)
    try:
        yield staging
        staging.chmod(0o644)
        os.replace(staging, target)
    finally:
        staging.unlink(missing_ok=True)
