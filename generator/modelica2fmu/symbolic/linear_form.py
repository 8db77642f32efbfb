"""Expressions as linear forms of some of their symbols."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field

from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node
from modelica2fmu.symbolic.expression_nodes import arguments_first


@dataclass(frozen=True)
class LinearForm:
    """``constant + sum(coefficient * symbol)``; neither contains the symbols of the form."""

    constant: float | Node = 0
    coefficients: Mapping[str, float | Node] = field(default_factory=dict)

    def scaled(self, factor: float | Node) -> LinearForm:
        """The form times an expression."""
        return LinearForm(
            ex.multiply(factor, self.constant),
            {name: ex.multiply(factor, value) for name, value in self.coefficients.items()},
        )

    def divided(self, divisor: float | Node) -> LinearForm:
        """The form divided by an expression."""
        return LinearForm(
            ex.divide(self.constant, divisor),
            {name: ex.divide(value, divisor) for name, value in self.coefficients.items()},
        )

    def plus(self, other: LinearForm, sign: int = 1) -> LinearForm:
        """The sum or (``sign = -1``) difference of two forms."""
        combine = ex.add if sign > 0 else ex.subtract
        coefficients = dict(self.coefficients)
        for name, value in other.coefficients.items():
            total = combine(coefficients.get(name, 0), value)
            if not isinstance(total, Node) and total == 0:
                coefficients.pop(name, None)
            else:
                coefficients[name] = total
        return LinearForm(combine(self.constant, other.constant), coefficients)


class LinearForms:
    """Linear forms of expressions over fixed symbols, shared subexpressions done once.

    Args:
        names: symbols of the forms.
        substitutions: forms that stand for other symbols.
    """

    def __init__(self, names: Collection[str], substitutions: Mapping[str, LinearForm] | None = None) -> None:
        self._names = frozenset(names)
        self.substitutions: dict[str, LinearForm] = dict(substitutions or {})
        self._memo: dict[Node, LinearForm | None] = {}

    def __call__(self, root: float | Node) -> LinearForm | None:
        """The form of ``root``; ``None`` if it is not linear."""
        if not isinstance(root, Node):
            return LinearForm(root)
        memo = self._memo
        for node in arguments_first(root, memo):
            memo[node] = self._form(node)
        return memo[root]

    def _form(self, node: Node) -> LinearForm | None:
        if node.op == "symbol":
            if node.name in self._names:
                return LinearForm(0, {node.name: 1})
            return self.substitutions.get(node.name) or LinearForm(node)
        if node.op == "constant":
            return LinearForm(node.value)
        forms = [self._memo[arg] for arg in node.args]
        known = [form for form in forms if form is not None]
        if len(known) < len(forms):
            return None
        if all(
            form.constant is arg or arg.op == "constant" for form, arg in zip(known, node.args, strict=True)
        ) and all(not form.coefficients for form in known):
            return LinearForm(node)
        if not any(form.coefficients for form in known):
            return LinearForm(ex.apply(node.op, [form.constant for form in known]))
        op = node.op
        if op == "add":
            return known[0].plus(known[1])
        if op == "sub":
            return known[0].plus(known[1], -1)
        if op == "neg":
            return known[0].scaled(-1)
        if op == "mul":
            if not known[0].coefficients:
                return known[1].scaled(known[0].constant)
            if not known[1].coefficients:
                return known[0].scaled(known[1].constant)
            return None
        if op == "div" and not known[1].coefficients:
            return known[0].divided(known[1].constant)
        if op == "select" and not known[0].coefficients:
            return _selected(known[0].constant, known[1], known[2])
        return None


def _selected(condition: float | Node, first: LinearForm, second: LinearForm) -> LinearForm:
    names = dict.fromkeys([*first.coefficients, *second.coefficients])
    coefficients = {
        name: ex.select(condition, first.coefficients.get(name, 0), second.coefficients.get(name, 0)) for name in names
    }
    return LinearForm(ex.select(condition, first.constant, second.constant), coefficients)


def solved_for(residual: float | Node, name: str) -> float | Node | None:
    """``name`` from ``residual = 0``, if the residual is linear in it; ``None`` otherwise."""
    if not isinstance(residual, Node):
        return None
    value = _isolated(residual, name)
    if value is not None:
        return value
    form = LinearForms([name])(residual)
    if form is None or name not in form.coefficients:
        return None
    return ex.negate(ex.divide(form.constant, form.coefficients[name]))


def _isolated(residual: Node, name: str) -> float | Node | None:
    """Unwraps the residual around the only occurrence of ``name``; keeps the form that the model has."""
    right: float | Node = 0
    node = residual
    while not (node.op == "symbol" and node.name == name):
        holders = [position for position, arg in enumerate(node.args) if name in ex.symbols(arg)]
        if len(holders) != 1:
            return None
        position = holders[0]
        other = ex.value_of(node.args[1 - position]) if len(node.args) == 2 else 0
        if node.op == "neg":
            right = ex.negate(right)
        elif node.op == "add":
            right = ex.subtract(right, other)
        elif node.op == "sub":
            right = ex.add(right, other) if position == 0 else ex.subtract(other, right)
        elif node.op == "mul":
            right = ex.divide(right, other)
        elif node.op == "div" and position == 0:
            right = ex.multiply(right, other)
        else:
            return None
        node = node.args[position]
    return right
