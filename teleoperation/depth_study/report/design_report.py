"""A design and its sequences as text and CSV."""

from __future__ import annotations

import csv
import io
from pathlib import Path

from contact_foundation.output import whole_file

from depth_study.arrays import IntArray
from depth_study.design.factors import Design
from depth_study.design.hamiltonian import MAX_DECIDED, hamiltonian_starts
from depth_study.design.sequences import Balance
from depth_study.report.text_table import text_table


def design_text(design: Design) -> str:
    """Factors, constellations, edges, contrasts, and whether Hamiltonian paths exist; no trailing newline."""
    lines = [design.title, ""]
    lines += [f"  {factor.name}: {', '.join(factor.levels)}" for factor in design.factors]
    by_factor = [
        f"{factor.name} {sum(edge.factor == factor.name for edge in design.edges)}" for factor in design.factors
    ]
    lines += ["", f"{len(design.constellations)} constellations, {len(design.edges)} edges ({', '.join(by_factor)})"]
    lines += [_hamiltonian_text(design), ""]
    rows = [("constellation", "edges")]
    rows += [(name, str(len(near))) for name, near in zip(design.names, design.neighbours, strict=True)]
    lines.append(text_table(rows))
    if design.contrasts:
        contrasts = [("contrast", "edges")]
        contrasts += [(c.name, str(len(design.directed_edges(c)))) for c in design.contrasts]
        lines += ["", text_table(contrasts)]
    return "\n".join(lines)


def _hamiltonian_text(design: Design) -> str:
    starts = hamiltonian_starts(design)
    if starts is None:
        return f"whether Hamiltonian paths exist is decided for {MAX_DECIDED} constellations at most"
    without = [name for name, exists in zip(design.names, starts, strict=True) if not exists]
    if not without:
        return "Hamiltonian paths start at every constellation: all steps can be edges"
    if len(without) == len(starts):
        return "no Hamiltonian path exists: each sequence has a step that is no edge"
    return f"Hamiltonian paths start at {len(starts) - len(without)} constellations, but not at {', '.join(without)}"


def balance_text(balance: Balance, observers: int) -> str:
    """How evenly sequences use edges and positions; no trailing newline."""
    uses, even, positions = balance.edge_uses, balance.even_uses, balance.position_uses
    off = abs(uses - even).max()
    return "\n".join(
        [
            f"{observers} sequences, {balance.jumps or 'none'} with a step that is no edge",
            f"edges are walked {uses.min()} to {uses.max()} times; most evenly, given the numbers of neighbours, "
            f"{even.min():.1f} to {even.max():.1f};",
            f"  farthest from that: {off:.1f}",
            f"constellations are {positions.min()} to {positions.max()} times at each position "
            f"({observers / len(positions):.1f} on average)",
        ]
    )


def write_sequences(design: Design, sequences: IntArray, target: Path) -> None:
    """Writes sequences as CSV: observer, position (both from 1), constellation, and whether an edge leads there."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(["observer", "position", "constellation", "step"])
    for observer, row in enumerate(sequences.tolist(), 1):
        for position, number in enumerate(row, 1):
            before = row[position - 2] if position > 1 else None
            step = "" if before is None else ("edge" if (before, number) in design.edge_numbers else "jump")
            writer.writerow([observer, position, design.names[number], step])
    with whole_file(target) as staging:
        staging.write_text(stream.getvalue(), encoding="utf-8", newline="\n")
