"""What the server and the simulation's process tell each other; all of it can be pickled."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from pathlib import Path

from fmu_regression.results.result import FloatArray

from interactive_drive.pacing.pacer import PacingRecord


class Mode(Enum):
    """What the simulation does."""

    STARTING = "starting"
    RUNNING = "running"
    PAUSED = "paused"
    FAILED = "failed"
    ENDED = "ended"


# From the server.


@dataclass(frozen=True)
class SetValues:
    """Values of controls from the next step on; ``stamp`` comes back with the first frame that they count in."""

    values: Mapping[str, float]
    stamp: float = 0.0


@dataclass(frozen=True)
class Run:
    """Goes on."""


@dataclass(frozen=True)
class Pause:
    """Stops after the present step."""


@dataclass(frozen=True)
class SingleStep:
    """Pauses, and makes one step."""


@dataclass(frozen=True)
class SetSpeed:
    """Simulated over wall time that is aimed at."""

    speed: float


@dataclass(frozen=True)
class Reset:
    """Goes to the start; whether it runs stays, a failure is over."""


@dataclass(frozen=True)
class Save:
    """Saves the state."""


@dataclass(frozen=True)
class Restore:
    """Goes to the saved state of a number and pauses there."""

    number: int


@dataclass(frozen=True)
class Record:
    """Begins or ends to hand on every step's row."""

    on: bool


@dataclass(frozen=True)
class Replay:
    """Goes through a record's rows until ``EndReplay``; the machine waits where it is."""

    file: Path


@dataclass(frozen=True)
class EndReplay:
    """Goes back to the machine, which is paused."""


@dataclass(frozen=True)
class Measure:
    """Asks for what the pacer measured; ``afresh`` clears it."""

    afresh: bool = False


@dataclass(frozen=True)
class Stop:
    """Ends the process."""


Command = (
    SetValues
    | Run
    | Pause
    | SingleStep
    | SetSpeed
    | Reset
    | Save
    | Restore
    | Record
    | Replay
    | EndReplay
    | Measure
    | Stop
)


# From the simulation.


@dataclass(frozen=True)
class Frame:
    """The machine after a step.

    Attributes:
        time: s.
        values: of the signals, shape (n,).
        stamp: of the newest values of controls that count in it.
        number: counts frames from 1.
        factor: real-time factor, NaN where unknown.
        steps, missed: steps since the start, and those among them that missed their deadline.
        replayed: whether it is of a record.
    """

    time: float
    values: FloatArray
    stamp: float
    number: int
    factor: float
    steps: int
    missed: int
    replayed: bool = False


@dataclass(frozen=True)
class RecordedRow:
    """A row of the record."""

    time: float
    values: FloatArray


@dataclass(frozen=True)
class SavedState:
    """A state that can be gone back to; ``automatic`` ones come and go by themselves."""

    number: int
    time: float
    automatic: bool


@dataclass(frozen=True)
class Status:
    """What changed beside the machine's motion.

    Attributes:
        mode: what the simulation does.
        speed: that is aimed at.
        message: of a failure, or a remark; "" if there is none.
        saved: states to go back to, oldest first.
        recording: whether rows are handed on.
        keeps_states: whether states can be saved.
        replayed: name of the record that is replayed; "" while there is none.
    """

    mode: Mode
    speed: float = 1.0
    message: str = ""
    saved: tuple[SavedState, ...] = ()
    recording: bool = False
    keeps_states: bool = False
    replayed: str = ""


@dataclass(frozen=True)
class Refusal:
    """Why a command was not carried out; all else stays as it is."""

    text: str


@dataclass(frozen=True)
class Measured:
    """The answer to ``Measure``."""

    record: PacingRecord


Report = Frame | RecordedRow | Status | Refusal | Measured
