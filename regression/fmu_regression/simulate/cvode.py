"""CVODE (SUNDIALS, the build that FMPy brings along) as a step-by-step integrator with event location.

FMPy's own wrapper lets exceptions of the model vanish inside C callbacks, caps the steps between two
outputs at 500 and keeps no counters; hence this one over the same library.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from enum import Enum
from typing import Any

import numpy as np
from fmpy.sundials.cvode import (
    CV_BDF,
    CV_ROOT_RETURN,
    CVode,
    CVodeCreate,
    CVodeInit,
    CVodeReInit,
    CVodeRootInit,
    CVodeSetMaxStep,
    CVodeSetNoInactiveRootWarn,
    CVRhsFn,
    CVRootFn,
)
from fmpy.sundials.cvode_ls import CVodeSetLinearSolver
from fmpy.sundials.libraries import sundials_core, sundials_cvode, sundials_sunlinsoldense, sundials_sunmatrixdense
from fmpy.sundials.nvector_serial import NV_DATA_S, N_VDestroy_Serial, N_VNew_Serial
from fmpy.sundials.sundials_context import SUNContext_Create, SUNContext_PushErrHandler
from fmpy.sundials.sundials_types import SUN_COMM_NULL, SUNContext, SUNErrHandlerFn
from fmpy.sundials.sunlinsol_dense import SUNLinSol_Dense
from fmpy.sundials.sunmatrix_dense import SUNDenseMatrix

from fmu_regression.results.result import FloatArray, SolverCounters
from fmu_regression.simulate.error_weights import error_weights, highest_order
from fmu_regression.simulate.indicator_watch import IndicatorWatch
from fmu_regression.simulate.newton import Newton

_CV_ONE_STEP = 2
# How far Newton's iteration goes, as a share of what the error test permits: CVODE's own share, and the one for where
# the integrator creeps. At loose tolerances steps beside a kink, as of dry friction, can go round in a cycle of two
# points with an error estimate that allows no longer step. Going on with the iteration breaks the cycle.
_USUAL_NEWTON_SHARE = 0.1
_CAREFUL_NEWTON_SHARE = 0.01
# So many steps of one length, shorter than this share of the longest, are creeping.
_STEPS_WATCHED = 200
_CREEPING_SHARE = 0.1
# How much longer the second step after a start may be than the first. CVODE's own 10 000 makes a step of a millisecond
# out of one of a microsecond, at order one: between its ends the interpolated distance of bodies that part slowly leads
# back into contact, and the events found there go on and on.
_GROWTH_AFTER_START = 10.0
# So many steps and seconds in which the states move by less than the error test permits are rest. (Slow impacts of soft
# contacts last 150 ms, and the longest step may be microseconds.)
_STEPS_OF_REST, _TIME_OF_REST = 10, 0.1
_ROOT_OF_ROUNDING = float(np.sqrt(np.finfo(float).eps))
# Increments of difference quotients after such a Jacobian was wrong, by the errors that the tolerance permits, and how
# many Jacobians in a row are made so.
_FINE_SHARE = 1e-3
_FINE_JACOBIANS = 3

WHAT_HELPS = "The tolerance may be too coarse for a contact's penetration, or the contact's stiffness too high"
"""What to change where steps become too small."""
_FAILURES = {
    -1: "too many steps",
    -2: "the tolerance asks for more accuracy than the numbers have",
    -3: f"the error test failed repeatedly: the step became too small. {WHAT_HELPS}",
    -4: f"Newton's iteration failed repeatedly: the step became too small. {WHAT_HELPS}",
    -6: "the Jacobian is singular or could not be set up",
    -8: "the model cannot be evaluated",
    -9: "the model cannot be evaluated at the start of a step",
    -10: "the model could not be evaluated in spite of smaller steps",
    -11: "the model cannot be evaluated after an error",
    -12: "the event indicators cannot be evaluated",
}

_GetLong = ctypes.POINTER(ctypes.c_long)


def _declare(library: Any, name: str, *arguments: Any, result: Any = ctypes.c_int) -> Any:
    function = getattr(library, name)
    function.argtypes = list(arguments)
    function.restype = result
    return function


_set_stop_time = _declare(sundials_cvode, "CVodeSetStopTime", ctypes.c_void_p, ctypes.c_double)
_set_highest_order = _declare(sundials_cvode, "CVodeSetMaxOrd", ctypes.c_void_p, ctypes.c_int)
_set_newton_share = _declare(sundials_cvode, "CVodeSetNonlinConvCoef", ctypes.c_void_p, ctypes.c_double)
_set_growth_after_start = _declare(sundials_cvode, "CVodeSetEtaMaxFirstStep", ctypes.c_void_p, ctypes.c_double)
_set_warnings = _declare(sundials_cvode, "CVodeSetMaxHnilWarns", ctypes.c_void_p, ctypes.c_int)
_set_first_step = _declare(sundials_cvode, "CVodeSetInitStep", ctypes.c_void_p, ctypes.c_double)
_get_last_step = _declare(sundials_cvode, "CVodeGetLastStep", ctypes.c_void_p, ctypes.POINTER(ctypes.c_double))
_get_dky = _declare(
    sundials_cvode, "CVodeGetDky", ctypes.c_void_p, ctypes.c_double, ctypes.c_int, CVRhsFn._argtypes_[1]
)
_get_roots = _declare(sundials_cvode, "CVodeGetRootInfo", ctypes.c_void_p, ctypes.POINTER(ctypes.c_int))
_counter = {
    name: _declare(sundials_cvode, f"CVodeGetNum{name}", ctypes.c_void_p, _GetLong)
    for name in (
        "Steps",
        "RhsEvals",
        "LinRhsEvals",
        "JacEvals",
        "ErrTestFails",
        "NonlinSolvConvFails",
    )
}
_JacobianFn = ctypes.CFUNCTYPE(
    ctypes.c_int,
    ctypes.c_double,
    CVRhsFn._argtypes_[1],
    CVRhsFn._argtypes_[2],
    *[ctypes.c_void_p] * 2,
    *[CVRhsFn._argtypes_[1]] * 3,
)
_WeightsFn = ctypes.CFUNCTYPE(ctypes.c_int, CVRhsFn._argtypes_[1], CVRhsFn._argtypes_[1], ctypes.c_void_p)
_set_weights = _declare(sundials_cvode, "CVodeWFtolerances", ctypes.c_void_p, _WeightsFn)
_set_jacobian = _declare(sundials_cvode, "CVodeSetJacFn", ctypes.c_void_p, _JacobianFn)
_matrix_data = _declare(
    sundials_sunmatrixdense, "SUNDenseMatrix_Data", ctypes.c_void_p, result=ctypes.POINTER(ctypes.c_double)
)
_free_cvode = _declare(sundials_cvode, "CVodeFree", ctypes.POINTER(ctypes.c_void_p), result=None)
_free_solver = _declare(sundials_sunlinsoldense, "SUNLinSolFree_Dense", ctypes.c_void_p)
_free_matrix = _declare(sundials_sunmatrixdense, "SUNMatDestroy_Dense", ctypes.c_void_p, result=None)
_clear_handlers = _declare(sundials_core, "SUNContext_ClearErrHandlers", SUNContext)
_free_context = _declare(sundials_core, "SUNContext_Free", ctypes.POINTER(SUNContext))


class RecoverableError(Exception):
    """The model cannot be evaluated at this point; a smaller step may avoid it."""


class IntegrationError(Exception):
    """CVODE gave up; the message says why, ``__cause__`` holds the model's own exception if there was one."""


class StepEnd(Enum):
    """Why a step ended where it did."""

    STEP = "step"
    ROOT = "root"


class Cvode:
    """Variable-order BDF with Newton's iteration, dense difference-quotient Jacobian and root finding.

    The increments of the difference quotients are shares of the states' values or nominal values, whichever is
    larger. CVODE's own shrink with the derivatives: at rest, where stiff contacts leave hardly any, the rounding of
    large forces would make up a good part of the quotients. Where Newton's iteration finds such a Jacobian wrong, as
    where a state's nominal value is far beyond the range over which the model bends, they are a thousandth of the
    error that the tolerance permits.

    Not thread-safe. ``close`` frees the library's memory; the object is a context manager.

    Args:
        derivatives: (t, states pointer, derivatives pointer); writes the derivatives. Raises RecoverableError where
            a smaller step may help, anything else to stop.
        indicators: (t, states pointer, values pointer); writes the event indicators. Raises as ``derivatives`` does.
        time: start time.
        states: shape (n,), n >= 1.
        indicator_count: number of event indicators.
        tolerance: relative tolerance.
        absolute: shape (n,), > 0, absolute tolerances of the states.
        nominal: shape (n,), > 0, nominal values of the states.
        max_step: longest step in s.
    """

    def __init__(
        self,
        derivatives: Callable[[float, Any, Any], None],
        indicators: Callable[[float, Any, Any], None],
        time: float,
        states: FloatArray,
        indicator_count: int,
        tolerance: float,
        absolute: FloatArray,
        nominal: FloatArray,
        max_step: float,
    ) -> None:
        self._nominal = nominal.copy()
        self._jacobian_evaluations = 0
        self._fine_jacobians = 0
        self._error: BaseException | None = None
        self._message = ""
        self._tolerance = tolerance
        self._indicator_count = indicator_count
        self._indicator_watch = IndicatorWatch(indicator_count)
        self._max_step = max_step
        self._last_step = ctypes.c_double(0.0)
        self._steps_alike = 0
        self._time = self._place_time = time
        self._place = states.copy()
        self._steps_of_rest = 0
        self._rests = False
        self._root_found = False
        self._first_step_limited = False
        self._totals = np.zeros(len(_counter), dtype=np.int64)
        self._memory: int | None = None
        self._newton: Newton | None = None
        self._matrix: int | None = None
        self._linear: int | None = None
        self._vectors: list[Any] = []
        self._context = SUNContext()
        self._check(SUNContext_Create(SUN_COMM_NULL, ctypes.byref(self._context)))
        # References keep the callbacks alive as long as the library may call them.
        self._rhs = CVRhsFn(self._guard_rhs(derivatives))
        self._root = CVRootFn(self._guard_root(indicators))
        self._jacobian = _JacobianFn(self._difference_quotients)
        self._weights = _WeightsFn(self._weigh)
        self._handler = SUNErrHandlerFn(self._remember)
        self._check(_clear_handlers(self._context))  # the library's own writes to standard error
        self._check(SUNContext_PushErrHandler(self._context, self._handler, None))
        self._x = self._vector(states)
        self._absolute = self._vector(absolute)
        self._interpolated = self._vector(states)
        self._between = self._vector(states)
        self._memory = CVodeCreate(CV_BDF, self._context)
        self._check(CVodeInit(self._memory, self._rhs, time, self._x))
        self._check(_set_weights(self._memory, self._weights))
        self._check(_set_highest_order(self._memory, highest_order(tolerance)))
        if indicator_count:
            self._check(CVodeRootInit(self._memory, indicator_count, self._root))
        self._matrix = SUNDenseMatrix(states.size, states.size, self._context)
        self._linear = SUNLinSol_Dense(self._x, self._matrix, self._context)
        self._check(CVodeSetLinearSolver(self._memory, self._linear, self._matrix))
        self._check(_set_jacobian(self._memory, self._jacobian))
        work = self._vector(np.zeros(states.size))
        self._newton = Newton(self._context, self._memory, states.size, work, self._keep_error, self._refine)
        self._check(self._newton.status)
        self._check(CVodeSetMaxStep(self._memory, max_step))
        self._check(_set_warnings(self._memory, -1))  # they would go to the terminal; who calls counts stalled steps
        self._check(_set_growth_after_start(self._memory, _GROWTH_AFTER_START))
        self._check(CVodeSetNoInactiveRootWarn(self._memory))

    def __enter__(self) -> Cvode:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Frees the library's memory; may be called twice."""
        if self._memory is not None:
            _free_cvode(ctypes.byref(ctypes.c_void_p(self._memory)))
            self._memory = None
        if self._newton is not None:
            self._newton.close()
            self._newton = None
        if self._linear is not None:
            _free_solver(self._linear)
            self._linear = None
        if self._matrix is not None:
            _free_matrix(self._matrix)
            self._matrix = None
        while self._vectors:
            N_VDestroy_Serial(self._vectors.pop())
        if self._context:
            _free_context(ctypes.byref(self._context))
            self._context = SUNContext()

    @property
    def states(self) -> Any:
        """Pointer to the states at the time that ``step`` returned."""
        return NV_DATA_S(self._x)

    def step(self, limit: float) -> tuple[float, StepEnd]:
        """Takes one internal step, at most to ``limit`` and at most to the first zero crossing.

        Returns:
            the time reached and why the step ended there.

        Raises:
            IntegrationError: the step could not be made.
        """
        still = self._time - self._place_time
        if not self._rests and self._steps_of_rest >= _STEPS_OF_REST and still >= _TIME_OF_REST:
            self._rest()
        self._check(_set_stop_time(self._memory, limit))
        reached = ctypes.c_double(0.0)
        status = CVode(self._memory, limit, self._x, ctypes.byref(reached), _CV_ONE_STEP)
        if status < 0:
            error, self._error = self._error, None
            detail = _FAILURES.get(status) or f"CVODE status {status} ({self._message})"
            raise IntegrationError(detail) from error
        if self._first_step_limited:
            self._first_step_limited = False
            self._check(CVodeSetMaxStep(self._memory, self._max_step))
        self._watch()
        self._root_found = status == CV_ROOT_RETURN
        self._time = reached.value
        self._watch_rest()
        return reached.value, StepEnd.ROOT if status == CV_ROOT_RETURN else StepEnd.STEP

    def _weigh(self, x: Any, weights: Any, _data: Any) -> int:
        """For CVODE, before each step."""
        step = ctypes.c_double(0.0)
        _get_last_step(self._memory, ctypes.byref(step))
        size = self._nominal.size
        states, absolute, result = (
            np.ctypeslib.as_array(NV_DATA_S(vector), (size,)) for vector in (x, self._absolute, weights)
        )
        result[:] = error_weights(states, absolute, self._tolerance, step.value)
        return 0 if np.all(np.isfinite(result)) else -1

    def _watch(self) -> None:
        """Lets Newton's iteration go further, until the next restart, where the integrator creeps."""
        before = self._last_step.value
        self._check(_get_last_step(self._memory, ctypes.byref(self._last_step)))
        step = self._last_step.value
        self._steps_alike = self._steps_alike + 1 if step == before and step < _CREEPING_SHARE * self._max_step else 0
        if self._steps_alike == _STEPS_WATCHED:
            self._check(_set_newton_share(self._memory, _CAREFUL_NEWTON_SHARE))

    def _watch_rest(self) -> None:
        """Counts the steps in which nothing moves away from a place; lets go of order one where something does."""
        size = self._nominal.size
        states, absolute = (np.ctypeslib.as_array(NV_DATA_S(each), (size,)) for each in (self._x, self._absolute))
        change = (states - self._place) * error_weights(states, absolute, self._tolerance, self._last_step.value)
        self._steps_of_rest += 1
        if self._root_found or not np.mean(change**2) < 1.0:
            self._move_to(states)

    def _move_to(self, states: FloatArray) -> None:
        self._place[:] = states
        self._place_time = self._time
        self._steps_of_rest = 0
        if self._rests:
            self._rests = False
            self._check(_set_first_step(self._memory, 0.0))
            self._check(_set_highest_order(self._memory, highest_order(self._tolerance)))

    def _rest(self) -> None:
        """Goes on by steps of order one.

        Where nothing moves the error test has nothing to choose the order by. Formulas of higher order extrapolate what
        Newton's iteration leaves of the residual, and bodies at rest tremble within the tolerance.
        """
        self._rests = True
        self._collect()
        self._check(CVodeReInit(self._memory, self._time, self._x))
        self._check(_set_first_step(self._memory, self._last_step.value))
        self._check(_set_highest_order(self._memory, 1))
        self._indicator_watch.restart()

    def interpolate(self, time: float) -> Any:
        """Pointer to the states at a time within the last step, to the order of the method."""
        self._check(_get_dky(self._memory, time, 0, self._interpolated))
        return NV_DATA_S(self._interpolated)

    def roots(self) -> list[int]:
        """Numbers, from 0, of the event indicators that crossed zero where the last step ended."""
        found = (ctypes.c_int * max(self._indicator_count, 1))()
        self._check(_get_roots(self._memory, found))
        return [number for number in range(self._indicator_count) if found[number]]

    def restart(self, time: float, states: FloatArray, nominal: FloatArray, absolute: FloatArray) -> None:
        """Starts anew after an event; states, nominal values and absolute tolerances have shape (n,).

        After one that an indicator told, the first step is no longer than the one in which it was found. CVODE's own
        choice knows the error test alone, and a long step at order one may lead bodies that part slowly back into
        contact between its ends, where another event is found, and so on.
        """
        self._collect()
        self._nominal[:] = nominal
        _fill(self._x, states)
        _fill(self._absolute, absolute)
        if self._root_found:
            self._check(CVodeSetMaxStep(self._memory, min(self._last_step.value, self._max_step)))
            self._first_step_limited = True
        self._indicator_watch.restart()
        self._check(CVodeReInit(self._memory, time, self._x))
        self._time = time
        self._move_to(states)
        self._check(_set_newton_share(self._memory, _USUAL_NEWTON_SHARE))
        self._steps_alike = 0

    def counters(self, state_events: int, time_events: int) -> SolverCounters:
        """Work since the object was made."""
        now = self._totals + self._current()
        by_name = dict(zip(_counter, (int(value) for value in now), strict=True))
        return SolverCounters(
            steps=by_name["Steps"],
            evaluations=by_name["RhsEvals"] + by_name["LinRhsEvals"] + self._jacobian_evaluations,
            jacobians=by_name["JacEvals"],
            error_test_failures=by_name["ErrTestFails"],
            convergence_failures=by_name["NonlinSolvConvFails"],
            state_events=state_events,
            time_events=time_events,
        )

    def _current(self) -> np.ndarray[Any, np.dtype[np.int64]]:
        value = ctypes.c_long(0)
        values = []
        for get in _counter.values():
            get(self._memory, ctypes.byref(value))
            values.append(value.value)
        return np.array(values, dtype=np.int64)

    def _collect(self) -> None:
        # CVodeReInit sets the integrator's counters to zero.
        self._totals += self._current()

    def _vector(self, values: FloatArray) -> Any:
        vector = N_VNew_Serial(values.size, self._context)
        self._vectors.append(vector)
        _fill(vector, values)
        return vector

    def _guard_rhs(self, derivatives: Callable[[float, Any, Any], None]) -> Callable[..., int]:
        def rhs(time: float, x: Any, dx: Any, _data: Any) -> int:
            try:
                derivatives(time, NV_DATA_S(x), NV_DATA_S(dx))
            except RecoverableError as error:
                self._error = error
                return 1
            except BaseException as error:
                self._error = error
                return -1
            return 0

        return rhs

    def _difference_quotients(self, time: float, x: Any, dx: Any, matrix: Any, data: Any, *work: Any) -> int:
        size = self._nominal.size
        states = np.ctypeslib.as_array(NV_DATA_S(x), (size,))
        here = np.ctypeslib.as_array(NV_DATA_S(dx), (size,))
        moved = np.ctypeslib.as_array(NV_DATA_S(work[0]), (size,))
        columns = np.ctypeslib.as_array(_matrix_data(matrix), (size, size))
        increments = _ROOT_OF_ROUNDING * np.maximum(np.abs(states), self._nominal)
        if self._fine_jacobians > 0:
            self._fine_jacobians -= 1
            absolute = np.ctypeslib.as_array(NV_DATA_S(self._absolute), (size,))
            permitted = self._tolerance * np.abs(states) + absolute
            increments = np.minimum(increments, _FINE_SHARE * permitted)
        for k in range(size):
            kept = float(states[k])
            states[k] = kept + increments[k]
            status: int = self._rhs(time, x, work[0], data)
            step = states[k] - kept
            states[k] = kept
            self._jacobian_evaluations += 1
            if status != 0:
                return status
            columns[k] = (moved - here) / step
        return 0

    def _guard_root(self, indicators: Callable[[float, Any, Any], None]) -> Callable[..., int]:
        watch = self._indicator_watch
        found = np.zeros(self._indicator_count)

        def between(time: float) -> FloatArray | None:
            if _get_dky(self._memory, time, 0, self._between) != 0:
                return None
            try:
                indicators(time, NV_DATA_S(self._between), found.ctypes.data_as(ctypes.POINTER(ctypes.c_double)))
            except RecoverableError:
                return None
            return found.copy()

        def root(time: float, x: Any, values: Any, _data: Any) -> int:
            try:
                indicators(time, NV_DATA_S(x), values)
                here = np.ctypeslib.as_array(values, (self._indicator_count,))
                watch.step(time, here, between)
                here[:] = watch.shown(time, here)
            except BaseException as error:
                self._error = error
                return -1
            return 0

        return root

    def _refine(self) -> bool:
        """Makes the next Jacobians by smaller increments; False if the last one was such."""
        if self._fine_jacobians > 0:
            return False
        self._fine_jacobians = _FINE_JACOBIANS
        return True

    def _keep_error(self, error: BaseException) -> None:
        self._error = error

    def _remember(self, _line: int, _function: Any, _file: Any, message: bytes | None, *_: Any) -> None:
        self._message = " ".join((message or b"").decode("utf-8", "replace").split())

    def _check(self, status: int) -> None:
        if status != 0:
            raise IntegrationError(self._message or f"SUNDIALS status {status}")


def _fill(vector: Any, values: FloatArray) -> None:
    np.ctypeslib.as_array(NV_DATA_S(vector), (values.size,))[:] = values
