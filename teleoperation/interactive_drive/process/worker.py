"""What runs in the simulation's process."""

from __future__ import annotations

import gc
import os
import tempfile
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from multiprocessing.connection import Connection
from pathlib import Path

from contact_foundation.errors import CmbError
from fmu_regression.fmi.description import StartValue
from fmu_regression.fmi.fmu import open_fmu
from fmu_regression.simulate.limited_process import end_with_parent

from interactive_drive.machine.machine import Machine
from interactive_drive.pacing.pacer import Pacer
from interactive_drive.process.messages import Command, Mode, Report, Status, Stop
from interactive_drive.process.outbox import Outbox
from interactive_drive.process.simulation_loop import SimulationLoop

_FAVOUR = -10  # of the process among others on this machine


@dataclass(frozen=True)
class Plan:
    """What is simulated.

    Attributes:
        fmu: the file.
        signals: names of the variables that frames hold.
        step: of communication, s.
        tolerance: of the FMU's solver; its own if None.
        start_values: of parameters.
    """

    fmu: Path
    signals: tuple[str, ...]
    step: float
    tolerance: float | None = None
    start_values: Mapping[str, StartValue] = field(default_factory=dict)


def simulate_in_process(plan: Plan, connection: Connection, folder: Path) -> None:
    """Simulates until the other end of the connection says Stop or is closed.

    Args:
        plan: what to simulate.
        connection: to the server; commands in, reports out.
        folder: for what is unpacked; the server removes it.
    """
    end_with_parent()
    with suppress(OSError):  # only for those who may
        os.nice(_FAVOUR)
    tempfile.tempdir = str(folder)
    reports: Outbox[Report] = Outbox(connection.send)

    def inbox(timeout: float) -> list[Command]:
        commands: list[Command] = []
        try:
            if connection.poll(timeout):
                commands.append(connection.recv())
                while connection.poll(0):
                    commands.append(connection.recv())
        except (EOFError, OSError):
            commands.append(Stop())
        return commands

    try:
        with open_fmu(plan.fmu) as fmu:
            machine = Machine(fmu, plan.signals, plan.step, plan.tolerance, plan.start_values)
            with machine:
                # What was loaded stays: a full collection in the midst of a step would take longer than the step.
                gc.collect()
                gc.freeze()
                SimulationLoop(machine, Pacer(plan.step), inbox, reports).run()
    except CmbError as error:
        reports.post(Status(Mode.ENDED, message=str(error)))
    reports.close()
