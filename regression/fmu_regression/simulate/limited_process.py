"""Work in a process of its own that is given a time: what hangs is ended, what crashes is an error."""

from __future__ import annotations

import ctypes
import multiprocessing
import signal
import time
from collections.abc import Callable
from multiprocessing.connection import Connection
from typing import TypeVar

from contact_foundation.errors import CmbError, Place, SimulationError
from contact_foundation.progress import Progress

T = TypeVar("T")

_END_WITH_PARENT = 1  # PR_SET_PDEATHSIG of Linux
_LEAST_GRACE = 1.0
_SHARE_OF_GRACE = 0.1


def run_limited(
    work: Callable[[Progress], T], limit: float, progress: Progress, component: str, cpu_limit: float | None = None
) -> T:
    """Runs ``work`` in a forked process.

    Args:
        work: receives a progress; it should end by itself after ``limit``, with a better message than this can give.
        limit: wall time in s; a second, or a tenth of it, later the process is ended.
        progress: receives what the work reports.
        component: named in errors.
        cpu_limit: processor time in s, if that is limited too; the same grace later the process ends itself.

    Returns:
        What the work returns, which must be picklable.

    Raises:
        CmbError: the one that the work raised.
        SimulationError: the process was ended or crashed.
    """
    # Forked, so that nothing is imported anew; the work may be a closure over opened files.
    context = multiprocessing.get_context("fork")
    receiver, sender = context.Pipe(duplex=False)
    process = context.Process(target=_carry_out, args=(work, sender, cpu_limit), daemon=True)
    process.start()
    sender.close()
    place = Place(component=component)
    deadline = time.monotonic() + _with_grace(limit)
    try:
        while receiver.poll(max(deadline - time.monotonic(), 0.0)):
            kind, content = receiver.recv()
            if kind == "result":
                result: T = content
                return result
            if kind == "error":
                raise content
            progress(*content)
    except EOFError:
        process.join()
        if process.exitcode == -signal.SIGPROF:
            text = f"given up after {cpu_limit:g} s of processor time: a call of the FMU did not return"
            raise SimulationError(text, place=place) from None
        raise SimulationError(f"the simulation crashed: {_cause(process.exitcode)}", place=place) from None
    finally:
        if process.is_alive():
            process.kill()
        process.join()
        receiver.close()
    raise SimulationError(f"given up after {limit:g} s of wall time: a call of the FMU did not return", place=place)


def end_with_parent() -> None:
    """For the start of a process that the one above ends: signals of the terminal are left to that one."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    ctypes.CDLL(None).prctl(_END_WITH_PARENT, signal.SIGKILL)  # also if the parent has no time to


def _with_grace(limit: float) -> float:
    return limit + max(_LEAST_GRACE, _SHARE_OF_GRACE * limit)


def _carry_out(work: Callable[[Progress], T], sender: Connection, cpu_limit: float | None) -> None:
    def report(phase: str, fraction: float, message: str = "") -> None:
        sender.send(("progress", (phase, fraction, message)))

    end_with_parent()
    if cpu_limit is not None:
        signal.signal(signal.SIGPROF, signal.SIG_DFL)  # ends the process also within a call of the FMU
        signal.setitimer(signal.ITIMER_PROF, _with_grace(cpu_limit))
    try:
        sender.send(("result", work(report)))
    except CmbError as error:
        sender.send(("error", error))


def _cause(exit_code: int | None) -> str:
    if exit_code is not None and exit_code < 0:
        return f"signal {signal.Signals(-exit_code).name} in the FMU"
    return f"its process ended with status {exit_code}"
