"""Tables of hard cases, as rows of cells."""

from __future__ import annotations

from collections.abc import Sequence

from hard_cases.operating_range import LIMITS, inside, outside
from hard_cases.run import Row
from hard_cases.summary import classes, counts, is_failure
from hard_cases.verdict import Kind

_SEEDS = 6
Table = list[tuple[str, ...]]


def verdict_rows(rows: Sequence[Row]) -> Table:
    """How many runs have each verdict, within the operating range and without."""
    within = counts([row for row in rows if inside(row)])
    every = counts(rows)
    table: Table = [("verdict", "runs", "within the operating range")]
    table += [(kind.value, str(every[kind]), str(within[kind])) for kind in Kind]
    return [*table, ("all", str(len(rows)), str(within.total()))]


def range_rows(rows: Sequence[Row]) -> Table:
    """The limits; how many runs exceed each, and how many of those are not right."""
    table: Table = [("quantity", "what it is", "range", "what to change", "runs beyond", "not right")]
    for limit in LIMITS:
        beyond = [row for row in rows if limit in outside(row)]
        bad = sum(is_failure(row) for row in beyond)
        span = f"{limit.low:g} to {limit.high:g}" if limit.low else f"{limit.high:g} at most"
        table.append((limit.name, limit.meaning, span, limit.change, str(len(beyond)), str(bad)))
    return table


def failure_rows(rows: Sequence[Row]) -> Table:
    """The classes of what is not right, the worst verdict first, with seeds."""
    table: Table = [("verdict", "scene", "what", "runs", "within the range", "seeds")]
    for kind in reversed(Kind):
        if kind is Kind.RIGHT:
            continue
        for scene, cause, own in classes(rows, kind):
            seeds = ", ".join(str(row.case.seed) for row in own[:_SEEDS]) + (", …" if len(own) > _SEEDS else "")
            table.append((kind.value, scene, cause, str(len(own)), str(sum(inside(row) for row in own)), seeds))
    return table
