"""Sequences for observers: quasi-Hamiltonian paths, balanced over edges and positions.

A sequence visits each constellation once. All of its steps are edges where that is possible from its start, else all
but one. Sequences are made one after the other, each the best of many random ones beside those before it, so that the
first ones do not depend on how many follow.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice, pairwise

import numpy as np
from contact_foundation.errors import InputError
from contact_foundation.progress import Progress, silent

from depth_study.arrays import FloatArray, IntArray
from depth_study.design.factors import Design
from depth_study.design.hamiltonian import hamiltonian_starts

_CANDIDATES = 60
_VISITS = 4000
_TRIES = 50


@dataclass(frozen=True)
class Balance:
    """How evenly sequences use edges and positions.

    Attributes:
        edge_uses: how often each edge is walked, in either direction; shape (edges,).
        even_uses: the most even use (least squares) by which each constellation is left or reached equally often;
            shape (edges,).
        position_uses: how often each constellation is at each position; shape (positions, constellations).
        jumps: sequences with a step that is no edge.
    """

    edge_uses: IntArray
    even_uses: FloatArray
    position_uses: IntArray
    jumps: int


def make_sequences(design: Design, observers: int, seed: int, progress: Progress = silent) -> IntArray:
    """Sequences for the observers 1, 2, ...

    Args:
        design: what is studied.
        observers: how many sequences.
        seed: the same seed gives the same sequences; those for fewer observers are the first ones of those for more.
        progress: is told the share of sequences made.

    Returns:
        Numbers of constellations in the order of their showing; shape (observers, constellations).

    Raises:
        InputError: no sequence with at most one step that is no edge was found.
    """
    rows = []
    for row in islice(sequences_without_end(design, seed), observers):
        rows.append(row)
        progress("sequences", len(rows) / observers)
    return np.array(rows, dtype=np.intp).reshape(observers, len(design.constellations))


def sequences_without_end(design: Design, seed: int) -> Iterator[IntArray]:
    """Yields the sequences of the observers 1, 2, ... one after the other; shape (constellations,) each.

    Raises:
        InputError: no sequence with at most one step that is no edge was found.
    """
    chance = random.Random(seed)
    count = len(design.constellations)
    exact = hamiltonian_starts(design)
    uses = _Uses(design)
    starts: list[int] = []
    while True:
        if not starts:
            starts = chance.sample(range(count), count)
        start = starts.pop()
        jumps = (1,) if exact is not None and not exact[start] else (0, 1)
        row = _best_of_many(design, start, jumps, uses, chance)
        uses.add(row)
        yield np.array(row, dtype=np.intp)


def balance(design: Design, sequences: IntArray) -> Balance:
    """How evenly these sequences use the design; they may be unfinished, with -1 after their last constellation."""
    count = len(design.constellations)
    edge_uses = np.zeros(len(design.edges), dtype=np.intp)
    position_uses = np.zeros((count, count), dtype=np.intp)
    jumps = 0
    for row in sequences:
        visited = [int(number) for number in row if number >= 0]
        for position, number in enumerate(visited):
            position_uses[position, number] += 1
        edges = [design.edge_numbers.get(step) for step in pairwise(visited)]
        jumps += any(edge is None for edge in edges)
        for edge in edges:
            if edge is not None:
                edge_uses[edge] += 1
    return Balance(edge_uses, _even_uses(design, int(edge_uses.sum())), position_uses, jumps)


def _even_uses(design: Design, steps: int) -> FloatArray:
    """Least squares: uses that sum to the same at each constellation, of all such those with the least squares.

    Rounded, as processors differ in the last digits, and equally good sequences are chosen by these numbers.
    """
    incidence = np.zeros((len(design.constellations), len(design.edges)))
    for number, edge in enumerate(design.edges):
        incidence[edge.first, number] = incidence[edge.second, number] = 1.0
    wanted = np.full(len(design.constellations), 2.0 * steps / len(design.constellations))
    even = np.asarray(np.linalg.lstsq(incidence, wanted)[0], dtype=np.float64)
    return even.round(12)


class _Uses:
    """How often edges and positions were used so far, less what an even use would be."""

    def __init__(self, design: Design) -> None:
        count = len(design.constellations)
        self._edges = design.edge_numbers
        self._share = _even_uses(design, count - 1)
        self._edge_uses = np.zeros(len(design.edges))
        self._position_uses = np.zeros((count, count))

    def add(self, path: Sequence[int]) -> None:
        """Counts a path."""
        self._edge_uses -= self._share
        for step in pairwise(path):
            if step in self._edges:
                self._edge_uses[self._edges[step]] += 1
        for position, number in enumerate(path):
            self._position_uses[position, number] += 1

    def edge(self, first: int, second: int) -> float:
        """How often more than evenly an edge was used; a jump counts as an edge used evenly."""
        number = self._edges.get((first, second))
        return 0.0 if number is None else float(self._edge_uses[number])

    def cost(self, path: Sequence[int]) -> float:
        """By how much the squared uses grow with this path, positions twice; without what is the same for all paths."""
        edges = sum(2 * self.edge(first, second) for first, second in pairwise(path))
        positions = 4 * float(self._position_uses[np.arange(len(path)), np.asarray(path)].sum())
        return edges + positions


def _best_of_many(
    design: Design, start: int, jump_numbers: Sequence[int], uses: _Uses, chance: random.Random
) -> list[int]:
    for jumps in jump_numbers:
        found: list[list[int]] = []
        for attempt in range(_CANDIDATES):
            path = _random_path(design, start, jumps, uses, chance)
            if path is not None:
                found.append(path)
            elif not found and attempt >= _TRIES:
                break
        if found:
            return min(found, key=uses.cost)
    raise InputError(
        f"no sequence from {design.names[start]} that visits all constellations with at most one step that is no edge "
        "was found",
        remedy="Loosen what the design's `only` excludes, so that more constellations differ in one factor.",
    )


def _random_path(design: Design, start: int, jumps: int, uses: _Uses, chance: random.Random) -> list[int] | None:
    """A random path over all constellations with at most so many jumps, or None if the search was given up.

    Goes on with constellations that have few ways left, and with edges that were little used; steps back where it ends.
    """
    count = len(design.constellations)
    path, left = [start], set(range(count)) - {start}
    jumped = [False]
    choices = [_ways(design, start, left, jumps > 0, uses, chance)]
    for _ in range(_VISITS):
        if not left:
            return path
        if choices[-1]:
            number, jump = choices[-1].pop()
            path.append(number)
            left.discard(number)
            jumped.append(jumped[-1] or jump)
            choices.append(_ways(design, number, left, jumps > 0 and not jumped[-1], uses, chance))
        elif len(path) == 1:
            return None
        else:
            left.add(path.pop())
            jumped.pop()
            choices.pop()
    return None


def _ways(
    design: Design, number: int, left: set[int], may_jump: bool, uses: _Uses, chance: random.Random
) -> list[tuple[int, bool]]:
    """Where to go next and whether by a jump, the best last."""

    def ways_left(other: int) -> int:
        return sum(third in left for third in design.neighbours[other])

    near = [other for other in design.neighbours[number] if other in left]
    order = sorted(near, key=lambda o: uses.edge(number, o) + 0.7 * ways_left(o) + chance.gauss(0, 1.2), reverse=True)
    if not may_jump:
        return [(other, False) for other in order]
    far = sorted(left - set(near))
    chance.shuffle(far)
    return [*((other, True) for other in far), *((other, False) for other in order)]
