"""Makes statements again of functions that were written without control flow for the front end.

See :mod:`modelica2fmu.frontend.rewriting.straight_line`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import fields, is_dataclass, replace
from typing import Any

from contact_foundation.errors import Place, UnsupportedModelError

from modelica2fmu.frontend import ir
from modelica2fmu.frontend.flat_expressions import as_reference
from modelica2fmu.frontend.rewriting import straight_line as straight
from modelica2fmu.library.source_map import Span


def with_control_flow(flat: ir.FlatModel, place_of: Callable[[Span | None], Place]) -> ir.FlatModel:
    """The same model with the statements that its functions have in the sources.

    Args:
        flat: the model.
        place_of: the place of a range of the sources.

    Raises:
        UnsupportedModelError: a statement assigns to what is no variable.
    """
    return replace(flat, functions={name: _restored(each, place_of) for name, each in flat.functions.items()})


def _restored(function: ir.Function, place_of: Callable[[Span | None], Place]) -> ir.Function:
    if not any(variable.name == straight.BEGIN for variable in function.locals):
        return function
    reader = _Reader(function.body, place_of)
    body = reader.statements()
    added = {*straight.MARKS, *reader.added}
    declared = tuple(variable for variable in function.locals if variable.name not in added)
    return replace(function, body=body, locals=declared, is_unproven=True)


class _Reader:
    def __init__(self, body: Sequence[ir.Statement], place_of: Callable[[Span | None], Place]) -> None:
        self._place_of = place_of
        begin = next(place for place, each in enumerate(body) if _mark(each) == straight.BEGIN)
        self._body = body
        self._at = begin + 1
        # Iterators, of which the front end was told that they are variables.
        self.added = {
            self._target(_part(each.value)).name
            for each in body[:begin]
            if isinstance(each, ir.Assignment) and _mark(each) == straight.ITERATOR
        }

    def statements(self) -> tuple[ir.Statement, ...]:
        """Those up to the end of a block, or of the function."""
        found: list[ir.Statement] = []
        while self._at < len(self._body) and self._next() not in (straight.END, straight.ELSE, straight.ELSE_IF):
            found.append(self._statement())
        return tuple(found)

    def _next(self) -> str:
        return _mark(self._body[self._at])

    def _take(self) -> ir.Expression:
        """The part of a statement that the next assignment holds."""
        statement = self._body[self._at]
        assert isinstance(statement, ir.Assignment)
        self._at += 1
        return _part(statement.value)

    def _statement(self) -> ir.Statement:
        span = self._body[self._at].span
        match self._next():
            case straight.IF:
                return self._if()
            case straight.FOR:
                domain, iterator = self._take(), self._take()
                assert isinstance(iterator, ir.Reference)
                return ir.For(((iterator.name, domain),), self._block(), span)
            case straight.WHILE:
                return ir.While(self._take(), self._block(), span)
            case straight.BREAK:
                self._at += 1
                return ir.Break(span)
            case straight.RETURN:
                self._at += 1
                return ir.Return(span)
            case straight.TARGET | straight.NO_TARGET:
                return self._assignment()
        self._at += 1
        return self._body[self._at - 1]

    def _block(self) -> tuple[ir.Statement, ...]:
        body = self.statements()
        self._at += 1
        return body

    def _if(self) -> ir.IfStatement:
        span = self._body[self._at].span
        branches = [(self._take(), self.statements())]
        while self._next() == straight.ELSE_IF:
            branches.append((self._take(), self.statements()))
        otherwise: tuple[ir.Statement, ...] = ()
        if self._next() == straight.ELSE:
            self._at += 1
            otherwise = self.statements()
        self._at += 1
        return ir.IfStatement(tuple(branches), otherwise, span)

    def _assignment(self) -> ir.Statement:
        span = self._body[self._at].span
        targets: list[ir.Reference | None] = []
        while self._next() != straight.VALUE:
            is_left_out = self._next() == straight.NO_TARGET
            target = self._take()
            targets.append(None if is_left_out else self._target(target))
        value = self._take()
        if isinstance(value, ir.Call) and not value.is_constructor and (len(targets) > 1 or targets[0] is None):
            return ir.CallAssignment(tuple(targets), value, span)
        assert targets[0] is not None
        return ir.Assignment(targets[0], value, span)

    def _target(self, expression: ir.Expression) -> ir.Reference:
        """What a statement assigns to, which the front end took for a value.

        Raises:
            UnsupportedModelError: it is nothing that could be assigned to.
        """
        read = as_reference(expression)
        if read is None:
            raise UnsupportedModelError(
                "this target of an assignment is not covered", place=self._place_of(expression.span)
            )
        names = [(name, inner) for part, inner in read.parts for name in part.split(".")]
        parts = tuple(
            (name, ()) if place < len(names) - 1 else (name, inner) for place, (name, inner) in enumerate(names)
        )
        return replace(read, parts=parts)


def _mark(statement: ir.Statement) -> str:
    """What a statement of the straight line stands for; empty for one that stands for itself."""
    is_mark = isinstance(statement, ir.Assignment) and statement.target.name in straight.MARKS
    return statement.target.name if is_mark and isinstance(statement, ir.Assignment) else ""


def _part(value: ir.Expression) -> ir.Expression:
    """``x`` of ``noEvent(size({x}, 1))``, with what its iterators go through; others are as they are."""
    match value:
        case ir.Builtin("noEvent", (ir.Builtin("size", (ir.ArrayConstructor((part,)), _)),)):
            read: ir.Expression = _with_domains(part)
            return read
    return value


def _with_domains(node: Any) -> Any:
    """The same with ``for i in x`` in place of ``for i in 1:size({x}, 1)``."""
    if isinstance(node, tuple):
        return type(node)(_with_domains(each) for each in node)
    if not is_dataclass(node) or isinstance(node, type | Span):
        return node
    changed = {each.name: _with_domains(getattr(node, each.name)) for each in fields(node)}
    if isinstance(node, ir.Comprehension):
        changed["indices"] = tuple((name, _domain(values)) for name, values in changed["indices"])
    return replace(node, **changed)


def _domain(values: ir.Expression) -> ir.Expression:
    match values:
        case ir.Range(_, None, ir.Builtin("size", (ir.ArrayConstructor((hidden,)), _))):
            return hidden
    return values
