"""A study as pages of Markdown: one a scene, and one that shows all."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from fmu_regression.compare.provenance import load_text

from accuracy_study.definition import Scene
from accuracy_study.grid import Variant
from accuracy_study.picture import file_name
from accuracy_study.reference_text import reference_text
from accuracy_study.sentences import milliseconds, scene_sentences, variant_text
from accuracy_study.study import Findings, Row, SceneFindings


def scene_page(findings: Findings, found: SceneFindings, pictures: Path) -> str:
    """The page of a scene: its picture, what its runs say, what its variants err and cost, where it was measured.

    Args:
        findings: of the study that the scene belongs to.
        found: the scene.
        pictures: folder of the pictures, relative to the page.
    """
    name = found.scene.name
    versions = ", ".join(f"{package} {version}" for package, version in findings.versions.items())
    load = load_text(row.outcome.load for row in found.rows)
    failures = [
        f"{variant_text(variant, found.scene)}: {errors.failure}."
        for variant, errors in found.errors.items()
        if errors.failure
    ]
    lines = [
        f"# {_title(found.scene)}: what accuracy costs",
        "",
        f"`{found.scene.model}`, measured against: {reference_text(found)}.",
        "",
        f"![{name}: error over processor time]({(pictures / file_name(found.scene)).as_posix()}.svg)",
        "",
        *(f"- {sentence}" for sentence in [*scene_sentences(found), *failures]),
        "",
        *_variants(found),
        "",
        f"{len(found.rows)} runs. Machine: {findings.machine}. Versions: {versions}. {load}".rstrip(),
        "",
    ]
    return "\n".join(lines)


def index_page(scenes: Sequence[Scene], pages: Path, pictures: Path) -> str:
    """Every scene that has a page, with its picture.

    Args:
        scenes: that have one.
        pages: folder of the pages, relative to this one.
        pictures: that of the pictures.
    """
    lines = []
    for scene in scenes:
        stem = file_name(scene)
        picture = f"![{scene.name}: error over processor time]({(pictures / stem).as_posix()}.svg)"
        lines += [f"## [{_title(scene)}]({(pages / stem).as_posix()}.md)", "", picture, ""]
    return "\n".join(lines)


def _title(scene: Scene) -> str:
    return f"{scene.name[0].upper()}{scene.name[1:]}"


def _variants(found: SceneFindings) -> list[str]:
    """What each variant errs without the solver, and its tightest run by the last solver of the study."""
    tightest = min(row.run.tolerance for row in found.rows)
    solver = found.rows[-1].run.solver
    lines = [
        "| variant | geometry error | model error | floor | order, model exchange | order, co-simulation "
        f"| error, {solver} at {tightest:g} | evaluations | time |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for variant, errors in found.errors.items():
        figures = [_figure(value) for value in (errors.geometry, errors.model, errors.floor)]
        orders = [found.order(variant, "me", None), found.order(variant, "cs", None)]
        figures += ["–" if order is None else f"{order:.1f}" for order in orders]
        run = _run(found, variant)
        if run is None or run.outcome.error is None:
            figures += ["–", "–", "–"]
        else:
            evaluations = run.outcome.evaluations
            figures += [_figure(run.outcome.error), "–" if evaluations is None else str(evaluations), milliseconds(run)]
        lines.append(f"| {variant_text(variant, found.scene)} | {' | '.join(figures)} |")
    return lines


def _run(found: SceneFindings, variant: Variant) -> Row | None:
    """The tightest run of a variant by the last solver, at the first longest step."""
    last = found.rows[-1].run.solver
    rows = [row for row in found.rows if row.run.variant == variant and row.run.solver == last]
    return min(rows, key=lambda row: row.run.tolerance, default=None)


def _figure(value: float | None) -> str:
    return "–" if value is None else f"{value:.1e}"
