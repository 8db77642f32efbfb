"""A picture of each scene: error over processor time of every program."""

from __future__ import annotations

from pathlib import Path

from accuracy_study.chart import Line, Point, chart
from contact_foundation.output import whole_file

from peer_bench.bench import Findings, Row
from peer_bench.comparison import LEAST, front, run_text
from peer_bench.configurations import PROGRAMS, Configuration
from peer_bench.scenes import Scene


def write_pictures(findings: Findings, folder: Path) -> None:
    """Writes one SVG file a scene, named after it; those without a point are left out."""
    for scene in findings.scenes:
        text = picture(findings, scene)
        if text:
            with whole_file(folder / f"{file_name(scene)}.svg") as staging:
                staging.write_text(text, encoding="utf-8", newline="\n")


def file_name(scene: Scene) -> str:
    """The name of a scene's picture, without ending."""
    return "-".join("".join(c if c.isalnum() else " " for c in scene.name.lower()).split())


def picture(findings: Findings, scene: Scene) -> str:
    """Every configuration a line, every program a colour; "" without a point."""
    rows = findings.of(scene)
    by_configuration: dict[Configuration, list[Row]] = {}
    for row in rows:
        if row.error is not None:
            by_configuration.setdefault(row.configuration, []).append(row)
    programs = list(PROGRAMS)
    marks = dict.fromkeys(programs, 0)
    lines = []
    for configuration, found in by_configuration.items():
        program = configuration.program
        lines.append(Line(configuration.name, [_point(r) for r in found], programs.index(program), marks[program]))
        marks[program] += 1
    best = [(row.cpu_time or 0.0, max(error, LEAST), "") for row, error in front(rows)]
    return chart(f"{scene.name}: error over processor time", lines, best)


def _point(row: Row) -> Point:
    return row.cpu_time or 0.0, max(row.error or 0.0, LEAST), f"{row.configuration.program}, {run_text(row)}"
