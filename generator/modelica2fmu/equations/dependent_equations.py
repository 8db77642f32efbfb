"""Equations that depend on each other by their numbers, though each has an unknown of its own by its structure.

Two capacitors side by side give ``a - b = v`` and ``b - a = w``: by their structure they determine the potentials a and
b, in truth v + w = 0. Where such equations are found in a block, their combination takes the place of one of them, so
that the structure shows what they say, and index reduction differentiates it where needed: analytical singularities
are made structural, as OpenModelica's ``--convertAnalyticalSingularities`` does.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import TypeGuard, TypeVar

from contact_foundation.errors import InputError, Place

from modelica2fmu.equations.blocks import Residual
from modelica2fmu.equations.continuous_system import ContinuousEquation
from modelica2fmu.library.source_map import Span
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node
from modelica2fmu.symbolic.linear_form import LinearForm

Statement = tuple[float | Node, Span | None]  # a residual, and where the model states it


class DependentEquationsError(InputError):
    """Equations whose weighted sum contains none of the unknowns that they are to determine.

    Attributes:
        weights: the equations with their weights.
    """

    def __init__(self, names: Sequence[str], weights: Sequence[tuple[Residual, Fraction]], place: Place) -> None:
        super().__init__(
            "equations are linearly dependent whatever the parameters are: " + ", ".join(names[:8]), place=place
        )
        self.weights = weights


def dependency(forms: Sequence[LinearForm]) -> dict[int, Fraction] | None:
    """Weights of forms whose sum has no symbol; only those forms count whose coefficients are numbers with bounds."""
    rows: dict[str, tuple[dict[str, Fraction], dict[int, Fraction]]] = {}  # by pivot, with what each is made of
    for number, form in enumerate(forms):
        row: dict[str, Fraction] = {}
        for name, value in form.coefficients.items():
            if not _is_number(value):
                break
            if value:
                row[name] = Fraction(value)
        else:
            made = {number: Fraction(1)}
            while pivot := next((name for name in row if name in rows), None):
                other, parts = rows[pivot]
                factor = -row[pivot] / other[pivot]
                _add(row, other, factor)
                _add(made, parts, factor)
            if not row:
                return made
            rows[next(iter(row))] = (row, made)
    return None


def with_combination(
    residuals: Sequence[Statement], equations: Sequence[ContinuousEquation], found: DependentEquationsError
) -> list[Statement]:
    """The residuals, one of them replaced by the combination; raises the error where that is no other equation.

    Args:
        residuals: what ``equations`` begin with.
        equations: these and derivatives of them.
        found: of a system of these equations.
    """
    chains: list[tuple[list[int], Fraction]] = []
    for entry, weight in found.weights:
        if entry.number is None:
            raise found
        chain = [entry.number]
        while (origin := equations[chain[-1]].derivative_of) is not None:
            chain.append(origin)
        chains.append((chain, weight))
    if not chains:
        raise found
    # Derivatives of one combination are dependent like it; the equation that is differentiated least gives way.
    least = min(len(chain) for chain, _ in chains)
    total = combined([(equations[chain[least - 1]].residual, weight) for chain, weight in chains])
    replaced = max(chain[-1] for chain, _ in chains if len(chain) == least)
    if not isinstance(total, Node) or total is residuals[replaced][0]:
        raise found
    return [(total, span) if number == replaced else (old, span) for number, (old, span) in enumerate(residuals)]


def combined(residuals: Sequence[tuple[float | Node, Fraction]]) -> float | Node:
    """A weighted sum of residuals, of which terms that cancel are left out."""
    constant = Fraction(0)
    terms: dict[Node, Fraction] = {}
    stack = [(residual, weight) for residual, weight in reversed(residuals)]
    while stack:
        item, weight = stack.pop()
        if _is_number(item):
            constant += Fraction(item) * weight
        elif not isinstance(item, Node):
            return item  # a sum with something without bounds has none
        elif _is_constant(item):
            constant += Fraction(item.value) * weight
        elif item.op in ("add", "sub"):
            first, second = item.args
            stack += [(second, weight if item.op == "add" else -weight), (first, weight)]
        elif item.op == "neg":
            stack.append((item.args[0], -weight))
        elif item.op == "mul" and any(_is_constant(arg) for arg in item.args):
            number, other = item.args if _is_constant(item.args[0]) else item.args[::-1]
            stack.append((other, weight * Fraction(number.value)))
        elif item.op == "div" and _is_constant(item.args[1]) and item.args[1].value != 0:
            stack.append((item.args[0], weight / Fraction(item.args[1].value)))
        else:
            _add(terms, {item: Fraction(1)}, weight)
    total: float | Node = float(constant)
    for term, weight in terms.items():
        total = ex.add(total, ex.multiply(float(weight), term))
    return total


def _is_number(value: float | Node) -> TypeGuard[float]:
    return not isinstance(value, Node) and math.isfinite(value)


def _is_constant(node: Node) -> bool:
    return node.op == "constant" and math.isfinite(node.value)


_Key = TypeVar("_Key")


def _add(to: dict[_Key, Fraction], other: Mapping[_Key, Fraction], factor: Fraction) -> None:
    for key, value in other.items():
        total = to.get(key, Fraction(0)) + factor * value
        if total:
            to[key] = total
        else:
            to.pop(key, None)
