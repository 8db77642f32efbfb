"""A study as one self-contained HTML page."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from contact_foundation.output import whole_file
from fmu_regression.report.page import Cell, Column, Section, Table, Tile, render_page
from fmu_regression.report.page import Row as TableRow
from fmu_regression.report.plots import Plot, Series

from accuracy_study.curves import Curve, curves
from accuracy_study.pareto import front
from accuracy_study.reference_text import reference_text
from accuracy_study.sentences import run_text, scene_sentences, variant_text
from accuracy_study.study import Findings, Row, SceneFindings


def write_page(findings: Findings, target: Path) -> None:
    """Writes the page; it appears whole or not at all."""
    sections = [
        _overview(findings),
        *(_scene(k, found) for k, found in enumerate(findings.scenes)),
        _failures(findings),
    ]
    text = render_page(f"What accuracy costs: {findings.study.name}", findings.study.description, sections)
    with whole_file(target) as staging:
        staging.write_text(text, encoding="utf-8", newline="\n")


def _overview(findings: Findings) -> Section:
    rows = [row for found in findings.scenes for row in found.rows]
    failed = sum(bool(row.outcome.failure) for row in rows)
    tiles = (
        Tile("Scenes", str(len(findings.scenes))),
        Tile("Runs", str(len(rows)), "", f"{failed or 'none'} failed", "bad" if failed else ""),
    )
    return Section(
        "summary",
        "Summary",
        lead="Errors are the largest ones by the scale of what shows them. Solver error: against a tight trajectory of "
        "the same variant. Geometry error: that trajectory against the one with the first value of every knob of "
        "geometry. Model error: the latter against the scene's reference. Time is processor time.",
        tiles=tiles,
        notes=(
            f"Machine: {findings.machine}",
            "Versions: " + ", ".join(f"{name} {version}" for name, version in findings.versions.items()),
        ),
    )


def _scene(number: int, found: SceneFindings) -> Section:
    lines = curves(found)
    identity = f"scene-{number + 1}"
    plots = [
        _plot(f"{identity}-time", "Error and time", "processor time in s", lines, front(found.rows)),
        _plot(f"{identity}-tolerance", "Solver error and tolerance", "tolerance", lines, None),
    ]
    return Section(
        identity,
        found.scene.name,
        lead=f"{found.scene.model}. Measured against: {reference_text(found)}.",
        plots=tuple(plot for plot in plots if plot.series),
        tables=(_variants(found), _runs(found)),
        notes=tuple(scene_sentences(found)),
    )


def _plot(identity: str, title: str, x_label: str, lines: tuple[Curve, ...], best: tuple[Row, ...] | None) -> Plot:
    series = []
    for number, curve in enumerate(lines):
        points = curve.over_time() if best is not None else curve.over_tolerance()
        if points:
            series.append(_series(curve.label, points, number))
    if best:
        points = [(r.outcome.cpu_time or 0.0, r.outcome.error or 0.0, "Pareto front") for r in best if r.outcome.error]
        series.append(_series("Pareto front", points, len(lines), dashed=True))
    return Plot(identity, title, x_label, "error", tuple(series), points=True, x_log=True, y_log=True)


def _series(name: str, points: list[tuple[float, float, str]], color: int, dashed: bool = False) -> Series:
    x, y, notes = zip(*points, strict=True)
    return Series(name, np.array(x), np.array(y), dashed=dashed, color=color, note=notes)


def _variants(found: SceneFindings) -> Table:
    columns = (
        Column("Variant", "text"),
        Column("Solver", "text"),
        Column("Order of convergence"),
        Column("Geometry error"),
        Column("Model error"),
        Column("Floor"),
        Column("Remark", "text"),
    )
    rows = []
    seen = dict.fromkeys((row.run.variant, row.run.solver, row.run.max_step) for row in found.rows)
    for variant, solver, step in seen:
        errors, order = found.errors[variant], found.order(variant, solver, step)
        rows.append(
            TableRow(
                (
                    Cell(variant_text(variant, found.scene), "text"),
                    Cell(solver if step is None else f"{solver}, step {step:g} s", "text"),
                    Cell("–" if order is None else f"{order:.2f}"),
                    *(Cell(_figure(value)) for value in (errors.geometry, errors.model, errors.floor)),
                    Cell(errors.failure, "text bad" if errors.failure else "text"),
                )
            )
        )
    return Table(columns, tuple(rows))


def _runs(found: SceneFindings) -> Table:
    columns = (
        Column("Run", "text"),
        Column("Error"),
        Column("Solver error"),
        Column("CPU, s"),
        Column("Steps"),
        Column("Rejected"),
        Column("Evaluations"),
        Column("Events"),
        Column("Energy rise, J"),
        Column("Deepest, mm"),
        Column("Shown by", "text"),
    )
    rows = []
    for row in found.rows:
        o = row.outcome
        name = Cell(run_text(row.run, found.scene), "text")
        if o.failure:
            rows.append(TableRow((name, *(Cell("–") for _ in range(9)), Cell(o.failure, "text bad"))))
            continue
        counts = (o.steps, o.rejected, o.evaluations, o.events)
        rows.append(
            TableRow(
                (
                    name,
                    *(Cell(_figure(value)) for value in (o.error, o.solver_error, o.cpu_time)),
                    *(Cell("–" if count is None else str(count)) for count in counts),
                    Cell(_figure(o.energy_rise)),
                    Cell(_figure(None if o.penetration is None else 1000 * o.penetration)),
                    Cell(o.worst, "text"),
                )
            )
        )
    return Table(columns, tuple(rows))


def _failures(findings: Findings) -> Section:
    found = [
        TableRow(
            (Cell(s.scene.name, "text"), Cell(run_text(r.run, s.scene), "text"), Cell(r.outcome.failure, "text bad"))
        )
        for s in findings.scenes
        for r in s.rows
        if r.outcome.failure
    ]
    columns = (Column("Scene", "text"), Column("Run", "text"), Column("Reason", "text"))
    lead = "Runs that did not end." if found else "Every run ended."
    return Section("failures", "Failures", lead=lead, tables=(Table(columns, tuple(found)),) if found else ())


def _figure(value: float | None) -> str:
    return "–" if value is None else f"{value:.3g}"
