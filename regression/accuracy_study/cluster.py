"""Tasks over a Dask cluster: each in a process of its own on a worker, its files in a folder that all see."""

from __future__ import annotations

import os
import pickle
import signal
import subprocess
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, Final

from contact_foundation.errors import CmbError, InputError, Place
from fmu_regression.simulate.workers import Lost, Task

_TRIES: Final = 3
_PATIENCE: Final = 20.0
"""For the scheduler's answer and for workers to come, s."""


def carry_out_on_cluster(address: str, folder: Path, tasks: Sequence[Task], done: Callable[[int], None]) -> list[Lost]:
    """Carries out tasks on the workers of a scheduler; the task of a worker or process that dies is repeated.

    Args:
        address: of the scheduler, ``tcp://host:8786``.
        folder: where tasks leave what they find; every worker must see it under the same path.
        tasks: picklable; each leaves behind what it finds, and does no harm when it is repeated.
        done: called with the number of tasks that are done, each time that this changes.

    Returns:
        the tasks whose process or worker died each time that they were tried.

    Raises:
        InputError: ``distributed`` is not installed, no scheduler answers, it has no worker, or one does not see the
            folder.
        Exception: what a task raised.
    """
    distributed = _distributed()
    try:
        client: Any = distributed.Client(address, timeout=_PATIENCE, set_as_default=False)
    except (OSError, ValueError, TimeoutError) as error:
        raise InputError(
            f"no scheduler of Dask answers at {address}: {' '.join(str(error).split())[:120]}",
            remedy="Start one with `dask scheduler` and workers with `dask worker ADDRESS`, in this environment.",
        ) from error
    with client, client.as_current():
        _check_workers(client, address, folder)
        lost: list[Lost] = []
        here = os.getcwd()
        futures = {
            client.submit(_in_process, pickle.dumps(task), here, pure=False, retries=_TRIES - 1): number
            for number, task in enumerate(tasks)
        }
        for count, future in enumerate(distributed.as_completed(list(futures)), start=1):
            if future.status == "error":
                lost.append(Lost(futures[future], " ".join(str(future.exception()).split())[:200]))
            else:
                raised = future.result()
                if raised is not None:
                    raise pickle.loads(raised)
            done(count)
    return lost


def _distributed() -> Any:
    try:
        import distributed
    except ImportError:
        raise InputError(
            "a scheduler needs the package distributed, which is not installed",
            remedy="Install it: pip install 'contactmultibody[cluster]'.",
        ) from None
    return distributed


def _check_workers(client: Any, address: str, folder: Path) -> None:
    try:
        client.wait_for_workers(1, timeout=_PATIENCE)
    except TimeoutError:
        raise InputError(
            f"the scheduler at {address} has no worker", remedy=f"Start some with `dask worker {address}`."
        ) from None
    for worker, sees in client.run(os.path.isdir, str(folder.resolve())).items():
        if not sees:
            raise InputError(
                f"the worker {worker} does not see the folder",
                place=Place(file=folder),
                remedy="Name an output folder that all machines share under one path.",
            )


class _Died(CmbError):
    """The process of a task died; the scheduler tries it again."""


def _in_process(task: bytes, folder: str) -> bytes | None:
    """Carries out a pickled task in a process of its own, as Dask's workers may have no children otherwise.

    Returns:
        None, or what it raised, pickled.
    """
    run = subprocess.run(
        [sys.executable, "-m", "accuracy_study.task_process"],
        input=task,
        cwd=folder,
        stdout=subprocess.PIPE,
        check=False,
    )
    if run.returncode < 0:
        raise _Died(f"signal {signal.Signals(-run.returncode).name}")
    if run.returncode:
        raise _Died(f"status {run.returncode}")
    return run.stdout or None
