"""Hard cases as one self-contained HTML page: the map, the operating range, what went wrong."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from pathlib import Path

from contact_foundation.output import whole_file

from hard_cases.picture import hard_map
from hard_cases.run import Row
from hard_cases.tables import failure_rows, range_rows, verdict_rows

_HEAD = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>Hard cases</title>
<style>body{font-family:sans-serif;max-width:1100px;margin:2em auto;padding:0 1em}
table{border-collapse:collapse;margin:1em 0}td,th{border:1px solid #ccc;padding:3px 8px;text-align:left}
svg{max-width:100%;height:auto}</style></head><body>
"""


def write_page(rows: Sequence[Row], target: Path) -> None:
    """Writes the page, whole or not at all."""
    parts = [
        _HEAD,
        "<h1>Hard cases</h1>",
        hard_map(rows),
        "<h2>Verdicts</h2>",
        _table(verdict_rows(rows)),
        "<h2>Operating range</h2>",
        _table(range_rows(rows)),
        "<h2>What went wrong, by class</h2>",
        _table(failure_rows(rows)),
        "</body></html>\n",
    ]
    with whole_file(target) as staging:
        staging.write_text("\n".join(parts), encoding="utf-8", newline="\n")


def _table(rows: Sequence[Sequence[str]]) -> str:
    head, *body = rows
    lines = ["<table>", "<tr>" + "".join(f"<th>{escape(cell)}</th>" for cell in head) + "</tr>"]
    lines += ["<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>" for row in body]
    return "\n".join([*lines, "</table>"])
