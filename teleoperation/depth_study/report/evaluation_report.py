"""An evaluation as tables for the terminal and as an HTML page."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from contact_foundation.output import whole_file
from fmu_regression.report.page import Cell, Column, Row, Section, Table, Tile, render_page
from fmu_regression.report.plots import Plot, Series

from depth_study.evaluation.panel import MIN_ANSWERS
from depth_study.evaluation.published import Published
from depth_study.evaluation.study import ContrastEffect, Evaluation
from depth_study.report.text_table import number, percent, text_table

_Rows = list[tuple[str, ...]]


def evaluation_text(evaluation: Evaluation, published: Published | None) -> str:
    """The tables of an evaluation; no trailing newline."""
    parts = [
        _summary(evaluation),
        f"Levels, {_confidence(evaluation)} intervals",
        text_table(_level_rows(evaluation, published)),
        "\n".join(_level_notes(evaluation, published)),
        "",
        f"Differences, {_confidence(evaluation)} intervals",
        text_table(_contrast_rows(evaluation, evaluation.contrasts + evaluation.factor_effects)),
    ]
    if published is not None and published.figures:
        parts += ["", f"Published: {published.source}", text_table(_figure_rows(evaluation, published))]
        parts += [f"- {note}" for note in figure_notes(published)]
    return "\n".join(part for part in parts if part is not None)


def figure_notes(published: Published) -> list[str]:
    """Where the published words deviate from the published levels."""
    notes = [f"{figure.contrast.name}: {text}" for figure in published.figures for text in figure.deviations]
    return notes or ["the published levels give all figures that the words say"]


def _summary(evaluation: Evaluation) -> str:
    count = int(np.isfinite(evaluation.answers.absolute).sum())
    lines = [f"{len(evaluation.answers.observers)} observers, {count} answers"]
    if evaluation.left_out:
        names = ", ".join(map(str, evaluation.left_out))
        lines.append(f"left out, for fewer than {MIN_ANSWERS} answers or all of them the same: observer {names}")
    used = evaluation.panel.used
    scale, bias = evaluation.panel.scale[used], evaluation.panel.bias[used]
    lines.append(
        f"removed: scales from {number(scale.min())} to {number(scale.max())}, "
        f"biases from {number(bias.min(), signed=True)} to {number(bias.max(), signed=True)}"
    )
    lines.append(carry_over_text(evaluation))
    return "\n".join([*lines, ""])


def carry_over_text(evaluation: Evaluation) -> str:
    """What is known of the carry-over, in a line."""
    share, half = float(evaluation.carry_over.share), float(evaluation.carry_over.half_width)
    text = f"carry-over: {number(share)} ± {number(half)} of the constellation before"
    if not np.isfinite(half):
        return "carry-over: cannot be told from these answers"
    if abs(share) > half:
        return f"{text}: real; take levels and differences in the columns `clean`"
    return f"{text}: none to be seen"


def _level_rows(evaluation: Evaluation, published: Published | None) -> _Rows:
    head = ("constellation", "answers", "level", "±", "± of all", "deviation", "clean", "±", "mixed", "±")
    rows: _Rows = [head if published is None else (*head, "published", "off")]
    levels, clean, mixed = evaluation.levels, evaluation.carry_over, evaluation.mixed_model
    mixed_half = mixed.half_widths()
    for k, name in enumerate(evaluation.answers.design.names):
        row: tuple[str, ...] = (
            name,
            str(levels.count[k]),
            number(levels.mean[k]),
            number(levels.half_width[k]),
            number(levels.population_half_width[k]),
            number(levels.deviation[k]),
            number(clean.levels[k]),
            number(clean.level_half_width[k]),
            number(mixed.levels[k]),
            number(mixed_half[k]),
        )
        if published is not None:
            off = float(levels.mean[k] - published.levels[k])
            mark = "" if not abs(off) > levels.population_half_width[k] else "*"
            row += (number(published.levels[k]), number(off, signed=True) + (mark or " "))
        rows.append(row)
    return rows


def _level_notes(evaluation: Evaluation, published: Published | None) -> list[str]:
    notes = [
        "±: for these observers, to compare constellations by; of all: for all observers like them",
        "deviation: of the fitted normal distribution; clean: without carry-over; mixed: mixed model of raw answers",
    ]
    if evaluation.mixed_model.failure:
        notes.append(f"no mixed model: {evaluation.mixed_model.failure}")
    if published is not None:
        off = np.abs(evaluation.levels.mean - published.levels) > evaluation.levels.population_half_width
        inside = int(np.isfinite(evaluation.levels.population_half_width).sum() - off.sum())
        notes.append(f"{inside} of {off.size} published levels lie in the intervals of all observers (* outside)")
    return notes


def _contrast_rows(evaluation: Evaluation, effects: tuple[ContrastEffect, ...]) -> _Rows:
    rows: _Rows = [("difference", "edges", "answers", "relative", "±", "levels", "clean", "±", "mixed", "±")]
    for entry in effects:
        effect = entry.effect
        mixed, mixed_half = evaluation.mixed_model.difference(effect.edges)
        rows.append(
            (
                entry.contrast.name,
                str(len(effect.edges)),
                str(int(effect.edge_counts.sum())),
                number(float(effect.mean), signed=True),
                number(float(effect.half_width)),
                number(entry.of_levels, signed=True),
                number(entry.of_clean_levels, signed=True),
                number(entry.of_clean_levels_half_width),
                number(mixed, signed=True),
                number(mixed_half),
            )
        )
    return rows


def _figure_rows(evaluation: Evaluation, published: Published) -> _Rows:
    found = {entry.contrast.name: entry.effect for entry in evaluation.contrasts}
    rows: _Rows = [("difference", "words", "its levels", "edges from", "to", "here", "±")]
    for figure in published.figures:
        effect = found[figure.contrast.name]
        spread = "" if figure.published_spread is None else f" ± {figure.published_spread:.1f}"
        own = "" if figure.spread is None else f" ± {figure.spread:.2f}"
        rows.append(
            (
                figure.contrast.name,
                f"{number(figure.published, 1, signed=True)}{spread}",
                f"{number(figure.difference, signed=True)}{own}",
                number(figure.least, signed=True),
                number(figure.greatest, signed=True),
                number(float(effect.mean), signed=True),
                number(float(effect.half_width)),
            )
        )
    return rows


def write_evaluation(evaluation: Evaluation, published: Published | None, target: Path) -> None:
    """Writes the evaluation as one self-contained HTML file; it appears whole or not at all."""
    sections = [
        _overview(evaluation),
        _levels_section(evaluation, published),
        Section(
            "differences",
            "What the factors do",
            lead="From relative answers over the edges on which one factor changes; beside it the same differences of "
            "levels, of levels without carry-over and of the mixed model.",
            tables=(_page_table(_contrast_rows(evaluation, evaluation.contrasts + evaluation.factor_effects)),),
        ),
    ]
    if published is not None and published.figures:
        sections.append(
            Section(
                "published",
                "Beside the published words",
                lead=f"{published.source}. Spreads are those of 90 % of a normal distribution fitted to the edges.",
                tables=(_page_table(_figure_rows(evaluation, published)),),
                notes=tuple(figure_notes(published)),
            )
        )
    sections += [_edges_section(evaluation), _observers_section(evaluation)]
    title = evaluation.answers.design.title
    text = render_page(title, "Depth study: levels, effects of factors, observers", sections)
    with whole_file(target) as staging:
        staging.write_text(text, encoding="utf-8", newline="\n")


def _overview(evaluation: Evaluation) -> Section:
    answers = evaluation.answers
    count = int(np.isfinite(answers.absolute).sum())
    whole = int(np.isfinite(answers.absolute).all(1).sum())
    share, half = float(evaluation.carry_over.share), float(evaluation.carry_over.half_width)
    mixed = evaluation.mixed_model
    off = np.nanmax(np.abs(mixed.levels - evaluation.levels.mean)) if not mixed.failure else float("nan")
    tiles = (
        Tile("Observers", str(len(answers.observers)), "", f"{whole} answered everything"),
        Tile("Answers", str(count)),
        Tile("Noise", number(float(evaluation.panel.deviation)), "", "standard deviation of scores about levels"),
        Tile("Carry-over", number(share), "", f"± {number(half)}", "bad" if abs(share) > half else ""),
        Tile("Mixed model", number(float(off)), "", mixed.failure or "largest difference from the levels"),
    )
    return Section("overview", "Overview", lead=carry_over_text(evaluation) + ".", tiles=tiles)


def _levels_section(evaluation: Evaluation, published: Published | None) -> Section:
    levels = evaluation.levels
    order = np.argsort(levels.mean, kind="stable")
    names = tuple(evaluation.answers.design.names[k] for k in order)
    place = np.arange(1.0, len(names) + 1)
    mean, half = levels.mean[order], levels.half_width[order]
    curves = [
        Series("level", place, mean, color=0, note=names),
        Series("lower", place, mean - half, dashed=True, color=0, note=names),
        Series("upper", place, mean + half, dashed=True, color=0, note=names),
        Series("mixed model", place, evaluation.mixed_model.levels[order], color=1, note=names),
    ]
    if published is not None:
        curves.append(Series("published", place, published.levels[order], color=2, note=names))
    title, axis = "Levels and their intervals", "constellations by level (point at one for its name)"
    plot = Plot("levels", title, axis, "depth seen, 1 to 9", tuple(curves), points=True)
    rows = _level_rows(evaluation, published)
    return Section(
        "levels",
        "Levels of depth seen",
        lead=f"{_confidence(evaluation)} intervals; the scale is that of these observers' mean.",
        plots=(plot,),
        tables=(_page_table(rows),),
        notes=tuple(_level_notes(evaluation, published)),
    )


def _edges_section(evaluation: Evaluation) -> Section:
    names = evaluation.answers.design.names
    rows: _Rows = [("from", "to", "factor", "answers", "difference", "±")]
    for edge, effect in zip(evaluation.answers.design.edges, evaluation.edge_effects, strict=True):
        rows.append(
            (
                names[edge.first],
                names[edge.second],
                edge.factor,
                str(int(effect.edge_counts.sum())),
                number(float(effect.mean), signed=True),
                number(float(effect.half_width)),
            )
        )
    return Section("edges", "Single edges", lead="From relative answers.", tables=(_page_table(rows, 3),))


def _observers_section(evaluation: Evaluation) -> Section:
    panel = evaluation.panel
    rows: _Rows = [("observer", "answers", "scale", "bias")]
    given = np.isfinite(evaluation.answers.absolute).sum(1)
    for k, observer in enumerate(evaluation.answers.observers):
        rows.append((str(observer), str(given[k]), number(panel.scale[k]), number(panel.bias[k], signed=True)))
    return Section(
        "observers", "Observers", lead="What was removed; 1 and 0 are the mean.", tables=(_page_table(rows),)
    )


def _page_table(rows: _Rows, left: int = 1) -> Table:
    columns = tuple(Column(title, "text" if k < left else "") for k, title in enumerate(rows[0]))
    return Table(
        columns, tuple(Row(tuple(Cell(text, "text" if k < left else "") for k, text in enumerate(r))) for r in rows[1:])
    )


def _confidence(evaluation: Evaluation) -> str:
    return f"{percent(evaluation.confidence).removesuffix('.0')} %"
