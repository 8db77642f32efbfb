"""Many scenes, run after run; each row is written at once, and what is there is not repeated."""

from __future__ import annotations

import csv
import tempfile
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Final

from contact_foundation.errors import CmbError, SimulationError

from contact_promises.soak.runs import IMPORTERS, MODES, TOLERANCES, Run, Trace, judge, stopped, trace
from contact_promises.soak.scenes import MODEL, Scene

Builder = Callable[[str, Path, Path], None]
"""Builds the FMU of a model: its name, the file that holds it, the FMU to write."""

COLUMNS: Final = (
    "seed", "bodies", "ground", "law", "friction", "restitution", "importer", "mode", "tolerance",
    "balance", "rise", "deviation", "failure", "message",
)  # fmt: skip
Row = dict[str, str]


def all_runs(importers: Sequence[str] = IMPORTERS, tolerances: Sequence[float] = TOLERANCES) -> list[Run]:
    """Every importer, mode and tolerance."""
    return [Run(importer, mode, tolerance) for importer in importers for mode in MODES for tolerance in tolerances]


def soak(
    draw: Callable[[int], Scene], seeds: Sequence[int], runs: Sequence[Run], table: Path, build: Builder
) -> Iterator[Row]:
    """Carries the campaign on.

    Args:
        draw: the scene of a seed.
        seeds: of the scenes.
        runs: of each scene.
        table: CSV file that rows are appended to; runs that it holds are left out.
        build: builds FMUs.

    Yields:
        each new row, after it was written.
    """
    there = {(row["seed"], row["importer"], row["mode"], row["tolerance"]) for row in read(table)}
    is_new = not table.exists()
    table.parent.mkdir(parents=True, exist_ok=True)
    with table.open("a", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        if is_new:
            writer.writeheader()
        for seed in seeds:
            left = [r for r in runs if (str(seed), r.importer, r.mode, f"{r.tolerance:.0e}") not in there]
            if not left:
                continue
            for row in _scene_rows(draw(seed), left, build):
                writer.writerow(row)
                file.flush()
                yield row


def read(table: Path) -> list[Row]:
    """The rows of a table; none if there is no file."""
    if not table.exists():
        return []
    with table.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def _scene_rows(scene: Scene, runs: Sequence[Run], build: Builder) -> Iterator[Row]:
    with tempfile.TemporaryDirectory(prefix="cmb-soak-") as folder:
        source, fmu = Path(folder) / f"{MODEL}.mo", Path(folder) / f"{MODEL}.fmu"
        source.write_text(scene.text, encoding="utf-8")
        reference: Trace | None = None
        error: CmbError | None = None
        try:
            build(MODEL, source, fmu)
            reference = trace(fmu, Run("cmb", "cs", min(TOLERANCES)))
        except CmbError as failure:
            error = failure
        for run in runs:
            yield _row(scene, run, fmu, reference, error)


def _row(scene: Scene, run: Run, fmu: Path, reference: Trace | None, error: CmbError | None) -> Row:
    row = {
        "seed": str(scene.seed),
        "bodies": "+".join(scene.bodies),
        "ground": scene.ground,
        "law": scene.law,
        "friction": scene.friction,
        "restitution": scene.restitution,
        "importer": run.importer,
        "mode": run.mode,
        "tolerance": f"{run.tolerance:.0e}",
    }
    if reference is None:
        text = " ".join(str(error).split())[:200]
        return {**row, "balance": "", "rise": "", "deviation": "", "failure": f"no reference: {text}", "message": ""}
    try:
        verdict = judge(trace(fmu, run), reference, run.tolerance)
    except SimulationError as failure:
        verdict = stopped(failure)
    numbers = {name: f"{getattr(verdict, name):.3g}" for name in ("balance", "rise", "deviation")}
    return {**row, **numbers, "failure": verdict.failure, "message": verdict.message}


def summary(rows: Sequence[Row]) -> str:
    """Markdown: how many runs of each importer, mode and tolerance are right, stopped or wrong; then the wrong ones."""
    lines = [
        "| importer | mode | tolerance | runs | right | stopped with a message | wrong |",
        "|---|---|---|---|---|---|---|",
    ]
    keys = dict.fromkeys((row["importer"], row["mode"], row["tolerance"]) for row in rows)
    for key in sorted(keys, key=lambda k: (k[0], k[1], -float(k[2]))):
        these = [row for row in rows if (row["importer"], row["mode"], row["tolerance"]) == key]
        wrong = sum(bool(row["failure"]) for row in these)
        messages = sum(bool(row["message"]) for row in these)
        lines.append(f"| {' | '.join(key)} | {len(these)} | {len(these) - wrong - messages} | {messages} | {wrong} |")
    wrong_rows = [row for row in rows if row["failure"]]
    if wrong_rows:
        lines += ["", "| seed | scene | run | what is wrong |", "|---|---|---|---|"]
        lines += [
            f"| {row['seed']} | {row['bodies']} on {row['ground']}, "
            f"{row['law']}, {row['friction']}, {row['restitution']} | "
            f"{row['importer']} {row['mode']} {row['tolerance']} | {row['failure']} |"
            for row in wrong_rows
        ]
    return "\n".join(lines) + "\n"
