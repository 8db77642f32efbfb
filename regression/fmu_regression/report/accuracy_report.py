"""An accuracy study as a table for the terminal and as an HTML page with log-log plots."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from contact_foundation.output import whole_file

from fmu_regression.compare.accuracy import AccuracyPoint, AccuracyStudy
from fmu_regression.fmi.binding import Mode
from fmu_regression.report.page import Cell, Column, Row, Section, Table, Tile, render_page
from fmu_regression.report.plots import Plot, Series

_MODE_NAMES: dict[Mode, str] = {"me": "model exchange", "cs": "co-simulation"}
_MODES: tuple[Mode, ...] = ("me", "cs")


def accuracy_text(study: AccuracyStudy) -> str:
    """A table of the study; no trailing newline."""
    head = f"{'mode':4}  {'tolerance':>9}  {'error':>9}  {'rms':>9}  {'time, s':>8}  {'steps':>7}  {'calls':>8}  events"
    lines = [f"{study.model}: {study.duration:g} s, reference: {study.reference}, floor {study.floor:.1e}", head]
    for point in study.points:
        start = f"{point.mode:4}  {point.tolerance:9.0e}  "
        if point.failure:
            lines.append(start + f"failed: {point.failure.splitlines()[0]}")
            continue
        counters = point.counters
        work = ("–", "–", "–")
        if counters is not None:
            work = (str(counters.steps), str(counters.evaluations), str(counters.state_events + counters.time_events))
        errors = f"{point.error:9.2e}  {point.mean_error:9.2e}  {point.wall_time:8.3f}"
        lines.append(f"{start}{errors}  {work[0]:>7}  {work[1]:>8}  {work[2]}")
    return "\n".join(lines)


def write_accuracy(study: AccuracyStudy, target: Path) -> None:
    """Writes the study as one self-contained HTML file."""
    sections = [_overview(study), _plots(study), _runs(study)]
    subtitle = f"{study.duration:g} s simulated, {len(study.signals)} signals compared"
    text = render_page(f"Accuracy of {study.model}", subtitle, sections)
    with whole_file(target) as staging:
        staging.write_text(text, encoding="utf-8", newline="\n")


def _overview(study: AccuracyStudy) -> Section:
    good = [point for point in study.points if not point.failure]
    failed = len(study.points) - len(good)
    tiles = [Tile("Runs", str(len(study.points)), "", f"{failed or 'none'} failed", "bad" if failed else "")]
    for mode in _MODES:
        best = min((p for p in good if p.mode == mode), key=lambda p: p.error or 0.0, default=None)
        if best is None:
            continue
        order = study.order(mode)
        more = f"of the range, at tolerance {best.tolerance:g}, {best.wall_time:.3g} s"
        tiles.append(Tile(f"Smallest error, {_MODE_NAMES[mode]}", f"{best.error:.2g}", "", more))
        if order is not None:
            tiles.append(Tile(f"Order, {_MODE_NAMES[mode]}", f"{order:.2f}", "", "error grows like tolerance to this"))
    tiles.append(Tile("Floor", f"{study.floor:.2g}", "", "of the range: doubt about the reference itself"))
    versions = ", ".join(f"{name} {version}" for name, version in study.versions.items())
    return Section(
        "summary",
        "Summary",
        lead="The error of a run is its largest difference from the reference at any output time, divided by the "
        "range of the signal. It is the error of the solver alone: what contact laws, compliance and geometry "
        "idealise is in the reference too.",
        tiles=tuple(tiles),
        notes=(
            f"Reference: {study.reference}",
            f"Signals: {', '.join(study.signals[:12])}" + (" …" if len(study.signals) > 12 else ""),
            f"Machine: {study.machine}",
            f"Versions: {versions}",
        ),
    )


def _plots(study: AccuracyStudy) -> Section:
    def evaluations(point: AccuracyPoint) -> float | None:
        return float(point.counters.evaluations) if point.counters is not None else None

    error: Callable[[AccuracyPoint], float | None] = lambda point: point.error  # noqa: E731
    plots = [
        _plot(study, "error-tolerance", "Error and tolerance", "relative tolerance", lambda p: p.tolerance, error),
        _plot(study, "error-time", "Error and time", "wall time in s", lambda p: p.wall_time, error),
        _plot(study, "error-calls", "Error and evaluations", "evaluations of the model", evaluations, error),
        _plot(
            study,
            "energy-tolerance",
            "Energy at the end, difference from the reference",
            "relative tolerance",
            lambda p: p.tolerance,
            lambda p: None if p.energy_change is None else abs(p.energy_change),
            "energy in J",
        ),
    ]
    return Section("plots", "Plots", plots=tuple(plot for plot in plots if plot.series))


def _plot(
    study: AccuracyStudy,
    identity: str,
    title: str,
    x_label: str,
    x: Callable[[AccuracyPoint], float | None],
    y: Callable[[AccuracyPoint], float | None],
    y_label: str = "error by the range of the signal",
) -> Plot:
    series = []
    for number, mode in enumerate(_MODES):
        found = [
            (across, up, f"{_MODE_NAMES[mode]}, tolerance {point.tolerance:g}")
            for point in study.points
            if point.mode == mode and (across := x(point)) and (up := y(point))
        ]
        if found:
            xs, ys, notes = zip(*found, strict=True)
            series.append(Series(_MODE_NAMES[mode], np.array(xs), np.array(ys), color=number, note=notes))
    return Plot(identity, title, x_label, y_label, tuple(series), points=True, x_log=True, y_log=True)


def _runs(study: AccuracyStudy) -> Section:
    columns = (
        Column("Mode", "text"),
        Column("Tolerance"),
        Column("Largest error"),
        Column("RMS error"),
        Column("Wall time, s"),
        Column("Steps"),
        Column("Rejected"),
        Column("Evaluations"),
        Column("Jacobians"),
        Column("Events"),
        Column("Energy change, J"),
        Column("Energy rise, J"),
        Column("Worst signal", "text"),
    )
    return Section("runs", "Runs", tables=(Table(columns, tuple(_row(point) for point in study.points)),))


def _row(point: AccuracyPoint) -> Row:
    start = (Cell(point.mode, "text"), Cell(f"{point.tolerance:g}"))
    if point.failure:
        return Row((*start, *(Cell("–") for _ in range(10)), Cell(point.failure, "text bad")))
    c = point.counters
    work: tuple[int | None, ...] = (None,) * 5
    if c is not None:
        rejected = c.error_test_failures + c.convergence_failures
        work = (c.steps, rejected, c.evaluations, c.jacobians, c.state_events + c.time_events)
    return Row(
        (
            *start,
            Cell(_figure(point.error)),
            Cell(_figure(point.mean_error)),
            Cell(_figure(point.wall_time)),
            *(Cell("–" if value is None else str(value)) for value in work),
            Cell(_figure(point.energy_change)),
            Cell(_figure(point.energy_rise)),
            Cell(point.worst_signal, "text"),
        )
    )


def _figure(value: float | None) -> str:
    return "–" if value is None else f"{value:.3g}"
