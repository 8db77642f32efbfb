"""Writes arrays and loops of a few elements out, where the front end does not take them otherwise.

rumoca 0.10 refuses ``cat(1, a, b)`` of Strings and records, whose type it takes to be that of the first argument, and
``{ball[i].geometry for i in 1:n}``, an array made of members of components. Written out, ``{ball[1].geometry,
ball[2].geometry, floor.geometry}``, it takes both; so it does with ``sum(ball[i].r_0[3] for i in 1:n)``.
``connect(ball.frame_a, contacts.frame[1:3])`` it takes with ``ball[1:3].frame_a``. What it does not take of loops, of
Integers that are to be Reals and of tables in files is in ``for_loops``, ``real_arguments`` and ``tables_in_files``.
The numbers that ranges and sizes depend on are read from the class that uses them, else from those around it and those
the model uses, and from modifiers of ``extends``; whether they hold in the model is for the caller to check.
"""

from __future__ import annotations

import ast
import operator
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final

from modelica2fmu.frontend.rewriting.class_scopes import (
    ClassScope,
    class_scopes,
    extends_modifiers,
    own_classes,
    scope_at,
    used_classes,
)
from modelica2fmu.frontend.rewriting.code_text import CodeText
from modelica2fmu.frontend.rewriting.for_loops import Edit, elements, iteration_edits, loop_edits
from modelica2fmu.frontend.rewriting.real_arguments import real_argument_edits
from modelica2fmu.frontend.rewriting.tables_in_files import table_edits
from modelica2fmu.library.brackets import end_of_bracket, parts_between_commas

_CALL: Final = re.compile(r"(?<![\w.])cat\s*\(")
_PLACE: Final = re.compile(r"(?<![\w.])cat\s*\(|(?<![\w.])(?P<reduction>sum|product|min|max)\s*\(|\{")
_MEMBER_OF_ELEMENT: Final = re.compile(r"\]\s*\.\s*\w")
_ITERATION: Final = re.compile(r"\bfor\s+(\w+)\s+in\s+(.+)$", re.DOTALL)
_BRACKET_OR_FOR: Final = re.compile(r"[({\[]|\bfor\b")
_REFERENCE: Final = re.compile(r"(\w+)((?:\.\w+)*)")
_CONNECT: Final = re.compile(r"\bconnect\s*\(")
_ARRAY_OF_CONNECTORS: Final = re.compile(r"\s*(\w+)((?:\.\w+)+)\s*")
_FUNCTION: Final = re.compile(r"function\b")
_SLICE: Final = re.compile(r"\[[^\]]*:[^\]]*\]")
# Strings are masked by zero characters.
_NUMBER: Final = (
    r"\bInteger\s+(?:[^;()]*,\s*)?{name}\s*(?:\([^()]*\)\s*)?=\s*([^;()\[\]{{}},\0]+?)\s*(?:[;,\0]|\bannotation\b)"
)
_DECLARED: Final = r"(?<![\w.]){name}\s*\[([^\[\],:]+)\]\s*[(;\0]"
_DECLARED_AS_NUMBERS: Final = r"\b(?:Real|Integer|Boolean)\s+{name}\s*\[([^\[\],:]+)\]\s*[=(;\0]"
_MOST_ELEMENTS: Final = 1000
_MOST_REFERENCES: Final = 20
_MOST_PASSES: Final = 5
_OPERATIONS: Final[dict[str, Callable[[int, int], int]]] = {
    "Add": operator.add,
    "Sub": operator.sub,
    "Mul": operator.mul,
}


class _UnknownError(Exception):
    """Something is not written as it would have to be."""


@dataclass(frozen=True)
class Numbers:
    """What was taken for the values of Integers.

    Attributes:
        own: of the model's own ones, by name.
        others: of those of other classes.
    """

    own: dict[str, int] = field(default_factory=dict)
    others: dict[str, int] = field(default_factory=dict)

    def take(self, name: str, number: int, is_own: bool) -> None:
        """Adds one; raises _UnknownError where classes give two to one name."""
        if (self.own if is_own else self.others).setdefault(name, number) != number:
            raise _UnknownError

    def hold_in(self, flat: Mapping[str, Any]) -> bool:
        """= true, if they are so in a flattened model, those of other classes wherever they occur."""
        variables = flat["variables"]
        bindings: dict[str, list[Any]] = {}
        for name, variable in variables.items():
            bindings.setdefault(name.rpartition(".")[2], []).append(variable["binding"])
        return all(
            name in variables and _integer(variables[name]["binding"], variables) == number
            for name, number in self.own.items()
        ) and all(
            name in bindings and all(_integer(binding, variables) == number for binding in bindings[name])
            for name, number in self.others.items()
        )


@dataclass(frozen=True)
class WrittenOut:
    """Texts with their arrays written out.

    Attributes:
        texts: of the same lines, in the same order.
        numbers: what was taken for the values of Integers.
    """

    texts: list[str]
    numbers: Numbers


def with_arrays_written_out(model: str, texts: Sequence[str], find_file: Callable[[str], Path]) -> WrittenOut:
    """The same Modelica with concatenations, and arrays over members of components, written out where that is possible.

    Args:
        model: whose arrays are meant: classes that it does not use stay as they are.
        texts: of Modelica files.
        find_file: the file that a name in a model means.

    Raises:
        InputError: a file that holds a table is missing or wrong.
        UnsupportedModelError: a file that is not read.
    """
    numbers = Numbers()
    given, written = list(texts), _written_once(model, texts, numbers, find_file)
    for _ in range(_MOST_PASSES):  # loops may hold others, and these arrays
        if written == given:
            break
        given, written = written, _written_once(model, written, numbers, find_file)
    return WrittenOut(written, numbers)


def _written_once(model: str, texts: Sequence[str], numbers: Numbers, find_file: Callable[[str], Path]) -> list[str]:
    writers = [_Writer(text, numbers, find_file) for text in texts]
    used = used_classes(model, [scope for writer in writers for scope in writer.scopes])
    own = own_classes(model, used)
    return [writer.written(used, own) for writer in writers]


def _integer(expression: Any, variables: Mapping[str, Any], depth: int = 0) -> int | None:
    """Value of an Integer expression of the flattened model; None of others."""
    match expression:
        case {"Literal": {"value": {"Integer": int(number)}}}:
            return number
        case {"VarRef": {"name": {"name": name}, "subscripts": []}} if name in variables and depth < _MOST_REFERENCES:
            return _integer(variables[name]["binding"], variables, depth + 1)
        case {"Binary": {"op": op, "lhs": left, "rhs": right}} if op in _OPERATIONS:
            values = [_integer(side, variables, depth) for side in (left, right)]
            return None if values[0] is None or values[1] is None else _OPERATIONS[op](values[0], values[1])
    return None


class _Writer:
    def __init__(self, text: str, numbers: Numbers, find_file: Callable[[str], Path]) -> None:
        self._source = CodeText(text)
        self._text, self._plain, self._code = self._source.text, self._source.plain, self._source.code
        self._numbers = numbers
        self._find_file = find_file
        self._used: Sequence[ClassScope] = ()
        self._own: Sequence[str] = ()
        self._scope: ClassScope | None = None  # of what is being written out
        self.scopes = class_scopes(self._code)

    def written(self, used: Sequence[ClassScope], own: Sequence[str]) -> str:
        """The text with what can be written out.

        Args:
            used: the classes that may be changed.
            own: names of those whose members are the model's, each before its bases.
        """
        self._used, self._own = used, own
        result, done = [], 0
        for start, end, text in sorted((*self._arrays(), *self._subscripts(), *self._iterations())):
            if start >= done:  # not within what is written out already
                result += [self._text[done:start], text]
                done = end
        return "".join((*result, self._text[done:]))

    def _arrays(self) -> Iterator[tuple[int, int, str]]:
        """Ranges of the text that are arrays, each with what they are written out."""
        for start, end, is_reduction in self._places():
            if not self._enter(start):
                continue
            with suppress(_UnknownError):
                if elements := (self._constructed if is_reduction else self._elements)(start, end):
                    lines = "\n" * self._text.count("\n", start, end)
                    yield start, end, f"{{{', '.join(elements)}}}{lines}"

    def _iterations(self) -> Iterator[Edit]:
        """Loops, iterators and arguments that are written otherwise, in the classes that the model uses."""
        edits = (
            *loop_edits(self._source, self._number_at, self._first_of_model),
            *iteration_edits(self._source),
            *real_argument_edits(self._source),
            *table_edits(self._source, self._enter, self._find_file),
        )
        return (edit for edit in edits if self._enter(edit[0]))

    def _number_at(self, position: int, text: str) -> int | None:
        if not self._enter(position):
            return None
        with suppress(_UnknownError):
            return self._number(text)
        return None

    def _first_of_model(self, position: int) -> int | None:
        scope = scope_at(self.scopes, position)
        return None if scope is None or _FUNCTION.match(self._code, scope.start) else scope.start

    def _subscripts(self) -> Iterator[tuple[int, int, str]]:
        """Places after an array of components that is connected to a slice, each with the subscripts of all of them."""
        for found in _CONNECT.finditer(self._code):
            if not self._enter(found.start()):
                continue
            parts = parts_between_commas(self._code, found.end(), end_of_bracket(self._code, found.end() - 1) - 1)
            for part, other in (parts, parts[::-1]) if len(parts) == 2 else ():
                array = _ARRAY_OF_CONNECTORS.fullmatch(self._code, *part)
                if array is None or not _SLICE.search(self._code[slice(*other)]):
                    continue
                with suppress(_UnknownError):
                    yield array.end(1), array.end(1), f"[1:{self._declared_size(array[1])}]"

    def _enter(self, position: int) -> bool:
        """Makes the class around a place that whose names are meant; = true, if the model uses it."""
        self._scope = scope_at(self.scopes, position)
        return self._scope is not None and any(scope is self._scope for scope in self._used)

    def _declarations(self, pattern: str) -> tuple[list[str], bool]:
        """What the nearest class says that says anything, and whether its members are the model's."""
        assert self._scope is not None
        for scope in self._scope.and_around():
            if declared := re.findall(pattern, scope.code):
                return declared, scope.name in self._own
        elsewhere = [
            (text, scope.name in self._own) for scope in self._used for text in re.findall(pattern, scope.code)
        ]
        return [text for text, _ in elsewhere], all(is_own for _, is_own in elsewhere)

    def _places(self) -> Iterator[tuple[int, int, bool]]:
        """Calls of cat, and array constructors with an iterator that subscripts a component or takes a list, in order.

        So are what reductions such as ``sum(ball[i].m for i in 1:n)`` have in their parentheses; true for these.
        """
        for found in _PLACE.finditer(self._code):
            end = end_of_bracket(self._code, found.end() - 1)
            iteration = self._iteration(found.end(), end - 1)
            if found[0] != "{" and not found["reduction"]:
                yield found.start(), end, False
            elif iteration is not None and (
                iteration[2].startswith("{") or _MEMBER_OF_ELEMENT.search(self._code, found.end(), end)
            ):
                yield (found.end(), end - 1, True) if found["reduction"] else (found.start(), end, False)

    def _elements(self, start: int, end: int) -> list[str]:
        """Elements of an array expression; raises _UnknownError where they are not plain."""
        while self._code[start].isspace():
            start += 1
        while self._code[end - 1].isspace():
            end -= 1
        code = self._code[start:end]
        call = _CALL.match(code)
        if call and end_of_bracket(self._code, start + call.end() - 1) == end:
            dimension, *arrays = parts_between_commas(self._code, start + call.end(), end - 1)
            if self._code[slice(*dimension)].strip() != "1":
                raise _UnknownError
            elements = [element for array in arrays for element in self._elements(*array)]
        elif code.startswith("{") and end_of_bracket(self._code, start) == end:
            elements = self._constructed(start + 1, end - 1)
        else:
            elements = self._members(code)
        if len(elements) > _MOST_ELEMENTS:
            raise _UnknownError
        return elements

    def _constructed(self, start: int, end: int) -> list[str]:
        iteration = self._iteration(start, end)
        if iteration is None:
            return [self._element(first, last) for first, last in parts_between_commas(self._code, start, end)]
        name = iteration[1]
        values = elements(self._source, iteration.start(2), iteration.end(2)) or self._range(iteration[2])
        self._element(start, iteration.start())
        bodies = (self._source.with_name_replaced(start, iteration.start(), name, value) for value in values)
        return [body.replace("\n", " ").strip() for body in bodies]

    def _iteration(self, start: int, end: int) -> re.Match[str] | None:
        """The iterator of an array constructor, not those of others within it."""
        position = start
        while (bound := _BRACKET_OR_FOR.search(self._code, position, end)) is not None:
            if bound[0] == "for":
                return _ITERATION.match(self._code, bound.start(), end)
            position = end_of_bracket(self._code, bound.start())
        return None

    def _range(self, text: str) -> list[str]:
        limits = text.split(":")
        if len(limits) != 2 or any(letter in text for letter in ",[{"):
            raise _UnknownError
        first, last = (self._number(limit) for limit in limits)
        if last - first >= _MOST_ELEMENTS:
            raise _UnknownError
        return [str(number) for number in range(first, last + 1)]

    def _element(self, start: int, end: int) -> str:
        """An expression in one line."""
        if self._source.has_broken_string(start, end):
            raise _UnknownError
        return self._plain[start:end].replace("\n", " ").strip()

    def _members(self, code: str) -> list[str]:
        """Elements of ``ball.geometry`` where ``ball`` is declared as an array."""
        reference = _REFERENCE.fullmatch(code)
        if reference is None:
            raise _UnknownError
        size = self._declared_size(reference[1])
        return [f"{reference[1]}[{number}]{reference[2]}" for number in range(1, size + 1)]

    def _declared_size(self, name: str) -> int:
        """Of an array that is declared once; raises _UnknownError."""
        declared, _ = self._declarations(_DECLARED.format(name=name))
        if len(declared) != 1:
            raise _UnknownError
        return self._number(declared[0])

    def _own_size(self, name: str) -> int:
        """Of an array of numbers that the class itself declares: one of a base may have the same name elsewhere."""
        declared = [] if self._scope is None else re.findall(_DECLARED_AS_NUMBERS.format(name=name), self._scope.code)
        if len(declared) != 1:
            raise _UnknownError
        return self._number(declared[0])

    def _modified(self, name: str) -> int | None:
        """What the model, or the class nearest to it, makes of a member of a class that it extends."""
        around = self._scope
        for own in self._own:
            for scope in self._used:
                given = extends_modifiers(scope).get(name) if scope.name == own else None
                if given is not None:
                    self._scope = scope
                    try:
                        return self._number(given)
                    finally:
                        self._scope = around
        return None

    def _number(self, text: str) -> int:
        try:
            return self._value(ast.parse(text.strip(), mode="eval").body)
        except (SyntaxError, ValueError, RecursionError) as error:
            raise _UnknownError from error

    def _value(self, tree: ast.expr) -> int:
        """Value of an Integer expression of numbers and of names that one declaration gives a number each."""
        match tree:
            case ast.Constant(value=int(number)):
                return number
            case ast.Name(id=name):
                declared, is_own = self._declarations(_NUMBER.format(name=name))
                if len(declared) != 1:
                    raise _UnknownError
                modified = self._modified(name) if is_own else None
                number = self._number(declared[0]) if modified is None else modified
                self._numbers.take(name, number, is_own)
                return number
            case ast.Call(func=ast.Name(id="size"), args=[ast.Name(id=name), ast.Constant(value=1)], keywords=[]):
                return self._own_size(name)
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return -self._value(operand)
            case ast.BinOp(left=left, op=ast.Add(), right=right):
                return self._value(left) + self._value(right)
            case ast.BinOp(left=left, op=ast.Sub(), right=right):
                return self._value(left) - self._value(right)
            case ast.BinOp(left=left, op=ast.Mult(), right=right):
                return self._value(left) * self._value(right)
        raise _UnknownError
