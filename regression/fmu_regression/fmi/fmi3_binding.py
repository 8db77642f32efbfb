"""FMI 3.0 through FMPy."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from typing import Any

import fmpy.fmi3
import numpy as np

from fmu_regression.fmi.binding import Binding, DiscreteUpdate, Identity, LogMessage, Mode, Reader, StepOutcome

_NUMBERS: dict[str, Any] = {
    "Float32": ctypes.c_float,
    "Float64": ctypes.c_double,
    "Int8": ctypes.c_int8,
    "UInt8": ctypes.c_uint8,
    "Int16": ctypes.c_int16,
    "UInt16": ctypes.c_uint16,
    "Int32": ctypes.c_int32,
    "UInt32": ctypes.c_uint32,
    "Int64": ctypes.c_int64,
    "UInt64": ctypes.c_uint64,
    "Boolean": ctypes.c_bool,
}


def _function(data_type: str) -> str:
    return "Int64" if data_type == "Enumeration" else data_type


class Fmi3Binding(Binding):
    """An instance of an FMU of FMI 3.0; in co-simulation it handles its events itself."""

    def __init__(self, identity: Identity, mode: Mode) -> None:
        """See Binding."""
        super().__init__(fmpy.fmi3.FMU3Model if mode == "me" else fmpy.fmi3.FMU3Slave, identity)

    def instantiate(self, log: LogMessage, logging: bool) -> None:
        """See Binding."""

        def message(_environment: Any, status: int, category: bytes | None, text: bytes | None) -> None:
            log(status, (category or b"").decode("utf-8", "replace"), (text or b"").decode("utf-8", "replace"))

        self.raw.instantiate(loggingOn=logging, logMessage=message)

    def set(self, data_type: str, reference: int, value: float | int | bool | str) -> None:
        """See Binding."""
        getattr(self.raw, f"set{_function(data_type)}")([reference], [value])

    def reader(self, data_type: str, references: Sequence[int]) -> Reader:
        """See Binding."""
        name = _function(data_type)
        function, component = getattr(self.raw, f"fmi3Get{name}"), self.raw.component
        numbers = (ctypes.c_uint32 * len(references))(*references)
        values = (_NUMBERS[name] * len(references))()

        def read() -> Any:
            function(component, numbers, len(numbers), values, len(values))
            return np.array(values, dtype=np.float64)

        return read

    def enter_initialization(self, tolerance: float, start: float, stop: float | None) -> None:
        """See Binding."""
        self.raw.enterInitializationMode(tolerance=tolerance, startTime=start, stopTime=stop)

    def update_discrete_states(self) -> DiscreteUpdate:
        """See Binding."""
        again, terminated, _, _, defined, time = self.raw.updateDiscreteStates()
        return DiscreteUpdate(bool(again), bool(terminated), *([float(time)] if defined else []))

    def get_derivatives(self, derivatives: Any, count: int) -> None:
        """See Binding."""
        self.raw.getContinuousStateDerivatives(derivatives, count)

    def do_step(self, time: float, step: float) -> StepOutcome:
        """See Binding."""
        _, terminated, early, reached = self.raw.doStep(currentCommunicationPoint=time, communicationStepSize=step)
        return StepOutcome(float(reached) if early or terminated else time + step, bool(terminated))
