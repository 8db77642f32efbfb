"""Many hard cases: workers, progress, the rows in the order of their seeds."""

from __future__ import annotations

import time as clock
from collections.abc import Sequence
from pathlib import Path
from typing import Final

from accuracy_study.store import Store
from contact_foundation.progress import Progress, silent
from fmu_regression.simulate.workers import carry_out

from hard_cases.expectation import expect
from hard_cases.knobs import RUNS_PER_STRUCTURE, hard_case
from hard_cases.run import Builder, Row, StructureTask, kept_verdict
from hard_cases.verdict import Kind, Verdict

DEFAULT_CPU_LIMIT: Final = 5.0
"""Processor time that a run may take if nothing else is asked for, s."""


def carry_out_cases(
    seeds: Sequence[int],
    build: Builder,
    folder: Path,
    cpu_limit: float = DEFAULT_CPU_LIMIT,
    jobs: int = 1,
    progress: Progress = silent,
) -> tuple[Row, ...]:
    """Carries out hard cases, or what is missing of them.

    Args:
        seeds: of the cases.
        build: builds FMUs; picklable.
        folder: keeps every row as soon as it is whole; what is found there is not run again, unless its FMU changed.
        cpu_limit: processor time that a run may take, s.
        jobs: worker processes; the task of one that is killed is repeated.
        progress: receives the phase "structures".

    Returns:
        a row for each seed.

    Raises:
        InputError: the folder exists and is not that of a study.
    """
    Store(folder).prepare()
    structures: dict[int, list[int]] = {}
    for seed in seeds:
        structures.setdefault(seed // RUNS_PER_STRUCTURE, []).append(seed)
    tasks = [StructureTask(folder, number, tuple(own), cpu_limit, build) for number, own in structures.items()]
    began = clock.monotonic()

    def done(count: int) -> None:
        left = (clock.monotonic() - began) / count * (len(tasks) - count)
        progress("structures", count / len(tasks), f"{count} of {len(tasks)}, {left:.0f} s left")

    lost = {tasks[entry.number].structure: entry.cause for entry in carry_out(tasks, jobs, done)}
    rows = []
    for seed in seeds:
        case = hard_case(seed)
        cause = lost.get(seed // RUNS_PER_STRUCTURE, "its row is missing")
        verdict = kept_verdict(folder, seed) or Verdict(Kind.CRASHED, f"the worker: {cause}")
        rows.append(Row(case, expect(case), verdict))
    return tuple(rows)
