"""Hard cases in numbers: verdicts, classes of what went wrong, seeds."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence

from hard_cases.operating_range import inside
from hard_cases.run import Row
from hard_cases.verdict import Kind

_LONGEST = 110


def is_failure(row: Row) -> bool:
    """Whether a run is anything but right."""
    return row.verdict.kind is not Kind.RIGHT


def is_wrong(row: Row) -> bool:
    """Whether a run failed otherwise than by taking too long."""
    return row.verdict.kind not in (Kind.RIGHT, Kind.SLOW)


def counts(rows: Sequence[Row]) -> Counter[Kind]:
    """How many runs have each verdict."""
    return Counter(row.verdict.kind for row in rows)


def cause_class(row: Row) -> str:
    """What went wrong, without what differs from run to run: numbers, names of variables."""
    words = [part.split(":")[0].strip() for part in row.verdict.cause.split(";")]
    if row.verdict.kind in (Kind.WRONG, Kind.DEEP, Kind.WARNED):
        return " and ".join(dict.fromkeys(words))
    text = re.sub(r"[-+]?\d[\d.]*(e[-+]?\d+)?", "N", row.verdict.cause)
    text = re.sub(r"^.*?(The integrator|given up|crashed)", r"\1", text)
    text = re.sub(r"[A-Za-z_]+N?\.[\w.\[\],]+|\b[a-z]\w*N\.\w+(\[N\])?", "…", text)
    return text[:_LONGEST]


def classes(rows: Sequence[Row], kind: Kind) -> list[tuple[str, str, list[Row]]]:
    """The runs of a verdict by kind of scene and cause, the most frequent first."""
    found: dict[tuple[str, str], list[Row]] = {}
    for row in rows:
        if row.verdict.kind is kind:
            found.setdefault((row.case.structure.kind, cause_class(row)), []).append(row)
    return sorted(((scene, cause, own) for (scene, cause), own in found.items()), key=lambda entry: -len(entry[2]))


def summary_lines(rows: Sequence[Row]) -> list[str]:
    """For the terminal."""
    within = [row for row in rows if inside(row)]
    lines = [f"{len(rows)} runs, {len(within)} of them within the operating range:"]
    all_counts, own = counts(rows), counts(within)
    lines += [f"  {all_counts[kind]:6d}  {own[kind]:6d}  {kind.value}" for kind in Kind if all_counts[kind]]
    failed = [row for row in within if is_wrong(row)]
    lines += [f"seed {row.case.seed}: {row.verdict.kind.value}: {row.verdict.cause}" for row in failed[:20]]
    return lines
