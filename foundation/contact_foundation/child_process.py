"""Programs that work on what unknown hands gave: in a process of their own, with limits on time and memory."""

from __future__ import annotations

import resource
import signal
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class ChildLimits:
    """What a process may take.

    Attributes:
        cpu: processor time, s: what comes of it does not depend on what else the machine does.
        wall: time by the clock, s.
        memory: address space, bytes; None: all there is.
    """

    cpu: int
    wall: float
    memory: int | None = None


@dataclass(frozen=True)
class ChildEnd:
    """How a process ended.

    Attributes:
        status: its exit status, negative for a signal.
        overran: "cpu" or "wall" where it took longer, else "".
        complaint: the last line of its standard error.
    """

    status: int
    overran: str
    complaint: str


def run_child(command: Sequence[str], limits: ChildLimits, folder: Path | None = None) -> ChildEnd:
    """Runs a program to its end, which is at its limits at the latest.

    Args:
        command: program and arguments.
        limits: what it may take.
        folder: where it runs; None: here.
    """
    with subprocess.Popen(command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as process:
        try:
            resource.prlimit(process.pid, resource.RLIMIT_CPU, (limits.cpu, limits.cpu + 1))
            resource.prlimit(process.pid, resource.RLIMIT_CORE, (0, 0))
            if limits.memory is not None:
                resource.prlimit(process.pid, resource.RLIMIT_AS, (limits.memory, limits.memory))
            _, complaints = process.communicate(timeout=limits.wall)
        except subprocess.TimeoutExpired:
            return ChildEnd(-signal.SIGKILL, "wall", "no message")
        finally:
            process.kill()
    last = (complaints.strip().splitlines() or ["no message"])[-1]
    return ChildEnd(process.returncode, "cpu" if process.returncode == -signal.SIGXCPU else "", last)
