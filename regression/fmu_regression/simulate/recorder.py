"""Collecting the values of chosen variables of an FMU instance, row by row."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from fmu_regression.fmi.binding import Reader
from fmu_regression.fmi.description import Variable
from fmu_regression.fmi.fmu import Instance
from fmu_regression.results.result import FloatArray


class Recorder:
    """Reads variables of an instance and keeps every row; nothing is thinned.

    Args:
        instance: the instance to read.
        variables: what to record; no strings.
    """

    def __init__(self, instance: Instance, variables: Sequence[Variable]) -> None:
        self._variables = tuple(variables)
        self._time: list[float] = []
        self._groups: list[tuple[Reader, list[FloatArray], tuple[Variable, ...]]] = []
        for data_type in dict.fromkeys(variable.data_type for variable in self._variables):
            members = tuple(variable for variable in self._variables if variable.data_type == data_type)
            read = instance.functions.reader(data_type, [variable.reference for variable in members])
            self._groups.append((read, [], members))

    def sample(self, time: float) -> None:
        """Appends a row with the instance's present values.

        Raises:
            fmpy.fmi1.FMICallException: the FMU cannot compute them.
        """
        for read, rows, _ in self._groups:
            rows.append(read())
        self._time.append(time)

    def table(self) -> tuple[FloatArray, Mapping[str, FloatArray]]:
        """Time, shape (n,), and name to values, each of shape (n,), in the order asked for."""
        time = np.array(self._time, dtype=np.float64)
        columns: dict[str, FloatArray] = {}
        for _, rows, members in self._groups:
            block = np.array(rows, dtype=np.float64).reshape(len(rows), len(members))
            for k, variable in enumerate(members):
                columns[variable.name] = np.ascontiguousarray(block[: time.size, k])
        return time, {v.name: columns[v.name] for v in self._variables}
