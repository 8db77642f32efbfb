"""Collecting the values of chosen variables of an FMU instance, row by row."""

from __future__ import annotations

import ctypes
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from fmu_regression.fmu import Instance, Variable
from fmu_regression.result import FloatArray

_GETTERS: dict[str, tuple[str, Any]] = {
    "Real": ("fmi2GetReal", ctypes.c_double),
    "Integer": ("fmi2GetInteger", ctypes.c_int),
    "Enumeration": ("fmi2GetInteger", ctypes.c_int),
    "Boolean": ("fmi2GetBoolean", ctypes.c_int),
}


class Recorder:
    """Reads variables of an instance and keeps every row; nothing is thinned.

    Args:
        instance: the instance to read.
        variables: what to record; no strings.
    """

    def __init__(self, instance: Instance, variables: Sequence[Variable]) -> None:
        self._component = instance.raw.component
        self._variables = tuple(variables)
        self._time: list[float] = []
        self._groups: list[tuple[Any, Any, Any, list[FloatArray], tuple[Variable, ...]]] = []
        for kinds in (("Real",), ("Integer", "Enumeration"), ("Boolean",)):
            members = tuple(v for v in self._variables if v.kind in kinds)
            if members:
                name, number = _GETTERS[kinds[0]]
                references = (ctypes.c_uint * len(members))(*(v.reference for v in members))
                values = (number * len(members))()
                self._groups.append((getattr(instance.raw, name), references, values, [], members))

    @property
    def row_count(self) -> int:
        """Rows so far."""
        return len(self._time)

    def sample(self, time: float) -> None:
        """Appends a row with the instance's present values.

        Raises:
            fmpy.fmi1.FMICallException: the FMU cannot compute them.
        """
        for get, references, values, rows, _ in self._groups:
            get(self._component, references, len(values), values)
            rows.append(np.array(values, dtype=np.float64))
        self._time.append(time)

    def table(self) -> tuple[FloatArray, Mapping[str, FloatArray]]:
        """Time, shape (n,), and name to values, each of shape (n,), in the order asked for."""
        time = np.array(self._time, dtype=np.float64)
        columns: dict[str, FloatArray] = {}
        for *_, rows, members in self._groups:
            block = np.array(rows, dtype=np.float64).reshape(len(rows), len(members))
            for k, variable in enumerate(members):
                columns[variable.name] = np.ascontiguousarray(block[: time.size, k])
        return time, {v.name: columns[v.name] for v in self._variables}
