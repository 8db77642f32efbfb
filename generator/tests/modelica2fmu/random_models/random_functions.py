"""Random Modelica functions with algorithms, each with the values that it gives.

Loops over ranges, arrays and nothing, ``while``, ``break`` and ``return``, assignments to elements, slices and members,
several outputs, defaults, named arguments, sizes that callers decide, records, functions that call functions.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from function_semantics import (
    BOOLEAN,
    DATA,
    INTEGER,
    REAL,
    Break,
    Expression,
    Function,
    Kind,
    Return,
    Statement,
    Values,
    copied,
)

RECORD = """  record Data
    Real a = 1.25;
    Real v[2] = {0.5, -2.25};
    Integer n = 3;
  end Data;
"""
MOST_ITERATIONS = 6


@dataclass
class Scope:
    """What statements of a function may read and assign."""

    readable: list[tuple[str, Kind]] = field(default_factory=list)
    assignable: list[tuple[str, Kind]] = field(default_factory=list)
    loops: int = 0

    def names(self, kind: Kind, assignable: bool = False) -> list[str]:
        of = self.assignable if assignable else self.readable
        return [name for name, each in of if each == kind]

    def vectors(self, assignable: bool = False) -> list[tuple[str, Kind]]:
        return [each for each in (self.assignable if assignable else self.readable) if each[1].name == "vector"]


class Writer:
    """Draws expressions, statements and functions."""

    def __init__(self, seed: int) -> None:
        self.draw = random.Random(seed)
        self.functions: list[Function] = []
        self._names = 0

    # --- expressions ---------------------------------------------------------
    def number(self) -> Expression:
        value = round(self.draw.uniform(-3, 3), 3)
        return (f"({value!r})" if value < 0 else repr(value)), lambda _: value

    def whole(self, least: int = 0, most: int = 5) -> Expression:
        value = self.draw.randint(least, most)
        return str(value), lambda _: value

    def real(self, scope: Scope, depth: int = 2) -> Expression:
        choices: list[Callable[[], Expression]] = [self.number]
        for name in scope.names(REAL):
            choices += [lambda name=name: _read(name)] * 3
        for name in scope.names(DATA):
            choices += [lambda name=name: (f"{name}.a", lambda values: values[name]["a"])]
        choices += [lambda each=each: self.element(scope, each) for each in scope.vectors()]
        if depth > 0:
            choices += [lambda: self.sum_or_product(scope, depth - 1)] * 3
            choices += [lambda: self.quotient(scope, depth - 1), lambda: self.elementary(scope, depth - 1)]
            choices += [lambda: self.choice(scope, depth - 1), lambda: self.reduction(scope, depth - 1)]
            choices += [lambda: self.whole_expression(scope, depth - 1)]
            for function in self.functions:
                if function.outputs[0][1] == REAL:
                    choices += [lambda function=function: self.called(scope, function, depth - 1)] * 2
        return self.draw.choice(choices)()

    def expression(self, scope: Scope, kind: Kind, depth: int = 2) -> Expression:
        if kind.name == "vector":
            return self.vector(scope, kind, depth)
        by_kind = {REAL: self.real, INTEGER: self.whole_expression, BOOLEAN: self.condition, DATA: self.record}
        return by_kind[kind](scope, depth)

    def sum_or_product(self, scope: Scope, depth: int) -> Expression:
        (left, of_left), (right, of_right) = self.real(scope, depth), self.real(scope, depth)
        sign = self.draw.choice("+-*")
        if sign == "+":
            return f"({left} + {right})", lambda values: of_left(values) + of_right(values)
        if sign == "-":
            return f"({left} - {right})", lambda values: of_left(values) - of_right(values)
        return f"{left}*{right}", lambda values: of_left(values) * of_right(values)

    def quotient(self, scope: Scope, depth: int) -> Expression:
        (left, of_left), (right, of_right) = self.real(scope, depth), self.real(scope, depth)
        return f"{left}/(1.5 + abs({right}))", lambda values: of_left(values) / (1.5 + abs(of_right(values)))

    def elementary(self, scope: Scope, depth: int) -> Expression:
        text, of = self.real(scope, depth)
        name = self.draw.choice(["sin", "cos", "tanh", "abs", "sqrt", "atan2", "max", "min", "sign", "square"])
        if name == "sqrt":
            return f"sqrt(abs({text}))", lambda values: math.sqrt(abs(of(values)))
        if name == "square":
            return f"({text})^2", lambda values: of(values) ** 2
        if name == "sign":
            return f"sign({text})", lambda values: float(np.sign(of(values)))
        if name in ("max", "min", "atan2"):
            other, of_other = self.real(scope, depth)
            two = {"max": max, "min": min, "atan2": math.atan2}[name]
            return f"{name}({text}, {other})", lambda values: float(two(of(values), of_other(values)))
        one = {"sin": math.sin, "cos": math.cos, "tanh": math.tanh, "abs": abs}[name]
        return f"{name}({text})", lambda values: one(of(values))

    def choice(self, scope: Scope, depth: int) -> Expression:
        (condition, holds), (yes, of_yes), (no, of_no) = (
            self.condition(scope, depth),
            self.real(scope, depth),
            self.real(scope, depth),
        )
        return (
            f"(if {condition} then {yes} else {no})",
            lambda values: of_yes(values) if holds(values) else of_no(values),
        )

    def reduction(self, scope: Scope, depth: int) -> Expression:
        name, inside = self.loop_variable(scope, INTEGER)
        (text, of), (count, of_count) = self.real(inside, depth), self.whole(0, 4)
        kind = self.draw.choice(["sum", "product", "max"])
        if kind == "max":
            count, of_count = self.whole(1, 4)

        def value(values: Values) -> float:
            each = [of({**values, name: place}) for place in range(1, of_count(values) + 1)]
            if kind == "max":
                return float(max(each))
            return float(math.fsum(each)) if kind == "sum" else float(np.prod(each)) if each else 1.0

        return f"{kind}({text} for {name} in 1:{count})", value

    def element(self, scope: Scope, vector: tuple[str, Kind]) -> Expression:
        name, kind = vector
        if isinstance(kind.size, int):
            if kind.size == 0:
                return self.number()
            place, of_place = self.index(scope, kind.size)
            return f"{name}[{place}]", lambda values: float(values[name][of_place(values) - 1])
        if self.draw.random() < 0.3:
            return f"sum({name})", lambda values: float(np.sum(values[name]))
        place, of_place = self.whole_expression(scope, 1)
        return (
            f"(if size({name}, 1) > 0 then {name}[mod({place}, max(size({name}, 1), 1)) + 1] else 0.75)",
            lambda values: float(values[name][of_place(values) % len(values[name])]) if len(values[name]) else 0.75,
        )

    def index(self, scope: Scope, size: int) -> Expression:
        if self.draw.random() < 0.5:
            return self.whole(1, size)
        text, of = self.whole_expression(scope, 1)
        return f"mod({text}, {size}) + 1", lambda values: of(values) % size + 1

    def whole_expression(self, scope: Scope, depth: int = 1) -> Expression:
        choices: list[Callable[[], Expression]] = [self.whole]
        for name in scope.names(INTEGER):
            choices += [lambda name=name: _read(name)] * 3
        for name in scope.names(DATA):
            choices += [lambda name=name: (f"{name}.n", lambda values: values[name]["n"])]
        for name, _ in scope.vectors():
            choices += [lambda name=name: (f"size({name}, 1)", lambda values: len(values[name]))]
        if depth > 0:
            choices += [lambda: self.whole_operation(scope, depth - 1)] * 3
            choices += [lambda: self.whole_part(scope)]
        return self.draw.choice(choices)()

    def whole_part(self, scope: Scope) -> Expression:
        names = scope.names(REAL)
        text, of = _read(self.draw.choice(names)) if names else self.number()
        return f"integer({text})", lambda values: math.floor(of(values))

    def whole_operation(self, scope: Scope, depth: int) -> Expression:
        (left, of_left), (right, of_right) = self.whole_expression(scope, depth), self.whole_expression(scope, depth)
        divisor = self.draw.choice([-3, -2, 2, 3])
        return self.draw.choice(
            [
                (f"({left} + {right})", lambda values: of_left(values) + of_right(values)),
                (f"({left} - {right})", lambda values: of_left(values) - of_right(values)),
                (f"mod({left}, {divisor})", lambda values: of_left(values) % divisor),
                (f"div({left}, {divisor})", lambda values: int(of_left(values) / divisor)),
                (f"rem({left}, {divisor})", lambda values: of_left(values) - divisor * int(of_left(values) / divisor)),
                (f"max({left}, {right})", lambda values: max(of_left(values), of_right(values))),
                (f"abs({left})", lambda values: abs(of_left(values))),
            ]
        )

    def condition(self, scope: Scope, depth: int = 1) -> Expression:
        names = scope.names(BOOLEAN)
        if names and self.draw.random() < 0.3:
            return _read(self.draw.choice(names))
        if depth > 0 and self.draw.random() < 0.4:
            (left, of_left), (right, of_right) = self.condition(scope, depth - 1), self.condition(scope, depth - 1)
            return self.draw.choice(
                [
                    (f"({left} and {right})", lambda values: of_left(values) and of_right(values)),
                    (f"({left} or {right})", lambda values: of_left(values) or of_right(values)),
                    (f"not ({left})", lambda values: not of_left(values)),
                    (f"(({left}) == ({right}))", lambda values: bool(of_left(values)) == bool(of_right(values))),
                ]
            )
        if self.draw.random() < 0.4:
            left, of_left = self.whole_expression(scope, depth)
            right, of_right = self.whole_expression(scope, 0)
            sign = self.draw.choice(["<", "<=", ">", ">=", "==", "<>"])
        else:
            left, of_left = self.real(scope, min(depth, 1))
            right, of_right = self.number()
            sign = self.draw.choice(["<", "<=", ">", ">="])
        holds = _RELATIONS[sign]
        return f"{left} {sign} {right}", lambda values: bool(holds(of_left(values), of_right(values)))

    def vector(self, scope: Scope, kind: Kind, depth: int = 2) -> Expression:
        same = scope.names(kind)
        choices: list[Callable[[], Expression]] = [
            lambda: self.filled(scope, kind, depth),
            lambda: self.listed(scope, kind, depth),
        ]
        choices += [lambda name=name: _read(name) for name in same] * 2
        if depth > 0:
            choices += [lambda: self.vector_operation(scope, kind, depth - 1)] * 2
            if kind.size == 2:
                choices += [
                    lambda name=name: (f"{name}.v", lambda values: values[name]["v"]) for name in scope.names(DATA)
                ]
            for function in self.functions:
                if function.outputs[0][1] == kind and isinstance(kind.size, int):
                    choices += [lambda function=function: self.called(scope, function, depth - 1)] * 2
        return self.draw.choice(choices)()

    def filled(self, scope: Scope, kind: Kind, depth: int) -> Expression:
        text, of = self.real(scope, depth - 1)
        count = _count(kind)
        return f"fill({text}, {kind.size_text})", lambda values: np.full(count(values), float(of(values)))

    def listed(self, scope: Scope, kind: Kind, depth: int) -> Expression:
        if isinstance(kind.size, int) and kind.size > 0 and self.draw.random() < 0.5:
            parts = [self.real(scope, depth - 1) for _ in range(kind.size)]
            text = ", ".join(text for text, _ in parts)
            return f"{{{text}}}", lambda values: np.array([float(of(values)) for _, of in parts])
        name, inside = self.loop_variable(scope, INTEGER)
        (text, of), count = self.real(inside, depth - 1), _count(kind)
        return (
            f"{{{text} for {name} in 1:{kind.size_text}}}",
            lambda values: np.array([float(of({**values, name: place + 1})) for place in range(count(values))]),
        )

    def vector_operation(self, scope: Scope, kind: Kind, depth: int) -> Expression:
        (left, of_left), (right, of_right) = self.vector(scope, kind, depth), self.vector(scope, kind, depth)
        factor, of_factor = self.real(scope, depth)
        return self.draw.choice(
            [
                (f"({left} + {right})", lambda values: of_left(values) + of_right(values)),
                (f"({left} - {right})", lambda values: of_left(values) - of_right(values)),
                (f"(({factor})*{left})", lambda values: of_factor(values) * of_left(values)),
                (f"({left} .* {right})", lambda values: of_left(values) * of_right(values)),
                (f"(-{left})", lambda values: -of_left(values)),
                (f"sin({left})", lambda values: np.sin(of_left(values))),
            ]
        )

    def record(self, scope: Scope, _depth: int = 2) -> Expression:
        names = scope.names(DATA)
        if names and self.draw.random() < 0.3:
            return _read(self.draw.choice(names))
        parts: list[tuple[str, Expression, Any]] = [
            ("a", self.real(scope, 1), None),
            ("v", self.vector(scope, Kind("vector", 2), 1), None),
            ("n", self.whole_expression(scope, 1), None),
        ]
        parts = [each for each in parts if self.draw.random() < 0.7]
        if self.draw.random() < 0.5:
            self.draw.shuffle(parts)
        text = ", ".join(f"{name} = {part[0]}" for name, part, _ in parts)

        def value(values: Values) -> Any:
            default = {"a": 1.25, "v": np.array([0.5, -2.25]), "n": 3}
            return {**default, **{name: part[1](values) for name, part, _ in parts}}

        return f"Data({text})", value

    def called(self, scope: Scope, function: Function, depth: int) -> Expression:
        text, given = self.arguments(scope, function, depth)

        def value(values: Values) -> Any:
            return function.call(given(values))[0]

        return f"{function.name}({text})", value

    def arguments(self, scope: Scope, function: Function, depth: int) -> tuple[str, Callable[[Values], Values]]:
        """Some by position, then some by name, none where a default does."""
        by_position, by_name, given = [], [], {}
        position = True
        for name, kind, default in function.inputs:
            position = position and self.draw.random() < 0.7
            if default and self.draw.random() < 0.4:
                position = False
                continue
            if kind.name == "vector":
                size = self.draw.choice([0, 1, 2, 3, 3, 4]) if isinstance(kind.size, str) else kind.size
                fitting = [each for each in scope.vectors() if isinstance(kind.size, str) or each[1] == kind]
                if fitting and self.draw.random() < 0.6:
                    given[name] = _read(self.draw.choice(fitting)[0])
                else:
                    given[name] = self.vector(scope, Kind("vector", size), min(depth, 1))
            else:
                given[name] = self.expression(scope, kind, depth)
            (by_position if position else by_name).append(name)
        self.draw.shuffle(by_name)
        text = [given[name][0] for name in by_position] + [f"{name} = {given[name][0]}" for name in by_name]
        return ", ".join(text), lambda values: {name: each[1](values) for name, each in given.items()}

    def loop_variable(self, scope: Scope, kind: Kind) -> tuple[str, Scope]:
        self._names += 1
        name = f"i{self._names}"
        return name, Scope([*scope.readable, (name, kind)], scope.assignable, scope.loops)

    # --- statements ----------------------------------------------------------
    def statements(self, scope: Scope, depth: int, least: int = 1, most: int = 3) -> list[Statement]:
        return [self.statement(scope, depth) for _ in range(self.draw.randint(least, most))]

    def statement(self, scope: Scope, depth: int) -> Statement:
        choices: list[Callable[[], Statement]] = [lambda: self.assignment(scope)] * 4
        choices += [lambda: self.element_assignment(scope)] * 2
        choices += [lambda: self.member_assignment(scope)]
        if self.functions:
            choices += [lambda: self.several_outputs(scope)] * 2
        if depth > 0:
            choices += [lambda: self.branches(scope, depth - 1)] * 2
            choices += [lambda: self.for_loop(scope, depth - 1)] * 2
            choices += [lambda: self.while_loop(scope, depth - 1)]
        if scope.loops:
            choices += [lambda: self.leave(scope, "break", Break)]
        if self.draw.random() < 0.3:
            choices += [lambda: self.leave(scope, "return", Return)]
        return self.draw.choice(choices)()

    def assignment(self, scope: Scope) -> Statement:
        name, kind = self.draw.choice(scope.assignable)
        text, of = self.expression(scope, kind)

        def run(values: Values) -> None:
            value = copied(of(values))
            values[name] = bounded(value)

        bound = _bound_text(name, kind)
        return [f"{name} := {text};", *bound], run

    def element_assignment(self, scope: Scope) -> Statement:
        vectors = [each for each in scope.vectors(assignable=True) if isinstance(each[1].size, int) and each[1].size]
        if not vectors:
            return self.assignment(scope)
        name, kind = self.draw.choice(vectors)
        size = int(kind.size)
        if self.draw.random() < 0.3 and size > 1:
            first = self.draw.randint(1, size - 1)
            last = self.draw.randint(first, size)
            text, of = self.vector(scope, Kind("vector", last - first + 1), 1)

            def run_slice(values: Values) -> None:
                values[name][first - 1 : last] = np.clip(copied(of(values)), -50, 50)

            sliced = f"{name}[{first}:{last}]"
            return [f"{sliced} := {text};", *_bound_text(sliced, Kind("vector", last - first + 1))], run_slice
        (place, of_place), (text, of) = self.index(scope, size), self.real(scope)

        def run(values: Values) -> None:
            value = of(values)
            values[name][of_place(values) - 1] = min(max(value, -50.0), 50.0)

        return [f"{name}[{place}] := min(max({text}, -50.0), 50.0);"], run

    def member_assignment(self, scope: Scope) -> Statement:
        names = scope.names(DATA, assignable=True)
        if not names:
            return self.assignment(scope)
        name = self.draw.choice(names)
        if self.draw.random() < 0.5:
            text, of = self.real(scope)

            def run(values: Values) -> None:
                values[name]["a"] = min(max(of(values), -50.0), 50.0)

            return [f"{name}.a := min(max({text}, -50.0), 50.0);"], run
        (place, of_place), (text, of) = self.index(scope, 2), self.real(scope)

        def run_element(values: Values) -> None:
            value = of(values)
            values[name]["v"][of_place(values) - 1] = min(max(value, -50.0), 50.0)

        return [f"{name}.v[{place}] := min(max({text}, -50.0), 50.0);"], run_element

    def several_outputs(self, scope: Scope) -> Statement:
        function = self.draw.choice(self.functions)
        text, given = self.arguments(scope, function, 1)
        targets: list[str | None] = []
        for _, kind, _ in function.outputs:
            names = [name for name in scope.names(kind, assignable=True) if name not in targets]
            usable = kind.name != "vector" or isinstance(kind.size, int)
            targets.append(self.draw.choice(names) if names and usable and self.draw.random() < 0.8 else None)
        while targets and targets[-1] is None:
            targets.pop()
        if not targets:
            return self.assignment(scope)
        kinds = [kind for _, kind, _ in function.outputs]

        def run(values: Values) -> None:
            for target, value in zip(targets, function.call(given(values)), strict=False):
                if target is not None:
                    values[target] = bounded(copied(value))

        left = ", ".join(target or "" for target in targets)
        bounds = [
            line for target, kind in zip(targets, kinds, strict=False) if target for line in _bound_text(target, kind)
        ]
        return [f"({left}) := {function.name}({text});", *bounds], run

    def branches(self, scope: Scope, depth: int) -> Statement:
        tests = [self.condition(scope) for _ in range(self.draw.randint(1, 3))]
        bodies = [self.statements(scope, depth, 1, 2) for _ in tests]
        otherwise = self.statements(scope, depth, 1, 2) if self.draw.random() < 0.7 else []
        lines: list[str] = []
        for place, ((condition, _), body) in enumerate(zip(tests, bodies, strict=True)):
            lines += [f"{'elseif' if place else 'if'} {condition} then", *_indented(body)]
        lines += ["else", *_indented(otherwise)] if otherwise else []

        def run(values: Values) -> None:
            for (_, holds), body in zip(tests, bodies, strict=True):
                if holds(values):
                    return _run(body, values)
            return _run(otherwise, values)

        return [*lines, "end if;"], run

    def for_loop(self, scope: Scope, depth: int) -> Statement:
        kinds = ["up", "down", "step", "list", "size", "expression"]
        vectors = scope.vectors()
        over = self.draw.choice(kinds + (["vector"] if vectors else []))
        name, inside = self.loop_variable(scope, REAL if over in ("list", "vector") else INTEGER)
        inside.loops += 1
        domain: Callable[[Values], Sequence[Any]]
        if over == "up":
            (low, of_low), (high, of_high) = self.whole(-1, 3), self.whole(0, 4)
            text, domain = f"{low}:{high}", lambda values: range(of_low(values), of_high(values) + 1)
        elif over == "down":
            (low, of_low), (high, of_high) = self.whole(0, 3), self.whole(0, 5)
            text, domain = f"{high}:-1:{low}", lambda values: range(of_high(values), of_low(values) - 1, -1)
        elif over == "step":
            (low, of_low), (high, of_high) = self.whole(0, 2), self.whole(1, 7)
            text, domain = f"{low}:2:{high}", lambda values: range(of_low(values), of_high(values) + 1, 2)
        elif over == "list":
            parts = [self.real(scope, 1) for _ in range(self.draw.randint(1, 3))]
            text = "{" + ", ".join(part for part, _ in parts) + "}"
            domain = lambda values: [float(of(values)) for _, of in parts]  # noqa: E731
        elif over == "size" and vectors:
            vector, _ = self.draw.choice(vectors)
            text, domain = f"1:size({vector}, 1)", lambda values: range(1, len(values[vector]) + 1)
        elif over == "vector":
            vector, _ = self.draw.choice(vectors)
            text, domain = vector, lambda values: [float(each) for each in values[vector]]
        else:
            whole, of_whole = self.whole_expression(scope)
            text = f"1:min({whole}, {MOST_ITERATIONS})"
            domain = lambda values: range(1, min(of_whole(values), MOST_ITERATIONS) + 1)  # noqa: E731
        body = self.statements(inside, depth)

        def run(values: Values) -> None:
            for each in list(domain(values)):
                values[name] = each
                try:
                    _run(body, values)
                except Break:
                    break

        return [f"for {name} in {text} loop", *_indented(body), "end for;"], run

    def while_loop(self, scope: Scope, depth: int) -> Statement:
        counters = scope.names(INTEGER, assignable=True)
        if not counters:
            return self.assignment(scope)
        counter = self.draw.choice(counters)
        others = [each for each in scope.assignable if each[0] != counter]
        if not others:
            return self.assignment(scope)
        inside = Scope(scope.readable, others, scope.loops + 1)
        (condition, holds), body = self.condition(scope), self.statements(inside, depth)

        def run(values: Values) -> None:
            values[counter] = 0
            while values[counter] < 4 and holds(values):
                values[counter] += 1
                try:
                    _run(body, values)
                except Break:
                    break

        lines = [f"{counter} := 0;", f"while {counter} < 4 and ({condition}) loop", f"  {counter} := {counter} + 1;"]
        return [*lines, *_indented(body), "end while;"], run

    def leave(self, scope: Scope, word: str, exception: type[Exception]) -> Statement:
        condition, holds = self.condition(scope)

        def run(values: Values) -> None:
            if holds(values):
                raise exception

        return [f"if {condition} then", f"  {word};", "end if;"], run

    # --- functions -----------------------------------------------------------
    def function(self, name: str) -> Function:
        function = Function(name)
        scope = Scope()
        for place in range(self.draw.randint(1, 4)):
            kind = self.draw.choice(
                [REAL, REAL, INTEGER, BOOLEAN, DATA, Kind("vector", f"u{place}"), Kind("vector", 3)]
            )
            default = None
            if self.draw.random() < 0.4 and kind.name != "vector":
                default = self.expression(scope, kind, 1)
            function.inputs.append((f"u{place}", kind, default))
            scope.readable.append((f"u{place}", kind))
        opened = [each for each in scope.vectors() if isinstance(each[1].size, str)]
        sizes: list[int | str] = [2, 3, *(each[1].size for each in opened)]
        for place in range(self.draw.randint(1, 3)):
            kind = self.draw.choice([REAL, REAL, REAL, INTEGER, DATA, Kind("vector", self.draw.choice(sizes))])
            start = self.expression(Scope(list(scope.readable)), kind, 1)
            function.outputs.append((f"y{place}", kind, start))
        for place in range(self.draw.randint(0, 3)):
            kind = self.draw.choice([REAL, INTEGER, BOOLEAN, DATA, Kind("vector", self.draw.choice(sizes))])
            function.protected.append((f"t{place}", kind, self.expression(Scope(list(scope.readable)), kind, 1)))
        declared = [(each, kind) for each, kind, _ in (*function.outputs, *function.protected)]
        scope.readable += declared
        scope.assignable += declared
        function.body = self.statements(scope, 2, 2, 5)
        self.functions.append(function)
        return function


def bounded(value: Any) -> Any:
    """What the statement after each assignment makes of it, so that loops let nothing grow without bound."""
    if isinstance(value, bool | dict):
        return value
    if isinstance(value, int):
        return min(max(value, -20), 20)
    if isinstance(value, np.ndarray):
        return np.clip(value, -50, 50)
    return min(max(value, -50.0), 50.0)


_RELATIONS: dict[str, Callable[[Any, Any], bool]] = {
    "<": lambda left, right: left < right,
    "<=": lambda left, right: left <= right,
    ">": lambda left, right: left > right,
    ">=": lambda left, right: left >= right,
    "==": lambda left, right: left == right,
    "<>": lambda left, right: left != right,
}


def _bound_text(name: str, kind: Kind) -> list[str]:
    if kind == REAL:
        return [f"{name} := min(max({name}, -50.0), 50.0);"]
    if kind == INTEGER:
        return [f"{name} := min(max({name}, -20), 20);"]
    if kind.name == "vector":
        return [f"{name} := {{min(max(e, -50.0), 50.0) for e in {name}}};"]
    return []


def _read(name: str) -> Expression:
    return name, lambda values: values[name]


def _count(kind: Kind) -> Callable[[Values], int]:
    size = kind.size
    return (lambda _: size) if isinstance(size, int) else (lambda values: len(values[size]))


def _indented(body: list[Statement]) -> list[str]:
    return [f"  {line}" for each in body for line in each[0]]


def _run(body: list[Statement], values: Values) -> None:
    for _, run in body:
        run(values)


@dataclass(frozen=True)
class RandomFunctions:
    """A model that calls functions, and its variables' values at a time, by their names in the FMU."""

    text: str
    values: Callable[[float], dict[str, float]]


def random_functions(seed: int) -> RandomFunctions:
    """Functions that a model calls with parameters, and with what changes."""
    writer = Writer(seed)
    draw = writer.draw
    functions = [writer.function(f"f{place}") for place in range(draw.randint(1, 3))]
    known: list[tuple[str, Kind, Callable[[float], Any]]] = []
    lines = []
    for name, kind in (("p", REAL), ("k", INTEGER), ("b", BOOLEAN)):
        text, of = (
            (writer.number() if kind == REAL else writer.whole(0, 4)) if kind != BOOLEAN else ("true", lambda _: True)
        )
        value = of({})
        known.append((name, kind, lambda _, value=value: value))
        lines.append(f"  parameter {kind.name} {name} = {text};")
    known.append(("x", REAL, lambda time: math.sin(3 * time) + 0.1 * time))
    known.append(("z", REAL, lambda time: 1.7 - 2 * time))
    known.append(("w", Kind("vector", 3), lambda time: np.array([math.sin(3 * time) + 0.1 * time, 0.4, 2 * time])))
    lines += ["  Real x = sin(3*time) + 0.1*time;", "  Real z = 1.7 - 2*time;", "  Real w[3] = {x, 0.4, 2*time};"]
    checked: list[tuple[str, Kind, Callable[[float], Any]]] = []

    def at(time: float) -> Values:
        return {name: of(time) for name, _, of in known}

    fixed = Scope([(name, kind) for name, kind, _ in known[:3]])
    moving = Scope([(name, kind) for name, kind, _ in known])
    equations = []
    for place, function in enumerate(functions):
        for suffix, scope in (("c", fixed), ("m", moving)):
            text, given = writer.arguments(scope, function, 1)
            targets = []
            for output, (_, kind, _) in enumerate(function.outputs):
                name = f"r{place}{suffix}{output}"
                of = lambda time, output=output, given=given, function=function: function.call(given(at(time)))[output]  # noqa: E731
                size = len(of(0.3)) if kind.name == "vector" else 0
                targets.append((name, Kind("vector", size) if kind.name == "vector" else kind, of))
            first_name, first_kind, first = targets[0]
            if first_kind == INTEGER:
                checked.append((first_name, REAL, first))
                lines.append(f"  Real {first_name} = 1.0*{function.name}({text});")
                continue
            # What is discrete follows no continuous variable; what has no elements is no variable.
            left_out = [kind in (INTEGER, DATA) or kind == Kind("vector", 0) for _, kind, _ in targets]
            kept = [each for each, is_left_out in zip(targets, left_out, strict=True) if not is_left_out]
            if not kept:
                continue
            if left_out[0]:
                continue
            if any(left_out) or draw.random() < 0.4:
                kept, left = kept[:1], first_name
            else:
                left = f"({', '.join(name for name, _, _ in kept)})"
            checked += kept
            lines += [f"  {kind.declaration(name)};" for name, kind, _ in kept]
            equations.append(f"  {left} = {function.name}({text});")
    text = "\n".join(
        [
            "package P",
            RECORD,
            *(each.text for each in functions),
            "  model M",
            *lines,
            "equation",
            *equations,
            "end M;",
            "end P;",
            "",
        ]
    )
    return RandomFunctions(text, lambda time: dict(_elements(checked, time)))


def _elements(checked: list[tuple[str, Kind, Callable[[float], Any]]], time: float) -> Iterator[tuple[str, float]]:
    for name, kind, of in checked:
        value = of(time)
        if kind.name == "vector":
            yield from ((f"{name}[{place + 1}]", float(each)) for place, each in enumerate(value))
        elif kind == DATA:
            yield f"{name}.a", float(value["a"])
            yield from ((f"{name}.v[{place + 1}]", float(each)) for place, each in enumerate(value["v"]))
            yield f"{name}.n", float(value["n"])
        else:
            yield name, float(value)
