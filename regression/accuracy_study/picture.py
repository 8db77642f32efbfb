"""A picture of each scene, error over time, as SVG."""

from __future__ import annotations

from pathlib import Path

from contact_foundation.output import whole_file

from accuracy_study.chart import COLORS, Line, chart
from accuracy_study.curves import curves
from accuracy_study.definition import Scene
from accuracy_study.pareto import front
from accuracy_study.study import Findings, SceneFindings


def write_pictures(findings: Findings, folder: Path) -> tuple[Path, ...]:
    """Writes one SVG file a scene, named after it; those without a point are left out."""
    written = []
    for found in findings.scenes:
        text = picture(found)
        if text:
            target = folder / f"{file_name(found.scene)}.svg"
            with whole_file(target) as staging:
                staging.write_text(text, encoding="utf-8", newline="\n")
            written.append(target)
    return tuple(written)


def file_name(scene: Scene) -> str:
    """The name of a scene's picture and page, without ending."""
    return "".join(c if c.isalnum() else "-" for c in scene.name.lower())


def picture(found: SceneFindings) -> str:
    """Error over processor time of every curve of a scene, with the Pareto front dashed; "" without a point."""
    shown = [(curve, points) for curve in curves(found) if (points := curve.over_time())]
    lines = [Line(c.label, points, number, number // len(COLORS)) for number, (c, points) in enumerate(shown)]
    best = [(r.outcome.cpu_time or 0.0, r.outcome.error or 0.0, "") for r in front(found.rows) if r.outcome.error]
    return chart(found.scene.name, lines, best)
