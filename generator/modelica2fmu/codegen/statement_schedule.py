"""An order of statements in which those of one family stand together where what they need allows it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from heapq import heapify, heappop, heappush


class Schedule:
    """Orders units.

    Args:
        needs: for each unit, the units that come before it.
        families: family of a unit; units without one come as early as they can.
        is_discrete: whether a unit is executed at events only; such units stand together, too.
        least: how many of a family are worth standing together.
    """

    def __init__(
        self, needs: Mapping[int, Sequence[int]], families: Mapping[int, int], is_discrete: Sequence[bool], least: int
    ) -> None:
        self._families = families
        self._is_discrete = is_discrete
        self._least = least
        self._missing = {unit: len(before) for unit, before in needs.items()}
        self._after: dict[int, list[int]] = {}
        for unit, before in needs.items():
            for other in before:
                self._after.setdefault(other, []).append(unit)
        self._left: dict[int, int] = {}
        for unit in needs:
            if unit in families:
                self._left[families[unit]] = self._left.get(families[unit], 0) + 1
        self._single: tuple[list[int], list[int]] = ([], [])
        self._together: dict[int, list[int]] = {}

    def run(self) -> Iterator[list[int]]:
        """All units, each after those it needs: lists of one, or of a family's."""
        for unit in [unit for unit, missing in self._missing.items() if missing == 0]:
            self._ready(unit)
        while True:
            yield from self._singles()
            if not self._together:
                return
            family = max(self._together, key=self._worth)
            units = sorted(self._together.pop(family))
            self._left[family] -= len(units)
            if len(units) >= self._least:
                yield units
            else:
                yield from ([unit] for unit in units)
            for unit in units:
                self._done(unit)

    def _worth(self, family: int) -> tuple[bool, int]:
        """Families that are whole come first, then the largest."""
        count = len(self._together[family])
        return count == self._left[family], count

    def _singles(self) -> Iterator[list[int]]:
        while self._single[0] or self._single[1]:
            for heap in self._single:
                heapify(heap)
                while heap:
                    unit = heappop(heap)
                    yield [unit]
                    self._done(unit)

    def _ready(self, unit: int) -> None:
        family = self._families.get(unit)
        if family is None:
            heappush(self._single[self._is_discrete[unit]], unit)
        else:
            self._together.setdefault(family, []).append(unit)

    def _done(self, unit: int) -> None:
        for other in self._after.pop(unit, ()):
            self._missing[other] -= 1
            if self._missing[other] == 0:
                self._ready(other)
