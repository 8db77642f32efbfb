"""Which equations give discrete variables their values, and which are left for the continuous ones."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence

from contact_foundation.errors import Place, UnsupportedModelError

from modelica2fmu.equations.blocks import Assignment
from modelica2fmu.equations.matching import Matching
from modelica2fmu.expand.scalar_model import Kind, ScalarEquation, ScalarVariable
from modelica2fmu.library.source_map import Span
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node


def partitioned(
    equations: Sequence[ScalarEquation],
    variables: Mapping[str, ScalarVariable],
    discrete: Sequence[str],
    place: Callable[[Span | None], Place],
) -> tuple[list[Assignment], list[ScalarEquation]]:
    """Assignments to discrete variables, and the continuous equations.

    Args:
        equations: all.
        variables: of the model.
        discrete: names of discrete variables that an equation must give, unless one has them for its target.
        place: place of a span.

    Raises:
        UnsupportedModelError: no equation gives one of them explicitly.
    """
    assignments: dict[str, Assignment] = {}
    rest: list[ScalarEquation] = []
    for equation in equations:
        target = equation.target
        if target is not None and variables[target].kind is Kind.DISCRETE:
            assignments[target] = Assignment(target, equation.right, is_discrete=True, span=equation.span)
        else:
            rest.append(equation)
    wanted = [name for name in discrete if name not in assignments]
    candidates = _candidates(rest, variables, wanted)
    matching = Matching(
        {position: [str(number) for number in candidates[name]] for position, name in enumerate(wanted)}
    )
    used: set[int] = set()
    for position, name in enumerate(wanted):
        if not matching.augment(position):
            raise UnsupportedModelError(
                f"no equation gives the discrete variable {name} explicitly",
                place=place(variables[name].span),
                remedy=f"write it as {name} = ...",
            )
    for position, name in enumerate(wanted):
        number = int(matching.column_of[position])
        used.add(number)
        assignments[name] = Assignment(name, candidates[name][number], is_discrete=True, span=rest[number].span)
    return list(assignments.values()), [item for number, item in enumerate(rest) if number not in used]


def _candidates(
    equations: Sequence[ScalarEquation], variables: Mapping[str, ScalarVariable], names: Collection[str]
) -> dict[str, dict[int, float | Node]]:
    """The equations that give each variable explicitly, by their numbers, and its value by them."""
    candidates: dict[str, dict[int, float | Node]] = {name: {} for name in names}
    for number, equation in enumerate(equations):
        for side, other in ((equation.left, equation.right), (equation.right, equation.left)):
            name, value = _explicit(side, other)
            if name in candidates and name not in ex.symbols(value) and not _is_real(variables, name, value):
                candidates[name].setdefault(number, value)
    return candidates


def _is_real(variables: Mapping[str, ScalarVariable], name: str, value: float | Node) -> bool:
    """= true, if an equation of an Integer or the like gives a continuous variable: ``y = i`` is none for ``i``."""
    while isinstance(value, Node) and value.op == "neg":
        value = value.args[0]
    other = variables.get(value.name) if isinstance(value, Node) and value.op == "symbol" else None
    is_continuous = other is not None and other.kind is Kind.CONTINUOUS
    return is_continuous and variables[name].type != "Real"


def _explicit(side: float | Node, other: float | Node) -> tuple[str, float | Node]:
    """Name and value if ``side`` is a symbol, its negative or its negation."""
    if not isinstance(side, Node):
        return "", 0
    if side.op == "symbol":
        return side.name, other
    if side.op == "neg" and side.args[0].op == "symbol":
        return side.args[0].name, ex.negate(other)
    if side.op == "not" and side.args[0].op == "symbol":
        return side.args[0].name, ex.logical_not(other)
    return "", 0
