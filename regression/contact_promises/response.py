"""Contact response at every tolerance: what scenes that break a solver showed before and show now."""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
from contact_foundation.errors import SimulationError
from fmu_regression.fmi.binding import Mode
from fmu_regression.simulate.simulation import simulate

TOLERANCES: Final = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)
MODES: Final[tuple[Mode, ...]] = ("me", "cs")
BEFORE: Final = Path(__file__).with_name("response_before.csv")
"""What the scenes showed with CVODE's own convergence test: scene, mode, tolerance, text. Not measured again."""
_TIME_LIMIT = 25.0


@dataclass(frozen=True)
class ResponseScene:
    """A scene: its regression case, a title, the signal that is shown with its name, and values of parameters."""

    case: str
    title: str
    signal: str
    symbol: str
    parameters: Mapping[str, float]

    @property
    def key(self) -> str:
        """What the scene is called in the table of what was before."""
        return " ".join([self.case, *(f"{name}={value:g}" for name, value in self.parameters.items())])


_HEIGHT = "rod.frame_a.r_0[3]"
_RODS: Final = {
    "painleve_rod": "restitution by events",
    "painleve_rod_without_events": "restitution without events",
    "painleve_rod_anchored": "anchored friction, restitution by events",
}
_FRICTION: Final = (0.8, 1.0, 1.2, 1.4, 1.6, 2.0, 3.0)
_SWEPT: Final = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
_TIGHTEST: Final = 1e-8


SCENES: Final = (
    ResponseScene(
        "backspin_ball",
        "Ball with backspin that bounces obliquely, without events (rolling: 15.7 rad/s)",
        "spin",
        "spin at the end in rad/s",
        {},
    ),
    ResponseScene(
        "falling_domino", "Domino that falls flat, without events", "domino.w_a[2]", "turning at the end", {}
    ),
    *(
        ResponseScene(
            "painleve_rod",
            f"Rod that jams on its end, mu = {mu:g}, restitution by events",
            _HEIGHT,
            "height at the end in m",
            {"mu": mu},
        )
        for mu in (0.8, 1.6)
    ),
)


@dataclass(frozen=True)
class Found:
    """What a run showed: value at the end, rise of the energy by that at the start, steps; or why it stopped."""

    value: float
    rise: float
    steps: int
    message: str = ""

    @property
    def text(self) -> str:
        """For a table's cell."""
        return self.message or f"{self.value:.4g}, energy +{self.rise:.1e}, {self.steps} steps"


def found(fmu: Path, scene: ResponseScene, mode: Mode, tolerance: float) -> Found:
    """Simulates a scene."""
    try:
        result = simulate(
            fmu,
            signals=["energy", scene.signal],
            mode=mode,
            tolerance=tolerance,
            parameters=scene.parameters,
            time_limit=_TIME_LIMIT,
        )
    except SimulationError as error:
        text = str(error)
        message = f"no end within {_TIME_LIMIT:g} s" if "given up after" in text else text.split("\n")[0]
        return Found(np.nan, np.nan, 0, message)
    energy = result["energy"]
    rise = float(np.max(energy - np.minimum.accumulate(energy)) / energy[0])
    return Found(float(result[scene.signal][-1]), rise, result.counters.steps if result.counters else 0)


def before() -> dict[tuple[str, str, str], str]:
    """What the scenes showed before, by scene, mode and tolerance."""
    with BEFORE.open(encoding="utf-8", newline="") as file:
        return {(row["scene"], row["mode"], row["tolerance"]): row["found"] for row in csv.DictReader(file)}


def section(scene: ResponseScene, fmu: Path, tolerances: Sequence[float] = TOLERANCES) -> str:
    """A scene's Markdown: one row a tolerance, before and after in both modes."""
    past = before()
    has_past = any(key[0] == scene.key for key in past)
    head = ["tolerance", "model exchange", "co-simulation"]
    if has_past:
        head = ["tolerance", "model exchange before", "and now", "co-simulation before", "and now"]
    lines = [f"## {scene.title}", "", f"Shown: {scene.symbol}, rise of the energy by that at the start, steps.", ""]
    lines += ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    for tolerance in tolerances:
        cells = [f"{tolerance:.0e}"]
        for mode in MODES:
            if has_past:
                cells.append(past.get((scene.key, mode, f"{tolerance:.0e}"), ""))
            cells.append(found(fmu, scene, mode, tolerance).text)
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def rod_sweep(case: str, fmu: Path) -> str:
    """Markdown of jamming rods: the height at the end over friction and tolerance, in both modes.

    Args:
        case: one of ``ROD_CASES``.
        fmu: its FMU.
    """
    head = ["mu", "mode", *(f"{tolerance:.0e}" for tolerance in _SWEPT), f"{_TIGHTEST:.0e}", "energy", "steps"]
    lines = [f"## Rods that jam on their ends, {_RODS[case]}", ""]
    lines += ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    for mu in _FRICTION:
        scene = ResponseScene(case, "", _HEIGHT, "", {"mu": mu})
        reference = found(fmu, scene, "cs", _TIGHTEST)
        for mode in MODES:
            runs = [found(fmu, scene, mode, tolerance) for tolerance in _SWEPT]
            lines.append("| " + " | ".join([f"{mu:g}", mode, *_sweep_cells(runs, reference)]) + " |")
    return "\n".join(lines) + "\n"


def _sweep_cells(runs: Sequence[Found], reference: Found) -> list[str]:
    cells = [
        run.message or f"{run.value:.4g} ({(run.value - reference.value) / tolerance:+.0f})"
        for run, tolerance in zip(runs, _SWEPT, strict=True)
    ]
    rises = [run.rise / tolerance for run, tolerance in zip(runs, _SWEPT, strict=True) if not run.message]
    steps = [run.steps for run in runs if not run.message]
    ranges = [f"+{max(rises):.1f}", f"{min(steps)} to {max(steps)}"] if rises else ["", ""]
    return [*cells, reference.message or f"{reference.value:.4g}", *ranges]


ROD_CASES: Final = tuple(_RODS)
"""Regression cases of rods that are swept over friction and tolerance."""
