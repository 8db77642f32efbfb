"""FMI 2.0 through FMPy."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from typing import Any

import fmpy
import fmpy.fmi2
import numpy as np
from fmpy.logging import addLoggerProxy

from fmu_regression.fmi.binding import Binding, DiscreteUpdate, Identity, LogMessage, Mode, Reader, StepOutcome

_GETTERS: dict[str, tuple[str, Any]] = {
    "Real": ("fmi2GetReal", ctypes.c_double),
    "Integer": ("fmi2GetInteger", ctypes.c_int),
    "Enumeration": ("fmi2GetInteger", ctypes.c_int),
    "Boolean": ("fmi2GetBoolean", ctypes.c_int),
}

# What FMPy itself logs through; handed back to its proxy after each simulation.
_FMPY_LOGGER = fmpy.fmi2.fmi2CallbackLoggerTYPE(fmpy.fmi2.printLogMessage)


class Fmi2Binding(Binding):
    """An instance of an FMU of FMI 2.0."""

    def __init__(self, identity: Identity, mode: Mode) -> None:
        """See Binding."""
        super().__init__(fmpy.fmi2.FMU2Model if mode == "me" else fmpy.fmi2.FMU2Slave, identity)

    def instantiate(self, log: LogMessage, logging: bool) -> None:
        """See Binding."""
        self.raw.instantiate(callbacks=_callbacks(log), loggingOn=logging)

    def free(self) -> None:
        """See Binding."""
        super().free()
        restore_fmpy_logger()

    def set(self, data_type: str, reference: int, value: float | int | bool | str) -> None:
        """See Binding."""
        name = "Integer" if data_type == "Enumeration" else data_type
        getattr(self.raw, f"set{name}")([reference], [value])

    def reader(self, data_type: str, references: Sequence[int]) -> Reader:
        """See Binding."""
        name, number = _GETTERS[data_type]
        function, component = getattr(self.raw, name), self.raw.component
        numbers = (ctypes.c_uint * len(references))(*references)
        values = (number * len(references))()

        def read() -> Any:
            function(component, numbers, len(values), values)
            return np.array(values, dtype=np.float64)

        return read

    def enter_initialization(self, tolerance: float, start: float, stop: float | None) -> None:
        """See Binding."""
        self.raw.setupExperiment(tolerance=tolerance, startTime=start, stopTime=stop)
        self.raw.enterInitializationMode()

    def update_discrete_states(self) -> DiscreteUpdate:
        """See Binding."""
        again, terminated, _, _, defined, time = self.raw.newDiscreteStates()
        return DiscreteUpdate(bool(again), bool(terminated), *([float(time)] if defined else []))

    def get_derivatives(self, derivatives: Any, count: int) -> None:
        """See Binding."""
        self.raw.getDerivatives(derivatives, count)

    def do_step(self, time: float, step: float) -> StepOutcome:
        """See Binding; a step that ends early, at the model's end too, is answered with discard, which raises."""
        self.raw.doStep(currentCommunicationPoint=time, communicationStepSize=step)
        return StepOutcome(time + step, False)


def restore_fmpy_logger() -> None:
    """Lets FMPy log through its own logger again, after a simulation that was given another one, which may be gone."""
    _log_through(fmpy.fmi2.fmi2CallbackFunctions(logger=_FMPY_LOGGER))


def _callbacks(log: LogMessage) -> Any:
    def logger(_component: Any, _instance: bytes, status: int, category: bytes | None, message: bytes | None) -> None:
        log(status, (category or b"").decode("utf-8", "replace"), (message or b"").decode("utf-8", "replace"))

    callbacks = fmpy.fmi2.fmi2CallbackFunctions()
    callbacks.logger = fmpy.fmi2.fmi2CallbackLoggerTYPE(logger)
    callbacks.allocateMemory = fmpy.fmi2.fmi2CallbackAllocateMemoryTYPE(fmpy.calloc)
    callbacks.freeMemory = fmpy.fmi2.fmi2CallbackFreeMemoryTYPE(fmpy.free)
    _log_through(callbacks)
    return callbacks


def _log_through(callbacks: Any) -> None:
    """Lets FMPy's native proxy format the variadic arguments of messages before the logger of ``callbacks`` sees them.

    The proxy hands messages to the logger it was given last, in the whole process: that one must stay alive. It takes
    the logger's place in ``callbacks``, which must therefore be new.
    """
    addLoggerProxy(fmpy.fmi2.byref(callbacks))
