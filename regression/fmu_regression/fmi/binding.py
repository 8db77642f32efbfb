"""What FMI 2.0 and 3.0 have in common: the functions of an instance, as those who simulate it use them."""

from __future__ import annotations

import ctypes
import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from fmu_regression.results.result import FloatArray

Mode = Literal["me", "cs"]
LogMessage = Callable[[int, str, str], None]
"""Receives FMI status, category and text of a message."""
Reader = Callable[[], FloatArray]
"""Reads the same variables each time, shape (n,)."""
SavedState = Any
"""A pointer that the FMU gave."""


@dataclass(frozen=True)
class Identity:
    """What is needed to load an FMU's binary.

    Attributes:
        folder: the unpacked FMU.
        name: of the instance.
        token: GUID or instantiation token.
        model_identifier: name of the binary.
    """

    folder: Path
    name: str
    token: str
    model_identifier: str


@dataclass(frozen=True)
class DiscreteUpdate:
    """Outcome of one event iteration.

    Attributes:
        again: whether another iteration is needed.
        terminated: whether the model asks for the end.
        next_time: of the next time event, infinite if there is none.
    """

    again: bool
    terminated: bool
    next_time: float = math.inf


@dataclass(frozen=True)
class StepOutcome:
    """Outcome of a communication step that did not fail.

    Attributes:
        time: reached.
        terminated: whether the model asks for the end.
    """

    time: float
    terminated: bool


class Binding(ABC):
    """One instance through FMPy's functions of one version of the standard.

    All methods raise ``fmpy.fmi1.FMICallException`` where the FMU answers with worse than a warning. Arrays of states
    and indicators are ``ctypes`` arrays of or pointers to double.

    Attributes:
        raw: FMPy's object.
    """

    def __init__(self, kind: type[Any], identity: Identity) -> None:
        """Loads the binary; raises any exception if that fails.

        Args:
            kind: FMPy's class of instances for a version and a mode.
            identity: what to load.
        """
        self.raw = kind(
            guid=identity.token,
            unzipDirectory=str(identity.folder),
            modelIdentifier=identity.model_identifier,
            instanceName=identity.name,
        )

    @abstractmethod
    def instantiate(self, log: LogMessage, logging: bool) -> None:
        """Makes the instance; raises any exception if that fails.

        Args:
            log: receives messages.
            logging: whether debug messages are wanted too.
        """

    def free(self) -> None:
        """Frees instance and binary."""
        self.raw.freeInstance()

    def unload(self) -> None:
        """Frees the binary of which no instance was made."""
        self.raw.freeLibrary()

    @abstractmethod
    def set(self, data_type: str, reference: int, value: float | int | bool | str) -> None:
        """Sets a variable of the given FMI type, "Float64"."""

    @abstractmethod
    def reader(self, data_type: str, references: Sequence[int]) -> Reader:
        """A function that reads variables of one FMI type, not strings."""

    @abstractmethod
    def enter_initialization(self, tolerance: float, start: float, stop: float | None) -> None:
        """Says what will be simulated, without an end if ``stop`` is None, and enters initialization mode."""

    def exit_initialization(self) -> None:
        """Ends initialization."""
        self.raw.exitInitializationMode()

    def terminate(self) -> None:
        """Ends the simulation."""
        self.raw.terminate()

    # Whole states of the FMU, where its description says that it keeps them.

    def save_state(self) -> SavedState:
        """A copy of everything that the FMU knows, until ``free_state``."""
        return self.raw.getFMUState()

    def restore_state(self, state: SavedState) -> None:
        """Puts the FMU where it was when the state was saved, its phase included."""
        self.raw.setFMUState(state)

    def free_state(self, state: SavedState) -> None:
        """Frees a saved state; before the instance is freed."""
        self.raw.freeFMUState(state)

    # Model exchange.

    def enter_event_mode(self) -> None:
        """Enters event mode."""
        self.raw.enterEventMode()

    @abstractmethod
    def update_discrete_states(self) -> DiscreteUpdate:
        """One event iteration."""

    def enter_continuous_time_mode(self) -> None:
        """Leaves event mode."""
        self.raw.enterContinuousTimeMode()

    def completed_step(self) -> tuple[bool, bool]:
        """Tells of a completed step; whether event mode is to be entered, and whether the model ends."""
        event, terminated = self.raw.completedIntegratorStep()
        return bool(event), bool(terminated)

    def set_time(self, time: float) -> None:
        """Sets the time."""
        self.raw.setTime(time)

    def set_states(self, states: Any, count: int) -> None:
        """Sets the continuous states."""
        self.raw.setContinuousStates(states, count)

    def get_states(self, count: int) -> Any:
        """The continuous states."""
        values = (ctypes.c_double * count)()
        self.raw.getContinuousStates(values, count)
        return values

    def get_nominals(self, count: int) -> Any:
        """Nominal values of the continuous states."""
        values = (ctypes.c_double * count)()
        self.raw.getNominalsOfContinuousStates(values, count)
        return values

    @abstractmethod
    def get_derivatives(self, derivatives: Any, count: int) -> None:
        """Writes the states' derivatives."""

    def get_indicators(self, indicators: Any, count: int) -> None:
        """Writes the event indicators."""
        self.raw.getEventIndicators(indicators, count)

    # Co-simulation.

    @abstractmethod
    def do_step(self, time: float, step: float) -> StepOutcome:
        """A communication step from ``time`` over ``step``, in s."""
