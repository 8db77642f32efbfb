"""The runs as CSV, a row each."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Final

from contact_foundation.output import whole_file

from peer_bench.bench import Findings

_COLUMNS: Final = (
    *("scene", "program", "version", "configuration", "swept", "value", "settings"),
    *("error", "cpu_time", "cpu_time_least", "cpu_time_most", "load_most", "repeats"),
)
_WORK: Final = ("steps", "evaluations", "jacobians", "rejected", "events")


def write_table(findings: Findings, target: Path) -> None:
    """Writes the file; it appears whole or not at all."""
    with whole_file(target) as staging, staging.open("w", encoding="utf-8", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(
            (*_COLUMNS, *_WORK, "failure"),
        )
        for row in findings.rows:
            c = row.configuration
            settings = "; ".join(f"{key}={value}" for key, value in c.settings.items())
            times, loads = row.cpu_times, [load for load in row.loads if load is not None]
            writer.writerow(
                [row.scene.name, c.program, findings.versions[c.program], c.label, c.swept, repr(row.value), settings]
                + ["" if row.error is None else repr(row.error), "" if row.cpu_time is None else repr(row.cpu_time)]
                + [repr(min(times)) if times else "", repr(max(times)) if times else ""]
                + [repr(max(loads)) if loads else "", len(times)]
                + [f"{row.work[key]:.0f}" if key in row.work else "" for key in _WORK]
                + [row.failure]
            )
