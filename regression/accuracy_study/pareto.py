"""Which runs nothing else beats: those that err less than every cheaper one."""

from __future__ import annotations

from collections.abc import Sequence

from accuracy_study.study import Row


def front(rows: Sequence[Row]) -> tuple[Row, ...]:
    """The rows that err less than all cheaper ones, from the cheapest to the most accurate; failures are left out."""
    found: list[Row] = []
    for row in sorted(_priced(rows), key=lambda row: (row.outcome.cpu_time or 0.0, row.outcome.error or 0.0)):
        if not found or _error(row) < _error(found[-1]):
            found.append(row)
    return tuple(found)


def cheapest_below(rows: Sequence[Row], error: float) -> Row | None:
    """The cheapest run that errs less than ``error``, or None."""
    good = [row for row in _priced(rows) if _error(row) < error]
    return min(good, key=lambda row: row.outcome.cpu_time or 0.0, default=None)


def most_accurate(rows: Sequence[Row]) -> Row | None:
    """The run that errs least, the cheapest of several; None where all failed."""
    return min(_priced(rows), key=lambda row: (_error(row), row.outcome.cpu_time or 0.0), default=None)


def _priced(rows: Sequence[Row]) -> list[Row]:
    return [row for row in rows if row.outcome.error is not None and row.outcome.cpu_time is not None]


def _error(row: Row) -> float:
    assert row.outcome.error is not None
    return row.outcome.error
