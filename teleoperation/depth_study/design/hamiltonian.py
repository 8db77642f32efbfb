"""Whether a design's graph has Hamiltonian paths: sequences over edges alone that visit each constellation once.

Decided by dynamic programming over sets of constellations (M. Held and R. M. Karp, "A dynamic programming approach to
sequencing problems", J. SIAM 10, 1962), with a set of ends instead of a cost for each set visited.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from depth_study.design.factors import Design

MAX_DECIDED = 22
"""Constellations of the largest design that is decided; memory and time double with each one more."""


def hamiltonian_starts(design: Design) -> tuple[bool, ...] | None:
    """For each constellation, whether a Hamiltonian path starts there; None if the design is too large to decide."""
    count = len(design.constellations)
    if count > MAX_DECIDED:
        return None
    ends = int(_ends_of_paths(design)[-1])
    return tuple(bool(ends >> number & 1) for number in range(count))


def _ends_of_paths(design: Design) -> NDArray[np.int32]:
    """For each set of constellations, as bits, the set of those where a path that visits just the set can end."""
    count = len(design.constellations)
    neighbours = [sum(1 << other for other in others) for others in design.neighbours]
    sets = np.arange(1 << count, dtype=np.int32)
    sizes = np.bitwise_count(sets)
    by_size = np.argsort(sizes, kind="stable").astype(np.int32)
    borders = np.searchsorted(sizes[by_size], np.arange(count + 2))
    ends = np.zeros(1 << count, dtype=np.int32)
    for number in range(count):
        ends[1 << number] = 1 << number
    for size in range(2, count + 1):
        visited = by_size[borders[size] : borders[size + 1]]
        found = np.zeros(visited.size, dtype=np.int32)
        for number in range(count):
            bit = 1 << number
            before = ends[visited & ~np.int32(bit)]
            found |= np.where((visited & bit != 0) & (before & neighbours[number] != 0), np.int32(bit), np.int32(0))
        ends[visited] = found
    return ends
