"""Integrating a model-exchange FMU with CVODE: steps, events, output."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from fmpy.fmi1 import FMICallException

from fmu_regression.fmi.description import StartValue, Variable
from fmu_regression.fmi.fmu import Instance
from fmu_regression.results.result import FloatArray, SolverCounters
from fmu_regression.simulate.cvode import Cvode, IntegrationError, RecoverableError, StepEnd
from fmu_regression.simulate.recorder import Recorder

_FMI_DISCARD = 2
_MAX_EVENT_ITERATIONS = 1000
_MAX_EVENTS_AT_A_TIME = 500
_MAX_STEPS_AT_A_TIME = 200
_RESOLUTION = 8 * float(np.finfo(np.float64).eps)
"""Times that differ by less of their size are one: no integrator starts so near to where it shall end."""
# So many state events within so short a time, s, are no physics but relations that undo themselves. FMUs of
# ContactMultiBody notice 1000 and say which relation it is.
_CHATTER_EVENTS = 1200
_CHATTER_TIME = 1e-4

Watch = Callable[[float], None]


def absolute_tolerances(relative: float, nominal: FloatArray) -> FloatArray:
    """Absolute tolerance of each state.

    Positions have the nominal value 1 m as a rule, and penetrations of a micrometre carry the load: with the relative
    tolerance itself they, and the fast modes of stiff contacts, would be left undetermined; from a tenth of a
    micrometre on static friction's springs are. Below a nanometre the rounding of contact geometry times the contact's
    stiffness would keep Newton's iteration from converging. Nominal values below 1, as of the stretches of friction's
    springs, tell the size that matters themselves: a share of a share would ask for picometres, where steps fail over
    kinks that nothing depends on.

    Args:
        relative: relative tolerance.
        nominal: shape (n,), > 0, nominal values of the states.

    Returns:
        Shape (n,).
    """
    absolute = min(relative, max(1e-3 * relative, 1e-9), 1e-7)
    return np.where(nominal < 1.0, np.minimum(absolute, relative * nominal), absolute * nominal)


def integrate(
    instance: Instance,
    variables: Sequence[Variable],
    grid: FloatArray,
    tolerance: float,
    start_values: Mapping[str, StartValue],
    max_step: float,
    watch: Watch,
) -> tuple[Recorder, SolverCounters]:
    """Simulates a fresh model-exchange instance over the grid of output times.

    Rows are recorded at the grid and, at every event, before and after it.

    Args:
        instance: a fresh instance.
        variables: what to record.
        grid: output times, shape (n,), n >= 2.
        tolerance: relative tolerance; those of states are ``absolute_tolerances`` of it.
        start_values: checked start values.
        max_step: longest internal step in s.
        watch: called with the time after every internal step; may raise to stop.

    Raises:
        SimulationError: the model or the integrator failed; the FMU's last messages are in the text.
    """
    time = float(grid[0])
    try:
        return _Master(instance, variables, grid, tolerance, max_step, watch).run(start_values)
    except FMICallException as error:
        raise instance.failure("the simulation failed", error) from error
    except IntegrationError as error:
        raise instance.failure(f"the integrator failed after t = {time:.9g}", error) from error


class _Master:
    """One run; methods follow the modes of FMI 2.0.4, section 3.2, and FMI 3.0.2, section 3."""

    def __init__(
        self,
        instance: Instance,
        variables: Sequence[Variable],
        grid: FloatArray,
        tolerance: float,
        max_step: float,
        watch: Watch,
    ) -> None:
        self.instance = instance
        self.functions = instance.functions
        self.grid = grid
        self.tolerance = tolerance
        self.max_step = max_step
        self.watch = watch
        self.recorder = Recorder(instance, variables)
        self.state_count = instance.description.state_count
        self.next_time_event = np.inf
        self.state_events = 0
        self.time_events = 0
        self.chatter_begin = -np.inf
        self.chatter_events = 0
        self.time = float(grid[0])
        self.discarded = False

    def run(self, start_values: Mapping[str, StartValue]) -> tuple[Recorder, SolverCounters]:
        functions = self.functions
        self.instance.set_start_values(start_values)
        functions.enter_initialization(self.tolerance, self.time, float(self.grid[-1]))
        functions.exit_initialization()
        self._iterate_events("initialization")
        self.recorder.sample(self.time)
        nominal = self._nominal()
        with Cvode(
            self._derivatives,
            self._indicators,
            self.time,
            self._states(),
            self.instance.description.indicator_count,
            self.tolerance,
            absolute_tolerances(self.tolerance, nominal),
            nominal,
            self.max_step,
        ) as solver:
            try:
                self._integrate(solver)
            except IntegrationError as error:
                cause = None if self.instance.messages else error.__cause__  # the FMU says more
                raise self.instance.failure(
                    f"the integrator failed after t = {self.time:.9g}: {error}", cause
                ) from error
            counters = solver.counters(self.state_events, self.time_events)
        functions.terminate()
        return self.recorder, counters

    def _integrate(self, solver: Cvode) -> None:
        stop = float(self.grid[-1])
        next_row = 1
        crowd_time, crowd = -np.inf, 0
        stalled = 0
        while self.time < stop:
            limit = min(stop, self.next_time_event)
            if limit - self.time > _RESOLUTION * max(abs(limit), abs(self.time)):
                self.discarded = False
                reached, end = solver.step(limit)
                if self.discarded and reached > self.time:
                    self.instance.forget_discards()
                stalled = stalled + 1 if reached <= self.time else 0
                if stalled > _MAX_STEPS_AT_A_TIME:
                    raise IntegrationError(
                        f"time does not advance: the step is below the resolution of time{self._fastest(solver)}"
                    )
            else:
                reached, end = max(limit, self.time), StepEnd.STEP
            while next_row < self.grid.size and self.grid[next_row] < reached:
                self._move(float(self.grid[next_row]), solver.interpolate(float(self.grid[next_row])))
                self.recorder.sample(float(self.grid[next_row]))
                next_row += 1
            self.time = reached
            self._move(reached, solver.states)
            step_event = terminated = False
            if self.instance.description.needs_completed_step:
                step_event, terminated = self.functions.completed_step()
            time_event = reached >= self.next_time_event
            on_grid = next_row < self.grid.size and self.grid[next_row] <= reached
            is_event = end is StepEnd.ROOT or time_event or step_event
            if on_grid or is_event or terminated:
                self.recorder.sample(reached)
                next_row += on_grid
            if terminated:
                raise IntegrationError("the model asked to be terminated")
            if is_event:
                self.state_events += end is StepEnd.ROOT
                self.time_events += time_event
                crowd = crowd + 1 if reached - crowd_time <= 1e-12 * max(1.0, abs(reached)) else 0
                crowd_time = reached
                if crowd > _MAX_EVENTS_AT_A_TIME:
                    raise IntegrationError(f"more than {_MAX_EVENTS_AT_A_TIME} events at one time (chattering)")
                if end is StepEnd.ROOT:
                    self._watch_for_chatter(solver)
                self.functions.enter_event_mode()
                self._iterate_events(f"the event at t = {reached:.9g}")
                self.recorder.sample(reached)
                nominal = self._nominal()
                solver.restart(reached, self._states(), nominal, absolute_tolerances(self.tolerance, nominal))
            self.watch(reached)

    def _watch_for_chatter(self, solver: Cvode) -> None:
        if self.time - self.chatter_begin >= _CHATTER_TIME:
            self.chatter_begin, self.chatter_events = self.time, 0
        self.chatter_events += 1
        if self.chatter_events < _CHATTER_EVENTS:
            return
        numbers = ", ".join(str(number + 1) for number in solver.roots())
        raise self.instance.failure(
            f"the model chatters at t = {self.time:.9g}: {_CHATTER_EVENTS} state events within "
            f"{self.time - self.chatter_begin:.3g} s, the last of event indicator {numbers}. A relation undoes the "
            "condition under which it became true: give it a hysteresis or make the change continuous"
        )

    def _iterate_events(self, where: str) -> None:
        for _ in range(_MAX_EVENT_ITERATIONS):
            update = self.functions.update_discrete_states()
            if update.terminated:
                raise self.instance.failure(f"the model asked to be terminated at {where}")
            if not update.again:
                break
        else:
            raise self.instance.failure(f"the event iteration does not end at {where}")
        self.next_time_event = update.next_time
        self.functions.enter_continuous_time_mode()

    def _fastest(self, solver: Cvode) -> str:
        """A remark that names the state which changes fastest, beside its size; empty where the FMU says more."""
        names = self.instance.description.states
        if len(names) != self.state_count or not names or self.instance.messages:
            return ""
        derivatives = (ctypes.c_double * self.state_count)()
        try:
            self._derivatives(self.time, solver.states, derivatives)
        except (FMICallException, RecoverableError):
            return ""
        states = np.ctypeslib.as_array(solver.states, (self.state_count,))
        rates = np.abs(np.array(derivatives)) / (np.abs(states) + absolute_tolerances(self.tolerance, self._nominal()))
        fastest = int(np.argmax(np.where(np.isfinite(rates), rates, np.inf)))
        return f"; {names[fastest]} = {states[fastest]:.6g} changes fastest, by {derivatives[fastest]:.6g} a second"

    def _states(self) -> FloatArray:
        if not self.state_count:
            # CVODE wants a state; a constant one costs nothing.
            return np.ones(1)
        return np.array(self.functions.get_states(self.state_count))

    def _nominal(self) -> FloatArray:
        if not self.state_count:
            return np.ones(1)
        nominal: FloatArray = np.abs(np.array(self.functions.get_nominals(self.state_count)))
        return nominal

    def _move(self, time: float, states: Any) -> None:
        self.functions.set_time(time)
        if self.state_count:
            self.functions.set_states(states, self.state_count)

    def _derivatives(self, time: float, states: Any, derivatives: Any) -> None:
        if not self.state_count:
            derivatives[0] = 0.0
            return
        self._evaluate(time, states, lambda: self.functions.get_derivatives(derivatives, self.state_count))

    def _indicators(self, time: float, states: Any, values: Any) -> None:
        count = self.instance.description.indicator_count
        self._evaluate(time, states, lambda: self.functions.get_indicators(values, count))

    def _evaluate(self, time: float, states: Any, get: Callable[[], None]) -> None:
        try:
            self._move(time, states)
            get()
        except FMICallException as error:
            if error.status == _FMI_DISCARD:
                self.discarded = True
                raise RecoverableError(str(error)) from error
            raise
