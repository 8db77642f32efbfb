"""Accuracy against work: a sweep of solver tolerances, measured against a much more accurate run."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from contact_foundation.errors import CmbError, InputError, SimulationError
from contact_foundation.progress import Progress, silent

from fmu_regression.compare.provenance import machine, versions
from fmu_regression.compare.trajectory_error import convergence_order, largest_differences, mean_square
from fmu_regression.fmi.binding import Mode
from fmu_regression.fmi.description import StartValue, read_description
from fmu_regression.results.result import SimulationResult, SolverCounters
from fmu_regression.scene.energy import energy_balance
from fmu_regression.scene.scene_file import Scene
from fmu_regression.scene.signals import signals_for
from fmu_regression.simulate.simulation import default_signals, simulate

DEFAULT_TOLERANCES = tuple(10.0**-k for k in range(3, 11))
_REFERENCE_TOLERANCE = 1e-12
_CHECK_TOLERANCE = 1e-11


@dataclass(frozen=True)
class AccuracyPoint:
    """One run of the sweep.

    Attributes:
        mode: "me" or "cs".
        tolerance: asked of the solver.
        error: largest difference from the reference, by the range of the signal; None if the run failed.
        worst_signal: the signal that shows it.
        mean_error: root of the mean square difference of all signals, by their ranges.
        wall_time: shortest of the repeated runs, s, initialization included.
        counters: the integrator's work (model exchange).
        energy_change: total energy at the end less that of the reference there, J, if the scene is known.
        energy_rise: largest rise of the total energy above an earlier value, J, if the scene is known.
        failure: why the run failed, or "".
    """

    mode: Mode
    tolerance: float
    error: float | None = None
    worst_signal: str = ""
    mean_error: float | None = None
    wall_time: float | None = None
    counters: SolverCounters | None = None
    energy_change: float | None = None
    energy_rise: float | None = None
    failure: str = ""


@dataclass(frozen=True)
class AccuracyStudy:
    """A sweep and what it was measured against.

    Attributes:
        model: name of the model.
        duration: s simulated.
        interval: output interval, s.
        signals: the signals that were compared.
        reference: how the reference was made.
        floor: difference of the reference from a second, slightly less accurate one: errors below it mean nothing.
        points: the runs, by mode, then from coarse to fine.
        machine: processor, cores and system.
        versions: name to version of the software that matters.
    """

    model: str
    duration: float
    interval: float
    signals: tuple[str, ...]
    reference: str
    floor: float
    points: tuple[AccuracyPoint, ...]
    machine: str
    versions: Mapping[str, str]

    def order(self, mode: Mode) -> float | None:
        """Exponent p of error ~ tolerance^p by least squares over the points well above the floor.

        None if fewer than three points are.
        """
        return convergence_order(((p.tolerance, p.error) for p in self.points if p.mode == mode), self.floor)


def study_accuracy(
    fmu: Path,
    *,
    signals: Sequence[str] | None = None,
    scene: Scene | None = None,
    stop: float | None = None,
    interval: float | None = None,
    tolerances: Sequence[float] = DEFAULT_TOLERANCES,
    modes: Sequence[Mode] = ("me", "cs"),
    max_step: float | None = None,
    parameters: Mapping[str, StartValue] | None = None,
    reference: SimulationResult | None = None,
    repeats: int = 1,
    time_limit: float | None = None,
    progress: Progress = silent,
) -> AccuracyStudy:
    """Runs an FMU at each tolerance in each mode.

    Args:
        fmu: the FMU.
        signals: what is compared; the outputs and continuous states if None.
        scene: if given, energies are followed too.
        stop, interval, max_step, parameters: see ``simulate``. After the first impact of a chaotic scene trajectories
            part from each other however accurate the solver is: choose the stop time before that.
        tolerances: relative tolerances, > 0.
        modes: "me", "cs" or both; those that the FMU does not offer become failed points.
        reference: a trajectory to measure against, for instance of another program; if None, model exchange (or, if
            the FMU has none, co-simulation) at tolerance 1e-12.
        repeats: how often each run is timed; the shortest time counts.
        time_limit: wall time for each run, s.
        progress: receives the phase "accuracy".

    Returns:
        the study; runs that failed are in it.

    Raises:
        InputError: the FMU or an argument is wrong.
        SimulationError: the reference cannot be computed.
    """
    if not tolerances or not all(0 < t < 1 for t in tolerances):
        raise InputError("tolerances must lie between 0 and 1")
    if repeats < 1:
        raise InputError("every run is needed at least once")
    description = read_description(fmu)
    compared = tuple(signals) if signals is not None else tuple(default_signals(description))
    if not compared:
        raise InputError(f"{description.name} has neither outputs nor states: name the signals to compare")
    recorded = list(dict.fromkeys([*compared, *(signals_for(scene, description) if scene is not None else [])]))

    def run(mode: Mode, tolerance: float) -> SimulationResult:
        return simulate(
            fmu,
            signals=recorded,
            stop=stop,
            interval=interval,
            tolerance=tolerance,
            mode=mode,
            max_step=max_step,
            parameters=parameters,
            time_limit=time_limit,
        )

    best: Mode = "me" if "me" in description.identifiers else "cs"
    progress("accuracy", 0.0, "reference")
    truth = reference
    if truth is None:
        truth = run(best, _REFERENCE_TOLERANCE)
        floor = max(largest_differences(run(best, _CHECK_TOLERANCE), truth, compared).values())
        origin = f"the same FMU, {best}, tolerance {_REFERENCE_TOLERANCE:g}"
    else:
        floor, origin = 0.0, f"given trajectory {reference.model if reference else ''}".strip()
    points: list[AccuracyPoint] = []
    count = len(modes) * len(tolerances)
    for mode in modes:
        for tolerance in sorted(tolerances, reverse=True):
            progress("accuracy", len(points) / count, f"{mode}, tolerance {tolerance:g}")
            try:
                results = [run(mode, tolerance) for _ in range(repeats)]
                points.append(_point(mode, tolerance, results, truth, compared, scene))
            except CmbError as error:
                points.append(AccuracyPoint(mode, tolerance, failure=str(error)))
    progress("accuracy", 1.0)
    return AccuracyStudy(
        model=description.name,
        duration=float(truth.time[-1] - truth.time[0]),
        interval=truth.interval or 0.0,
        signals=compared,
        reference=origin,
        floor=floor,
        points=tuple(points),
        machine=machine(),
        versions=versions(description.generation_tool),
    )


def _point(
    mode: Mode,
    tolerance: float,
    results: Sequence[SimulationResult],
    truth: SimulationResult,
    compared: Sequence[str],
    scene: Scene | None,
) -> AccuracyPoint:
    result = results[0]
    errors = largest_differences(result, truth, compared)
    worst = max(errors, key=lambda name: errors[name])
    if not math.isfinite(errors[worst]):
        raise SimulationError(f"{worst} is not finite, or the run ends before the reference")
    squares = [mean_square(result, truth, name) for name in compared]
    change = rise = None
    if scene is not None:
        energy = energy_balance(scene, result)
        change = float(energy.total[-1] - energy_balance(scene, truth).total[-1])
        rise = energy.largest_rise
    return AccuracyPoint(
        mode=mode,
        tolerance=tolerance,
        error=errors[worst],
        worst_signal=worst,
        mean_error=math.sqrt(sum(squares) / len(squares)),
        wall_time=min(r.wall_time or math.inf for r in results),
        counters=result.counters,
        energy_change=change,
        energy_rise=rise,
    )
