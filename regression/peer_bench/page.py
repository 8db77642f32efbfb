"""The comparison as one self-contained HTML page."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from contact_foundation.output import whole_file
from fmu_regression.report.page import Cell, Column, Section, Table, render_page
from fmu_regression.report.page import Row as TableRow
from fmu_regression.report.plots import Plot, Series

from peer_bench.bench import Findings
from peer_bench.comparison import LEAST, sentences
from peer_bench.configurations import PROGRAMS
from peer_bench.notes import NOTES
from peer_bench.scenes import Scene


def write_page(findings: Findings, target: Path) -> None:
    """Writes the page; it appears whole or not at all."""
    versions = ", ".join(f"{name} {version}" for name, version in findings.versions.items())
    summary = Section(
        "summary",
        "Summary",
        lead="Every program simulates every scene, swept over its own tolerance or step. Time is processor time from "
        "the first step to the last, without start-up.",
        notes=(
            f"Machine: {findings.machine}",
            f"Versions: {versions}",
            *(f"{name} was not there: {why}" for name, why in findings.missing.items()),
        ),
    )
    sections = [summary, *(_scene(k, findings, scene) for k, scene in enumerate(findings.scenes))]
    text = render_page("Beside the peers", "Error against processor time, program by program", sections)
    with whole_file(target) as staging:
        staging.write_text(text, encoding="utf-8", newline="\n")


def _scene(number: int, findings: Findings, scene: Scene) -> Section:
    identity = f"scene-{number + 1}"
    series = []
    for configuration in dict.fromkeys(row.configuration for row in findings.of(scene)):
        rows = [r for r in findings.of(scene) if r.configuration == configuration and r.error is not None]
        if rows:
            x = np.array([row.cpu_time for row in rows], dtype=float)
            y = np.array([max(row.error or 0.0, LEAST) for row in rows])
            note = tuple(f"{configuration.swept} {row.value:g}" for row in rows)
            color = list(PROGRAMS).index(configuration.program)
            series.append(Series(configuration.name, x, y, color=color, note=note))
    plot = Plot(
        identity, "Error and time", "processor time in s", "error", tuple(series), points=True, x_log=True, y_log=True
    )
    return Section(
        identity,
        scene.name,
        lead=f"{scene.text} Measured against: {scene.reference}. Error: {scene.error}.",
        plots=(plot,) if series else (),
        tables=(_runs(findings, scene),),
        notes=(*sentences(findings, scene), *NOTES.get(scene.name, ())),
    )


def _runs(findings: Findings, scene: Scene) -> Table:
    texts, figures = (
        ("Program", "Configuration", "Swept"),
        ("Error", "CPU, ms", "least", "most", "Steps", "Evaluations"),
    )
    columns = (*(Column(t, "text") for t in texts), *(Column(f) for f in figures), Column("Failure", "text"))
    rows = []
    for row in findings.of(scene):
        c, times = row.configuration, row.cpu_times
        numbers = (row.error, row.cpu_time, min(times, default=None), max(times, default=None))
        shown = [numbers[0], *(None if value is None else 1e3 * value for value in numbers[1:])]
        shown += [row.work.get("steps"), row.work.get("evaluations")]
        cells = (
            *(Cell(text, "text") for text in (c.program, c.label, f"{c.swept} {row.value:g}")),
            *(Cell("–" if value is None else f"{value:.3g}" if value < 1e3 else f"{value:.0f}") for value in shown),
            Cell(row.failure, "text bad" if row.failure else "text"),
        )
        rows.append(TableRow(cells))
    return Table(columns, tuple(rows))
