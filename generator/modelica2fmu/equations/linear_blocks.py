"""Linear blocks: the system for the torn unknowns, in expressions or evaluated from the equations as they are.

With the other unknowns inserted, a mechanism's system is its mass matrix in closed form. For trees of short legs that
is the fastest code, since most products vanish; along a chain each entry is a sum over the chain, and the code grows
with the square of its length. Evaluating the equations once for each unit vector (as the columns of the mass matrix are
found from the inverse dynamics: Walker and Orin 1982, "Efficient dynamic computer simulation of robotic mechanisms")
takes code in proportion to the equations, and about as many operations.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from typing import Final

from contact_foundation.errors import Place

from modelica2fmu.equations.blocks import Assignment, LinearBlock, LinearSystem, Residual
from modelica2fmu.equations.dependent_equations import DependentEquationsError, dependency
from modelica2fmu.equations.lanes import lane_passes
from modelica2fmu.library.source_map import Span
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node
from modelica2fmu.symbolic.linear_form import LinearForm, LinearForms, solved_for

# So many times the length of the equations, the closed form takes longer to compile than it saves when it runs: a chain
# of 8 pendulums (5 times) runs 15 % faster with it, of 64 (40 times) slower by half. For the legs of a hexapod it is 7.
_LONGEST_FORM: Final = 10.0


def linear_block(
    torn: Sequence[str],
    order: Sequence[tuple[Residual, str]],
    remaining: Sequence[Residual],
    place: Callable[[Span | None], Place],
) -> LinearBlock | None:
    """The block of a torn component; ``None`` if it is not linear.

    Args:
        torn: unknowns that are assumed.
        order: equations with the unknowns that they give, in order.
        remaining: equations that determine the torn unknowns.
        place: place of a span.

    Raises:
        DependentEquationsError: an equation holds or fails whatever the unknowns are.
    """
    names = [*torn, *(name for _, name in order)]
    forms = LinearForms(names)
    inner_forms = [forms(entry.residual) for entry, _ in order]
    last_forms = [forms(entry.residual) for entry in remaining]
    known = [form for form in inner_forms if form is not None], [form for form in last_forms if form is not None]
    if len(known[0]) < len(inner_forms) or len(known[1]) < len(last_forms):
        return None
    solutions = dict(zip((name for _, name in order), known[0], strict=True))
    inner = []
    for entry, name in order:
        value = solved_for(entry.residual, name)
        assert value is not None
        inner.append(Assignment(name, value, span=entry.span))
    reach = _Reach(torn, solutions)
    rows: Sequence[LinearForm] | None = None
    columns: list[Collection[str]] = [reach.unknowns(form) for form in known[1]]
    if not _is_evaluated(reach, [*known[0], *known[1]]):
        rows = _inserted_rows(torn, solutions, known[1])
        columns = [form.coefficients for form in rows]
    entries = [*(entry for entry, _ in order), *remaining]
    weights = dependency([*known[0], *known[1]])
    if weights is not None:
        raise DependentEquationsError(
            names, [(entries[number], weight) for number, weight in weights.items()], place(entries[max(weights)].span)
        )
    for entry, found in zip(remaining, columns, strict=True):
        if not found:
            raise DependentEquationsError(names, (), place(entry.span))
    # Sparse columns first: those of a leg stay apart from those of the other legs while they are eliminated.
    fill = {name: sum(name in found for found in columns) for name in torn}
    ordered = tuple(sorted(torn, key=lambda name: fill[name]))
    places = _matching_rows(ordered, columns)
    return LinearBlock(
        ordered,
        tuple(inner),
        tuple(remaining[row].residual for row in places),
        len(names),
        None if rows is None else _system(ordered, [rows[row] for row in places]),
    )


def _matching_rows(torn: Sequence[str], unknowns: Sequence[Collection[str]]) -> list[int]:
    """An order of the rows in which the sparsest that has each unknown stands at its place, as far as there is one.

    There it is a pivot as a rule, and rows of many unknowns, as those of a robot's trunk, stay below those of its legs.
    """
    left = dict.fromkeys(range(len(unknowns)))
    chosen: dict[int, int] = {}
    for place, name in enumerate(torn):
        found = min((row for row in left if name in unknowns[row]), key=lambda row: len(unknowns[row]), default=None)
        if found is not None:
            chosen[place] = found
            del left[found]
    others = iter(left)
    return [chosen[place] if place in chosen else next(others) for place in range(len(torn))]


class _Reach:
    """Which torn unknowns expressions depend on, cancellation apart; sets are bits of integers."""

    def __init__(self, torn: Sequence[str], solutions: Mapping[str, LinearForm]) -> None:
        self.torn = tuple(torn)
        self._bits = {name: 1 << position for position, name in enumerate(torn)}
        for name, form in solutions.items():
            self._bits[name] = self._union(other for other in form.coefficients if other != name)

    def _union(self, names: Iterable[str]) -> int:
        bits = 0
        for name in names:
            bits |= self._bits[name]
        return bits

    def unknowns(self, form: LinearForm) -> set[str]:
        """The torn unknowns that a form depends on."""
        bits = self._union(form.coefficients)
        return {name for position, name in enumerate(self.torn) if bits >> position & 1}

    def products(self, form: LinearForm) -> int:
        """The number of products when solutions are inserted into a form."""
        return sum(self._bits[name].bit_count() for name in form.coefficients)


def _is_evaluated(reach: _Reach, forms: Sequence[LinearForm]) -> bool:
    """True if the system shall be evaluated from the equations: code and number of operations speak for it."""
    inserted = sum(reach.products(form) for form in forms)
    length = sum(len(form.coefficients) for form in forms)
    return inserted > _LONGEST_FORM * length and inserted > lane_passes(len(reach.torn)) * length


def _inserted_rows(
    torn: Sequence[str], solutions: Mapping[str, LinearForm], rows: Sequence[LinearForm]
) -> list[LinearForm]:
    """The rows as forms of the torn unknowns alone."""
    inserted: dict[str, LinearForm] = {name: LinearForm(0, {name: 1}) for name in torn}
    for name, form in solutions.items():
        pivot = form.coefficients[name]
        inserted[name] = _inserted(form, inserted, skip=name).divided(ex.negate(pivot))
    return [_inserted(form, inserted) for form in rows]


def _inserted(form: LinearForm, solutions: Mapping[str, LinearForm], skip: str | None = None) -> LinearForm:
    """The form with its symbols replaced by their solutions."""
    constant = form.constant
    coefficients: dict[str, float | Node] = {}
    for name, factor in form.coefficients.items():
        if name == skip:
            continue
        solution = solutions[name]
        constant = ex.add(constant, ex.multiply(factor, solution.constant))
        for inner, value in solution.coefficients.items():
            coefficients[inner] = ex.add(coefficients.get(inner, 0), ex.multiply(factor, value))
    return LinearForm(
        constant, {name: value for name, value in coefficients.items() if isinstance(value, Node) or value != 0}
    )


def _system(torn: Sequence[str], rows: Sequence[LinearForm]) -> LinearSystem:
    matrix = tuple(tuple(form.coefficients.get(name, 0) for name in torn) for form in rows)
    return LinearSystem(matrix, tuple(ex.negate(form.constant) for form in rows))
