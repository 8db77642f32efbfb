"""Contact response at every tolerance: what scenes that break a solver showed before and show now."""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
from contact_foundation.errors import SimulationError
from fmu_regression.fmi.fmu import Mode
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


def _rod(case: str, kind: str, mu: float) -> ResponseScene:
    return ResponseScene(
        case,
        f"Rod that jams on its end, mu = {mu:g}, {kind}",
        "rod.frame_a.r_0[3]",
        "height at the end in m",
        {"mu": mu},
    )


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
        _rod(case, kind, mu)
        for case, kind in (
            ("painleve_rod", "restitution by events"),
            ("painleve_rod_without_events", "restitution without events"),
            ("painleve_rod_anchored", "anchored friction, restitution by events"),
        )
        for mu in (0.8, 1.6, 3.0)
    ),
)


def found(fmu: Path, scene: ResponseScene, mode: Mode, tolerance: float) -> str:
    """Simulates and tells value, rise of the energy in shares of that at the start, and steps."""
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
        return f"no end within {_TIME_LIMIT:g} s" if "given up after" in text else text.split("\n")[0]
    energy = result["energy"]
    rise = float(np.max(energy - np.minimum.accumulate(energy)) / energy[0])
    steps = "" if result.counters is None else f", {result.counters.steps} steps"
    return f"{result[scene.signal][-1]:.4g}, energy +{rise:.1e}{steps}"


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
            cells.append(found(fmu, scene, mode, tolerance))
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"
