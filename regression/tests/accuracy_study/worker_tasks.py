"""Tasks of the tests of worker processes, in a file of their own: each process imports it, and little else."""

from __future__ import annotations

import os
import signal
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Note:
    """Writes its file; its process is killed before that the first ``deaths`` times."""

    folder: Path
    number: int
    deaths: int = 0

    def __call__(self) -> None:
        tried = self.folder / f"tried-{self.number}"
        count = len(tried.read_text()) if tried.exists() else 0
        tried.write_text("x" * (count + 1))
        if count < self.deaths:
            os.kill(os.getpid(), signal.SIGKILL)
        (self.folder / f"done-{self.number}").write_text(str(os.getpid()))


@dataclass(frozen=True)
class Wrong:
    """Raises."""

    def __call__(self) -> None:
        raise ValueError("wrong")
