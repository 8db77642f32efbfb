"""Keep the speed of all pairs of kinds: docs/engine/pairs.csv, and its summary in docs/engine/measurements.md.

    build/external-c/bench/bench/bench_pairs 8 | .venv/bin/python external-c/bench/pairs_table.py

The program is built by scripts/bench. Rows of pairs that it did not time stay as they are; a column that it left empty
is a distance that the bodies do not allow, or one that no peer answers.
"""

from __future__ import annotations

import csv
import re
import statistics
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path

from contact_data import checkout

FOLDER = checkout() / "docs" / "engine"
TABLE = FOLDER / "pairs.csv"
PAGE = FOLDER / "measurements.md"
BEGIN, END = "<!-- pairs begin -->\n", "<!-- pairs end -->\n"
COLUMNS = ("1 mm", "10 cm", "30 cm", "apart", "distance", "coherent")
HEADER = ("a", "b", *(name for column in COLUMNS for name in (f"{column}: ratio", f"{column}: microseconds")))
# Kinds of bodies that are much alike; a class of pairs is one of two groups.
GROUPS = {
    "half-spaces": ("half-space",),
    "spheres, ellipsoids, capsules": ("sphere", "ellipsoid", "capsule"),
    "cylinders, cones": ("cylinder", "cone"),
    "boxes, hulls": ("box", "hull-20", "hull-100", "hull-1000"),
    "meshes": ("box-mesh-12", "box-mesh-768", "sphere-mesh-1280"),
    "height fields": ("height-field-2048",),
}
Row = dict[str, str]


def main() -> None:
    """Read a table from standard input and write both files."""
    rows = {(row["a"], row["b"]): row for row in read_table(TABLE)}
    rows.update({(row["a"], row["b"]): row for row in timed_rows(sys.stdin)})
    with TABLE.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, HEADER, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows.values())
    PAGE.write_text(with_summary(PAGE.read_text(encoding="utf-8"), summary(rows.values())), encoding="utf-8")


def read_table(file: Path) -> list[Row]:
    """Rows of the kept table."""
    with file.open(encoding="utf-8", newline="") as lines:
        return list(csv.DictReader(lines))


def timed_rows(lines: Iterable[str]) -> list[Row]:
    """Rows of what bench_pairs prints: `| a, b | ratio (microseconds) | ...`, up to its list of the worst."""
    rows = []
    for line in lines:
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        pair = cells[0].split(", ")
        if len(pair) != 2 or len(cells) != 1 + len(COLUMNS):
            continue
        row = {"a": pair[0], "b": pair[1]}
        for column, cell in zip(COLUMNS, cells[1:], strict=True):
            found = re.fullmatch(r"([\d.]*) ?\(([\d.e+-]+)\)|", cell)
            if not found:
                raise ValueError(f"{cell!r} in {line!r} is no ratio with microseconds")
            row[f"{column}: ratio"], row[f"{column}: microseconds"] = found[1] or "", found[2] or ""
        rows.append(row)
    return rows


def summary(rows: Iterable[Row]) -> str:
    """Markdown: the classes of pairs, each with the least, median and greatest ratio at each distance."""
    classes: dict[tuple[int, ...], list[Row]] = {}
    for row in rows:
        classes.setdefault(tuple(sorted((_group(row["a"]), _group(row["b"])))), []).append(row)
    names = list(GROUPS)
    lines = ["| pairs | " + " | ".join(COLUMNS) + " |", "|---" * (1 + len(COLUMNS)) + "|"]
    for (first, second), members in sorted(classes.items()):
        name = f"{names[first]} with " + ("each other" if first == second else names[second])
        lines.append(f"| {name} ({len(members)}) | " + " | ".join(_spread(_ratios(members, c)) for c in COLUMNS) + " |")
    everything = [row for members in classes.values() for row in members]
    lines.append(f"| all ({len(everything)}) | " + " | ".join(_spread(_ratios(everything, c)) for c in COLUMNS) + " |")
    counts = ", ".join(f"{column} {_slower(_ratios(everything, column))}" for column in COLUMNS)
    every = [ratio for column in COLUMNS for ratio in _ratios(everything, column)]
    means = f"Geometric mean {statistics.geometric_mean(every):.2f}, median {statistics.median(every):.2f}"
    lines += ["", f"Above 1: {counts}; together {_slower(every)}. {means}."]
    return "\n".join(lines) + "\n"


def with_summary(page: str, table: str) -> str:
    """The page with the table between its marks."""
    before, rest = page.split(BEGIN)
    return before + BEGIN + table + END + rest.split(END)[1]


def _group(kind: str) -> int:
    return next(k for k, kinds in enumerate(GROUPS.values()) if kind in kinds)


def _ratios(rows: Iterable[Row], column: str) -> list[float]:
    # Two decimals are printed: a ratio of 0.00 is below 0.005.
    return [max(float(row[f"{column}: ratio"]), 0.005) for row in rows if row[f"{column}: ratio"]]


def _spread(ratios: Sequence[float]) -> str:
    return f"{min(ratios):.2g}/{statistics.median(ratios):.2g}/{max(ratios):.2g}" if ratios else ""


def _slower(ratios: Sequence[float]) -> str:
    return f"{sum(ratio > 1 for ratio in ratios)} of {len(ratios)}"


if __name__ == "__main__":
    main()
