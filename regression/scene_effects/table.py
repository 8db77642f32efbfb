"""A study of effects as a text table and as an HTML page."""

from __future__ import annotations

import math
from pathlib import Path

from contact_foundation.output import whole_file
from fmu_regression.report.page import Cell, Column, Row, Section, Table, Tile, render_page

from scene_effects.measurement import Measurement
from scene_effects.study import EffectStudy

_HEADINGS = (
    "variant",
    "equations",
    "states",
    "indicators",
    "systems",
    "lines",
    "evaluations",
    "steps",
    "events",
    "time, s",
    "difference, mm",
    "degrees",
)


def effects_text(study: EffectStudy) -> str:
    """The table of a study; no trailing newline."""
    rows = [_HEADINGS, *(_cells(measurement) for measurement in study.measurements)]
    widths = [max(len(row[k]) for row in rows if k < len(row)) for k in range(len(_HEADINGS))]
    lines = [f"{study.model}, manager {study.manager.name}: {study.duration:g} s simulated"]
    for row in rows:
        cells = [row[0].ljust(widths[0]), *(cell.rjust(widths[k + 1]) for k, cell in enumerate(row[1:]))]
        lines.append("  ".join(cells).rstrip())
    lines += [f"{m.variant.name}: failed: {m.error}" for m in study.measurements if m.error]
    return "\n".join(lines)


def write_effects(study: EffectStudy, target: Path) -> None:
    """Writes the study as one self-contained HTML file; it appears whole or not at all."""
    columns = (Column("Variant", "text"), *(Column(name.capitalize()) for name in _HEADINGS[1:]))
    rows = tuple(
        Row(tuple(Cell(text, "" if k else "text") for k, text in enumerate(_cells(measurement))))
        for measurement in study.measurements
    )
    modifications = tuple(
        f"{m.variant.name}: " + (f"failed: {m.error}" if m.error else m.modification or "no change")
        for m in study.measurements
    )
    pairs = tuple(
        Row(
            (
                Cell(study.manager.pair_label(k), "text"),
                Cell(f"{1000 * pair.smallest_distance:.4g}"),
                Cell(f"{pair.contact_time:.4g}"),
                Cell(str(pair.impacts)),
                Cell(f"{pair.fastest_impact:.4g}"),
                Cell(f"{pair.sticking_time:.4g}"),
                Cell(str(pair.most_points)),
            )
        )
        for k, pair in enumerate(study.observations)
    )
    pair_columns = (
        Column("Pair", "text"),
        Column("Smallest distance, mm"),
        Column("In contact, s"),
        Column("Impacts"),
        Column("Fastest, m/s"),
        Column("Sticking, s"),
        Column("Most points"),
    )
    sections = [
        Section(
            "effects",
            "What each effect costs",
            lead="Each variant switches one effect of the first one. Difference: the largest one of the bodies' "
            "positions and orientations from the first variant at any output time.",
            tiles=_tiles(study),
            tables=(Table(columns, rows),),
            notes=_NOTES,
        ),
        Section("pairs", "What the pairs did, with everything on", tables=(Table(pair_columns, pairs),)),
        Section(
            "modifications",
            "The variants in Modelica",
            notes=modifications,
        ),
    ]
    subtitle = f"{study.duration:g} s simulated, {len(study.measurements)} variants"
    text = render_page(f"Effects of {study.model}", subtitle, sections)
    with whole_file(target) as staging:
        staging.write_text(text, encoding="utf-8", newline="\n")


_NOTES = (
    "Systems: unknowns of each system of equations that is solved in every evaluation.",
    "Lines: of C in one evaluation of the derivatives, the contact engine not counted.",
    "Time: wall time of the simulation, which varies from run to run; evaluations do not.",
)


def _tiles(study: EffectStudy) -> tuple[Tile, ...]:
    failed = sum(1 for m in study.measurements if m.error)
    touching = sum(1 for pair in study.observations if pair.touches)
    return (
        Tile("Variants", str(len(study.measurements)), "", f"{failed or 'none'} failed", "bad" if failed else ""),
        Tile("Pairs that touch", str(touching), "", f"of {len(study.observations)}"),
    )


def _cells(measurement: Measurement) -> tuple[str, ...]:
    build, counters, difference = measurement.build, measurement.counters, measurement.difference
    size: tuple[str, ...] = ("–",) * 5
    work: tuple[str, ...] = ("–",) * 3
    if build is not None:
        systems = "+".join(map(str, build.systems)) or "none"
        size = (str(build.equations), str(build.states), str(build.event_indicators), systems, str(build.lines))
    if counters is not None:
        work = (str(counters.evaluations), str(counters.steps), str(counters.state_events + counters.time_events))
    apart: tuple[str, ...] = ("–", "–")
    if difference is not None:
        apart = (f"{1000 * difference.position:.3g}", f"{math.degrees(difference.angle):.3g}")
    time = "–" if measurement.wall_time is None else f"{measurement.wall_time:.2f}"
    return (measurement.variant.name, *size, *work, time, *apart)
