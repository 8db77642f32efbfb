"""Tearing: a few unknowns of a component are assumed, the others follow one by one.

As many equations remain as unknowns were assumed (Kron 1963, "Diakoptics"; Elmqvist and Otter 1994, "Methods for
tearing systems of equations in object-oriented modeling"). For a mechanism, the derivatives of the states are tried
first: with them given, all accelerations and then all forces follow, so a block has at most as many torn unknowns as
the mechanism has degrees of freedom.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from modelica2fmu.equations.blocks import Entry, Residual, entry_targets
from modelica2fmu.expand.scalar_model import unwrapped
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node


class Tearing:
    """Tears one component.

    Args:
        entries: of the component, by number.
        dependencies: unknowns that each entry contains, its targets not counted.
        names: unknowns of the component.
        preferred: unknowns to be torn first.
    """

    def __init__(
        self,
        entries: Mapping[int, Entry],
        dependencies: Mapping[int, Sequence[str]],
        names: Sequence[str],
        preferred: Collection[str],
    ) -> None:
        self._entries = entries
        self._rows = list(entries)
        self._names = dict.fromkeys(names)
        self._preferred = preferred
        self._open: dict[int, set[str]] = {}
        self._rows_of: dict[str, list[int]] = {name: [] for name in names}
        for number in entries:
            inside = {name for name in dependencies[number] if name in self._names}
            self._open[number] = inside
            for name in inside:
                self._rows_of[name].append(number)
        self._targets: dict[int, tuple[str, ...]] = {
            number: entry_targets(entry) for number, entry in entries.items() if not isinstance(entry, Residual)
        }
        self._solvable_memo: dict[tuple[int, str], bool] = {}
        self._known: set[str] = set()
        self._used: set[int] = set()
        self._order: list[tuple[int, str]] = []

    def run(self) -> tuple[list[str], list[tuple[int, str]], list[int]]:
        """Torn unknowns, entries in order with what they give, and the entries that remain as residuals."""
        torn: list[str] = []
        queue = list(self._rows)
        while True:
            self._propagate(queue)
            if len(self._known) == len(self._names):
                break
            name = self._next()
            torn.append(name)
            queue = self._mark(name)
        remaining = [number for number in self._rows if number not in self._used]
        return torn, self._order, remaining

    def _mark(self, name: str) -> list[int]:
        self._known.add(name)
        for number in self._rows_of[name]:
            self._open[number].discard(name)
        return list(self._rows_of[name])

    def _propagate(self, queue: list[int]) -> None:
        position = 0
        while position < len(queue):
            number = queue[position]
            position += 1
            if number in self._used:
                continue
            if number in self._targets:
                if not self._open[number] and not any(name in self._known for name in self._targets[number]):
                    self._used.add(number)
                    self._order.append((number, self._targets[number][0]))
                    for name in self._targets[number]:
                        queue.extend(self._mark(name))
                continue
            if len(self._open[number]) == 1:
                (name,) = self._open[number]
                if self._solvable(number, name):
                    self._used.add(number)
                    self._order.append((number, name))
                    queue.extend(self._mark(name))

    def _solvable(self, number: int, name: str) -> bool:
        """True if the equation gives the unknown without a division that may be one by zero."""
        key = (number, name)
        if key not in self._solvable_memo:
            entry = self._entries[number]
            assert isinstance(entry, Residual)
            coefficient = ex.Differentiation(lambda other: 1 if other == name else 0)(entry.residual)
            self._solvable_memo[key] = not isinstance(coefficient, Node) and coefficient != 0
        return self._solvable_memo[key]

    def _gives_other(self, number: int, name: str) -> bool:
        """True if an equation with two open unknowns gives the other one when ``name`` is known."""
        if number in self._targets:
            return False
        (other,) = self._open[number] - {name}
        return self._solvable(number, other)

    def _next(self) -> str:
        """The unknown to assume next."""
        outputs = {name for targets in self._targets.values() for name in targets}
        candidates = [name for name in self._names if name not in self._known and name not in outputs]
        if not candidates:
            candidates = [name for name in self._names if name not in self._known]
        candidates = (
            [name for name in candidates if name in self._preferred]
            or [name for name in candidates if unwrapped(name)[0] == "der"]
            or candidates
        )
        open_rows = {name: [n for n in self._rows_of[name] if n not in self._used] for name in candidates}

        def score(name: str) -> tuple[int, int]:
            follow = sum(len(self._open[number]) == 2 and self._gives_other(number, name) for number in open_rows[name])
            return follow, len(open_rows[name])

        return max(candidates, key=score)
