"""Which coordinates of coupled loops are the states: such that come to no dead centre on the loops' way.

At a dead centre of a coordinate the loops move while it does not: as a state it says nothing there, and a model cannot
pass. Where n coordinates have f freedoms, f of them are states if their rows of the null space of the loops' equations
make a regular matrix. Its determinant is followed along the ways that the loops can go.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from math import comb

import numpy as np

from cad2modelica.geometry.spatial import Array
from cad2modelica.kinematics.joint_twists import Column
from cad2modelica.kinematics.loop_motion import LoopMotion
from cad2modelica.kinematics.planar_loops import Loop

MOST_COLUMNS = 24  # of loops whose ways are followed
MOST_CHOICES = 2000
MOST_FREEDOMS = 2  # whose motions a few ways stand for
FLAT = 0.02  # of a determinant, 1 at most: a dead centre
ENDLESS = 10**6


@dataclass(frozen=True)
class CoordinateChoice:
    """Chosen states.

    Attributes:
        independent: numbers of columns.
        dead_centers: of a single state, its displacements from the start where it comes to a dead centre.
        is_sampled: = true, if there are more freedoms than the ways that were followed can stand for.
    """

    independent: tuple[int, ...]
    dead_centers: tuple[float, ...] = ()
    is_sampled: bool = False


def choose_coordinates(
    loops: Sequence[Loop],
    columns: Sequence[Column],
    length: float,
    preferred: Sequence[int],
    possible: Sequence[int],
) -> CoordinateChoice:
    """The preferred states, unless others go farther on the loops' ways before a dead centre.

    Args:
        loops: they share joints.
        columns: coordinates of all their joints.
        length: typical length of the mechanism, m.
        preferred: numbers of independent columns.
        possible: numbers of the columns that may be states.
    """
    count = len(preferred)
    small = len(columns) <= MOST_COLUMNS and comb(len(possible), count) <= MOST_CHOICES
    if count == 0 or not small:
        return CoordinateChoice(tuple(preferred), is_sampled=count > MOST_FREEDOMS)
    motion = LoopMotion(loops, columns, length)
    begin = motion.null_space(motion.start())
    if begin.shape[1] != count:
        return CoordinateChoice(tuple(preferred))
    ways = motion.ways()
    bases = [_along([begin, *(motion.null_space(position) for position in way)]) for way in ways]
    first = tuple(sorted(preferred))
    best, reach = first, _reach(bases, first)
    if reach[0] < ENDLESS:
        for choice in combinations(sorted(possible), count):
            other = _reach(bases, choice)
            if other > reach:
                best, reach = choice, other
    found = []
    if count == 1:
        for way, base in zip(ways, bases, strict=True):
            passed = _passed(_determinants(base, best))
            if passed < ENDLESS:
                # The first base of a way is that of the start.
                found.append(float(way[passed - 1].coordinates[best[0]]) if passed > 0 else 0.0)
    return CoordinateChoice(best, tuple(dict.fromkeys(found)), is_sampled=count > MOST_FREEDOMS)


def _along(bases: Sequence[Array]) -> list[Array]:
    """Null spaces in a row, each in the base nearest to the one before, so that determinants do not change sign."""
    found = [bases[0]]
    for base in bases[1:]:
        if base.shape != found[0].shape:
            break
        left, _, right = np.linalg.svd(base.T @ found[-1])
        found.append(base @ (left @ right))
    return found


def _determinants(bases: Sequence[Array], choice: Sequence[int]) -> Array:
    return np.asarray(np.linalg.det(np.array([base[list(choice)] for base in bases])))


def _passed(determinants: Array) -> int:
    """How many steps of a way lie before a dead centre."""
    flat = np.flatnonzero(determinants * np.sign(determinants[0]) < FLAT)
    return int(flat[0]) if len(flat) else ENDLESS


def _reach(ways: Sequence[Sequence[Array]], choice: Sequence[int]) -> tuple[int, float]:
    """Steps to the nearest dead centre, and the smallest determinant before it; rounding decides nothing."""
    found = [_determinants(bases, choice) for bases in ways]
    steps = min(map(_passed, found), default=ENDLESS)
    least = min((float(np.abs(values[: steps + 1]).min()) for values in found), default=0.0)
    return steps, float(f"{least:.2g}")
