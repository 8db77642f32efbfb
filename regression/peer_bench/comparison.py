"""Who is fastest at which error, and what each run's time went into."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from peer_bench.bench import Findings, Row
from peer_bench.configurations import OURS
from peer_bench.scenes import Scene

LEVELS: Final = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
LEAST: Final = 1e-12
"""Errors below this are drawn and compared as this: they are rounding."""


@dataclass(frozen=True)
class Level:
    """The cheapest run of each program that errs less than a level, and stays below it when it is tightened once.

    Attributes:
        error: the level.
        cheapest: by program, those that reach it.
    """

    error: float
    cheapest: dict[str, Row]

    @property
    def winner(self) -> str:
        """The program that is fastest, "" where none reaches the level."""
        return min(self.cheapest, key=lambda program: _time(self.cheapest[program]), default="")

    @property
    def behind(self) -> float | None:
        """By how much longer this project takes than the fastest peer; below 1 it wins; None where one is missing."""
        peers = [_time(row) for program, row in self.cheapest.items() if program != OURS]
        if OURS not in self.cheapest or not peers:
            return None
        return _time(self.cheapest[OURS]) / min(peers)


def levels(findings: Findings, scene: Scene) -> tuple[Level, ...]:
    """The levels that any program reaches in a scene."""
    found = []
    for error in LEVELS:
        below = [row for row, reached in safe_errors(findings.of(scene)).items() if reached < error]
        programs = dict.fromkeys(row.configuration.program for row in below)
        cheapest = {p: min((r for r in below if r.configuration.program == p), key=_time) for p in programs}
        if cheapest:
            found.append(Level(error, cheapest))
    return tuple(found)


def safe_errors(rows: Sequence[Row]) -> dict[Row, float]:
    """Of each row its error, or that of the next tighter one of the same configuration if that is larger.

    So that nobody wins by luck: an error counts where the next tighter tolerance or step keeps it.
    """
    found = {}
    for row in rows:
        if row.error is not None:
            same = [r for r in rows if r.configuration == row.configuration and r.error is not None]
            following = max((r for r in same if r.value < row.value), key=lambda r: r.value, default=row)
            found[row] = max(row.error, following.error or 0.0)
    return found


def front(rows: Sequence[Row]) -> tuple[tuple[Row, float], ...]:
    """The rows that err less than all cheaper ones, with what counts as their errors."""
    found: list[tuple[Row, float]] = []
    for row, error in sorted(safe_errors(rows).items(), key=lambda item: (_time(item[0]), item[1])):
        if not found or error < found[-1][1]:
            found.append((row, error))
    return tuple(found)


def most_accurate(rows: Sequence[Row]) -> Row | None:
    """The row that errs least, or None where all failed."""
    return min((r for r in rows if r.error is not None), key=lambda r: (r.error, _time(r)), default=None)


def sentences(findings: Findings, scene: Scene) -> list[str]:
    """Who wins where, and by what."""
    found = []
    groups: list[list[Level]] = []
    for level in levels(findings, scene):
        if groups and groups[-1][0].winner == level.winner:
            groups[-1].append(level)
        else:
            groups.append([level])
    for group in groups:
        found.append(_winner_sentence(group))
        last = group[-1]
        if OURS in last.cheapest and len(last.cheapest) > 1:
            found.append(_work_sentence(last))
    for program in dict.fromkeys(row.configuration.program for row in findings.of(scene)):
        best = most_accurate([r for r in findings.of(scene) if r.configuration.program == program])
        if best is None:
            found.append(f"{program}: every run failed.")
        elif (best.error or 0.0) >= LEVELS[1]:
            found.append(f"{program} errs {best.error:.1e} at least ({best.configuration.label}).")
    return found


def _winner_sentence(group: Sequence[Level]) -> str:
    first, last = group[0], group[-1]
    if first is last:
        return f"Errors below {first.error:.0e}: {first.winner} is fastest ({_beside(first)})."
    return (
        f"Errors from {first.error:.0e} down to {last.error:.0e}: {first.winner} is fastest; below {first.error:.0e} "
        f"({_beside(first)}), below {last.error:.0e} ({_beside(last)})."
    )


def _beside(level: Level) -> str:
    """The fastest run of a level, and how much longer the others take."""
    row = level.cheapest[level.winner]
    rest = {program: _time(other) / _time(row) for program, other in level.cheapest.items() if other is not row}
    others = [f"{program} takes {ratio:.3g} times as long" for program, ratio in sorted(rest.items(), key=_second)]
    return ", ".join([f"{milliseconds(row)}: {run_text(row)}", *(others or ["no other program gets there"])])


def _second(item: tuple[str, float]) -> float:
    return item[1]


def _work_sentence(level: Level) -> str:
    """What the fastest of this project and of its peers did."""
    peers = [program for program in level.cheapest if program != OURS]
    fastest = min(peers, key=lambda program: _time(level.cheapest[program]))
    return f"There {_work(level.cheapest[OURS])}, {_work(level.cheapest[fastest])}."


def _work(row: Row) -> str:
    steps, evaluations = row.work.get("steps"), row.work.get("evaluations")
    text = f"{row.configuration.program} takes {steps:.0f} steps" if steps else row.configuration.program
    if evaluations:
        text += f" and {evaluations:.0f} evaluations ({1e6 * _time(row) / evaluations:.1f} µs each)"
    elif steps:
        text += f" ({1e6 * _time(row) / steps:.1f} µs each)"
    return text


def run_text(row: Row) -> str:
    """Configuration and swept value of a run."""
    return f"{row.configuration.label}, {row.configuration.swept} {row.value:g}"


def milliseconds(row: Row) -> str:
    """The time of a run."""
    return f"{1e3 * _time(row):.3g} ms"


def _time(row: Row) -> float:
    time = row.cpu_time
    assert time is not None
    return time
