"""Loops that the front end does not take, written so that it does.

rumoca 0.10 goes through ranges of whole numbers alone. Loops over ``{3, 1, 2}`` and those in algorithm sections of
models are written out; ``for x in v`` becomes ``for x in 1:size(v, 1)`` with ``v[x]`` for ``x``, and an enumeration the
list of its values.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Final

from modelica2fmu.crosscheck.whole_numbers import inclusive_range
from modelica2fmu.frontend.rewriting.code_text import CodeText
from modelica2fmu.library.brackets import end_of_bracket, parts_between_commas

# Ranges of a text, each with what is to stand there.
Edit = tuple[int, int, str]

_BOUND: Final = re.compile(r"[(\[{]|\bend\s+for\s*;|\bfor\b")
_HEAD: Final = re.compile(r"for\s+(?P<name>\w+)\s+in\s+(?P<values>[^;]+?)\s*\bloop\b")
_ITERATION: Final = re.compile(r"\bfor\s+(?P<name>\w+)\s+in\s+(?P<values>[A-Za-z_][\w.]*)\s*(?=[)}])")
_VECTOR: Final = re.compile(r"[A-Za-z_]\w*(?:\.\w+)*")
_SECTION: Final = re.compile(r"\b(algorithm|equation)\b")
_ASSIGNED: Final = re.compile(r"(?<!\w)(?:(?!\b(?:then|else|loop)\b)[^;])*?:=")
_NAME: Final = re.compile(r"(?<![\w.])[A-Za-z_]\w*")
_BREAK: Final = re.compile(r"\bbreak\b")
_DECLARED_ENUMERATION: Final = r"\btype\s+{name}\s*=\s*enumeration\s*\(([^()]*)\)"
_CLASS: Final = r"\b(?:block|class|function|model|package|record)\s+{name}\b"
_PLAIN_ELEMENT: Final = re.compile(r"\w+(?:\.\w+)*")
_MOST_LETTERS: Final = 100_000


@dataclass(frozen=True)
class ForLoop:
    """A loop with one iterator.

    Attributes:
        start: of its ``for``.
        end: behind its ``end for;``.
        name: of the iterator.
        values: the range of what it goes through.
        body: the range of what it repeats.
    """

    start: int
    end: int
    name: str
    values: tuple[int, int]
    body: tuple[int, int]


def for_loops(code: str) -> Iterator[ForLoop]:
    """The loops with one iterator, inner ones before those around them."""
    waiting: list[int] = []
    position = 0
    while (bound := _BOUND.search(code, position)) is not None:
        position = bound.end()
        if bound[0] in "([{":
            position = end_of_bracket(code, bound.start())
        elif bound[0] == "for":
            waiting.append(bound.start())
        elif waiting:
            start = waiting.pop()
            head = _HEAD.match(code, start, bound.start())
            if head is not None:
                yield ForLoop(start, bound.end(), head["name"], head.span("values"), (head.end(), bound.start()))


def loop_edits(
    source: CodeText, number: Callable[[int, str], int | None], first_of_model: Callable[[int], int | None]
) -> Iterator[Edit]:
    """Loops that are written otherwise.

    Args:
        source: the Modelica text.
        number: the value of an Integer expression at a place; None if it is not known.
        first_of_model: where the class around a place begins; None for functions.
    """
    for loop in for_loops(source.code):
        if _changes_its_values(source.code, loop):
            continue
        vector = _VECTOR.fullmatch(source.code, *loop.values)
        literals = None if vector is None else _enumeration(source.code, vector[0])
        if literals is not None:
            yield *loop.values, literals
            continue
        if vector is not None:
            body = _indexed(source, loop.body, loop.name, vector[0])
            head = source.plain[loop.start : loop.values[0]]
            between = source.plain[loop.values[1] : loop.body[0]]
            end = source.plain[loop.body[1] : loop.end]
            yield loop.start, loop.end, f"{head}1:size({vector[0]}, 1){between}{body}{end}"
            continue
        values = elements(source, *loop.values)
        first = first_of_model(loop.start)
        if values is None and first is not None and _is_in_algorithm(source.code, first, loop.start):
            values = _whole_numbers(source, loop, number)
        if values is not None:
            yield from _repeated(source, loop, values)


def iteration_edits(source: CodeText) -> Iterator[Edit]:
    """Iterators of expressions that go through a vector: ``{x^2 for x in v}`` is that of ``v[x]`` for its indices."""
    for found in _ITERATION.finditer(source.code):
        opened = _opening_bracket(source.code, found.start())
        literals = _enumeration(source.code, found["values"])
        if literals is not None:
            yield *found.span("values"), literals
        elif opened is not None:
            body = _indexed(source, (opened + 1, found.start()), found["name"], found["values"])
            head = source.plain[found.start() : found.start("values")]
            yield opened + 1, found.end("values"), f"{body}{head}1:size({found['values']}, 1)"


def elements(source: CodeText, start: int, end: int) -> list[str] | None:
    """The elements of a list ``{a, b, c}`` as they can stand in an expression; None of anything else."""
    code = source.code
    while start < end and code[start].isspace():
        start += 1
    if not code.startswith("{", start) or end_of_bracket(code, start) != len(code[:end].rstrip()):
        return None
    parts = [source.plain[slice(*part)].strip() for part in parts_between_commas(code, start + 1, end - 1)]
    if any(not part or re.search(r"\bfor\b|\n", part) for part in parts):
        return None
    return [part if _PLAIN_ELEMENT.fullmatch(part) else f"({part})" for part in parts]


def _enumeration(code: str, name: str) -> str | None:
    """The values of an enumeration of the text as a list ``{E.a, E.b}``; None of other names."""
    first, _, rest = name.partition(".")
    if rest and re.search(_CLASS.format(name=first), code) is None:
        return None
    declared = re.findall(_DECLARED_ENUMERATION.format(name=name.rpartition(".")[2]), code)
    if len(declared) != 1:
        return None
    literals = (literal.split("\0")[0].strip() for literal in declared[0].split(","))
    return f"{{{', '.join(f'{name}.{literal}' for literal in literals)}}}"


def _changes_its_values(code: str, loop: ForLoop) -> bool:
    """= true, if the body may assign to what the loop goes through, which counts as it is before the loop."""
    names = set(_NAME.findall(code, *loop.values))
    targets = (found[0] for found in _ASSIGNED.finditer(code, *loop.body))
    return any(names & set(_NAME.findall(target)) for target in targets)


def _is_in_algorithm(code: str, first: int, position: int) -> bool:
    """= true, if the last section between two places is an algorithm."""
    sections = _SECTION.findall(code, first, position)
    return bool(sections) and sections[-1] == "algorithm"


def _whole_numbers(source: CodeText, loop: ForLoop, number: Callable[[int, str], int | None]) -> list[str] | None:
    numbers = inclusive_range([number(loop.start, text) for text in source.code[slice(*loop.values)].split(":")])
    return None if numbers is None else [str(value) for value in numbers]


def _repeated(source: CodeText, loop: ForLoop, values: list[str]) -> Iterator[Edit]:
    start, end = loop.body
    if _BREAK.search(source.code, start, end) is not None:  # it would end the loop around this one
        return
    if source.has_broken_string(start, end) or (end - start) * len(values) > _MOST_LETTERS:
        return
    lines = "\n" * source.text.count("\n", loop.start, loop.end)
    bodies = (source.with_name_replaced(start, end, loop.name, value) for value in values)
    yield loop.start, loop.end, " ".join(body.replace("\n", " ").strip() for body in bodies) + lines


def _indexed(source: CodeText, extent: tuple[int, int], name: str, vector: str) -> str:
    return source.with_name_replaced(*extent, name, f"{vector}[{name}]")


def _opening_bracket(code: str, position: int) -> int | None:
    """Where the bracket begins that a place lies in."""
    depth = 0
    for place in range(position - 1, -1, -1):
        if code[place] in ")]}":
            depth += 1
        elif code[place] in "([{":
            if depth == 0:
                return place
            depth -= 1
    return None
