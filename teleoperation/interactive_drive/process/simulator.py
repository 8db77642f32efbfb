"""The server's side of the simulation's process: starts it, sends commands, hears reports, notices its end."""

from __future__ import annotations

import multiprocessing
import shutil
import signal
import tempfile
import threading
from collections.abc import Callable
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from pathlib import Path

from interactive_drive.process.messages import Command, Mode, Report, SetValues, Status, Stop
from interactive_drive.process.outbox import Outbox
from interactive_drive.process.worker import Plan, simulate_in_process

_PATIENCE = 3.0


class Simulator:
    """A simulation in a process of its own.

    Args:
        plan: what is simulated.
        hear: receives every report, in a thread of this class.
    """

    def __init__(self, plan: Plan, hear: Callable[[Report], None]) -> None:
        self._plan, self._hear = plan, hear
        self._process: BaseProcess | None = None
        self._commands: Outbox[Command] | None = None
        self._listener: threading.Thread | None = None
        self._folder: Path | None = None
        self._ending = False

    def start(self) -> None:
        """Starts the process; it opens the FMU and reports when the machine stands."""
        self._ending = False
        self._folder = Path(tempfile.mkdtemp(prefix="cmb-drive-"))
        context = multiprocessing.get_context("spawn")  # a fork would copy the server's threads half
        here, there = context.Pipe()
        self._process = context.Process(
            target=simulate_in_process, args=(self._plan, there, self._folder), daemon=True, name="cmb-simulation"
        )
        self._process.start()
        there.close()
        self._commands = Outbox(here.send, _merged)
        self._listener = threading.Thread(target=self._listen, args=(here, self._process), daemon=True)
        self._listener.start()

    def send(self, command: Command) -> None:
        """Sends a command; values of controls that wait are merged, everything else arrives in order."""
        if self._commands is None:
            return
        if isinstance(command, SetValues):
            self._commands.show(command)
        else:
            self._commands.post(command)

    def stop(self) -> None:
        """Ends the process, kindly and then not, and removes what it unpacked."""
        self._ending = True
        process = self._process
        if process is not None:
            self.send(Stop())
            process.join(_PATIENCE)
            if process.is_alive():
                process.kill()
                process.join()
        if self._commands is not None:
            self._commands.close()
        if self._listener is not None:
            self._listener.join(_PATIENCE)
        if self._folder is not None:
            shutil.rmtree(self._folder, ignore_errors=True)
        self._process = self._commands = self._listener = self._folder = None

    def restart(self) -> None:
        """Ends the process if it still runs, and starts another one."""
        self.stop()
        self.start()

    def _listen(self, connection: Connection, process: BaseProcess) -> None:
        last: Report | None = None
        try:
            while True:
                last = connection.recv()
                self._hear(last)
        except (EOFError, OSError):
            pass
        process.join(_PATIENCE)
        told = isinstance(last, Status) and last.mode is Mode.ENDED
        if not self._ending and not told:
            self._hear(Status(Mode.ENDED, message=f"the simulation's process ended: {_cause(process.exitcode)}"))


def _merged(older: Command, newer: Command) -> Command:
    assert isinstance(older, SetValues)
    assert isinstance(newer, SetValues)
    return SetValues({**older.values, **newer.values}, max(older.stamp, newer.stamp))


def _cause(exit_code: int | None) -> str:
    if exit_code is not None and exit_code < 0:
        return f"signal {signal.Signals(-exit_code).name} in the FMU"
    return f"status {exit_code}"
