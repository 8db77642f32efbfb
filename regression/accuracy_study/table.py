"""A study as one table, CSV or Parquet: a row a run."""

from __future__ import annotations

import csv
from importlib.util import find_spec
from pathlib import Path

from contact_foundation.errors import InputError
from contact_foundation.output import whole_file

from accuracy_study.grid import value_text
from accuracy_study.knobs import Part, part_of
from accuracy_study.study import Findings, Row, SceneFindings

_COUNTS = ("steps", "rejected", "evaluations", "jacobians", "events")
_NUMBERS = (
    *("tolerance", "max_step", "error", "solver_error", "geometry_error", "model_error", "floor"),
    *("energy_rise", "penetration", "cpu_time", "load"),
)
CPU_COLUMNS = ("cpu_time", "load")
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
    """Writes the CSV file, whole or not at all; numbers with all their digits, what is not known left empty."""
    with whole_file(target) as staging, staging.open("w", encoding="utf-8", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        names = knob_names(findings)
        writer.writerow(_columns(names))
        for scene in findings.scenes:
            for row in scene.rows:
                writer.writerow([_text(value) for value in _values(scene, row, names)])


def check_parquet() -> None:
    """Raises InputError where Parquet cannot be written, before anything is run."""
    if find_spec("pyarrow") is None:
        raise InputError(
            "Parquet needs the package pyarrow, which is not installed",
            remedy="Install it: pip install 'contactmultibody[parquet]'.",
        )


def write_parquet(findings: Findings, target: Path) -> None:
    """Writes the same rows as Parquet, whole or not at all: numbers as numbers, what is not known as null.

    Raises:
        InputError: pyarrow is not installed.
    """
    check_parquet()
    from pyarrow import Table, array, float64, int64, parquet, string

    names = knob_names(findings)
    rows = [_values(scene, row, names) for scene in findings.scenes for row in scene.rows]
    kinds = {**dict.fromkeys(_NUMBERS, float64()), **dict.fromkeys(_COUNTS, int64())}
    columns = _columns(names)
    arrays = {name: array([row[k] for row in rows], kinds.get(name, string())) for k, name in enumerate(columns)}
    with whole_file(target) as staging:
        parquet.write_table(Table.from_pydict(arrays), staging)


def knob_names(findings: Findings) -> tuple[str, ...]:
    """The knobs of model and geometry of all scenes, each once."""
    return tuple(
        dict.fromkeys(name for s in findings.scenes for name in s.scene.knobs if part_of(name) is not Part.SOLVER)
    )


def _columns(names: tuple[str, ...]) -> list[str]:
    return ["scene", "solver", "tolerance", "max_step", *names, *_FIGURES, *CPU_COLUMNS]


def _values(scene: SceneFindings, row: Row, names: tuple[str, ...]) -> list[str | float | None]:
    run, outcome, errors = row.run, row.outcome, scene.errors[row.run.variant]
    settings = dict(run.variant.settings)
    figures = {**vars(outcome), "geometry_error": errors.geometry, "model_error": errors.model, "floor": errors.floor}
    return [
        scene.scene.name,
        run.solver,
        run.tolerance,
        run.max_step,
        *(value_text(settings[name]) if name in settings else None for name in names),
        *(figures[name] for name in (*_FIGURES, *CPU_COLUMNS)),
    ]


def _text(value: object) -> str:
    return "" if value is None else repr(value) if isinstance(value, float) else str(value)
