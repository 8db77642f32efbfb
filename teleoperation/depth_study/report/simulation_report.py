"""Simulated studies as text: coverage of intervals, and how many observers find a difference."""

from __future__ import annotations

import math

from depth_study.report.text_table import number, percent, text_table
from depth_study.simulation.coverage import Coverage, LevelCoverage
from depth_study.simulation.power import ENOUGH, PowerTable


def coverage_text(
    results: tuple[Coverage, ...], names: tuple[str, ...], *, studies: int, observers: int, confidence: float
) -> str:
    """Coverage over carry-over, and where it breaks; no trailing newline."""
    wanted = percent(confidence).removesuffix(".0")
    low, high = confidence - 0.02, confidence + 0.02
    rows: list[tuple[str, ...]] = [
        ("carry-over", "these observers", "all observers", "clean levels", "estimated", "its interval")
    ]
    for result in results:
        cells = (_range(level) for level in (result.panel, result.population, result.clean))
        rows.append(
            (
                number(result.carry_over),
                *cells,
                number(result.carry_over_estimate),
                percent(result.carry_over_share),
            )
        )
    lines = [
        f"{studies} simulated studies of {observers} observers for each carry-over",
        f"{wanted} % intervals of levels that cover the truth, % (mean over constellations, least to greatest)",
        text_table(rows, left=0),
        f"One share has a standard error of {100 * math.sqrt(confidence * (1 - confidence) / studies):.1f} %.",
        "",
    ]
    for result in results:
        broken = [
            (names[k], share, bias)
            for k, (share, bias) in enumerate(zip(result.panel.share, result.panel.bias, strict=True))
            if share < low - 2 * math.sqrt(confidence * (1 - confidence) / studies)
        ]
        inside = low <= result.panel.mean <= high
        text = f"carry-over {number(result.carry_over)}: {'within' if inside else 'outside'} "
        text += f"{100 * low:.0f} to {100 * high:.0f} % on average"
        lines.append(text + (", but not for" if broken and inside else ":" if broken else ""))
        lines += [f"  {name}: {percent(share)} %, off by {number(bias, signed=True)}" for name, share, bias in broken]
    head: list[tuple[str, ...]] = [("difference", *(f"carry-over {number(r.carry_over)}" for r in results))]
    relative = [_effect_row(results, k, clean=False) for k in range(len(results[0].effects))]
    clean = [_effect_row(results, k, clean=True) for k in range(len(results[0].effects))]
    if relative:
        title = f"{wanted} % intervals of differences that cover the truth, % (and mean error)"
        lines += ["", f"{title}, from relative answers", text_table([*head, *relative])]
        lines += ["", "the same from clean levels", text_table([*head, *clean])]
    return "\n".join(lines)


def _effect_row(results: tuple[Coverage, ...], k: int, *, clean: bool) -> tuple[str, ...]:
    cells = []
    for effect in (result.effects[k] for result in results):
        share, bias = (effect.clean_share, effect.clean_bias) if clean else (effect.share, effect.bias)
        cells.append(f"{percent(share)} ({number(bias, signed=True)})")
    return results[0].effects[k].contrast.name, *cells


def power_text(table: PowerTable, studies: int) -> str:
    """How many observers find a difference; no trailing newline."""
    contrast = table.contrast
    difference = table.rows[0].difference
    rows = [("observers", "two levels", "one edge", "whole factor")]
    for row in (*table.rows, table.without):
        name = str(row.observers) if row.difference else f"{row.observers}, no difference"
        rows.append((name, percent(row.constellations), percent(row.edge), percent(row.factor)))
    enough = [
        ("two levels", table.enough("constellations")),
        ("one edge", table.enough("edge")),
        ("the whole factor", table.enough("factor")),
    ]
    found = "; ".join(f"{name}: {count if count is not None else 'more'}" for name, count in enough)
    return "\n".join(
        [
            f"Studies of {studies} that find a difference of {difference:g} ({contrast.name}), %",
            text_table(rows),
            f"two levels: {table.edge[0]} and {table.edge[1]} by absolute answers; one edge: the same by relative ones",
            f"least number of observers in the table that finds it in {percent(ENOUGH).removesuffix('.0')} %: {found}",
        ]
    )


def _range(level: LevelCoverage) -> str:
    return f"{percent(level.mean)} ({percent(float(level.share.min()))} to {percent(float(level.share.max()))})"
