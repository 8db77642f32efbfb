"""The table of promises: what was allowed and what came out at each tolerance."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final

from contact_foundation.progress import Progress, silent
from fmu_regression.cases.case import Case, load_case
from fmu_regression.cases.runner import RunResult, run_case
from fmu_regression.compare.checks import BoundCheck, ValueCheck

from contact_promises.impacts import RESTITUTION, all_impacts, errors

Builder = Callable[[Case], Path]
"""Gives the FMU of a case's model."""


ALLOWED_RESTITUTION: Final = 1e-3
"""Error of a free impact's restitution at tolerances from 1e-4 on."""


@dataclass(frozen=True)
class Row:
    """One promise: what, the largest error that is allowed, and the worst that came out at each tolerance."""

    scene: str
    subject: str
    allowed: str
    found: tuple[str, ...]


def impact_rows(title: str, fmu: Path, tolerances: Sequence[float]) -> list[Row]:
    """A row for each coefficient of restitution: the worst of all speeds, stiffnesses and exponents."""
    rows = []
    for e in RESTITUTION:
        impacts = [impact for impact in all_impacts() if impact.restitution == e]
        found = tuple(_marked(max(errors(fmu, impacts, tolerance)), ALLOWED_RESTITUTION) for tolerance in tolerances)
        scene = f"{title}, {len(impacts)} speeds, stiffnesses, exponents"
        rows.append(Row(scene, f"e = {e:g}", f"{ALLOWED_RESTITUTION:.1e}", found))
    return rows


def _marked(error: float, allowed: float) -> str:
    """An error, bold if it is greater than what is allowed."""
    return f"{error:.1e}" if error <= allowed else f"**{error:.1e}**"


def case_rows(
    path: Path, build: Builder, tolerances: Sequence[float], *, time_limit: float = 120.0, progress: Progress = silent
) -> list[Row]:
    """A row for each check of a case; the worst of its modes counts."""
    case = load_case(path)
    fmu = build(case)
    runs = [
        run_case(replace(case, tolerance=tolerance), fmu, time_limit=time_limit, progress=progress).runs
        for tolerance in tolerances
    ]
    rows = []
    for k, check in enumerate(case.checks):
        found = tuple(_worst(modes, k) for modes in runs)
        first = next((run.outcomes[k] for modes in runs for run in modes if run.outcomes), None)
        rows.append(
            Row(case.description, check.subject, "" if first is None else _allowed(check, first.allowed), found)
        )
    return rows


def _allowed(check: object, allowed: float | None) -> str:
    if isinstance(check, BoundCheck):
        return " … ".join(f"{limit:g}" for limit in (check.minimum, check.maximum) if limit is not None)
    return "" if allowed is None else f"{allowed:.1e}"


def _worst(modes: Sequence[RunResult], check: int) -> str:
    failed = [run for run in modes if run.error]
    if failed:
        return "failed: " + failed[0].error.split("\n")[0]
    outcome = max((run.outcomes[check] for run in modes), key=lambda one: (not one.passed, one.measured))
    text = outcome.message if not isinstance(outcome.check, ValueCheck) else f"{outcome.measured:.1e}"
    return text if outcome.passed else f"**{text}**"


def markdown(rows: Sequence[Row], tolerances: Sequence[float]) -> str:
    """The rows as a Markdown table; what is not kept is bold."""
    head = ["scene", "promise", "allowed", *(f"at {tolerance:.0e}" for tolerance in tolerances)]
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    scene = ""
    for row in rows:
        name = "" if row.scene == scene else row.scene
        scene = row.scene
        lines.append("| " + " | ".join([name, row.subject, row.allowed, *row.found]) + " |")
    return "\n".join(lines) + "\n"
