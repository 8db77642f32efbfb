"""Whole numbers that the sources alone tell: sums, differences and products of numbers and parameters."""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping, Sequence
from typing import Final

from modelica2fmu.crosscheck.class_instances import ClassInstance, UnknownError
from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.class_tokens import UnreadableError

_DEEPEST: Final = 20
_LARGEST: Final = 10**6
_PLAIN: Final = re.compile(r"(?:\s|\w|[-+*(),])*")


def whole_number(
    text: str, scope: ClassInstance, library: ClassLibrary, known: Mapping[str, int], depth: int = 0
) -> int | None:
    """The value of an expression; None where the sources do not tell it.

    Args:
        text: of the expression.
        scope: class in which its names are looked up.
        library: the sources.
        known: values of iterators.
        depth: how many parameters were looked up on the way here.
    """
    if depth > _DEEPEST or _PLAIN.fullmatch(text) is None:
        return None
    try:
        tree = ast.parse(text.strip(), mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None

    def value(node: ast.expr) -> int | None:
        match node:
            case ast.Constant(value=bool()):
                return None
            case ast.Constant(value=int(number)):
                return number
            case ast.Name(id=name):
                return known[name] if name in known else _of_parameter(name, scope, library, depth)
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                inner = value(operand)
                return None if inner is None else -inner
            case ast.UnaryOp(op=ast.UAdd(), operand=operand):
                return value(operand)
            case ast.BinOp(left=left, op=operator, right=right):
                return _combined(operator, value(left), value(right))
            case ast.Call(func=ast.Name(id="div"), args=[first, second], keywords=[]):
                return _quotient(value(first), value(second))
        return None

    return value(tree)


def inclusive_range(limits: Sequence[int | None]) -> range | None:
    """The numbers of ``first:last`` or ``first:step:last``; None of other limits, and where one is not known."""
    match limits:
        case [int(first), int(last)]:
            return range(first, last + 1)
        case [int(first), int(step), int(last)] if step != 0:
            return range(first, last + (1 if step > 0 else -1), step)
    return None


def _combined(operator: ast.operator, left: int | None, right: int | None) -> int | None:
    if left is None or right is None or max(abs(left), abs(right)) > _LARGEST:
        return None
    match operator:
        case ast.Add():
            return left + right
        case ast.Sub():
            return left - right
        case ast.Mult():
            return left * right
    return None


def _quotient(left: int | None, right: int | None) -> int | None:
    """Modelica's ``div``, which rounds towards zero."""
    if left is None or not right:
        return None
    size = abs(left) // abs(right)
    return size if (left < 0) == (right < 0) else -size


def _of_parameter(name: str, scope: ClassInstance, library: ClassLibrary, depth: int) -> int | None:
    try:
        component = scope.component(name)
    except (UnknownError, UnreadableError, RecursionError):
        return None
    if component is None or component.binding is None or not component.is_certain:
        return None
    binding = component.binding
    return whole_number(library.text(binding.extent), binding.scope, library, {}, depth + 1)
