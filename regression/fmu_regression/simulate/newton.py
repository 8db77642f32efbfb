"""Newton's iteration for CVODE with a convergence test that an old matrix cannot deceive.

A step's equation is G(c) = 0 for the correction c of the predicted states; one iteration adds -M^-1 G(c), where M was
made some steps ago. CVODE's own test looks at that correction alone. Where a contact has opened since, M still holds
its stiffness: the correction is then tiny though G is not, the step is accepted, and what the contact did last goes on
in free flight, seen by no error test. Where a contact begins, M does not hold its stiffness yet, and the correction may
be small beside the size of a large body that is then far in another one, as if that were not there. So states are
accepted only where G is small there too: a tenth as small where the correction did not lessen G, as it must if M is
right. FMUs of ContactMultiBody do the same in co-simulation.

Where the iteration fails with a new Jacobian, either the equation is too curved, which a shorter step cures, or the
Jacobian is wrong, as difference quotients are whose increments are wider than the range over which the model bends:
damping at a speed of rest that is a hundred millionth of the nominal one. The derivative of G along the first
correction tells, by one evaluation.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from typing import Any, Final

import numpy as np
from fmpy.sundials.libraries import sundials_cvode
from fmpy.sundials.nvector_serial import NV_DATA_S
from fmpy.sundials.sundials_nvector import N_Vector
from fmpy.sundials.sundials_types import SUNContext

from fmu_regression.results.result import FloatArray

_SUCCESS = 0
_NOT_CONVERGED = 902
_UNRECOVERABLE = -1

SMALL_RESIDUAL: Final = 0.1
"""Residuals up to so many times a correction's tolerance are small, whatever the matrix is: a hundredth of what the
error test allows."""
_SMALL_REMAINDER = 1.0
"""The same for those that the matrix has just lessened; the next correction would do so again."""
LARGEST_REMAINDER: Final = 0.5
"""A correction by the right matrix leaves at most this share of the residual."""
_PROBE_SHARE, _LARGEST_JACOBIAN_ERROR = 1e-3, 0.1
"""The share of the first correction over which G is differentiated, and the largest error of a Jacobian."""
_SLOWEST_FALL_OF_RATE = 0.3
_DIVERGENCE = 2.0

_Solver = ctypes.c_void_p
_Residual = ctypes.CFUNCTYPE(ctypes.c_int, N_Vector, N_Vector, ctypes.c_void_p)
_Setup = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_int, ctypes.POINTER(ctypes.c_int), ctypes.c_void_p)
_LinearSolve = ctypes.CFUNCTYPE(ctypes.c_int, N_Vector, ctypes.c_void_p)
_Solve = ctypes.CFUNCTYPE(
    ctypes.c_int, _Solver, N_Vector, N_Vector, N_Vector, ctypes.c_double, ctypes.c_int, ctypes.c_void_p
)
_SetFunction = ctypes.CFUNCTYPE(ctypes.c_int, _Solver, ctypes.c_void_p)
_SetCount = ctypes.CFUNCTYPE(ctypes.c_int, _Solver, ctypes.c_int)
_GetCount = ctypes.CFUNCTYPE(ctypes.c_int, _Solver, ctypes.POINTER(ctypes.c_long))
_OPERATIONS = 14
"""Entries in the table of a nonlinear solver's operations. Their order changes from version to version of SUNDIALS."""


class _Object(ctypes.Structure):
    """``_generic_SUNNonlinearSolver`` of sundials_nonlinearsolver.h."""

    _fields_ = (
        ("content", ctypes.c_void_p),
        ("operations", ctypes.POINTER(ctypes.c_void_p * _OPERATIONS)),
        ("context", ctypes.c_void_p),
    )


def _declare(name: str, result: Any, *arguments: Any) -> Any:
    function = getattr(sundials_cvode, name)
    function.restype = result
    function.argtypes = list(arguments)
    return function


_new = _declare("SUNNonlinSol_Newton", ctypes.POINTER(_Object), N_Vector, SUNContext)
_free = _declare("SUNNonlinSolFree_Newton", ctypes.c_int, ctypes.POINTER(_Object))
_attach = _declare("CVodeSetNonlinearSolver", ctypes.c_int, ctypes.c_void_p, ctypes.POINTER(_Object))


class Newton:
    """A nonlinear solver for ``CVodeSetNonlinearSolver``. ``close`` frees it, after CVODE's memory.

    Args:
        context: of SUNDIALS.
        memory: CVODE's, which uses this solver from now on.
        size: number of states.
        work: vector of that size that is used for nothing else.
        on_error: receives exceptions, which cannot pass through C.
        refine: asked for better Jacobians where one was wrong; False if they are as good as they get.
    """

    def __init__(
        self,
        context: SUNContext,
        memory: int,
        size: int,
        work: Any,
        on_error: Callable[[BaseException], None],
        refine: Callable[[], bool],
    ) -> None:
        self._size = size
        self._step = work
        self._on_error = on_error
        self._refine = refine
        self._first_residual: FloatArray = np.zeros(size)
        self._first_step: FloatArray = np.zeros(size)
        self._residual: Any = None
        self._set_up: Any = None
        self._solve_linear: Any = None
        self._most_iterations = 3
        self._rate = 1.0
        self._iterations = 0
        self._failures = 0
        # The library's own solver, whose operations are replaced where they are found in its table. References keep the
        # callbacks alive as long as the library may call them.
        self._object: Any = _new(work, context)
        self._callbacks = {
            "Solve": _Solve(self._guarded_solve),
            "SetSysFn": _SetFunction(self._keep("_residual", _Residual)),
            "SetLSetupFn": _SetFunction(self._keep("_set_up", _Setup)),
            "SetLSolveFn": _SetFunction(self._keep("_solve_linear", _LinearSolve)),
            "SetMaxIters": _SetCount(self._set_most_iterations),
            "GetNumIters": _GetCount(self._count("_iterations")),
            "GetNumConvFails": _GetCount(self._count("_failures")),
        }
        table = self._object.contents.operations.contents
        places = {address: place for place, address in enumerate(table)}
        for name, callback in self._callbacks.items():
            own = ctypes.cast(getattr(sundials_cvode, f"SUNNonlinSol{name}_Newton"), ctypes.c_void_p).value
            table[places[own]] = ctypes.cast(callback, ctypes.c_void_p).value
        self.status: int = _attach(memory, self._object)

    def close(self) -> None:
        """Frees the solver; may be called twice."""
        if self._object is not None:
            _free(self._object)
            self._object = None

    def _keep(self, attribute: str, kind: Any) -> Callable[..., int]:
        def keep(_solver: int, function: int) -> int:
            setattr(self, attribute, kind(function))
            return _SUCCESS

        return keep

    def _set_most_iterations(self, _solver: int, count: int) -> int:
        self._most_iterations = count
        return _SUCCESS

    def _count(self, attribute: str) -> Callable[..., int]:
        def count(_solver: int, target: Any) -> int:
            target[0] = getattr(self, attribute)
            return _SUCCESS

        return count

    def _guarded_solve(self, _solver: int, _predicted: Any, *arguments: Any) -> int:
        try:
            return self._solve(*arguments)
        except BaseException as error:
            self._on_error(error)
            return _UNRECOVERABLE

    def _solve(self, vector: Any, weights: Any, tolerance: float, setup_wanted: int, memory: int) -> int:
        correction = self._array(vector)
        weight = self._array(weights)
        step = self._array(self._step)
        self._iterations = self._failures = 0
        jacobian_is_bad = 0
        while True:
            is_new = ctypes.c_int(0)
            flag: int = self._residual(vector, self._step, memory)
            if flag != _SUCCESS:  # the predicted states cannot be evaluated: no matrix helps
                self._failures += 1
                return flag
            if setup_wanted:
                flag = self._set_up(jacobian_is_bad, ctypes.byref(is_new), memory)
                self._rate = 1.0
            if flag == _SUCCESS:
                flag = self._iterate(vector, correction, weight, step, tolerance, bool(is_new.value), memory)
            if flag == _SUCCESS:
                return _SUCCESS
            if flag < 0 or (
                is_new.value
                and not (
                    flag == _NOT_CONVERGED
                    and self._jacobian_is_wrong(vector, correction, weight, step, memory)
                    and self._refine()
                )
            ):
                self._failures += 1
                return flag
            setup_wanted = jacobian_is_bad = 1
            correction[:] = 0.0

    def _iterate(
        self,
        vector: Any,
        correction: FloatArray,
        weight: FloatArray,
        step: FloatArray,
        tolerance: float,
        is_new: bool,
        memory: int,
    ) -> int:
        """Iterates from the predicted states until the correction is believed.

        ``is_new`` tells whether the Jacobian is of this very step.
        """
        last_change = 0.0
        residual = self._norm(step, weight)
        self._first_residual[:] = step
        count = 1
        while True:
            flag = self._correct(correction, step, memory)
            if flag != _SUCCESS:
                return flag
            if count == 1:
                self._first_step[:] = step
            change = self._norm(step, weight)
            if count > 1:
                self._rate = max(_SLOWEST_FALL_OF_RATE * self._rate, change / last_change)
            converged = change * min(1.0, self._rate) <= tolerance
            if not converged and (
                count >= self._most_iterations or (count > 1 and not change <= _DIVERGENCE * last_change)
            ):
                return _NOT_CONVERGED
            last_change = change
            flag = int(self._residual(vector, self._step, memory))
            if flag != _SUCCESS:
                return flag
            remainder = self._norm(step, weight)
            if converged:
                is_right = remainder <= LARGEST_REMAINDER * residual
                if remainder <= (_SMALL_REMAINDER if is_right else SMALL_RESIDUAL) * tolerance:
                    return _SUCCESS
                if count >= self._most_iterations or not (is_new or is_right):
                    return _NOT_CONVERGED
            residual = remainder
            count += 1

    def _jacobian_is_wrong(
        self, vector: Any, correction: FloatArray, weight: FloatArray, step: FloatArray, memory: int
    ) -> bool:
        """Whether the Jacobian of the failed iteration does not give G's derivative along the first correction.

        That is minus the first residual. Changes ``correction``.
        """
        correction[:] = _PROBE_SHARE * self._first_step
        if self._residual(vector, self._step, memory) != _SUCCESS:
            return False
        error = step - (1.0 - _PROBE_SHARE) * self._first_residual
        allowed = _LARGEST_JACOBIAN_ERROR * _PROBE_SHARE * self._norm(self._first_residual, weight)
        return self._norm(error, weight) > allowed

    def _correct(self, correction: FloatArray, step: FloatArray, memory: int) -> int:
        """Turns the residual in ``step`` into the correction and adds it."""
        self._iterations += 1
        np.negative(step, out=step)
        flag: int = self._solve_linear(self._step, memory)
        if flag == _SUCCESS:
            correction += step
        return flag

    def _norm(self, vector: FloatArray, weight: FloatArray) -> float:
        scaled = vector * weight
        return float(np.sqrt(scaled.dot(scaled) / self._size))

    def _array(self, vector: Any) -> FloatArray:
        return np.ctypeslib.as_array(NV_DATA_S(vector), (self._size,))
