"""Worker processes, one a program, that answer one request after the other; one that hangs is ended and replaced."""

from __future__ import annotations

import json
import os
import select
import subprocess
import tempfile
import time
from collections.abc import Sequence
from importlib.resources import files
from pathlib import Path
from typing import Any, Final

from contact_foundation.errors import CmbError

_PACKAGES: Final = Path(str(files("peer_bench"))).parent
_START_LIMIT: Final = 120.0


class Program:
    """A program in a process of its own.

    Args:
        python: interpreter that has it.
        module: beginning of the name of its module.
        paths: where the interpreter finds packages beside its own.
    """

    def __init__(self, python: Path, module: str, paths: Sequence[Path] = ()) -> None:
        self._command = [os.path.abspath(python), "-m", "peer_bench.worker", module]
        self._environment = dict(os.environ, PYTHONPATH=os.pathsep.join(map(str, (_PACKAGES, *paths))))
        self._process: subprocess.Popen[bytes] | None = None
        self._unread = b""
        self.version = ""
        self.missing = ""

    def start(self) -> None:
        """Starts the process; ``version`` tells what it has, ``missing`` why it does not."""
        self._process = subprocess.Popen(
            self._command,
            env=self._environment,
            cwd=tempfile.gettempdir(),  # some write logs into the folder where they run
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
        )
        self._unread = b""
        first = self._line(_START_LIMIT)
        found = json.loads(first) if first else {"missing": "its process ended at once"}
        self.version, self.missing = str(found.get("version", "")), str(found.get("missing", ""))

    def ask(self, scene: str, settings: dict[str, float | str], limit: float) -> dict[str, Any]:
        """Has a scene simulated.

        Args:
            scene: name.
            settings: of the program.
            limit: wall time, s.

        Returns:
            values, cpu_time and work, or failure.

        Raises:
            CmbError: the program is missing.
        """
        if self._process is None:
            self.start()
        if self.missing:
            raise CmbError(f"the program is missing: {self.missing}")
        assert self._process is not None
        assert self._process.stdin is not None
        line: bytes | None
        try:
            self._process.stdin.write(json.dumps({"scene": scene, "settings": settings}).encode() + b"\n")
            self._process.stdin.flush()
            line = self._line(limit)
        except OSError:
            line = b""
        if line:
            answer: dict[str, Any] = json.loads(line)
            return answer
        self.close()
        return {"failure": f"given up after {limit:g} s of wall time" if line is None else "its process crashed"}

    def close(self) -> None:
        """Ends the process."""
        if self._process is not None:
            self._process.kill()
            self._process.communicate()
            self._process = None

    def _line(self, limit: float) -> bytes | None:
        """The next line; None where none came in time, b"" where the process ended."""
        assert self._process is not None
        assert self._process.stdout is not None
        descriptor, end = self._process.stdout.fileno(), time.monotonic() + limit
        while b"\n" not in self._unread:
            ready, _, _ = select.select([descriptor], [], [], max(0.0, end - time.monotonic()))
            if not ready:
                return None
            more = os.read(descriptor, 1 << 16)
            if not more:
                return b""
            self._unread += more
        line, self._unread = self._unread.split(b"\n", 1)
        return line
