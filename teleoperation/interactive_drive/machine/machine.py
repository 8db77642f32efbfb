"""A co-simulation FMU that is stepped without an end: inputs, whole states saved and restored, a fresh start."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from types import TracebackType
from typing import Self

import numpy as np
from contact_foundation.errors import InputError, Place, SimulationError
from fmpy.fmi1 import FMICallException
from fmu_regression.fmi.binding import Reader, SavedState
from fmu_regression.fmi.description import StartValue, check_signals, check_start_values
from fmu_regression.fmi.fmu import Fmu, Instance
from fmu_regression.results.result import FloatArray

DEFAULT_TOLERANCE = 1e-4
_SLACK = 1e-9


@dataclass(frozen=True)
class Moment:
    """A saved state and its time in s."""

    state: SavedState
    time: float


class Machine:
    """An instance of an FMU between two communication points.

    Attributes:
        signals: names of the variables of ``row``.
        time: reached, s.
        at_end: never; see ``recorded_machine``.
    """

    at_end = False

    def __init__(
        self,
        fmu: Fmu,
        signals: Sequence[str],
        step: float,
        tolerance: float | None = None,
        start_values: Mapping[str, StartValue] | None = None,
    ) -> None:
        """Checks what is asked for; ``with`` makes the instance and initializes it.

        Args:
            fmu: an opened FMU that offers co-simulation.
            signals: variables to read after each step.
            step: of communication, s.
            tolerance: relative tolerance of the FMU's solver; 1e-4 if neither this nor the FMU says.
            start_values: of parameters.

        Raises:
            InputError: a signal or a start value is wrong, or the FMU cannot be stepped from outside.
        """
        if "cs" not in fmu.description.identifiers:
            raise InputError(
                "the FMU offers model exchange alone and cannot be driven",
                place=Place(file=fmu.path),
                remedy="Build it for co-simulation too; FMUs of cmb fmu are.",
            )
        self._fmu = fmu
        self._variables = check_signals(fmu.description, signals)
        self._start_values = check_start_values(fmu.description, start_values or {})
        self._tolerance = tolerance or fmu.description.tolerance or DEFAULT_TOLERANCE
        self.step_length = step
        self.signals = tuple(variable.name for variable in self._variables)
        self.time = fmu.description.start
        self._stack = ExitStack()
        self._instance: Instance | None = None
        self._readers: list[tuple[Reader, list[int]]] = []
        self._origin, self._count = self.time, 0

    @property
    def keeps_states(self) -> bool:
        """Whether states can be saved and restored."""
        return self._fmu.description.keeps_states

    def __enter__(self) -> Self:
        """Makes an instance and initializes it.

        Raises:
            InputError: the binary cannot be loaded.
            SimulationError: initialization failed.
        """
        self.start_anew()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Frees the instance."""
        self._stack.close()
        self._instance = None

    def start_anew(self) -> None:
        """Replaces the instance, if there is one, by a fresh one at the start time.

        Saved states of the old one are lost. Raises as ``with`` does.
        """
        self._stack.close()
        self._instance = None
        instance = self._stack.enter_context(self._fmu.instantiate("cs"))
        description = self._fmu.description
        try:
            instance.set_start_values(self._start_values)
            instance.functions.enter_initialization(self._tolerance, description.start, None)
            instance.functions.exit_initialization()
        except FMICallException as error:
            raise instance.failure("the initialization failed", error) from error
        self._instance = instance
        self._readers = self._make_readers(instance)
        self._go_to(description.start)

    def _make_readers(self, instance: Instance) -> list[tuple[Reader, list[int]]]:
        readers = []
        for data_type in dict.fromkeys(variable.data_type for variable in self._variables):
            places = [k for k, variable in enumerate(self._variables) if variable.data_type == data_type]
            references = [self._variables[k].reference for k in places]
            readers.append((instance.functions.reader(data_type, references), places))
        return readers

    def set(self, values: Mapping[str, float]) -> None:
        """Sets inputs and tunable parameters; they count from the next step on.

        Raises:
            SimulationError: the FMU refuses a value.
        """
        instance = self._ready()
        for name, value in values.items():
            variable = self._fmu.description.variables[name]
            number: float | int | bool = value
            if variable.kind != "Real":
                number = bool(value) if variable.kind == "Boolean" else round(value)
            try:
                instance.functions.set(variable.data_type, variable.reference, number)
            except FMICallException as error:
                raise instance.failure(f"{name} = {value:g} is refused", error) from error

    def step(self) -> None:
        """One communication step.

        Raises:
            SimulationError: it failed, with what the FMU said; ``time`` stays.
        """
        instance = self._ready()
        target = self._origin + (self._count + 1) * self.step_length
        said = len(instance.messages)
        try:
            outcome = instance.functions.do_step(self.time, target - self.time)
        except FMICallException as error:
            del instance.messages[:said]  # what went before is no cause
            raise instance.failure(f"stopped after t = {self.time:.6g} s", error) from error
        if outcome.terminated or outcome.time < target - _SLACK * self.step_length:
            cause = "the model asked for its end" if outcome.terminated else "the FMU ended a step early"
            raise instance.failure(f"{cause} at t = {outcome.time:.6g} s")
        self._count += 1
        self.time = target

    def row(self) -> FloatArray:
        """Values of the signals now, shape (len(signals),).

        Raises:
            SimulationError: the FMU cannot compute them, or one is not a number.
        """
        instance = self._ready()
        values = np.empty(len(self._variables))
        try:
            for read, places in self._readers:
                values[places] = read()
        except FMICallException as error:
            raise instance.failure(f"values at t = {self.time:.6g} s", error) from error
        wrong = np.flatnonzero(np.isnan(values))
        if wrong.size:
            names = ", ".join(self.signals[k] for k in wrong[:3])
            raise SimulationError(
                f"{names} {'is' if wrong.size == 1 else 'are'} not a number at t = {self.time:.6g} s",
                place=Place(component=self._fmu.description.name),
            )
        return values

    def save(self) -> Moment:
        """A copy of the whole state; free it before the machine is left or started anew.

        Raises:
            SimulationError: the FMU keeps no states, or refuses.
        """
        instance = self._ready()
        self._require_states()
        try:
            return Moment(instance.functions.save_state(), self.time)
        except FMICallException as error:
            raise instance.failure("the state cannot be saved", error) from error

    def restore(self, moment: Moment) -> None:
        """Goes back to a saved state.

        Raises:
            SimulationError: the FMU keeps no states, or refuses.
        """
        instance = self._ready()
        self._require_states()
        try:
            instance.functions.restore_state(moment.state)
        except FMICallException as error:
            raise instance.failure("the state cannot be restored", error) from error
        self._go_to(moment.time)

    def free(self, moment: Moment) -> None:
        """Frees a saved state; what the FMU says to that is of no interest."""
        try:
            self._ready().functions.free_state(moment.state)
        except (FMICallException, SimulationError):
            return

    def _go_to(self, time: float) -> None:
        self.time = self._origin = time
        self._count = 0

    def _require_states(self) -> None:
        if not self.keeps_states:
            raise SimulationError(
                "this FMU keeps no states: it can be reset, not saved",
                place=Place(component=self._fmu.description.name),
            )

    def _ready(self) -> Instance:
        if self._instance is None:
            raise SimulationError("there is no instance of the FMU", place=Place(component=self._fmu.description.name))
        return self._instance
