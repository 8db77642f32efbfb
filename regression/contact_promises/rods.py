"""Random rods that slide and jam on their ends: how far results at loose tolerances are from tight ones.

A jam magnifies what it begins with, more so near the coefficient of friction from which on rods jam. So each rod is
also simulated tightly with its speed changed by a millionth; a result may be off by what such a change of some
tolerances does.
"""

from __future__ import annotations

import random
import tempfile
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
from contact_foundation.errors import SimulationError
from fmu_regression.fmi.binding import Mode
from fmu_regression.simulate.simulation import simulate

LAWS: Final = ("PainleveRod", "PainleveRodAnchored", "PainleveRodWithoutEvents")
TOLERANCES: Final = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
MODES: Final[tuple[Mode, ...]] = ("me", "cs")
SPREAD: Final = 200.0
"""By how many tolerances a height may be off, in units of the rod's length or of what a jam makes of a tolerance."""
_TIGHT = 1e-8
_CHANGE = 1e-6
_TIME_LIMIT = 60.0
_HEIGHT = "rod.frame_a.r_0[3]"
_TOLD = "is struck again while it touches"


@dataclass(frozen=True)
class Rod:
    """A rod of 1 m and 1 kg: model of ContactMultiBodyTest.Impacts, tip radius in m, values of its parameters."""

    law: str
    radius: float
    parameters: dict[str, float]

    @property
    def text(self) -> str:
        """Modelica; the tip's radius is structural."""
        return (
            f'model RandomRod "A rod that may jam"\n  extends ContactMultiBodyTest.Impacts.{self.law}'
            f"(radius={self.radius:.6g});\nend RandomRod;\n"
        )


@dataclass(frozen=True)
class RodRun:
    """A run.

    Attributes:
        mode: of the run.
        tolerance: of the run.
        deviation: of its height at the end, in tolerances.
        magnification: what a change of the speed by one tolerance does to the height of a tight run, in tolerances.
        rise: of the energy, in tolerances of that at the start.
        is_told: the FMU warned that the rod was struck again during a contact.
        message: why it stopped, empty if it did not.
    """

    mode: Mode
    tolerance: float
    deviation: float
    magnification: float
    rise: float
    is_told: bool = False
    message: str = ""

    @property
    def is_near(self) -> bool:
        """True if height and energy are as near as the tolerance asks for."""
        return self.deviation <= SPREAD * max(1.0, self.magnification) and self.rise <= SPREAD

    @property
    def is_silent_error(self) -> bool:
        """True if it is off and neither it nor the FMU says so: a warning excuses the height, not the energy."""
        if self.message:
            return "given up after" in self.message or "crashed" in self.message
        return not self.is_near and not (self.is_told and np.isfinite(self.deviation) and self.rise <= SPREAD)


def random_rod(seed: int) -> Rod:
    """The rod of a seed; the same on every machine."""
    source = random.Random(seed)
    parameters = {
        "mu": source.uniform(0.5, 3.0),
        "slope": source.uniform(0.6, 1.4),
        "speed": 10.0 ** source.uniform(0.0, 1.2),
        "e": source.choice((0.0, 0.3, 0.6, 0.9)),
    }
    return Rod(source.choice(LAWS), source.choice((0.002, 0.01, 0.03)), parameters)


def rod_runs(
    rod: Rod, fmu: Path, tolerances: Sequence[float] = TOLERANCES, modes: Sequence[Mode] = MODES
) -> Iterator[RodRun]:
    """Simulates a rod at all tolerances.

    Args:
        rod: what is simulated.
        fmu: its FMU.
        tolerances: of the runs.
        modes: of the runs.
    """
    expected, _, _ = _end(fmu, rod.parameters, "cs", _TIGHT)
    changed = {**rod.parameters, "speed": rod.parameters["speed"] * (1.0 + _CHANGE)}
    magnification = abs(_end(fmu, changed, "cs", _TIGHT)[0] - expected) / _CHANGE
    for mode in modes:
        for tolerance in tolerances:
            try:
                height, rise, is_told = _end(fmu, rod.parameters, mode, tolerance)
            except SimulationError as error:
                yield RodRun(mode, tolerance, np.nan, magnification, np.nan, message=" ".join(str(error).split()))
                continue
            yield RodRun(mode, tolerance, abs(height - expected) / tolerance, magnification, rise / tolerance, is_told)


def _end(fmu: Path, parameters: dict[str, float], mode: Mode, tolerance: float) -> tuple[float, float, bool]:
    """The height at the end in m, the rise of the energy by that at the start, and if a second strike was told."""
    result = simulate(
        fmu,
        signals=["energy", _HEIGHT],
        mode=mode,
        tolerance=tolerance,
        parameters=parameters,
        time_limit=_TIME_LIMIT,
    )
    energy = result["energy"]
    rise = float(np.max(energy - np.minimum.accumulate(energy)) / energy[0])
    return float(result[_HEIGHT][-1]), rise, any(_TOLD in line for line in result.log)


def random_rods(seeds: Sequence[int], build: Callable[[str, Path], None]) -> str:
    """Markdown of random rods: how many runs are near, off but told, and off without a word, by mode and tolerance.

    Args:
        seeds: of the rods.
        build: builds the FMU of ``RandomRod``: the model's text, the file to write.
    """
    found: dict[tuple[Mode, float], list[tuple[int, RodRun]]] = {}
    with tempfile.TemporaryDirectory(prefix="cmb-rods-") as folder:
        for seed in seeds:
            rod = random_rod(seed)
            fmu = Path(folder) / f"{rod.law}-{rod.radius:g}.fmu"
            if not fmu.exists():
                build(rod.text, fmu)
            for run in rod_runs(rod, fmu):
                found.setdefault((run.mode, run.tolerance), []).append((seed, run))
    lines = [
        "| mode | tolerance | runs | near | stopped | off and told | off without a word | median, tolerances |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for (mode, tolerance), runs in found.items():
        ended = [run for _, run in runs if not run.message]
        near = sum(run.is_near for run in ended)
        silent = [seed for seed, run in runs if run.is_silent_error]
        told = [seed for seed, run in runs if not run.message and not run.is_near and seed not in silent]
        median = float(np.median([run.deviation for run in ended])) if ended else np.nan
        lines.append(
            f"| {mode} | {tolerance:.0e} | {len(runs)} | {near} | {len(runs) - len(ended)} "
            f"| {_seeds(told)} | {_seeds(silent)} | {median:.2g} |"
        )
    return "\n".join(lines) + "\n"


def _seeds(seeds: Sequence[int]) -> str:
    return ", ".join(map(str, seeds)) or "none"
