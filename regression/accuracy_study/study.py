"""Carrying out a study: FMUs, tight trajectories, runs, and what they add up to."""

from __future__ import annotations

import hashlib
import time as clock
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from contact_foundation.errors import CmbError, ProblemList
from contact_foundation.progress import Progress, silent
from fmu_regression.compare.provenance import machine, versions
from fmu_regression.compare.trajectory_error import convergence_order
from fmu_regression.fmi.binding import Mode
from fmu_regression.simulate.workers import Lost, Task, carry_out

from accuracy_study.answers import GivenTrajectory
from accuracy_study.attribution import VariantErrors, attribute
from accuracy_study.cluster import carry_out_on_cluster
from accuracy_study.definition import Scene, Study
from accuracy_study.grid import Run, Variant, base_variant, runs, variants
from accuracy_study.run import Experiment, RunTask, TightTask, first_line
from accuracy_study.scene_models import Builder, SceneModels
from accuracy_study.store import Outcome, Store

_TIGHTER = 1000.0
_TIGHTEST = 1e-12


@dataclass(frozen=True)
class Row:
    """A run of the grid and what it showed."""

    run: Run
    outcome: Outcome


@dataclass(frozen=True)
class SceneFindings:
    """What a study found about a scene.

    Attributes:
        scene: which.
        rows: in the order of the grid.
        errors: of each variant, without the solver's; where its FMU could not be built, the reason only.
        tight: tolerance of the tight trajectories.
    """

    scene: Scene
    rows: tuple[Row, ...]
    errors: Mapping[Variant, VariantErrors]
    tight: float

    def order(self, variant: Variant, solver: Mode, max_step: float | None) -> float | None:
        """Exponent p of solver error ~ tolerance^p, or None where too few points tell."""
        points = [
            (row.run.tolerance, row.outcome.solver_error)
            for row in self.rows
            if (row.run.variant, row.run.solver, row.run.max_step) == (variant, solver, max_step)
        ]
        return convergence_order(points, self.errors[variant].floor or 0.0)


@dataclass(frozen=True)
class Findings:
    """What a study found.

    Attributes:
        study: which.
        scenes: in its order.
        machine: processor, cores and system.
        versions: name to version of the software that matters.
    """

    study: Study
    scenes: tuple[SceneFindings, ...]
    machine: str
    versions: Mapping[str, str]


@dataclass(frozen=True)
class _Prepared:
    """A scene whose FMUs are built."""

    models: SceneModels
    experiments: Mapping[Variant, Experiment]
    failures: Mapping[Variant, str]
    tight: Mapping[Variant, TightTask]


def carry_out_study(
    study: Study, build: Builder, folder: Path, jobs: int = 1, progress: Progress = silent, scheduler: str = ""
) -> Findings:
    """Carries out a study, or what is missing of it.

    Args:
        study: which.
        build: builds FMUs.
        folder: keeps every run as soon as it is whole; what is found there is not run again.
        jobs: worker processes.
        progress: receives the phases "models", "trajectories" and "runs".
        scheduler: address of a scheduler of Dask, whose workers then do what worker processes here would, or "".

    Raises:
        ProblemList: a scene does not have what the study asks of it.
        InputError: the scheduler or its workers cannot be used.
        CmbError: the model of a scene, as it is, cannot be built or started.
    """
    store = Store(folder)
    store.prepare()
    prepared = _prepare(study, build, store, progress)
    tight = {task.key: task for scene in prepared for task in scene.tight.values()}
    missing = {key: task for key, task in tight.items() if store.tight(key) is None}
    carry = partial(carry_out_on_cluster, scheduler, folder) if scheduler else partial(_carry_out_here, jobs)
    _carry_out("trajectories", missing, carry, progress)
    tasks = {run: task for scene in prepared for run, task in _run_tasks(study, scene, folder).items()}
    to_do = {task.key: task for task in tasks.values() if store.outcome(task.key) is None}
    lost = _carry_out("runs", to_do, carry, progress)
    scenes = tuple(_findings(study, scene, store, tasks, lost) for scene in prepared)
    return Findings(study, scenes, machine(), versions(""))


def _prepare(study: Study, build: Builder, store: Store, progress: Progress) -> list[_Prepared]:
    """Builds every FMU; what is wrong with any scene is told before variants are built."""
    models: list[SceneModels] = []
    problems: list[CmbError] = []
    for k, scene in enumerate(study.scenes):
        progress("models", 0.3 * k / len(study.scenes), scene.name)
        models.append(SceneModels(study, scene, build, store.models))
        problems += models[-1].problems()
    if problems:
        raise ProblemList(str(study.path), problems)
    every = [(m, v) for m in models for v in variants(study, m.scene)]
    experiments: dict[str, dict[Variant, Experiment]] = {m.scene.name: {} for m in models}
    failures: dict[str, dict[Variant, str]] = {m.scene.name: {} for m in models}
    for k, (m, variant) in enumerate(every):
        progress("models", 0.3 + 0.7 * k / len(every), f"{m.scene.name}: {variant.label}")
        try:
            built = m.variant(variant)
        except CmbError as error:
            failures[m.scene.name][variant] = first_line(error)
            continue
        experiments[m.scene.name][variant] = Experiment(
            built.fmu,
            built.digest,
            built.start_values,
            m.start,
            m.stop,
            m.interval,
            m.recorded,
            m.compared,
            study.time_limit,
        )
    progress("models", 1.0)
    return [
        _Prepared(
            m,
            experiments[m.scene.name],
            failures[m.scene.name],
            {
                variant: TightTask(store.folder, experiment, m.modes[0], _tight_tolerance(m.scene))
                for variant, experiment in experiments[m.scene.name].items()
            },
        )
        for m in models
    ]


def _tight_tolerance(scene: Scene) -> float:
    return max(min(float(t) for t in scene.knobs["tolerance"]) / _TIGHTER, _TIGHTEST)


def _run_tasks(study: Study, prepared: _Prepared, folder: Path) -> dict[Run, RunTask]:
    """A task for each run whose FMU could be built."""
    scene = prepared.models.scene
    base = prepared.tight.get(base_variant(scene))
    reference = scene.reference
    mark = repr(reference)
    if isinstance(reference, GivenTrajectory):
        mark = hashlib.sha256(reference.path.read_bytes()).hexdigest()
    return {
        run: RunTask(
            folder,
            prepared.experiments[run.variant],
            run.solver,
            run.tolerance,
            run.max_step,
            study.repeats,
            reference,
            base.key if base is not None else "",
            prepared.tight[run.variant].key,
            prepared.models.energy,
            prepared.models.distances,
            mark,
        )
        for run in runs(study, scene)
        if run.variant in prepared.experiments
    }


_Carry = Callable[[Sequence[Task], Callable[[int], None]], list[Lost]]
"""Carries out tasks; calls the function with the number of those done; the tasks that were lost."""


def _carry_out_here(jobs: int, tasks: Sequence[Task], done: Callable[[int], None]) -> list[Lost]:
    return carry_out(tasks, min(jobs, len(tasks)), done)


def _carry_out(phase: str, by_key: Mapping[str, Task], carry: _Carry, progress: Progress) -> dict[str, str]:
    """Carries out tasks with progress and time left; by key, how the process of those ended that were lost."""
    keys, tasks = list(by_key), list(by_key.values())
    began = clock.monotonic()

    def done(count: int) -> None:
        left = (clock.monotonic() - began) / count * (len(tasks) - count)
        progress(phase, count / len(tasks), f"{count} of {len(tasks)}, {left:.0f} s left")

    lost = carry(tasks, done) if tasks else []
    progress(phase, 1.0, f"{len(tasks)} done now")
    return {keys[entry.number]: entry.cause for entry in lost}


def _findings(
    study: Study, prepared: _Prepared, store: Store, tasks: Mapping[Run, RunTask], lost: Mapping[str, str]
) -> SceneFindings:
    scene = prepared.models.scene
    keys = {variant: task.key for variant, task in prepared.tight.items()}
    errors: dict[Variant, VariantErrors] = {}
    for variant in variants(study, scene):
        if variant in prepared.failures:
            errors[variant] = VariantErrors(failure=prepared.failures[variant])
        else:
            errors[variant] = attribute(store, scene, keys, variant, prepared.models.compared, scene.reference)
    rows = []
    for run in runs(study, scene):
        task = tasks.get(run)
        if task is None:
            outcome = Outcome(failure=f"the model cannot be built: {prepared.failures[run.variant]}")
        else:
            found = store.outcome(task.key)
            cause = lost.get(task.key, "is missing")
            outcome = found or Outcome(failure=f"its process was ended again and again: {cause}")
        rows.append(Row(run, outcome))
    return SceneFindings(scene, tuple(rows), errors, _tight_tolerance(scene))
