"""The loops around connections, and the values that their iterators take."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Final

from modelica2fmu.crosscheck.class_instances import ClassInstance
from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.whole_numbers import inclusive_range, whole_number
from modelica2fmu.library.brackets import parts_between_commas

_LOOP: Final = re.compile(r"\bend\s+for\b|\bend\s+if\b|\bfor\b(?P<heads>[^;]*?)\bloop\b|(?<!\w)(?P<branch>if)\b")
_HEAD: Final = re.compile(r"\s*(\w+)\s+in\s+(.+)", re.DOTALL)
_OPENS: Final = re.compile(r"(?:^|;|\b(?:equation|loop|then|else))\s*$")
_OPENING: Final = 200
_MOST_ROUNDS: Final = 10000


@dataclass(frozen=True)
class Loops:
    """What stands around a connection.

    Attributes:
        heads: of loops, as in ``i in 1:n``, the outermost first.
        is_conditional: = true, if an if-equation does, too.
    """

    heads: tuple[str, ...]
    is_conditional: bool

    @property
    def iterators(self) -> frozenset[str]:
        """Their names, which hide variables of the same names."""
        return frozenset(head.split()[0] for head in self.heads if head.split())


class LoopsAround:
    """Reads an equation section once, for the loops around places in it that ascend.

    Args:
        text: of the section, without comments and Strings.
    """

    def __init__(self, text: str) -> None:
        self._text = text
        self._marks = _LOOP.finditer(text)
        self._next = next(self._marks, None)
        self._stack: list[tuple[str, ...] | None] = []

    def at(self, place: int) -> Loops:
        """The loops that a place is in."""
        while self._next is not None and self._next.start() < place:
            self._take(self._next)
            self._next = next(self._marks, None)
        heads = tuple(head for heads in self._stack if heads is not None for head in heads)
        return Loops(heads, is_conditional=None in self._stack)

    def _take(self, mark: re.Match[str]) -> None:
        if mark["heads"] is not None:
            heads = mark["heads"]
            self._stack.append(tuple(heads[a:b] for a, b in parts_between_commas(heads, 0, len(heads))))
        elif mark["branch"]:
            if _begins_equation(self._text[: mark.start()]):
                self._stack.append(None)
        elif self._stack:
            self._stack.pop()


def rounds(heads: Sequence[str], scope: ClassInstance, library: ClassLibrary) -> Iterator[Mapping[str, int]]:
    """The iterators' values in each round of nested loops; none where they are not known, or are too many."""
    known: list[dict[str, int]] = [{}]
    for head in heads:
        parsed = _HEAD.fullmatch(head)
        if parsed is None:
            return
        name, text = parsed.groups()
        further: list[dict[str, int]] = []
        for outer in known:
            values = numbers_of_range(text, scope, library, outer)
            if values is None or len(further) + len(values) > _MOST_ROUNDS:
                return
            further += [{**outer, name: number} for number in values]
        known = further
    yield from known


def numbers_of_range(
    text: str, scope: ClassInstance, library: ClassLibrary, known: Mapping[str, int]
) -> Sequence[int] | None:
    """The numbers of ``a``, ``a:b`` or ``a:step:b``; None where they are not known."""
    values = [whole_number(each, scope, library, known) for each in text.split(":")]
    match values:
        case [int(number)]:
            return [number]
    return inclusive_range(values)


def _begins_equation(before: str) -> bool:
    """= true, if an ``if`` behind a text is an equation's: behind a semicolon or a word that opens equations."""
    return _OPENS.search(before[-_OPENING:]) is not None
