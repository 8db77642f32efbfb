"""A study's design: factors, the constellations of their levels, and the edges between those that differ in one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import combinations, product

Constellation = tuple[str, ...]
"""One level of each factor, in the order of the factors."""


@dataclass(frozen=True)
class Factor:
    """What is varied, and its levels."""

    name: str
    levels: tuple[str, ...]


@dataclass(frozen=True)
class Restriction:
    """Where all factors of ``when`` have the given levels, those of ``allow`` have one of the given ones."""

    when: Mapping[str, str]
    allow: Mapping[str, tuple[str, ...]]


@dataclass(frozen=True)
class Edge:
    """Two constellations that differ in one factor.

    Attributes:
        first, second: numbers of the constellations, from 0; first < second.
        factor: name of the factor.
    """

    first: int
    second: int
    factor: str


@dataclass(frozen=True)
class Contrast:
    """A difference that the study asks about: the mean over edges of one factor.

    Attributes:
        name: for people.
        factor: the one that changes.
        start: levels of the factor that the difference starts from.
        end: levels it leads to.
        where: levels that other factors must have; all if a factor is left out.
    """

    name: str
    factor: str
    start: tuple[str, ...]
    end: tuple[str, ...]
    where: Mapping[str, tuple[str, ...]] = field(default_factory=dict)


@dataclass(frozen=True)
class Design:
    """A study's design.

    Attributes:
        title: for people.
        factors: at least one.
        restrictions: what excludes combinations of levels.
        contrasts: the differences asked about.
    """

    title: str
    factors: tuple[Factor, ...]
    restrictions: tuple[Restriction, ...] = ()
    contrasts: tuple[Contrast, ...] = ()

    @cached_property
    def constellations(self) -> tuple[Constellation, ...]:
        """All allowed combinations of levels, the last factor's level changing fastest."""
        every = product(*(factor.levels for factor in self.factors))
        return tuple(levels for levels in every if self._allows(levels))

    @cached_property
    def names(self) -> tuple[str, ...]:
        """The constellations' names, such as "shutter/parallel/still"."""
        return tuple("/".join(levels) for levels in self.constellations)

    @cached_property
    def edges(self) -> tuple[Edge, ...]:
        """The pairs of constellations that differ in one factor."""
        found = []
        for first, second in combinations(range(len(self.constellations)), 2):
            changed = self._changed(first, second)
            if len(changed) == 1:
                found.append(Edge(first, second, changed[0]))
        return tuple(found)

    @cached_property
    def edge_numbers(self) -> Mapping[tuple[int, int], int]:
        """Number of the edge between two constellations, in both orders of these."""
        numbers = {}
        for number, edge in enumerate(self.edges):
            numbers[edge.first, edge.second] = numbers[edge.second, edge.first] = number
        return numbers

    @cached_property
    def neighbours(self) -> tuple[tuple[int, ...], ...]:
        """Of each constellation, those that an edge joins it with."""
        lists: list[list[int]] = [[] for _ in self.constellations]
        for edge in self.edges:
            lists[edge.first].append(edge.second)
            lists[edge.second].append(edge.first)
        return tuple(tuple(sorted(entries)) for entries in lists)

    def parts(self) -> tuple[tuple[int, ...], ...]:
        """The sets of constellations that edges connect; one set in a design that can be studied."""
        left = set(range(len(self.constellations)))
        parts = []
        while left:
            part, border = set(), [min(left)]
            while border:
                number = border.pop()
                if number not in part:
                    part.add(number)
                    border += self.neighbours[number]
            left -= part
            parts.append(tuple(sorted(part)))
        return tuple(parts)

    def directed_edges(self, contrast: Contrast) -> tuple[tuple[int, int], ...]:
        """A contrast's edges as pairs (from, to) of constellations' numbers."""
        position = self._positions[contrast.factor]
        found = []
        for edge in self.edges:
            if edge.factor != contrast.factor:
                continue
            for start, end in ((edge.first, edge.second), (edge.second, edge.first)):
                levels, after = self.constellations[start], self.constellations[end]
                if (
                    levels[position] in contrast.start
                    and after[position] in contrast.end
                    and all(levels[self._positions[name]] in allowed for name, allowed in contrast.where.items())
                ):
                    found.append((start, end))
        return tuple(found)

    @cached_property
    def level_contrasts(self) -> tuple[Contrast, ...]:
        """For every factor and two of its levels that an edge joins: the difference over all of these edges."""
        found = []
        for factor in self.factors:
            for start, end in combinations(factor.levels, 2):
                contrast = Contrast(f"{factor.name}: {start} to {end}", factor.name, (start,), (end,))
                if self.directed_edges(contrast):
                    found.append(contrast)
        return tuple(found)

    @cached_property
    def _positions(self) -> Mapping[str, int]:
        return {factor.name: k for k, factor in enumerate(self.factors)}

    def _changed(self, first: int, second: int) -> list[str]:
        pairs: Sequence[tuple[str, str]] = list(
            zip(self.constellations[first], self.constellations[second], strict=True)
        )
        return [factor.name for factor, (a, b) in zip(self.factors, pairs, strict=True) if a != b]

    def _allows(self, levels: Constellation) -> bool:
        value = {factor.name: level for factor, level in zip(self.factors, levels, strict=True)}
        return all(
            all(value[name] in allowed for name, allowed in restriction.allow.items())
            for restriction in self.restrictions
            if all(value[name] == level for name, level in restriction.when.items())
        )
