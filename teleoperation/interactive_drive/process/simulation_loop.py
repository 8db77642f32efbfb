"""The loop that steps a machine at the pace of the clock and carries out commands between steps."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator, Mapping
from itertools import count
from typing import Protocol

from contact_foundation.errors import CmbError, InputError, SimulationError
from fmu_regression.results.result import FloatArray

from interactive_drive.machine.machine import Moment
from interactive_drive.machine.recorded_machine import RecordedMachine
from interactive_drive.pacing.pacer import Pacer
from interactive_drive.process.messages import (
    Command,
    EndReplay,
    Frame,
    Measure,
    Measured,
    Mode,
    Pause,
    Record,
    RecordedRow,
    Refusal,
    Replay,
    Report,
    Reset,
    Restore,
    Run,
    Save,
    SavedState,
    SetSpeed,
    SetValues,
    SingleStep,
    Status,
    Stop,
)

CHECKPOINT_PERIOD = 1.0
MOST_CHECKPOINTS = 5
MOST_SAVED = 20
_LONGEST_WAIT = 0.25


class DrivenMachine(Protocol):
    """What the loop needs of a machine; see ``machine.Machine`` and ``recorded_machine.RecordedMachine``."""

    signals: tuple[str, ...]

    @property
    def time(self) -> float:
        """Reached, s."""

    @property
    def at_end(self) -> bool:
        """Whether there is no further step."""

    @property
    def keeps_states(self) -> bool:
        """Whether states can be saved."""

    def set(self, values: Mapping[str, float]) -> None:
        """Sets controls."""

    def step(self) -> None:
        """One communication step."""

    def row(self) -> FloatArray:
        """Values of the signals."""

    def save(self) -> Moment:
        """Saves the state."""

    def restore(self, moment: Moment) -> None:
        """Goes back."""

    def free(self, moment: Moment) -> None:
        """Frees a saved state."""

    def start_anew(self) -> None:
        """A fresh instance."""


class Inbox(Protocol):
    """Where commands come from."""

    def __call__(self, timeout: float) -> list[Command]:
        """The commands that wait; waits up to ``timeout`` s for the first one."""


class Reports(Protocol):
    """Where reports go; see ``outbox.Outbox``."""

    def post(self, message: Report) -> None:
        """Every one of these arrives."""

    def show(self, message: Report) -> None:
        """The newest of these arrives."""


class SimulationLoop:
    """Steps, obeys and reports until it is told to stop.

    Args:
        machine: ready to be stepped.
        pacer: of its steps.
        inbox: of commands.
        reports: receives frames, rows and states.
    """

    def __init__(self, machine: DrivenMachine, pacer: Pacer, inbox: Inbox, reports: Reports) -> None:
        self._machine, self._pacer, self._inbox, self._reports = machine, pacer, inbox, reports
        self._mode = Mode.PAUSED
        self._message = ""
        self._recording = False
        self._replayed = ""
        self._stamp = 0.0
        self._frame_numbers = count(1)
        self._numbers = 0
        self._waiting: deque[Command] = deque()
        self._stopped = False
        self._start: Moment | None = None
        self._checkpoints: deque[tuple[SavedState, Moment]] = deque()
        self._saved: list[tuple[SavedState, Moment]] = []
        self._actions: dict[type, Callable[[Command], None]] = {
            SetValues: self._set,
            Run: self._run,
            Pause: self._pause,
            SingleStep: self._single_step,
            SetSpeed: self._set_speed,
            Reset: self._reset,
            Save: self._save,
            Restore: self._restore,
            Record: self._record,
            Replay: self._replay,
            EndReplay: lambda _command: None,  # it ended by itself
            Measure: self._measure,
        }

    def run(self) -> bool:
        """Returns after ``Stop``, a replay also where it ends; whether it was ``Stop``."""
        if self._machine.keeps_states:
            self._start = self._machine.save()
        self._report_status()
        self._show()
        while True:
            if self._mode is Mode.RUNNING:
                self._pacer.wait()
            for command in self._commands(0.0 if self._mode is Mode.RUNNING else _LONGEST_WAIT):
                if isinstance(command, Stop):
                    return True
                if self._replayed and isinstance(command, Replay):
                    self._waiting.appendleft(command)
                    return False
                if self._replayed and isinstance(command, EndReplay):
                    return False
                self._obey(command)
                if self._stopped:
                    return True
            if self._mode is Mode.RUNNING:
                self._step()

    def _commands(self, timeout: float) -> Iterator[Command]:
        """Commands one by one; a replay that begins in between takes what is left."""
        self._waiting.extend(self._inbox(0.0 if self._waiting else timeout))
        while self._waiting:
            yield self._waiting.popleft()

    def _obey(self, command: Command) -> None:
        try:
            self._actions[type(command)](command)
        except CmbError as error:
            self._fail(error)

    def _step(self) -> None:
        if self._machine.at_end:
            self._mode, self._message = Mode.PAUSED, "the record ends here"
            self._report_status()
            return
        self._pacer.step_begins()
        try:
            self._machine.step()
            values = self._machine.row()
            self._keep_checkpoint()
        except CmbError as error:
            self._fail(error)
            return
        self._pacer.step_ended()
        if self._recording:
            self._reports.post(RecordedRow(self._machine.time, values))
        self._show(values)

    def _show(self, values: FloatArray | None = None) -> None:
        try:
            row = self._machine.row() if values is None else values
        except CmbError as error:
            self._fail(error)
            return
        pacer, number, replayed = self._pacer, next(self._frame_numbers), bool(self._replayed)
        self._reports.show(
            Frame(self._machine.time, row, self._stamp, number, pacer.factor, pacer.steps, pacer.missed, replayed)
        )

    def _fail(self, error: CmbError) -> None:
        self._mode, self._message = Mode.FAILED, str(error)
        self._report_status()

    def _report_status(self) -> None:
        saved = [state for state, _ in (*self._saved, *self._checkpoints)]
        self._reports.post(
            Status(
                self._mode,
                self._pacer.speed,
                self._message,
                tuple(sorted(saved, key=lambda state: state.number)),
                self._recording,
                self._machine.keeps_states,
                self._replayed,
            )
        )

    # Commands.

    def _set(self, command: Command) -> None:
        assert isinstance(command, SetValues)
        self._stamp = max(self._stamp, command.stamp)
        self._set_machine(command.values)
        if self._mode is Mode.PAUSED:
            self._show()

    def _set_machine(self, values: Mapping[str, float]) -> None:
        if self._mode is not Mode.FAILED:
            self._machine.set(values)

    def _run(self, _command: Command) -> None:
        if self._mode is Mode.PAUSED:
            if self._machine.at_end:
                self._machine.start_anew()
            self._mode, self._message = Mode.RUNNING, ""
            self._pacer.begin()
            self._report_status()

    def _pause(self, _command: Command) -> None:
        if self._mode is Mode.RUNNING:
            self._mode = Mode.PAUSED
            self._report_status()

    def _single_step(self, _command: Command) -> None:
        if self._mode is Mode.FAILED:
            return
        self._pause(_command)
        self._message = ""
        self._pacer.begin()
        self._step()

    def _set_speed(self, command: Command) -> None:
        assert isinstance(command, SetSpeed)
        self._pacer.set_speed(command.speed)
        self._report_status()

    def _reset(self, _command: Command) -> None:
        self._end_record("the machine was reset")
        failed = self._mode is Mode.FAILED
        try:
            if self._start is None:
                raise SimulationError("this FMU keeps no states")
            self._machine.restore(self._start)
        except SimulationError:
            self._forget_all()
            self._machine.start_anew()
            if self._machine.keeps_states:
                self._start = self._machine.save()
        self._forget_checkpoints()
        self._mode, self._message = Mode.PAUSED if failed else self._mode, ""
        self._pacer.begin()
        self._report_status()
        self._show()

    def _save(self, _command: Command) -> None:
        if self._mode is Mode.FAILED:
            return
        if len(self._saved) >= MOST_SAVED:
            self._machine.free(self._saved.pop(0)[1])
        self._saved.append((self._numbered(automatic=False), self._machine.save()))
        self._report_status()

    def _restore(self, command: Command) -> None:
        assert isinstance(command, Restore)
        known = (*self._saved, *self._checkpoints)
        moment = next((moment for state, moment in known if state.number == command.number), None)
        if moment is None:
            self._report_status()
            return
        self._end_record("an earlier state was restored")
        self._machine.restore(moment)
        while self._checkpoints and self._checkpoints[-1][0].time > moment.time:
            self._machine.free(self._checkpoints.pop()[1])
        self._mode, self._message = Mode.PAUSED, ""
        self._report_status()
        self._show()

    def _record(self, command: Command) -> None:
        assert isinstance(command, Record)
        if command.on and not self._recording and self._mode is not Mode.FAILED:
            self._recording = True
            self._report_status()
            self._reports.post(RecordedRow(self._machine.time, self._machine.row()))
        elif not command.on:
            self._end_record("")

    def _replay(self, command: Command) -> None:
        assert isinstance(command, Replay)
        self._pause(command)
        self._end_record("another one is replayed")
        try:
            machine = RecordedMachine(command.file, self._machine.signals, self._set_machine)
        except InputError as error:
            self._reports.post(Refusal(str(error)))
            return
        replay = SimulationLoop(machine, self._pacer.for_steps_of(machine.step_length), self._inbox, self._reports)
        replay._replayed = command.file.parent.name
        replay._waiting, replay._frame_numbers = self._waiting, self._frame_numbers
        self._stopped = replay.run()
        self._report_status()
        self._show()

    def _measure(self, command: Command) -> None:
        assert isinstance(command, Measure)
        self._reports.post(Measured(self._pacer.record()))
        if command.afresh:
            self._pacer.clear_record()

    # Saved states.

    def _end_record(self, why: str) -> None:
        if self._recording:
            self._recording = False
            self._message = f"the record ended: {why}" if why else ""
            self._report_status()

    def _numbered(self, *, automatic: bool) -> SavedState:
        self._numbers += 1
        return SavedState(self._numbers, self._machine.time, automatic)

    def _keep_checkpoint(self) -> None:
        if not self._machine.keeps_states:
            return
        last = self._checkpoints[-1][0].time if self._checkpoints else self._start.time if self._start else -1e300
        if self._machine.time - last < CHECKPOINT_PERIOD * (1 - 1e-9):
            return
        if len(self._checkpoints) >= MOST_CHECKPOINTS:
            self._machine.free(self._checkpoints.popleft()[1])
        self._checkpoints.append((self._numbered(automatic=True), self._machine.save()))
        self._report_status()

    def _forget_checkpoints(self) -> None:
        while self._checkpoints:
            self._machine.free(self._checkpoints.pop()[1])

    def _forget_all(self) -> None:
        self._forget_checkpoints()
        for _, moment in self._saved:
            self._machine.free(moment)
        self._saved.clear()
        if self._start is not None:
            self._machine.free(self._start)
            self._start = None
