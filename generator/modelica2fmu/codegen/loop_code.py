"""C loops that execute statements of one form, with their places and numbers in tables."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass
from textwrap import wrap
from typing import Final

from modelica2fmu.codegen.c_expressions import bare, operation
from modelica2fmu.codegen.expression_forms import NUMBER, Again, Form, Leaf, Operation, split_place
from modelica2fmu.codegen.statements import Stored

_INLINE_LENGTH: Final = 160


@dataclass(frozen=True)
class TrueList:
    """Where a loop of conditions lists those that hold: their number and then their positions.

    Attributes:
        offset: in the integers of the work array.
        length: number of conditions.
    """

    offset: int
    length: int

    @property
    def place(self) -> str:
        """C expression of the list."""
        return f"v->integer_work + {self.offset}"


@dataclass(frozen=True)
class Guards:
    """Where statements are executed.

    Attributes:
        conditions: of each, a C lvalue.
        holds: whether where it holds, or where it does not.
        otherwise: what a target is elsewhere, a C expression; empty if it stays as it is.
        listed: the list in which the conditions are, if there is one; statements are in the order of their positions.
        positions: of each statement's condition in that list.
    """

    conditions: Sequence[str]
    holds: bool
    otherwise: str = ""
    listed: TrueList | None = None
    positions: Sequence[int] = ()


class _Table:
    """A table of what differs from one execution to the next."""

    def __init__(self, name: str, c_type: str) -> None:
        self._name = name
        self._c_type = c_type
        self._columns: dict[tuple[str, ...], int] = {}

    def cell(self, values: Sequence[str]) -> str:
        """C expression of the value in the present execution."""
        column = self._columns.setdefault(tuple(values), len(self._columns))
        return f"{self._name}[k][{column}]"

    def lines(self) -> list[str]:
        """The declaration."""
        if not self._columns:
            return []
        rows = [f"{{{', '.join(row)}}}" for row in zip(*self._columns, strict=True)]
        head = f"static const {self._c_type} {self._name}[{len(rows)}][{len(self._columns)}] = {{"
        return [head, *wrap(", ".join(rows), 120, initial_indent="  ", subsequent_indent="  "), "};"]


class _Indices:
    """Indices in terms of the number ``k`` of an execution, of each other, or of a table."""

    def __init__(self) -> None:
        self.table = _Table("places", "int")
        self._bases: list[tuple[Sequence[int], str]] = []

    def expression(self, indices: Sequence[int]) -> str:
        """C expression of an index."""
        if min(indices) == max(indices):
            return str(indices[0])
        for base, text in [(range(len(indices)), "k"), *self._bases]:
            line = _line(base, indices)
            if line is not None:
                return _linear(*line, text)
        text = self.table.cell([str(index) for index in indices])
        self._bases.append((indices, text))
        return text


def _line(base: Sequence[int], values: Sequence[int]) -> tuple[int, int] | None:
    """Whole factor and offset with which all values follow from those of a base."""
    other = next((k for k in range(1, len(base)) if base[k] != base[0]), None)
    if other is None:
        return None
    factor, rest = divmod(values[other] - values[0], base[other] - base[0])
    offset = values[0] - factor * base[0]
    if rest or any(value != factor * at + offset for at, value in zip(base, values, strict=True)):
        return None
    return factor, offset


def _linear(factor: int, offset: int, text: str) -> str:
    product = text if factor == 1 else f"{factor} * {text}"
    return product if offset == 0 else f"{product} {'+' if offset > 0 else '-'} {abs(offset)}"


def loop_lines(
    form: Form,
    leaves: Sequence[Sequence[str]],
    targets: Sequence[str],
    stored: Stored,
    guards: Guards | None = None,
    listing: TrueList | None = None,
) -> list[str]:
    """C that computes and stores an expression once for each target.

    Args:
        form: of all expressions.
        leaves: of each expression, C lvalues and numbers.
        targets: C lvalues, which differ by their index alone.
        stored: how.
        guards: where; None for everywhere.
        listing: where targets that are not zero are listed; None for nowhere.
    """
    places, numbers = _Indices(), _Table("numbers", "double")
    columns = iter(zip(*leaves, strict=True))
    texts = [
        _number(next(columns), numbers) if step == NUMBER else _place(next(columns), places)
        for step in form
        if isinstance(step, Leaf)
    ]
    body, value = _body(form, texts)
    target = _place(targets, places)
    body.append(f"{target} = {bare(value)};" if stored is Stored.NUMBER else f"{target} = ({value} != 0);")
    all_of_them = f"for (int k = 0; k < {len(targets)}; ++k) {{"
    if guards is not None and guards.listed is not None:
        loops = [
            *_first_of_each(guards.positions, guards.listed.length),
            f"const int *const holding = {guards.listed.place};",
        ]
        if guards.otherwise:
            loops += [all_of_them, f"  {target} = {guards.otherwise};", "}"]
        loops += [
            "for (int h = 1; h <= holding[0]; ++h) {",
            "  for (int k = first[holding[h]]; k < first[holding[h] + 1]; ++k) {",
            *(f"    {line}" for line in body),
            "  }",
            "}",
        ]
    elif listing is not None:
        body.append(f"if ({target}) holding[++count] = k;")
        loops = [
            f"int *const holding = {listing.place};",
            "int count = 0;",
            all_of_them,
            *(f"  {line}" for line in body),
            "}",
            "holding[0] = count;",
        ]
    else:
        if guards is not None:
            body = [*_skip(guards, _place(guards.conditions, places), target), *body]
        loops = [all_of_them, *(f"  {line}" for line in body), "}"]
    return ["{", *places.table.lines(), *numbers.lines(), *loops, "}"]


def _skip(guards: Guards, condition: str, target: str) -> list[str]:
    head = f"if ({'!' if guards.holds else ''}{condition})"
    if not guards.otherwise:
        return [f"{head} continue;"]
    return [f"{head} {{", f"  {target} = {guards.otherwise};", "  continue;", "}"]


def _first_of_each(positions: Sequence[int], length: int) -> list[str]:
    """The table of the first statement of each condition, and the number of all."""
    firsts = [bisect_left(positions, position) for position in range(length + 1)]
    text = wrap(", ".join(map(str, firsts)), 120, initial_indent="  ", subsequent_indent="  ")
    return [f"static const int first[{length + 1}] = {{", *text, "};"]


def _number(values: Sequence[str], table: _Table) -> str:
    return values[0] if len(set(values)) == 1 else table.cell(values)


def _place(values: Sequence[str], indices: _Indices) -> str:
    parts = split_place(values[0])
    if parts is None:
        return values[0]
    return parts[0].format(indices.expression([found[1] for value in values if (found := split_place(value))]))


def _body(form: Form, leaves: Sequence[str]) -> tuple[list[str], str]:
    """Declarations of what is used again, and the expression."""
    given = iter(leaves)
    lines: list[str] = []
    again: list[tuple[str, bool]] = []
    stack: list[tuple[str, bool]] = []
    for step in form:
        if isinstance(step, Leaf):
            stack.append((next(given), "lanes" in step.array or step.array.startswith("LANES")))
            continue
        if isinstance(step, Again):
            stack.append(again[step.number])
            continue
        args = stack[-step.count :]
        del stack[-step.count :]
        text = _operation(step, args)
        if step.is_shared or len(text) > _INLINE_LENGTH:
            name = f"m{len(lines)}"
            lines.append(f"const {'fmurt_lanes' if step.is_lane else 'double'} {name} = {bare(text)};")
            text = name
        if step.is_shared:
            again.append((text, step.is_lane))
        stack.append((text, step.is_lane))
    return lines, stack.pop()[0]


def _operation(step: Operation, args: Sequence[tuple[str, bool]]) -> str:
    texts = [text for text, _ in args]
    if step.op == "select" and step.is_lane:
        # A branch that is no vector is the number zero: derivatives are linear in the directions.
        texts[1:] = [f"(fmurt_lanes){text}" if is_lane else "(fmurt_lanes){0}" for text, is_lane in args[1:]]
    return operation(step.op, texts)
