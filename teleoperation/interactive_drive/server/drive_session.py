"""What a drive is made of, as the server needs it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol

from fmu_regression.scene.scene_file import Scene

from interactive_drive.channel.conditions import Conditions
from interactive_drive.machine.controls import Control
from interactive_drive.operation.key_map import KeyMap
from interactive_drive.process.messages import Command


class Simulation(Protocol):
    """The simulation's process; see ``process.simulator.Simulator``."""

    def send(self, command: Command) -> None:
        """Sends a command."""

    def restart(self) -> None:
        """Ends the process and starts another one; takes its time."""


@dataclass(frozen=True)
class DriveSession:
    """What is driven and how.

    Attributes:
        model: name of the model.
        step: of communication, s.
        signals: names of the values of a frame.
        controls: what the operator sets.
        key_map: keys and axes.
        scene: what is drawn, or None.
        scene_file: where it came from, for the report.
        output: folder of records.
        plots: names of the signals plotted at first.
        units: of the signals.
        channel: poor one that is simulated between the server and each page, or None.
    """

    model: str
    step: float
    signals: tuple[str, ...]
    controls: tuple[Control, ...]
    key_map: KeyMap
    scene: Scene | None
    scene_file: Path | None
    output: Path
    plots: tuple[str, ...]
    units: Mapping[str, str] = field(default_factory=dict)
    channel: Conditions | None = None
