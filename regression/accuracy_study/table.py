"""A study as one CSV file: a row a run."""

from __future__ import annotations

import csv
from pathlib import Path

from contact_foundation.output import whole_file

from accuracy_study.grid import value_text
from accuracy_study.knobs import Part, part_of
from accuracy_study.study import Findings, Row, SceneFindings

CPU_COLUMNS = ("cpu_time",)
"""Columns that differ from one time to the next; all others are the same, whatever the number of processes."""
_FIGURES = (
    "error",
    "worst",
    "solver_error",
    "geometry_error",
    "model_error",
    "floor",
    "steps",
    "rejected",
    "evaluations",
    "jacobians",
    "events",
    "energy_rise",
    "penetration",
    "failure",
)


def write_table(findings: Findings, target: Path) -> None:
    """Writes the file, whole or not at all; numbers with all their digits, what is not known left empty."""
    names = knob_names(findings)
    with whole_file(target) as staging, staging.open("w", encoding="utf-8", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(["scene", "solver", "tolerance", "max_step", *names, *_FIGURES, *CPU_COLUMNS])
        for scene in findings.scenes:
            for row in scene.rows:
                writer.writerow(_cells(scene, row, names))


def knob_names(findings: Findings) -> tuple[str, ...]:
    """The knobs of model and geometry of all scenes, each once."""
    return tuple(
        dict.fromkeys(name for s in findings.scenes for name in s.scene.knobs if part_of(name) is not Part.SOLVER)
    )


def _cells(scene: SceneFindings, row: Row, names: tuple[str, ...]) -> list[str]:
    run, outcome, errors = row.run, row.outcome, scene.errors[row.run.variant]
    settings = dict(run.variant.settings)
    figures = {**vars(outcome), "geometry_error": errors.geometry, "model_error": errors.model, "floor": errors.floor}
    step = "" if run.max_step is None else f"{run.max_step:g}"
    return [
        scene.scene.name,
        run.solver,
        f"{run.tolerance:g}",
        step,
        *(value_text(settings[name]) if name in settings else "" for name in names),
        *(_text(figures[name]) for name in (*_FIGURES, *CPU_COLUMNS)),
    ]


def _text(value: object) -> str:
    return "" if value is None else repr(value) if isinstance(value, float) else str(value)
