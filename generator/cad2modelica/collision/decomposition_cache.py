"""Entries of the decomposition cache: one file a decomposition, named by what it was computed from."""

from __future__ import annotations

import contextlib
import hashlib
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from contact_foundation.output import whole_file
from numpy.typing import NDArray

from cad2modelica.geometry.spatial import Array

FORMAT = 1


def content_key(tool: str, task: Mapping[str, NDArray[Any] | np.generic]) -> str:
    """A name that changes with the tool's version and with every byte of the task."""
    digest = hashlib.sha256(f"{FORMAT} {tool}".encode())
    for name in sorted(task):
        array = np.asarray(task[name])
        digest.update(f"\n{name} {array.dtype.str} {array.shape}\n".encode())
        digest.update(array.tobytes())
    return digest.hexdigest()


def read_pieces(entry: Path) -> tuple[Array, ...] | None:
    """The pieces of an entry, which may be none; None if there is no entry, or it is not what was written."""
    try:
        content = json.loads(entry.read_text(encoding="utf-8"))
        if content["digest"] != _digest(content["pieces"]):
            return None
        pieces = tuple(np.array(piece, dtype=np.float64) for piece in content["pieces"])
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return None
    sound = all(piece.ndim == 2 and piece.shape[1] == 3 and np.isfinite(piece).all() for piece in pieces)
    return pieces if sound else None


def write_pieces(entry: Path, pieces: tuple[Array, ...]) -> None:
    """Writes an entry whole or not at all; a cache that cannot be written to is no error."""
    rows = [piece.tolist() for piece in pieces]
    text = json.dumps({"digest": _digest(rows), "pieces": rows}) + "\n"
    with contextlib.suppress(OSError), whole_file(entry) as staging:
        staging.write_text(text, encoding="utf-8")


def _digest(rows: object) -> str:
    return hashlib.sha256(json.dumps(rows).encode()).hexdigest()
