"""Random models with events, each with what the language makes of it (Modelica Language Specification 3.6, 8.3.5, 8.6).

States move at constant speeds, so all events have closed forms: at multiples of intervals, at given times, where states
pass thresholds. Times and thresholds have digits that keep them apart.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

END = 2.0
MOST_EVENTS = 300
MOST_ROUNDS = 30
APART = 1e-6


class AmbiguousError(Exception):
    """Events coincide, or do not end."""


@dataclass(eq=False)
class Atom:
    """A condition without ``and`` and ``or``.

    Attributes:
        kind: ``sample``, ``time``, ``count`` (of a counter) or ``state`` (beyond a threshold).
        number: of the counter or state.
        limit: what it is compared with; the first instant of a sample.
        interval: of a sample.
        is_above: = true, if what is greater than the limit counts.
    """

    kind: str
    number: int = 0
    limit: float = 0.0
    interval: float = 0.0
    is_above: bool = True

    def text(self) -> str:
        sign = ">" if self.is_above else "<"
        return {
            "sample": f"sample({self.limit:.6g}, {self.interval:.6g})",
            "time": f"time >= {self.limit:.8g}",
            "count": f"m{self.number} {sign} {self.limit:.0f}",
            "state": f"x{self.number} {sign} {self.limit:.8g}",
        }[self.kind]


@dataclass(eq=False)
class Condition:
    """Atoms joined by ``and``, ``or``, or the vector of several conditions."""

    atoms: list[Atom]
    joint: str

    def text(self) -> str:
        texts = [atom.text() for atom in self.atoms]
        return f"{{{', '.join(texts)}}}" if self.joint == "vector" else f" {self.joint} ".join(texts)


@dataclass
class Clause:
    """A when-equation.

    Attributes:
        variable: what it sets: ``m0``, ``k1``; or ``x0``, that it reinitializes.
        branches: conditions, each with the operation and its operand.
    """

    variable: str
    branches: list[tuple[Condition, str, float]]

    def text(self) -> str:
        keyword, parts = "when", []
        for condition, operation, operand in self.branches:
            value = OPERATIONS[operation].format(name=self.variable, operand=operand)
            action = f"reinit({self.variable}, {value})" if self.variable[0] == "x" else f"{self.variable} = {value}"
            parts.append(f"{keyword} {condition.text()} then\n    {action};\n  ")
            keyword = "elsewhen"
        return "".join((*parts, "end when;"))


OPERATIONS = {
    "increase": "pre({name}) + {operand:.0f}",
    "set": "{operand:g}",
    "turn": "-pre({name})",
    "reflect": "-{name}",
    "halve": "0.5*{name}",
}


@dataclass
class RandomEvents:
    """A model named M, and its run."""

    choose: random.Random
    start: dict[str, float] = field(default_factory=dict)
    clauses: list[Clause] = field(default_factory=list)

    def fill(self) -> None:
        states = range(self.choose.randint(1, 3))
        self.start |= {f"x{number}": self.choose.choice([0.11, 0.52, -0.31]) for number in states}
        self.start |= {f"k{number}": self.choose.choice([0.7, -0.6, 1.3, 0.45]) for number in states}
        self.start |= {f"m{number}": 0 for number in range(self.choose.randint(1, 4))}
        order = [name for name in self.start if name[0] != "x"]
        self.choose.shuffle(order)
        for place, name in enumerate(order):
            known = [int(each[1:]) for each in order[:place] if each[0] == "m"]
            branches = [
                (self._condition(known), *self._operation(name)) for _ in range(self.choose.choice([1, 1, 2, 3]))
            ]
            sampled = [each for each in branches if any(atom.kind == "sample" for atom in each[0].atoms)]
            self.clauses.append(Clause(name, [each for each in branches if each not in sampled[1:]]))
        counters = [int(name[1:]) for name in order if name[0] == "m"]
        for number in states:
            if self.choose.random() < 0.6:
                operation, operand = self.choose.choice(
                    [("set", 0.371), ("reflect", 0.0), ("halve", 0.0), ("set", -0.213)]
                )
                self.clauses.append(Clause(f"x{number}", [(self._condition(counters), operation, operand)]))

    def _operation(self, name: str) -> tuple[str, float]:
        if name[0] == "m":
            return self.choose.choice([("increase", 1), ("increase", 2), ("set", 3), ("set", -1)])
        return self.choose.choice([("turn", 0.0), ("set", 0.8), ("set", -0.5)])

    def _condition(self, counters: Sequence[int]) -> Condition:
        atoms = [self._atom(counters) for _ in range(self.choose.choice([1, 1, 2]))]
        sampled = [atom for atom in atoms if atom.kind == "sample"]
        if sampled and len(atoms) > 1:
            atoms = [atom for atom in atoms if atom not in sampled[1:]]
            return Condition(atoms, "vector" if len(atoms) > 1 else "and")
        return Condition(atoms, self.choose.choice(["and", "or", "vector"]) if len(atoms) > 1 else "and")

    def _atom(self, counters: Sequence[int]) -> Atom:
        choose = self.choose
        kind = choose.choice(["sample", "time", "state", "state", *(["count"] if counters else [])])
        if kind == "sample":
            return Atom(
                kind, limit=round(choose.uniform(0, 0.5), 2) + 0.0013, interval=round(choose.uniform(0.15, 0.7), 2)
            )
        if kind == "time":
            return Atom(kind, limit=round(choose.uniform(0.05, 1.9), 3) + 0.00037)
        if kind == "count":
            return Atom(kind, choose.choice(counters), choose.randint(0, 3), is_above=choose.random() < 0.7)
        number = choose.randrange(sum(name[0] == "x" for name in self.start))
        return Atom(kind, number, round(choose.uniform(-0.5, 1.5), 2) + 0.00071, is_above=choose.random() < 0.5)

    def text(self) -> str:
        kinds = {"x": "Real", "k": "discrete Real", "m": "Integer"}
        lines = [f"{kinds[name[0]]} {name}(start = {value:g}, fixed = true);" for name, value in self.start.items()]
        rates = [f"der({name}) = k{name[1:]};" for name in self.start if name[0] == "x"]
        body = "\n  ".join((*lines, "equation", *rates, *(clause.text() for clause in self.clauses)))
        return f"model M\n  {body}\nend M;\n"

    def run(self, grid: NDArray[np.float64]) -> dict[str, list[float]]:
        """The variables at the times of a grid; raises AmbiguousError."""
        run = _Run(self)
        rows: dict[str, list[float]] = {name: [] for name in self.start}
        following = run.events()
        event = next(following)
        for time in grid:
            while event <= time:
                event = next(following)
            for name in rows:
                rows[name].append(run.at(name, time))
        return rows


class _Run:
    def __init__(self, model: RandomEvents) -> None:
        self._clauses = model.clauses
        self._values = dict(model.start)
        self._time = 0.0
        self._atoms = [
            atom for clause in model.clauses for condition, _, _ in clause.branches for atom in condition.atoms
        ]
        self._passing: dict[Atom, bool] = {}  # what the thresholds say that are being passed
        self._held = {id(part): self._holds(part, False) for part in self._parts()}

    def at(self, name: str, time: float) -> float:
        speed = self._values[f"k{name[1:]}"] if name[0] == "x" else 0.0
        return self._values[name] + speed * (time - self._time)

    def events(self) -> Iterator[float]:
        """Goes from event to event: the time of the next one, before it happens."""
        for _ in range(MOST_EVENTS):
            time = self._next()
            yield time
            self._happen(time)
        raise AmbiguousError

    def _parts(self) -> Iterator[Condition | Atom]:
        """What becomes true for itself: conditions, or the elements of their vectors."""
        for clause in self._clauses:
            for condition, _, _ in clause.branches:
                yield from condition.atoms if condition.joint == "vector" else [condition]

    def _next(self) -> float:
        times: dict[Any, float] = {}
        for atom in self._atoms:
            if atom.kind == "sample":
                ahead = max(0.0, np.floor((self._time - atom.limit) / atom.interval + APART) + 1)
                times[atom] = atom.limit + (ahead * atom.interval if self._time >= atom.limit - APART else 0)
            elif atom.kind == "time" and atom.limit > self._time:
                times[atom] = atom.limit
            elif atom.kind == "state" and self._values[f"k{atom.number}"]:
                way = atom.limit - self._values[f"x{atom.number}"]
                time = self._time + way / self._values[f"k{atom.number}"]
                if time > self._time + 1e-10:
                    times[atom.number, atom.limit] = time
        first = min(times.values(), default=2 * END)
        near = [key for key, time in times.items() if time < first + APART]
        if len(near) > 1 and not all(isinstance(key, Atom) and key.kind == "sample" for key in near):
            raise AmbiguousError
        self._passed = near[0] if near else None
        return first

    def _happen(self, time: float) -> None:
        self._values |= {name: self.at(name, time) for name in self._values if name[0] == "x"}
        self._time = time
        self._passing = {
            atom: (self._values[f"k{atom.number}"] > 0) == atom.is_above
            for atom in self._atoms
            if atom.kind == "state" and (atom.number, atom.limit) == self._passed
        }
        is_first = True
        for _ in range(MOST_ROUNDS):
            before = dict(self._values)
            held = {id(part): self._holds(part, is_first) for part in self._parts()}
            for clause in self._clauses:
                self._activate(clause, before, is_first, held)
            is_over = self._values == before and held == self._held and not is_first
            self._held, is_first = held, False
            moved = {name for name in before if name[0] == "x" and before[name] != self._values[name]}
            self._passing = {atom: is_true for atom, is_true in self._passing.items() if f"x{atom.number}" not in moved}
            if is_over:
                return
        raise AmbiguousError

    def _activate(self, clause: Clause, before: dict[str, float], is_first: bool, held: dict[int, bool]) -> None:
        is_done = False
        for condition, operation, operand in clause.branches:
            rises = False
            for part in condition.atoms if condition.joint == "vector" else [condition]:
                held[id(part)] = self._holds(part, is_first)  # after the counters that were set before it
                rises |= held[id(part)] and not self._held[id(part)]
            if rises and not is_done:
                is_done = True
                name = clause.variable
                self._values[name] = {
                    "increase": before[name] + operand,
                    "set": operand,
                    "turn": -before[name],
                    "reflect": -before[name],
                    "halve": 0.5 * before[name],
                }[operation]

    def _holds(self, part: Condition | Atom, is_first: bool) -> bool:
        if isinstance(part, Condition):
            return (any if part.joint == "or" else all)(self._holds(atom, is_first) for atom in part.atoms)
        if part.kind == "sample":
            ticks = (self._time - part.limit) / part.interval
            return is_first and ticks > -APART and bool(abs(ticks - round(ticks)) < APART)
        if part.kind == "time":
            return self._time >= part.limit - 1e-12
        if part in self._passing:
            return self._passing[part]
        value = self._values[f"{'m' if part.kind == 'count' else 'x'}{part.number}"]
        return value > part.limit if part.is_above else value < part.limit


def random_events(seed: int) -> RandomEvents:
    """The model of a seed."""
    model = RandomEvents(random.Random(seed))
    model.fill()
    return model
