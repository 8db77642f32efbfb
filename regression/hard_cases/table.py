"""Hard cases as one CSV file: a row a run."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from pathlib import Path

from contact_foundation.output import whole_file

from hard_cases.knobs import NUMBERS
from hard_cases.run import Row

CPU_COLUMN = "cpu_time"
"""The column that differs from one time to the next."""
_FIGURES = ("energy_gain", "momentum_error", "drift", "depth", "restitution_error", "steps", "reached", CPU_COLUMN)


def write_table(rows: Sequence[Row], target: Path) -> None:
    """Writes the file, whole or not at all; numbers with all their digits, what is not known left empty."""
    with whole_file(target) as staging, staging.open("w", encoding="utf-8", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        words = ("seed", "kind", "law", "friction", "restitution_method", "bodies", "mode")
        expected = ("relative_depth", "contact_times", "stop")
        writer.writerow([*words, *NUMBERS, *expected, "verdict", "cause", "knobs_named", *_FIGURES])
        for row in rows:
            case, structure, found = row.case, row.case.structure, row.verdict
            writer.writerow(
                [
                    case.seed,
                    structure.kind,
                    structure.law,
                    structure.friction,
                    structure.restitution,
                    structure.count,
                    case.mode,
                    *(repr(case.number(name)) for name in NUMBERS),
                    *(repr(getattr(row.expected, name)) for name in expected),
                    found.kind.value,
                    found.cause,
                    found.knobs,
                    *(_text(getattr(found, name)) for name in _FIGURES),
                ]
            )


def _text(value: float) -> str:
    return "" if value != value or value == -1 else repr(value)
