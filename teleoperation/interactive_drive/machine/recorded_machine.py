"""A record stepped through as if it were the machine: replay."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import numpy as np
from contact_foundation.errors import InputError, Place, SimulationError
from fmu_regression.results.result import FloatArray, read_csv

from interactive_drive.machine.machine import Moment


class RecordedMachine:
    """The rows of a record, one after the other.

    Attributes:
        signals: names of the values of ``row``.
        step_length: between rows, s.
        time: of the present row, s.
        keeps_states: no; a record is gone through from its start.
    """

    keeps_states = False

    def __init__(
        self, file: Path, signals: Sequence[str], set_waiting: Callable[[Mapping[str, float]], None] | None = None
    ) -> None:
        """Reads a record.

        Args:
            file: result.csv.
            signals: to show; the record may have more.
            set_waiting: takes values for the machine that waits.

        Raises:
            InputError: the file cannot be read, has one row alone, or lacks a signal.
        """
        result = read_csv(file)
        missing = [name for name in signals if name not in result]
        if missing:
            raise InputError(
                f"the record has no {missing[0]}: it is of another machine",
                place=Place(file=file),
                remedy="Drive the machine that it was made of, or look at the record's report.",
            )
        times = np.diff(result.time)
        if not times.size or not times.max() > 0:
            raise InputError("the record holds no time that passes", place=Place(file=file))
        self.signals = tuple(signals)
        self.step_length = float(np.median(times[times > 0]))
        self._time, self._rows = result.time, result.vector(self.signals)
        self._present = 0
        self._set_waiting = set_waiting

    @property
    def time(self) -> float:
        """Of the present row, s."""
        return float(self._time[self._present])

    @property
    def at_end(self) -> bool:
        """Whether the last row is the present one."""
        return self._present == len(self._time) - 1

    def set(self, values: Mapping[str, float]) -> None:
        """What was recorded stays; values are for the machine that waits.

        Pages set none in a replay, but the last before it may come late, and who leaves lets go of the inputs.
        """
        if self._set_waiting is not None:
            self._set_waiting(values)

    def step(self) -> None:
        """On to the next row; the last one stays."""
        self._present = min(self._present + 1, len(self._time) - 1)

    def row(self) -> FloatArray:
        """Values of the signals in the present row."""
        values: FloatArray = self._rows[self._present].copy()
        return values

    def start_anew(self) -> None:
        """Back to the first row."""
        self._present = 0

    def save(self) -> Moment:
        """Refused: see ``keeps_states``."""
        raise SimulationError("a record keeps no states")

    def restore(self, moment: Moment) -> None:  # noqa: ARG002
        """Refused."""
        raise SimulationError("a record keeps no states")

    def free(self, moment: Moment) -> None:
        """Nothing to do."""
