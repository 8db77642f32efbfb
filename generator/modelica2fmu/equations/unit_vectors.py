"""Vectors of states whose length their differential equations keep at one: quaternions.

A model may state a quaternion's derivative without the constraint of its length. Integration then keeps the length up
to its error only; knowing the vector, what is shown can be scaled to length one.
"""

from __future__ import annotations

import random
from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import Final

from modelica2fmu.equations.blocks import Assignment, Block
from modelica2fmu.expand.scalar_model import derivative_name
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node

_COMPONENTS: Final = 4
_POINTS: Final = 5
_TOLERANCE: Final = 1e-12


def unit_vectors(states: Sequence[str], blocks: Iterable[Block]) -> list[tuple[str, ...]]:
    """Groups ``q[1]`` to ``q[4]`` of states with ``q * der(q) = 0`` wherever ``q * q = 1``.

    The property is tested at random points, of the vector and of everything its derivative depends on: an expression
    that vanishes at several of them vanishes identically but for a set of measure zero (Schwartz 1980).

    Args:
        states: names of the states.
        blocks: what computes their derivatives while simulating.
    """
    explicit = {block.target: block.value for block in blocks if isinstance(block, Assignment)}
    known = set(states)
    found = []
    for name in states:
        if not name.endswith("1]"):
            continue
        names = tuple(f"{name[:-2]}{number}]" for number in range(1, _COMPONENTS + 1))
        rates = [explicit.get(derivative_name(component)) for component in names]
        given = [rate for rate in rates if isinstance(rate, Node)]
        if len(given) == _COMPONENTS and known.issuperset(names) and _keeps_length(names, given):
            found.append(names)
    return found


def _keeps_length(names: Sequence[str], rates: Sequence[Node]) -> bool:
    total: float | Node = 0
    for name, rate in zip(names, rates, strict=True):
        total = ex.add(total, ex.multiply(ex.symbol(name), rate))
    if not set(names) <= set(ex.symbols(total)):
        return False
    generator = random.Random(1)
    return all(_vanishes(total, rates, _point(names, ex.symbols(total), generator)) for _ in range(_POINTS))


def _point(names: Collection[str], symbols: Iterable[str], generator: random.Random) -> dict[str, float]:
    point = {symbol: generator.uniform(0.5, 1.5) for symbol in symbols}
    length = sum(point[name] ** 2 for name in names) ** 0.5
    return {symbol: value / length if symbol in names else value for symbol, value in point.items()}


def _vanishes(total: float | Node, rates: Sequence[Node], point: Mapping[str, float]) -> bool:
    try:
        size = max(abs(ex.evaluate(rate, point)) for rate in rates)
        return abs(ex.evaluate(total, point)) <= _TOLERANCE * max(size, 1.0)
    except ValueError:
        return False
