"""The comparison as pages of Markdown: who wins where, with its pictures, and what was tried."""

from __future__ import annotations

from pathlib import Path

from fmu_regression.compare.provenance import load_text

from peer_bench.bench import Findings
from peer_bench.comparison import levels, milliseconds, most_accurate, run_text, sentences
from peer_bench.configurations import OURS, Configuration
from peer_bench.notes import NOTES
from peer_bench.picture import file_name
from peer_bench.scenes import Scene


def markdown(findings: Findings, pictures: Path) -> str:
    """Versions, an overview, and for each scene its picture and who wins where.

    Args:
        findings: of the comparison.
        pictures: folder of the pictures, relative to the page.
    """
    versions = ", ".join(f"{name} {version}" for name, version in findings.versions.items())
    lines = [f"{len(findings.rows)} runs. Machine: {findings.machine}. Versions: {versions}."]
    lines += [load_text(load for row in findings.rows for load in row.loads), ""]
    lines += [f"{name} was not there: {why}." for name, why in findings.missing.items()]
    lines += _overview(findings)
    for scene in findings.scenes:
        lines += _scene(findings, scene, pictures)
    return "\n".join(lines)


def tried_markdown(findings: Findings) -> str:
    """For each scene, every configuration that was tried, with the least error that it reached."""
    lines = []
    for scene in findings.scenes:
        lines += [_heading(scene), "", *_tried(findings, scene), ""]
    return "\n".join(lines)


def _heading(scene: Scene) -> str:
    return f"## {scene.name[0].upper()}{scene.name[1:]}"


def _overview(findings: Findings) -> list[str]:
    errors = sorted({level.error for scene in findings.scenes for level in levels(findings, scene)}, reverse=True)
    lines = [
        f"How many times as long as the fastest peer {OURS} takes for an error below a level; less than 1: it is the "
        "fastest. *Alone*: no peer gets there; *–*: it does not itself.",
        "",
        "| scene | " + " | ".join(f"{error:.0e}" for error in errors) + " |",
        "|---|" + "---|" * len(errors),
    ]
    for scene in findings.scenes:
        found = {level.error: level for level in levels(findings, scene)}
        cells = []
        for error in errors:
            level = found.get(error)
            if level is None or OURS not in level.cheapest:
                cells.append("–")
            elif level.behind is None:
                cells.append("alone")
            else:
                text = f"{level.behind:.2g}"
                cells.append(f"**{text}**, {level.winner}" if level.behind > 1 else text)
        lines.append(f"| {scene.name} | {' | '.join(cells)} |")
    return [*lines, ""]


def _scene(findings: Findings, scene: Scene, pictures: Path) -> list[str]:
    picture = (pictures / f"{file_name(scene)}.svg").as_posix()
    programs = list(findings.versions)
    lines = [
        _heading(scene),
        "",
        f"{scene.text} Measured against: {scene.reference}. Error: {scene.error}.",
        "",
        f"![{scene.name}: error over processor time]({picture})",
        "",
        *(f"- {sentence}" for sentence in [*sentences(findings, scene), *NOTES.get(scene.name, ())]),
        "",
        "| error below | " + " | ".join(programs) + " |",
        "|---|" + "---|" * len(programs),
    ]
    for level in levels(findings, scene):
        cells = []
        for program in programs:
            row = level.cheapest.get(program)
            text = f"{milliseconds(row)} ({run_text(row)})" if row else "–"
            cells.append(f"**{text}**" if program == level.winner else text)
        lines.append(f"| {level.error:.0e} | {' | '.join(cells)} |")
    return [*lines, ""]


def _tried(findings: Findings, scene: Scene) -> list[str]:
    lines = [
        "| program | configuration | settings | swept | least error | at | failed |",
        "|---|---|---|---|---|---|---|",
    ]
    for configuration in dict.fromkeys(row.configuration for row in findings.of(scene)):
        rows = [row for row in findings.of(scene) if row.configuration == configuration]
        best = most_accurate(rows)
        failures = [row for row in rows if row.failure]
        failed = f"{len(failures)} of {len(rows)}: {failures[0].failure}" if failures else ""
        least = (f"{best.error:.1e}", f"{best.value:g}, {milliseconds(best)}") if best else ("–", "–")
        values = [row.value for row in rows]
        swept = f"{configuration.swept} {max(values):g} to {min(values):g}"
        cells = (configuration.program, configuration.label, _settings(configuration), swept, *least, failed)
        lines.append("| " + " | ".join(cells) + " |")
    return lines


def _settings(configuration: Configuration) -> str:
    given = {key.removeprefix("start."): value for key, value in configuration.settings.items()}
    if configuration.model:
        given = {"model": configuration.model.split(".")[-1], **given}
    return ", ".join(
        f"{key} {value:g}" if not isinstance(value, str) else f"{key} {value}" for key, value in given.items()
    )
