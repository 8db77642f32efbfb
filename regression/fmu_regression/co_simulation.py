"""Stepping a co-simulation FMU over the grid of output times."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from fmpy.fmi1 import FMICallException

from fmu_regression.fmu import Instance, StartValue, Variable
from fmu_regression.recorder import Recorder
from fmu_regression.result import FloatArray, SolverCounters

_COUNTERS = {
    "steps": "cmbSolver.steps",
    "evaluations": "cmbSolver.evaluations",
    "jacobians": "cmbSolver.jacobians",
    "error_test_failures": "cmbSolver.errorTestFailures",
    "convergence_failures": "cmbSolver.convergenceFailures",
    "state_events": "cmbSolver.stateEvents",
    "time_events": "cmbSolver.timeEvents",
}


def step_through(
    instance: Instance,
    variables: Sequence[Variable],
    grid: FloatArray,
    tolerance: float,
    start_values: Mapping[str, StartValue],
    watch: Callable[[float], None],
) -> tuple[Recorder, SolverCounters | None]:
    """Simulates a fresh co-simulation instance; rows are recorded at the grid only, as FMI 2.0 shows no events.

    The counters are those that an FMU of ContactMultiBody shows as variables ``cmbSolver.*``; other FMUs have none.

    Args:
        instance: a fresh instance.
        variables: what to record.
        grid: communication points, shape (n,), n >= 2.
        tolerance: relative tolerance that the FMU's own solver is asked for.
        start_values: checked start values.
        watch: called with the time after every step; may raise to stop.

    Raises:
        SimulationError: a step failed; the FMU's last messages are in the text.
    """
    raw = instance.raw
    recorder = Recorder(instance, variables)
    time = float(grid[0])
    try:
        raw.setupExperiment(tolerance=tolerance, startTime=time, stopTime=float(grid[-1]))
        instance.set_start_values(start_values)
        raw.enterInitializationMode()
        raw.exitInitializationMode()
        recorder.sample(time)
        for target in grid[1:].tolist():
            # A discarded step raises too: repeating it with the same length would fail again.
            raw.doStep(currentCommunicationPoint=time, communicationStepSize=target - time)
            time = target
            recorder.sample(time)
            watch(time)
        counters = _counters(instance)
        raw.terminate()
    except FMICallException as error:
        raise instance.failure(f"the simulation failed after t = {time:.9g}", error) from error
    return recorder, counters


def _counters(instance: Instance) -> SolverCounters | None:
    variables = instance.description.variables
    found: dict[str, int] = {}
    for attribute, name in _COUNTERS.items():
        if name not in variables or variables[name].kind != "Integer":
            return None
        found[attribute] = int(instance.raw.getInteger([variables[name].reference])[0])
    return SolverCounters(**found)
