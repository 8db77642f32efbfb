"""Simulating an FMU: the entry point for both kinds."""

from __future__ import annotations

import math
import time as clock
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NoReturn

from contact_foundation.errors import InputError, Place, SimulationError
from contact_foundation.progress import Progress, silent

from fmu_regression.fmi.binding import Mode
from fmu_regression.fmi.description import ModelDescription, StartValue, check_signals, check_start_values
from fmu_regression.fmi.fmu import open_fmu
from fmu_regression.results.result import SimulationResult, SolverCounters
from fmu_regression.simulate.co_simulation import step_through
from fmu_regression.simulate.grid import output_grid
from fmu_regression.simulate.limited_process import run_limited
from fmu_regression.simulate.model_exchange import integrate

DEFAULT_TOLERANCE = 1e-6
DEFAULT_ROWS = 500
MAX_ROWS = 20_000_000
_PROGRESS_PERIOD = 0.1
_LONGEST_STEP = "cmbSolver.maximumStep"
"""The parameter by which FMUs of ContactMultiBody limit their own solver."""


def simulate(
    fmu: Path,
    *,
    signals: Sequence[str] | None = None,
    start: float | None = None,
    stop: float | None = None,
    tolerance: float | None = None,
    interval: float | None = None,
    mode: Mode = "me",
    max_step: float | None = None,
    parameters: Mapping[str, StartValue] | None = None,
    time_limit: float | None = None,
    cpu_limit: float | None = None,
    progress: Progress = silent,
) -> SimulationResult:
    """Simulates an FMU.

    Args:
        fmu: the FMU file.
        signals: names to record; the outputs and states if None.
        start: start time in s; that of the FMU's default experiment, else 0, if None.
        stop: stop time in s; that of the FMU's default experiment, else 1, if None.
        tolerance: relative tolerance; that of the default experiment, else 1e-6, if None.
        interval: output interval in s; that of the default experiment, else a 500th of the time, if None.
        mode: "me" (model exchange, integrated by CVODE) or "cs" (co-simulation, the FMU integrates).
        max_step: longest step of the integrator in s; if None, the output interval for model exchange, so that a
            contact long enough to show in the output is not stepped over, and the FMU's own choice for co-simulation.
        parameters: start values by name.
        time_limit: seconds of wall time after which the simulation is given up. With a limit it runs in a process of
            its own, so that a step that does not return is stopped too, and a crash of the FMU is an error.
        cpu_limit: the same of processor time; together with ``time_limit`` only.
        progress: receives the phase "simulate" with the share of the time that is done.

    Returns:
        the signals at every output time and, for model exchange, before and after every event. Nothing is thinned.

    Raises:
        InputError: the file, a name or a number is wrong.
        SimulationError: the simulation failed, took too long or crashed.
    """
    with open_fmu(fmu) as opened:
        description = opened.description
        first = description.start if start is None else start
        last = stop if stop is not None else description.stop if description.stop is not None else first + 1.0
        accuracy = tolerance if tolerance is not None else description.tolerance or DEFAULT_TOLERANCE
        step = interval if interval is not None else description.interval or (last - first) / DEFAULT_ROWS
        _check_numbers(fmu, first, last, accuracy, step, max_step, time_limit, cpu_limit)
        grid = output_grid(first, last, step)
        variables = check_signals(description, default_signals(description) if signals is None else signals)
        values = check_start_values(description, parameters or {})

        def run(report: Progress) -> SimulationResult:
            began, began_cpu = clock.perf_counter(), clock.process_time()
            watch = _Watch(first, last, began, (time_limit, cpu_limit), report, description.name)
            counters: SolverCounters | None
            with opened.instantiate(mode) as instance:
                if mode == "me":
                    recorder, counters = integrate(instance, variables, grid, accuracy, values, max_step or step, watch)
                else:
                    recorder, counters = step_through(
                        instance, variables, grid, accuracy, _with_longest_step(description, values, max_step), watch
                    )
                log = tuple(instance.told())
                wall_time, cpu_time = clock.perf_counter() - began, clock.process_time() - began_cpu
            time, columns = recorder.table()
            report("simulate", 1.0)
            return SimulationResult(
                time=time,
                signals=columns,
                model=description.name,
                mode=mode,
                tolerance=accuracy,
                interval=step,
                counters=counters,
                wall_time=wall_time,
                cpu_time=cpu_time,
                log=log,
                units={variable.name: variable.unit for variable in variables if variable.unit},
            )

        if time_limit is None:
            return run(progress)
        return run_limited(run, time_limit, progress, description.name, cpu_limit)


def default_signals(description: ModelDescription) -> list[str]:
    """The outputs and continuous states of an FMU, in the order of the description."""
    states = set(description.states)
    return [
        v.name
        for v in description.variables.values()
        if v.kind != "String" and (v.causality == "output" or v.name in states)
    ]


def _with_longest_step(
    description: ModelDescription, values: Mapping[str, StartValue], max_step: float | None
) -> Mapping[str, StartValue]:
    if max_step is None or _LONGEST_STEP not in description.variables:
        return values
    return {_LONGEST_STEP: max_step, **values}


class _Watch:
    """Reports progress, not too often, and stops a run that takes too long."""

    def __init__(
        self,
        first: float,
        last: float,
        began: float,
        limits: tuple[float | None, float | None],
        progress: Progress,
        model: str,
    ) -> None:
        self._first, self._last, self._began = first, last, began
        self._limit, self._cpu_limit = limits
        self._began_cpu = clock.process_time()
        self._progress, self._model = progress, model
        self._reported = began

    def __call__(self, time: float) -> None:
        now = clock.perf_counter()
        if now - self._reported < _PROGRESS_PERIOD:
            return
        self._reported = now
        self._progress("simulate", (time - self._first) / (self._last - self._first), f"t = {time:.4g} s")
        if self._limit is not None and now - self._began > self._limit:
            self._give_up(f"{self._limit:g} s of wall time", time)
        if self._cpu_limit is not None and clock.process_time() - self._began_cpu > self._cpu_limit:
            self._give_up(f"{self._cpu_limit:g} s of processor time", time)

    def _give_up(self, limit: str, time: float) -> NoReturn:
        raise SimulationError(f"given up after {limit} at t = {time:.6g}", place=Place(component=self._model))


def _check_numbers(
    fmu: Path,
    start: float,
    stop: float,
    tolerance: float,
    interval: float,
    max_step: float | None,
    time_limit: float | None,
    cpu_limit: float | None,
) -> None:
    place = Place(file=fmu)
    for name, time in (("start", start), ("stop", stop)):
        if not math.isfinite(time):
            raise InputError(f"the {name} time {time:g} must be finite", place=place)
    if not stop > start:
        raise InputError(f"the stop time {stop:g} must be greater than the start time {start:g}", place=place)
    if not 0 < tolerance < 1:
        raise InputError(f"the tolerance {tolerance:g} must lie between 0 and 1", place=place)
    if time_limit is not None and not 0 < time_limit < math.inf:
        raise InputError(f"the time limit {time_limit:g} must be positive and finite", place=place)
    if cpu_limit is not None and (time_limit is None or not 0 < cpu_limit < math.inf):
        raise InputError(
            f"the limit of processor time {cpu_limit:g} must be positive and finite, beside a time limit", place=place
        )
    if not interval > 0:
        raise InputError(f"the output interval {interval:g} must be positive", place=place)
    if max_step is not None and not max_step > 0:
        raise InputError(f"the longest step {max_step:g} must be positive", place=place)
    if (stop - start) / interval > MAX_ROWS:
        raise InputError(f"the output interval {interval:g} gives more than {MAX_ROWS} rows", place=place)
