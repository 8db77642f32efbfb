"""Which states' directions are followed together, and what each of these passes has to compute.

A direction moves only what depends on its state: that of a free body moves the body and the contacts it may have, that
of a leg moves the leg. States that move much the same share a pass; what no direction of a pass moves is left out of
it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from modelica2fmu.equations.lanes import LANES
from modelica2fmu.equations.tangents import Tangent, is_tangent, tangent_name, tangent_roots, tangent_targets
from modelica2fmu.symbolic import expression as ex

_CALL_COST: Final = 4  # of the call of one cluster, in steps


@dataclass(frozen=True)
class Cluster:
    """Steps that are executed one after the other in the same passes.

    Attributes:
        steps: in order.
        passes: bit p is set if pass p executes them.
        handed_on: tangents that later clusters or the result read.
    """

    steps: tuple[Tangent, ...]
    passes: int
    handed_on: tuple[str, ...]


@dataclass(frozen=True)
class DirectionPasses:
    """The schedule.

    Attributes:
        columns: of each pass, positions of at most ``LANES`` states.
        clusters: in the order of execution.
    """

    columns: tuple[tuple[int, ...], ...]
    clusters: tuple[Cluster, ...]


def direction_passes(steps: Sequence[Tangent], states: Sequence[str], wanted: Sequence[str]) -> DirectionPasses:
    """Schedules the steps.

    Args:
        steps: see :func:`modelica2fmu.equations.tangents.tangents`.
        states: whose directions are followed.
        wanted: tangents that are read in the end.
    """
    reads = [_reads(step) for step in steps]
    moved_by = _moving_columns(steps, reads, states)
    columns = _shared_passes(moved_by, len(states))
    pass_of = {column: number for number, group in enumerate(columns) for column in group}
    executing = {mask: sum({1 << pass_of[column] for column in _bits(mask)}) for mask in set(moved_by)}
    passes = [executing[mask] for mask in moved_by]
    runs = _merged(_ordered(steps, reads, passes), passes)
    home = {position: number for number, run in enumerate(runs) for position in run}
    readers: dict[str, set[int]] = {}
    for position, names in enumerate(reads):
        for name in names:
            readers.setdefault(name, set()).add(home[position])
    final = set(wanted)
    clusters = []
    for number, run in enumerate(runs):
        handed_on = tuple(
            name
            for position in run
            for name in tangent_targets(steps[position])
            if name in final or any(reader != number for reader in readers.get(name, ()))
        )
        union = 0
        for position in run:
            union |= passes[position]
        clusters.append(Cluster(tuple(steps[position] for position in run), union, handed_on))
    return DirectionPasses(columns, tuple(clusters))


def _reads(step: Tangent) -> tuple[str, ...]:
    return tuple(name for name in ex.symbols(*tangent_roots(step)) if is_tangent(name))


def _bits(mask: int) -> list[int]:
    found = []
    while mask:
        lowest = mask & -mask
        found.append(lowest.bit_length() - 1)
        mask ^= lowest
    return found


def _moving_columns(steps: Sequence[Tangent], reads: Sequence[Sequence[str]], states: Sequence[str]) -> list[int]:
    """Of each step, the states that move it, as bits."""
    moving = {tangent_name(state): 1 << column for column, state in enumerate(states)}
    result = []
    for step, names in zip(steps, reads, strict=True):
        mask = 0
        for name in names:
            mask |= moving.get(name, 0)
        moving.update(dict.fromkeys(tangent_targets(step), mask))
        result.append(mask)
    return result


def _shared_passes(moved_by: Sequence[int], count: int) -> tuple[tuple[int, ...], ...]:
    """States by ``LANES``, so that those of a pass move as much in common as they can; those that move most first."""
    moved: dict[int, int] = {}
    for position, mask in enumerate(moved_by):
        moved[mask] = moved.get(mask, 0) | 1 << position
    moves = [0] * count
    for mask, positions in moved.items():
        for column in _bits(mask):
            moves[column] |= positions
    left = sorted(range(count), key=lambda column: (-moves[column].bit_count(), column))
    passes = []
    while left:
        group = [left.pop(0)]
        union = moves[group[0]]
        while left and len(group) < LANES:
            best = max(left, key=lambda column: _saving(union, moves[column]))
            left.remove(best)
            group.append(best)
            union |= moves[best]
        passes.append(tuple(group))
    return tuple(passes)


def _saving(union: int, moves: int) -> int:
    """Steps that a state has in common with a pass, less those that it would add to it."""
    return (union & moves).bit_count() - (moves & ~union).bit_count()


def _ordered(steps: Sequence[Tangent], reads: Sequence[Sequence[str]], passes: Sequence[int]) -> list[list[int]]:
    """Positions of the steps in few runs of the same passes; what is read comes before what reads it."""
    producer = {name: position for position, step in enumerate(steps) for name in tangent_targets(step)}
    waiting = []
    followers: list[list[int]] = [[] for _ in steps]
    ready: dict[int, list[int]] = {}
    for position, names in enumerate(reads):
        before = {producer[name] for name in names if name in producer}
        waiting.append(len(before))
        for other in before:
            followers[other].append(position)
        if not before:
            ready.setdefault(passes[position], []).append(position)
    runs = []
    while ready:
        chosen = min(ready, key=lambda mask: (-len(ready[mask]), ready[mask][0]))
        run: list[int] = []
        while chosen in ready:
            batch = ready.pop(chosen)
            run += batch
            for position in batch:
                for follower in followers[position]:
                    waiting[follower] -= 1
                    if waiting[follower] == 0:
                        ready.setdefault(passes[follower], []).append(follower)
        runs.append(run)
    return runs


def _merged(runs: Sequence[list[int]], passes: Sequence[int]) -> list[list[int]]:
    """The same with runs joined to the one before where that costs less than calling them."""
    result: list[list[int]] = []
    masks: list[int] = []
    for run in runs:
        mask = passes[run[0]]
        if result:
            union = masks[-1] | mask
            wasted = len(result[-1]) * (union ^ masks[-1]).bit_count() + len(run) * (union ^ mask).bit_count()
            if wasted <= _CALL_COST * mask.bit_count():
                result[-1] += run
                masks[-1] = union
                continue
        result.append(list(run))
        masks.append(mask)
    return result
