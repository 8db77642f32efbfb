"""Worker processes that carry out tasks; the task of one that is killed is repeated."""

from __future__ import annotations

import multiprocessing
import signal
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from typing import Final

from fmu_regression.simulate.limited_process import end_with_parent

Task = Callable[[], object]
_TRIES: Final = 3


@dataclass(frozen=True)
class Lost:
    """The number of a task whose process died each time that it was tried, and how."""

    number: int
    cause: str


@dataclass
class _Worker:
    process: BaseProcess
    connection: Connection
    task: int


def carry_out(tasks: Sequence[Task], jobs: int, done: Callable[[int], None]) -> list[Lost]:
    """Carries out tasks in processes of their own, each of which ends with this one, however that ends.

    Args:
        tasks: picklable; each leaves behind what it finds, and does no harm when it is repeated.
        jobs: processes at a time.
        done: called with the number of tasks that are done, each time that this changes.

    Returns:
        the tasks that were tried three times and whose process died each time.

    Raises:
        Exception: what a task raised.
    """
    waiting = deque(range(len(tasks)))
    tries = [0] * len(tasks)
    lost: list[Lost] = []
    finished = 0
    workers: list[_Worker] = []
    context = multiprocessing.get_context("spawn")
    try:
        while waiting or workers:
            while waiting and len(workers) < jobs:
                workers.append(_started(context))
                _give(workers[-1], waiting.popleft(), tasks, tries)
            ready = wait([worker.connection for worker in workers])
            for worker in [w for w in workers if w.connection in ready]:
                try:
                    error = worker.connection.recv()
                except (EOFError, OSError):
                    cause = _ended(worker)
                    workers.remove(worker)
                    if tries[worker.task] < _TRIES:
                        waiting.appendleft(worker.task)
                    else:
                        lost.append(Lost(worker.task, cause))
                        finished += 1
                        done(finished)
                    continue
                if error is not None:
                    raise error
                finished += 1
                done(finished)
                if waiting:
                    _give(worker, waiting.popleft(), tasks, tries)
                else:
                    workers.remove(worker)
                    _ended(worker)
    finally:
        for worker in workers:
            worker.process.kill()
            _ended(worker)
    return lost


def _started(context: multiprocessing.context.SpawnContext) -> _Worker:
    here, there = context.Pipe()
    # No daemon: a run has a process of its own, which daemons may not have.
    process = context.Process(target=_serve, args=(there,), daemon=False)
    process.start()
    there.close()
    return _Worker(process, here, -1)


def _give(worker: _Worker, number: int, tasks: Sequence[Task], tries: list[int]) -> None:
    worker.task = number
    tries[number] += 1
    try:
        worker.connection.send(tasks[number])
    except OSError:
        return  # it died already, which the next look at it shows


def _ended(worker: _Worker) -> str:
    """Ends a worker that has nothing to do, or takes leave of a dead one; how it ended."""
    worker.connection.close()
    worker.process.join()
    code = worker.process.exitcode
    if code is not None and code < 0:
        return f"signal {signal.Signals(-code).name}"
    return f"status {code}"


def _serve(connection: Connection) -> None:
    end_with_parent()
    while True:
        try:
            task: Task = connection.recv()
        except EOFError:
            return
        try:
            task()
        except Exception as error:
            connection.send(error)
        else:
            connection.send(None)
