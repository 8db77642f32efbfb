"""States of any length for vectors of length one: quaternions.

Integration keeps the length of a vector of states up to its error only, and what an importer interpolates between its
steps is worse. So the states are vectors of their own, ``q_integrated``, and the model's vector ``q`` is an algebraic
variable, ``q_integrated / |q_integrated|``, of length one at every trial point of every integrator. The derivative

    der(q_integrated) = |q_integrated| der(q) + rate (1 - |q_integrated|^2) q_integrated / 2

turns them as the model says and draws their length back to one (Baumgarte 1972), so that it never gets far from it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Final

from modelica2fmu.equations.blocks import Assignment, Block
from modelica2fmu.equations.state_selection import STABILIZATION_RATE
from modelica2fmu.expand.scalar_model import ScalarModel, ScalarVariable, derivative_name
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node

_ELEMENT: Final = re.compile(r"(.*?)(\[[\d,]+\])?$", re.DOTALL)


@dataclass(frozen=True)
class UnitStates:
    """What takes the place of unit vectors among the states.

    Attributes:
        states: all states, in order, with those that stand for the vectors' elements.
        integrated: the state of each element of a vector, by the element's name.
        vectors: gives the vectors, from the states alone.
        rates: gives the states' derivatives, from those of the vectors.
        initialization: gives the states and their derivatives at the start.
    """

    states: tuple[str, ...]
    integrated: dict[str, str]
    vectors: tuple[Block, ...]
    rates: tuple[Block, ...]
    initialization: tuple[Block, ...]


def with_unit_states(model: ScalarModel, states: Sequence[str], vectors: Iterable[Sequence[str]]) -> UnitStates:
    """States in place of unit vectors; their variables are added to ``model``.

    Args:
        model: is changed.
        states: names of the states.
        vectors: names of the elements of vectors among them.
    """
    integrated: dict[str, str] = {}
    shown: list[Block] = []
    rates: list[Block] = []
    initialization: list[Block] = []
    for names in vectors:
        raw = [_integrated_name(name) for name in names]
        integrated.update(zip(names, raw, strict=True))
        square: float | Node = 0
        for name in raw:
            square = ex.add(square, ex.multiply(ex.symbol(name), ex.symbol(name)))
        length = ex.unary("sqrt", square)
        correction = ex.multiply(STABILIZATION_RATE / 2, ex.subtract(1, square))
        for name, state in zip(names, raw, strict=True):
            model.variables[state] = _state_variable(model.variables[name], state)
            turned = ex.multiply(length, ex.symbol(derivative_name(name)))
            rate = ex.add(turned, ex.multiply(correction, ex.symbol(state)))
            shown.append(Assignment(name, ex.divide(ex.symbol(state), length)))
            rates.append(Assignment(derivative_name(state), rate))
            initialization.append(Assignment(state, ex.symbol(name)))
            initialization.append(Assignment(derivative_name(state), ex.symbol(derivative_name(name))))
    model.reinitializations[:] = [
        replace(item, state=integrated.get(item.state, item.state)) for item in model.reinitializations
    ]
    return UnitStates(
        states=tuple(integrated.get(name, name) for name in states),
        integrated=integrated,
        vectors=tuple(shown),
        rates=tuple(rates),
        initialization=tuple(initialization),
    )


def _integrated_name(name: str) -> str:
    match = _ELEMENT.match(name)
    assert match is not None
    return f"{match[1]}_integrated{match[2] or ''}"


def _state_variable(variable: ScalarVariable, name: str) -> ScalarVariable:
    """A state for an element; its value at the start is the element's."""
    declaration = variable.declaration
    if declaration is not None:
        declaration = replace(
            declaration, name=_integrated_name(declaration.name), description=_described(declaration.name)
        )
    return replace(
        variable, name=name, start=ex.symbol(variable.name), fixed=False, declaration=declaration, is_output=False
    )


def _described(name: str) -> str:
    return f"What is integrated for {name}, which is this over its length"
