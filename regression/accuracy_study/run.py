"""What worker processes do: one tight trajectory, or one run of the grid, each written as soon as it is whole."""

from __future__ import annotations

import statistics
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from contact_foundation.errors import CmbError, SimulationError
from fmu_regression.compare.provenance import load
from fmu_regression.fmi.binding import Mode
from fmu_regression.fmi.description import StartValue
from fmu_regression.results.result import SimulationResult, read_csv
from fmu_regression.simulate.simulation import simulate

from accuracy_study.answers import ClosedForm, Error, GivenTrajectory, closed_form_error, trajectory_error
from accuracy_study.store import Outcome, Store, Tight, key_of

_CHECK = 10.0
"""By how much looser the run is that tells how far a tight trajectory can be trusted."""
_DETAIL = 20
"""Rows for each output interval in the run that shows penetration and energy between them."""
_WALL_BY_CPU = 20.0
"""Wall time over processor time from which on a run is given up too: one that waits for ever."""
_UNSEEN = 3
"""Runs more than wanted, where the clock saw no time pass."""
_LONG = 1.0
"""Processor time of a run that is not repeated, s: its spread says nothing that is looked for."""
_TIGHT_TIME = 10.0
"""How many times longer than a run of the grid a tight trajectory may take."""


@dataclass(frozen=True)
class Experiment:
    """How a variant is simulated.

    Attributes:
        fmu: the file.
        digest: of its content.
        start_values: by name.
        start, stop, interval: s.
        recorded: every signal that is needed.
        compared: those by which trajectories are compared.
        time_limit: processor time, s.
    """

    fmu: Path
    digest: str
    start_values: Mapping[str, StartValue]
    start: float
    stop: float
    interval: float
    recorded: tuple[str, ...]
    compared: tuple[str, ...]
    time_limit: float

    def simulate(
        self, solver: Mode, tolerance: float, max_step: float | None = None, patience: float = 1.0, detail: int = 1
    ) -> SimulationResult:
        """Simulates the variant.

        Args:
            solver, tolerance, max_step: how.
            patience: multiplies the time limit.
            detail: rows for each output interval; in model exchange the steps are the same with any number.

        Raises:
            SimulationError: it failed or took too long.
        """
        return simulate(
            self.fmu,
            signals=self.recorded,
            start=self.start,
            stop=self.stop,
            tolerance=tolerance,
            interval=self.interval / detail,
            mode=solver,
            max_step=self.interval if max_step is None and detail > 1 else max_step,
            parameters=self.start_values,
            time_limit=_WALL_BY_CPU * patience * self.time_limit,
            cpu_limit=patience * self.time_limit,
        )

    def described(self) -> dict[str, Any]:
        """All of it that determines what comes out."""
        return {
            "fmu": self.digest,
            "start_values": dict(self.start_values),
            "span": [self.start, self.stop, self.interval],
            "recorded": self.recorded,
            "compared": self.compared,
            "cpu_limit": self.time_limit,
        }


@dataclass(frozen=True)
class TightTask:
    """Computes the tight trajectory of a variant."""

    folder: Path
    experiment: Experiment
    solver: Mode
    tolerance: float

    @property
    def key(self) -> str:
        """Of the trajectory in the store."""
        return key_of({"tight": [self.solver, self.tolerance], **self.experiment.described()})

    def __call__(self) -> None:
        """Computes and keeps it; a failure is kept too."""
        Store(self.folder).keep_tight(self.key, self._compute())

    def _compute(self) -> Tight:
        try:
            truth = self.experiment.simulate(self.solver, self.tolerance, patience=_TIGHT_TIME)
            check = self.experiment.simulate(self.solver, _CHECK * self.tolerance, patience=_TIGHT_TIME)
            return Tight(truth, trajectory_error(truth, check, self.experiment.compared).value, "")
        except CmbError as error:
            return Tight(None, None, first_line(error))


@dataclass(frozen=True)
class RunTask:
    """Carries out one run of the grid.

    Attributes:
        folder: of the store.
        experiment, solver, tolerance, max_step: what is run.
        repeats: how often.
        reference: what the error is measured against; None: the tight trajectory ``base``.
        base: key of the scene's tight trajectory with the first value of every knob.
        own: key of the tight trajectory of the same variant.
        energy: variable with the total energy, or "".
        distances: variables with the signed distances.
        mark: of what lies outside and determines the error, as the content of a given trajectory.
    """

    folder: Path
    experiment: Experiment
    solver: Mode
    tolerance: float
    max_step: float | None
    repeats: int
    reference: ClosedForm | GivenTrajectory | None
    base: str
    own: str
    energy: str
    distances: tuple[str, ...]
    mark: str

    @property
    def key(self) -> str:
        """Of the outcome in the store."""
        return key_of(
            {
                "run": [self.solver, self.tolerance, self.max_step, self.repeats],
                "reference": self.mark,
                "base": self.base,
                "own": self.own,
                "energy": self.energy,
                **self.experiment.described(),
            }
        )

    def __call__(self) -> None:
        """Runs and keeps the outcome; a failure is one too."""
        store = Store(self.folder)
        try:
            outcome = self._run(store)
        except CmbError as error:
            outcome = Outcome(failure=first_line(error))
        store.keep_outcome(self.key, outcome)

    def _run(self, store: Store) -> Outcome:
        result = self.experiment.simulate(self.solver, self.tolerance, self.max_step)
        times = measured_times(
            result.cpu_time,
            lambda: self.experiment.simulate(self.solver, self.tolerance, self.max_step).cpu_time,
            self.repeats,
        )
        error = measured_error(store, self.reference, self.base, self.experiment.compared, result)
        counters = result.counters
        fine = result
        if self.solver == "me" and (self.energy or self.distances):
            fine = self.experiment.simulate("me", self.tolerance, self.max_step, detail=_DETAIL)
        own = store.tight(self.own)
        solver_error = None
        if own is not None and own.trajectory is not None:
            solver_error = trajectory_error(own.trajectory, result, self.experiment.compared).value
        return Outcome(
            error=error.value,
            worst=error.worst,
            solver_error=solver_error,
            steps=counters.steps if counters else None,
            rejected=counters.error_test_failures + counters.convergence_failures if counters else None,
            evaluations=counters.evaluations if counters else None,
            jacobians=counters.jacobians if counters else None,
            events=counters.state_events + counters.time_events if counters else None,
            energy_rise=_rise(fine[self.energy]) if self.energy else None,
            penetration=_deepest(fine, self.distances),
            cpu_time=statistics.median(times) if times else None,
            cpu_times=tuple(times),
            load=load(),
        )


def measured_error(
    store: Store,
    reference: ClosedForm | GivenTrajectory | None,
    base: str,
    compared: tuple[str, ...],
    result: SimulationResult,
) -> Error:
    """How far a run is from the reference of its scene.

    Raises:
        SimulationError: the reference could not be computed, or the run does not reach it.
    """
    if isinstance(reference, ClosedForm):
        return closed_form_error(reference, result)
    if isinstance(reference, GivenTrajectory):
        return trajectory_error(read_csv(reference.path), result, compared)
    tight = store.tight(base)
    if tight is None or tight.trajectory is None:
        raise SimulationError(f"the reference failed: {tight.failure if tight else 'it is missing'}")
    return trajectory_error(tight.trajectory, result, compared)


def first_line(error: CmbError) -> str:
    """What failed, in one line."""
    return error.message.splitlines()[0]


def measured_times(first: float | None, again: Callable[[], float | None], repeats: int) -> list[float]:
    """Processor times of repeated runs, s, but those that the clock did not see, as happens on virtual machines.

    Args:
        first: of the run that was made already.
        again: makes another one.
        repeats: how many are wanted; one of a run that takes long.
    """
    times = [first] if first else []
    for _ in range(repeats - 1 + _UNSEEN):
        if len(times) >= repeats or (times and times[0] >= _LONG):
            break
        time = again()
        times += [time] if time else []
    return times


def _rise(energy: np.ndarray[Any, np.dtype[np.float64]]) -> float:
    return float(np.max(energy - np.minimum.accumulate(energy)))


def _deepest(result: SimulationResult, distances: tuple[str, ...]) -> float | None:
    if not distances:
        return None
    return max(0.0, -min(float(result[name].min()) for name in distances))
