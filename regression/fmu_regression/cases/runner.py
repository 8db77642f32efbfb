"""Running regression cases."""

from __future__ import annotations

import pickle
import tempfile
import time as clock
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from enum import Enum
from pathlib import Path

from contact_foundation.errors import CmbError
from contact_foundation.output import whole_file
from contact_foundation.progress import Progress, silent

from fmu_regression.cases.case import Case, find_cases, load_case
from fmu_regression.compare.checks import Outcome
from fmu_regression.compare.comparison import evaluate
from fmu_regression.fmi.binding import Mode
from fmu_regression.results.result import SimulationResult, read_csv
from fmu_regression.simulate.simulation import simulate
from fmu_regression.simulate.workers import carry_out


class Verdict(Enum):
    """How a case came out."""

    PASSED = "passed"
    FAILED = "failed"
    ERROR = "error"
    SKIPPED = "skipped"


@dataclass(frozen=True)
class Skip:
    """Why a case cannot be run here."""

    reason: str


@dataclass(frozen=True)
class RunResult:
    """One simulation of a case.

    Attributes:
        mode: "me" or "cs".
        outcomes: of the checks, in the case's order; empty if the simulation failed.
        result: the simulation, or None if it failed.
        error: why it failed, or "".
    """

    mode: Mode
    outcomes: tuple[Outcome, ...] = ()
    result: SimulationResult | None = None
    error: str = ""

    @property
    def verdict(self) -> Verdict:
        """Passed only if the simulation ended and every check holds."""
        if self.error:
            return Verdict.ERROR
        return Verdict.PASSED if all(outcome.passed for outcome in self.outcomes) else Verdict.FAILED


@dataclass(frozen=True)
class CaseResult:
    """What came out of a case.

    Attributes:
        name: of the case.
        case: the case, or None if its file is wrong.
        runs: one for each mode; empty if it did not come to that.
        reference: what was compared with, if anything.
        error: why it did not come to a run, or "".
        skipped: why it was not tried, or "".
    """

    name: str
    case: Case | None
    runs: tuple[RunResult, ...] = ()
    reference: SimulationResult | None = None
    error: str = ""
    skipped: str = ""

    @property
    def verdict(self) -> Verdict:
        """The worst of its runs."""
        if self.error:
            return Verdict.ERROR
        if self.skipped:
            return Verdict.SKIPPED
        verdicts = [run.verdict for run in self.runs]
        return next((v for v in (Verdict.ERROR, Verdict.FAILED) if v in verdicts), Verdict.PASSED)


FmuProvider = Callable[[Case], Path | Skip]


def run_case(case: Case, fmu: Path, *, time_limit: float | None = None, progress: Progress = silent) -> CaseResult:
    """Simulates a case in each of its modes and carries out its checks.

    Nothing is raised for a simulation that fails: that is an outcome too.

    Args:
        case: the case.
        fmu: the FMU of its model.
        time_limit: wall time in s for each simulation.
        progress: see ``simulate``.
    """
    try:
        reference = read_csv(case.reference) if case.reference is not None else None
    except CmbError as error:
        return CaseResult(case.name, case, error=str(error))
    runs = tuple(_run(case, mode, fmu, reference, time_limit, progress) for mode in case.modes)
    return CaseResult(case.name, case, runs=runs, reference=reference)


def run_cases(
    folder: Path,
    provide: FmuProvider,
    *,
    time_limit: float | None = None,
    jobs: int = 1,
    progress: Progress = silent,
) -> tuple[CaseResult, ...]:
    """Runs all cases below a folder, in the order of their paths.

    Args:
        folder: holds the TOML files.
        provide: gives the FMU of a case, or says why it is skipped; a CmbError that it raises is the case's outcome.
            With several processes it must be picklable.
        time_limit: wall time in s for each simulation.
        jobs: processes; with several, the cases of one that is killed are repeated.
        progress: receives the phase "cases" and, with one process, those of ``simulate``.

    Raises:
        InputError: there is no such folder or it holds no case.
    """
    paths = find_cases(folder)
    names = [path.relative_to(folder).with_suffix("").as_posix() for path in paths]
    if jobs > 1 and len(paths) > 1:
        return _in_processes(paths, names, provide, time_limit, jobs, progress)
    results = []
    for k, (path, name) in enumerate(zip(paths, names, strict=True)):
        progress("cases", k / len(paths), name)
        results.append(_run_file(path, name, provide, time_limit, progress))
    progress("cases", 1.0)
    return tuple(results)


@dataclass(frozen=True)
class _CaseTask:
    """Runs a case in a worker process and leaves its result in a file."""

    path: Path
    name: str
    provide: FmuProvider
    time_limit: float | None
    target: Path

    def __call__(self) -> None:
        result = _run_file(self.path, self.name, self.provide, self.time_limit, silent)
        with whole_file(self.target) as staging:
            staging.write_bytes(pickle.dumps(replace(result, case=None)))

    def result(self) -> CaseResult:
        """What it left, with the case, which is read again, as a case's mappings are not picklable."""
        left: CaseResult = pickle.loads(self.target.read_bytes())
        try:
            return replace(left, case=load_case(self.path))
        except CmbError:
            return left  # whose error says so


def _in_processes(
    paths: Sequence[Path],
    names: Sequence[str],
    provide: FmuProvider,
    time_limit: float | None,
    jobs: int,
    progress: Progress,
) -> tuple[CaseResult, ...]:
    began = clock.monotonic()

    def done(count: int) -> None:
        left = (clock.monotonic() - began) / count * (len(paths) - count)
        progress("cases", count / len(paths), f"{count} of {len(paths)}, {left:.0f} s left")

    with tempfile.TemporaryDirectory(prefix="cmb-cases-") as folder:
        tasks = [
            _CaseTask(path, name, provide, time_limit, Path(folder) / f"{k}.pickle")
            for k, (path, name) in enumerate(zip(paths, names, strict=True))
        ]
        lost = {entry.number: entry.cause for entry in carry_out(tasks, min(jobs, len(tasks)), done)}
        return tuple(
            CaseResult(task.name, None, error=f"its process was ended again and again: {lost[k]}")
            if k in lost
            else task.result()
            for k, task in enumerate(tasks)
        )


def _run_file(path: Path, name: str, provide: FmuProvider, time_limit: float | None, progress: Progress) -> CaseResult:
    try:
        case = load_case(path)
    except CmbError as error:
        return CaseResult(name, None, error=str(error))
    try:
        fmu = provide(case)
    except CmbError as error:
        return CaseResult(case.name, case, error=str(error))
    if isinstance(fmu, Skip):
        return CaseResult(case.name, case, skipped=fmu.reason)
    return run_case(case, fmu, time_limit=time_limit, progress=progress)


def _run(
    case: Case,
    mode: Mode,
    fmu: Path,
    reference: SimulationResult | None,
    time_limit: float | None,
    progress: Progress,
) -> RunResult:
    try:
        result = simulate(
            fmu,
            signals=case.signals,
            start=case.start,
            stop=case.stop,
            tolerance=case.tolerance,
            interval=case.interval,
            mode=mode,
            max_step=case.max_step,
            parameters=case.parameters,
            time_limit=time_limit,
            progress=progress,
        )
    except CmbError as error:
        return RunResult(mode, error=str(error))
    outcomes = tuple(evaluate(check, result, reference, case.time_tolerance) for check in case.checks)
    return RunResult(mode, outcomes, result)
