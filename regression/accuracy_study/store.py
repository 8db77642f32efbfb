"""What a study has found so far, in its folder: one file a run and one a tight trajectory, each written whole."""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np
from contact_foundation.errors import InputError, Place
from contact_foundation.output import MARKER, whole_file
from fmu_regression.results.result import SimulationResult

_FORMAT: Final = 1
"""Of the files; part of every key, so that files of another format are not found."""


@dataclass(frozen=True)
class Outcome:
    """What one run showed.

    Attributes:
        error: from the scene's reference, by the scale of what shows it; None where it failed.
        worst: what shows it.
        solver_error: from the tight trajectory of the same variant; None where either failed.
        steps, rejected, evaluations, jacobians, events: of the solver; rejected by error test or Newton's iteration.
        energy_rise: largest rise of the total energy above an earlier value, J; None where the scene has no energy.
        penetration: deepest, m; None without a manager. Both are looked for at events and, in model exchange, at twenty
            times an output interval, in co-simulation at output times.
        failure: why it failed, or "".
        cpu_time: median processor time, s; None if the clock saw none.
        cpu_times: of every repeat, s.
        load: of the machine while it was measured, in processes; None if unknown.
    """

    error: float | None = None
    worst: str = ""
    solver_error: float | None = None
    steps: int | None = None
    rejected: int | None = None
    evaluations: int | None = None
    jacobians: int | None = None
    events: int | None = None
    energy_rise: float | None = None
    penetration: float | None = None
    failure: str = ""
    cpu_time: float | None = None
    cpu_times: tuple[float, ...] = ()
    load: float | None = None


@dataclass(frozen=True)
class Tight:
    """A trajectory at a much tighter tolerance.

    Attributes:
        trajectory: None where it could not be computed.
        floor: its largest difference from one at ten times its tolerance, by the ranges of the signals: errors below
            that mean nothing; None where that could not be computed.
        failure: why, or "".
    """

    trajectory: SimulationResult | None
    floor: float | None
    failure: str


def key_of(description: dict[str, Any]) -> str:
    """A digest of all that determines a run."""
    text = json.dumps({"format": _FORMAT, **description}, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()[:24]


class Store:
    """The folder of a study."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    @property
    def models(self) -> Path:
        """Folder of the FMUs."""
        return self.folder / "fmus"

    def prepare(self) -> None:
        """Makes the folder, or takes the one of an earlier call.

        Raises:
            InputError: it exists and is not that of a study.
        """
        marker = self.folder / MARKER
        if self.folder.exists() and not marker.exists() and (not self.folder.is_dir() or any(self.folder.iterdir())):
            raise InputError(
                "exists already and is no folder of a study",
                place=Place(file=self.folder),
                remedy="Name another output, or remove it first.",
            )
        self.folder.mkdir(parents=True, exist_ok=True)
        marker.touch()

    def outcome(self, key: str) -> Outcome | None:
        """The outcome of a run, or None if it is missing or cannot be read."""
        try:
            values = json.loads(self._run(key).read_text(encoding="utf-8"))
            return Outcome(**{**values, "cpu_times": tuple(values["cpu_times"])})
        except (OSError, ValueError, TypeError, KeyError):
            return None

    def keep_outcome(self, key: str, outcome: Outcome) -> None:
        """Writes the outcome of a run, whole or not at all."""
        with whole_file(self._run(key)) as staging:
            staging.write_text(json.dumps(asdict(outcome), indent=1), encoding="utf-8")

    def tight(self, key: str) -> Tight | None:
        """A tight trajectory, or None if it is missing or cannot be read."""
        try:
            with np.load(self._trajectory(key), allow_pickle=False) as content:
                values = json.loads(str(content["about"]))
                if values["failure"]:
                    return Tight(None, None, str(values["failure"]))
                table = content["table"]
            trajectory = SimulationResult(
                time=np.ascontiguousarray(table[0]),
                signals={name: np.ascontiguousarray(table[k + 1]) for k, name in enumerate(values["signals"])},
                model=values["model"],
                mode=values["mode"],
                tolerance=values["tolerance"],
                interval=values["interval"],
            )
            return Tight(trajectory, values["floor"], "")
        except (OSError, ValueError, KeyError, IndexError, EOFError):
            return None

    def keep_tight(self, key: str, tight: Tight) -> None:
        """Writes a tight trajectory, whole or not at all."""
        found = tight.trajectory
        about: dict[str, Any] = {"failure": tight.failure, "floor": tight.floor}
        table = np.empty((0, 0))
        if found is not None:
            about |= {"signals": list(found.signals), "model": found.model, "mode": found.mode}
            about |= {"tolerance": found.tolerance, "interval": found.interval}
            table = np.vstack([found.time, *found.signals.values()])
        with whole_file(self._trajectory(key)) as staging, staging.open("wb") as stream:
            np.savez_compressed(stream, about=np.array(json.dumps(about)), table=table)

    def _run(self, key: str) -> Path:
        return self.folder / "runs" / f"{key}.json"

    def _trajectory(self, key: str) -> Path:
        return self.folder / "trajectories" / f"{key}.npz"
