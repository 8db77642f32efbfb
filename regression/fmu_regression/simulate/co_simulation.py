"""Stepping a co-simulation FMU over the grid of output times."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from fmpy.fmi1 import FMICallException

from fmu_regression.fmi.description import StartValue, Variable
from fmu_regression.fmi.fmu import Instance
from fmu_regression.results.result import FloatArray, SolverCounters
from fmu_regression.simulate.recorder import Recorder

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
    """Simulates a fresh co-simulation instance; rows are at the grid only, as the FMU handles its events itself.

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
    functions = instance.functions
    recorder = Recorder(instance, variables)
    time = float(grid[0])
    try:
        instance.set_start_values(start_values)
        functions.enter_initialization(tolerance, time, float(grid[-1]))
        functions.exit_initialization()
        recorder.sample(time)
        for target in grid[1:].tolist():
            # A discarded step raises too: repeating it with the same length would fail again.
            outcome = functions.do_step(time, target - time)
            if outcome.terminated or outcome.time < target - 1e-9 * (target - time):
                cause = "the model asked to be terminated" if outcome.terminated else "the FMU ended a step early"
                raise instance.failure(f"{cause} at t = {outcome.time:.9g}")
            time = target
            recorder.sample(time)
            watch(time)
        counters = _counters(instance)
        functions.terminate()
    except FMICallException as error:
        raise instance.failure(f"the simulation failed after t = {time:.9g}", error) from error
    return recorder, counters


def _counters(instance: Instance) -> SolverCounters | None:
    variables = instance.description.variables
    found: dict[str, int] = {}
    for attribute, name in _COUNTERS.items():
        if name not in variables or variables[name].kind != "Integer":
            return None
        read = instance.functions.reader(variables[name].data_type, [variables[name].reference])
        found[attribute] = int(read()[0])
    return SolverCounters(**found)
