"""A study as a page of Markdown with its pictures."""

from __future__ import annotations

from pathlib import Path

from accuracy_study.picture import file_name
from accuracy_study.reference_text import reference_text
from accuracy_study.sentences import scene_sentences, variant_text
from accuracy_study.study import Findings, SceneFindings


def markdown(findings: Findings, pictures: Path) -> str:
    """For each scene its picture, what its runs say, and a table of its variants.

    Args:
        findings: of the study.
        pictures: folder of the pictures, relative to the page.
    """
    runs = sum(len(found.rows) for found in findings.scenes)
    versions = ", ".join(f"{name} {version}" for name, version in findings.versions.items())
    lines = [
        f"{len(findings.scenes)} scenes, {runs} runs. Machine: {findings.machine}. Versions: {versions}.",
        "",
    ]
    for found in findings.scenes:
        lines += _scene(found, pictures)
    return "\n".join(lines)


def _scene(found: SceneFindings, pictures: Path) -> list[str]:
    name = found.scene.name
    picture = (pictures / f"{file_name(found)}.svg").as_posix()
    table = [
        "| variant | geometry error | model error | floor | order, model exchange | order, co-simulation |",
        "|---|---|---|---|---|---|",
    ]
    failures = []
    for variant, errors in found.errors.items():
        figures = [_figure(value) for value in (errors.geometry, errors.model, errors.floor)]
        orders = [found.order(variant, "me", None), found.order(variant, "cs", None)]
        figures += ["–" if order is None else f"{order:.1f}" for order in orders]
        label = variant_text(variant, found.scene)
        table.append(f"| {label} | {' | '.join(figures)} |")
        if errors.failure:
            failures.append(f"{label}: {errors.failure}.")
    return [
        f"## {name[0].upper()}{name[1:]}",
        "",
        f"`{found.scene.model}`, measured against: {reference_text(found)}.",
        "",
        f"![{name}: error over processor time]({picture})",
        "",
        *(f"- {sentence}" for sentence in [*scene_sentences(found), *failures]),
        "",
        *table,
        "",
    ]


def _figure(value: float | None) -> str:
    return "–" if value is None else f"{value:.1e}"
