"""From equations to a sequence of explicit assignments, calls, and small blocks that are solved numerically.

Each strongly connected component of the matched system is torn: a few unknowns are assumed (torn), the others follow
one by one, and as many equations remain as unknowns were assumed (Kron 1963, "Diakoptics"; Elmqvist and Otter 1994,
"Methods for tearing systems of equations in object-oriented modeling"). For a mechanism, the derivatives of the
states are tried first: with them given, all accelerations and then all forces follow, so a block has at most as many
torn unknowns as the mechanism has degrees of freedom.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass

from cmb_base.errors import InputError, Place, UnsupportedModelError

from modelica2fmu import expression as ex
from modelica2fmu import ir
from modelica2fmu.expression import Node
from modelica2fmu.linear_form import LinearForm, LinearForms
from modelica2fmu.matching import Matching, strongly_connected_components
from modelica2fmu.scalar_model import ExternalCall, unwrapped


@dataclass(frozen=True)
class Residual:
    """``residual = 0``."""

    residual: float | Node
    span: ir.Span | None = None


@dataclass(frozen=True)
class Assignment:
    """``target := value``; explicit, because it is one (discrete variables) or because it was solved."""

    target: str
    value: float | Node
    is_discrete: bool = False
    span: ir.Span | None = None


Entry = Residual | Assignment | ExternalCall
Step = Assignment | ExternalCall


@dataclass(frozen=True)
class LinearBlock:
    """``matrix * torn = right``, then ``inner`` in order.

    Attributes:
        torn: unknowns of the linear system.
        matrix: n x n, row by row.
        right: right-hand side.
        inner: what follows from the torn unknowns.
        size: number of unknowns before tearing.
        residuals: the equations of the linear system before ``inner`` was inserted, row by row.
    """

    torn: tuple[str, ...]
    matrix: tuple[tuple[float | Node, ...], ...]
    right: tuple[float | Node, ...]
    inner: tuple[Assignment, ...]
    size: int
    residuals: tuple[float | Node, ...]


@dataclass(frozen=True)
class NonlinearBlock:
    """Find ``torn`` so that after ``inner`` all ``residuals`` vanish; ``spans`` says where these stand in the model."""

    torn: tuple[str, ...]
    residuals: tuple[float | Node, ...]
    inner: tuple[Step, ...]
    size: int
    spans: tuple[ir.Span | None, ...] = ()


Block = Assignment | ExternalCall | LinearBlock | NonlinearBlock


def solve_order(
    entries: Sequence[Entry],
    unknowns: Collection[str],
    preferred: Collection[str],
    place: Callable[[ir.Span | None], Place],
) -> list[Block]:
    """Blocks in the order in which they can be solved.

    Args:
        entries: equations, assignments and calls.
        unknowns: all symbols that they determine.
        preferred: unknowns to be torn first.
        place: place of a span.

    Raises:
        InputError: equations and unknowns cannot be matched.
        UnsupportedModelError: an algebraic loop over discrete variables.
    """
    return _Sorter(entries, unknowns, preferred, place).run()


class _Sorter:
    def __init__(
        self,
        entries: Sequence[Entry],
        unknowns: Collection[str],
        preferred: Collection[str],
        place: Callable[[ir.Span | None], Place],
    ) -> None:
        self._entries = entries
        self._unknowns = dict.fromkeys(unknowns)
        self._preferred = set(preferred)
        self._place = place
        self._dependencies: list[list[str]] = []
        for entry in entries:
            names = ex.symbols(*_roots(entry))
            self._dependencies.append([name for name in names if name in self._unknowns])

    def run(self) -> list[Block]:
        owner: dict[str, int] = {}
        for number, entry in enumerate(self._entries):
            for name in _targets(entry):
                owner[name] = number
        residuals = [number for number, entry in enumerate(self._entries) if isinstance(entry, Residual)]
        matching = Matching(
            {number: [name for name in self._dependencies[number] if name not in owner] for number in residuals}
        )
        unmatched = [number for number in residuals if not matching.augment(number)]
        missing = [name for name in self._unknowns if name not in owner and name not in matching.row_of]
        if unmatched or missing:
            raise InputError(self._singular(unmatched, missing), place=self._first_place(unmatched))
        owner.update(matching.row_of)
        successors = {
            number: [owner[name] for name in dict.fromkeys(self._dependencies[number]) if owner[name] != number]
            for number in range(len(self._entries))
        }
        self._draw_in(successors, owner)
        blocks: list[Block] = []
        for component in strongly_connected_components(successors):
            blocks.extend(self._component(component, matching.column_of))
        return blocks

    def _draw_in(self, successors: dict[int, list[int]], owner: Mapping[str, int]) -> None:
        """Adds the equations of preferred unknowns to the component that determines them.

        The derivative of a joint's speed often stands in one equation only, so that it would be computed after
        the component; as an unknown of the component it is the best one to assume.
        """
        components = strongly_connected_components(successors)
        large: dict[int, int] = {}  # entry -> number of the only large component it follows from, -1 if several
        for number, component in enumerate(components):
            if len(component) > 1:
                large.update(dict.fromkeys(component, number))
                continue
            (entry,) = component
            found = {large[successor] for successor in successors[entry] if successor in large}
            if found:
                large[entry] = found.pop() if len(found) == 1 else -1
        for name in self._unknowns:
            entry = owner[name]
            number = large.get(entry, -1)
            if name in self._preferred and number >= 0 and isinstance(self._entries[entry], Residual):
                successors[components[number][0]].append(entry)

    def _singular(self, unmatched: Sequence[int], missing: Sequence[str]) -> str:
        texts = []
        if unmatched:
            shown = [ex.to_text(_roots(self._entries[number])[0]) for number in unmatched[:5]]
            texts.append("equations without an unknown: " + "; ".join(shown))
        if missing:
            texts.append("unknowns without an equation: " + ", ".join(missing[:10]))
        return "the equations are structurally singular: " + "; ".join(texts)

    def _first_place(self, numbers: Sequence[int]) -> Place | None:
        for number in numbers:
            return self._place(self._entries[number].span)
        return None

    # --- one component ---

    def _component(self, component: Sequence[int], column_of: Mapping[int, str]) -> list[Block]:
        if len(component) == 1:
            entry = self._entries[component[0]]
            if not isinstance(entry, Residual):
                if any(name in self._dependencies[component[0]] for name in _targets(entry)):
                    raise self._discrete_loop(component)
                return [entry]
            name = column_of[component[0]]
            value = solved_for(entry.residual, name)
            if value is not None:
                return [Assignment(name, value, span=entry.span)]
            return [NonlinearBlock((name,), (entry.residual,), (), 1, (entry.span,))]
        if any(isinstance(self._entries[number], Assignment) for number in component):
            raise self._discrete_loop(component)
        return [self._tear(component, column_of)]

    def _discrete_loop(self, component: Sequence[int]) -> UnsupportedModelError:
        names = [name for number in component for name in _targets(self._entries[number])]
        return UnsupportedModelError(
            "discrete variables depend on each other in a loop: " + ", ".join(names[:8]),
            place=self._first_place(component),
            remedy="break the loop by pre()",
        )

    def _tear(self, component: Sequence[int], column_of: Mapping[int, str]) -> Block:
        calls = [entry for number in component if isinstance(entry := self._entries[number], ExternalCall)]
        numbers = [number for number in component if isinstance(self._entries[number], Residual)]
        names = [column_of[number] for number in numbers] + [name for call in calls for name in call.outputs]
        torn, order, remaining = _Tearing(self, component, names, self._preferred).run()
        size = len(names)
        if not calls:
            linear = self._linear(torn, order, remaining, size, names)
            if linear is not None:
                return linear
        inner: list[Step] = []
        for number, name in order:
            entry = self._entries[number]
            if isinstance(entry, Residual):
                value = solved_for(entry.residual, name)
                assert value is not None
                inner.append(Assignment(name, value, span=entry.span))
            else:
                assert isinstance(entry, ExternalCall)
                inner.append(entry)
        rows = [entry for number in remaining if isinstance(entry := self._entries[number], Residual)]
        residuals, spans = tuple(row.residual for row in rows), tuple(row.span for row in rows)
        return NonlinearBlock(tuple(torn), residuals, tuple(inner), size, spans)

    def _linear(
        self,
        torn: Sequence[str],
        order: Sequence[tuple[int, str]],
        remaining: Sequence[int],
        size: int,
        names: Sequence[str],
    ) -> LinearBlock | None:
        forms = LinearForms(names)
        row_forms: dict[int, LinearForm] = {}
        for number in [*(number for number, _ in order), *remaining]:
            entry = self._entries[number]
            assert isinstance(entry, Residual)
            form = forms(entry.residual)
            if form is None:
                return None
            row_forms[number] = form
        solutions: dict[str, LinearForm] = {name: LinearForm(0, {name: 1}) for name in torn}
        inner = []
        for number, name in order:
            form = row_forms[number]
            pivot = form.coefficients[name]
            solutions[name] = _inserted(form, solutions, skip=name).divided(ex.negate(pivot))
            entry = self._entries[number]
            assert isinstance(entry, Residual)
            value = solved_for(entry.residual, name)
            assert value is not None
            inner.append(Assignment(name, value, span=entry.span))
        residual_forms = [_inserted(row_forms[number], solutions) for number in remaining]
        for number, form in zip(remaining, residual_forms, strict=True):
            if not form.coefficients:
                raise InputError(
                    "equations are linearly dependent whatever the parameters are: " + ", ".join(names[:8]),
                    place=self._place(self._entries[number].span),
                )
        # Sparse columns first: those of a leg stay apart from those of the other legs while they are eliminated.
        fill = {name: sum(name in form.coefficients for form in residual_forms) for name in torn}
        ordered = sorted(torn, key=lambda name: fill[name])
        matrix = tuple(tuple(form.coefficients.get(name, 0) for name in ordered) for form in residual_forms)
        right = tuple(ex.negate(form.constant) for form in residual_forms)
        residuals = tuple(
            entry.residual for number in remaining if isinstance(entry := self._entries[number], Residual)
        )
        return LinearBlock(tuple(ordered), matrix, right, tuple(inner), size, residuals)

    # --- for tearing ---

    def entry(self, number: int) -> Entry:
        """The entry ``number``."""
        return self._entries[number]

    def dependencies(self, number: int) -> list[str]:
        """Unknowns that the entry ``number`` contains, its targets not counted."""
        return self._dependencies[number]


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


class _Tearing:
    """Tears one component."""

    def __init__(self, sorter: _Sorter, component: Sequence[int], names: Sequence[str], preferred: set[str]) -> None:
        self._sorter = sorter
        self._rows = list(component)
        self._names = dict.fromkeys(names)
        self._preferred = preferred
        self._open: dict[int, set[str]] = {}
        self._rows_of: dict[str, list[int]] = {name: [] for name in names}
        for number in component:
            inside = {name for name in sorter.dependencies(number) if name in self._names}
            self._open[number] = inside
            for name in inside:
                self._rows_of[name].append(number)
        self._targets: dict[int, tuple[str, ...]] = {
            number: _targets(sorter.entry(number))
            for number in component
            if not isinstance(sorter.entry(number), Residual)
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
            entry = self._sorter.entry(number)
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


def _roots(entry: Entry) -> list[float | Node]:
    if isinstance(entry, Residual):
        return [entry.residual]
    if isinstance(entry, Assignment):
        return [entry.value]
    return list(entry.inputs())


def _targets(entry: Entry) -> tuple[str, ...]:
    if isinstance(entry, Assignment):
        return (entry.target,)
    if isinstance(entry, ExternalCall):
        return entry.outputs
    return ()


def block_roots(block: Block) -> list[float | Node]:
    """All expressions that a block evaluates."""
    if isinstance(block, Assignment):
        return [block.value]
    if isinstance(block, ExternalCall):
        return list(block.inputs())
    if isinstance(block, LinearBlock):
        inner = [assignment.value for assignment in block.inner]
        return [*(item for row in block.matrix for item in row), *block.right, *inner]
    return [*block.residuals, *(root for step in block.inner for root in block_roots(step))]


def block_targets(block: Block) -> list[str]:
    """All symbols that a block determines."""
    if isinstance(block, LinearBlock | NonlinearBlock):
        return [*block.torn, *(name for step in block.inner for name in block_targets(step))]
    return list(_targets(block))


def needed_blocks(blocks: Sequence[Block], wanted: Iterable[str]) -> list[Block]:
    """The blocks that ``wanted`` needs, in the same order."""
    needed = set(wanted)
    kept = []
    for block in reversed(blocks):
        if any(name in needed for name in block_targets(block)):
            kept.append(block)
            needed.update(ex.symbols(*block_roots(block)))
    return kept[::-1]
