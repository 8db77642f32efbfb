"""Subscripts in ``connect`` of which the front end takes no notice, so that it connects other elements or none.

Found by trials with rumoca 0.10: lists and vectors of subscripts, ``end``, constants of packages and calls are left
out, and all elements connected; a colon beside other subscripts, too few of them, those behind an array without any
and those beyond an array's size end the connection without a word.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence, Set
from typing import Final, NamedTuple

from modelica2fmu.crosscheck.class_instances import ClassInstance, Component, UnknownError
from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.class_tokens import UnreadableError
from modelica2fmu.crosscheck.connections.connect_loops import numbers_of_range
from modelica2fmu.crosscheck.whole_numbers import whole_number
from modelica2fmu.library.brackets import end_of_bracket, parts_between_commas

Parts = Sequence[tuple[str, str]]
"""Names of an end of a connection with their subscripts in brackets, which are empty where there are none."""

_SIZES: Final = re.compile(r"\w+\s*(?=\[)")
_TAKEN: Final = re.compile(r"(?:\s|[\w.]|[-+*^():,])+")
_CALL: Final = re.compile(r"\b(?!div\b)[A-Za-z_]\w*\s*\(")
_WORD: Final = re.compile(r"\b(?:if|then|else|and|or|not|true|false)\b")
_END: Final = re.compile(r"\bend\b")
_NAME: Final = re.compile(r"[A-Za-z_][\w.]*")

_BY_NUMBER: Final = "connect element by element, connect(a[3].y, b[1]); or name a range, as in a[1:2]"
_BY_SIZE: Final = "write a number or a parameter in place of end: connect(a.y[2:3], b.u)"
_BY_RANGE: Final = "name the elements of each array by a range or a number, as in a[1:2, 1].y or b[1:3].frame[1]"
_PLAIN: Final = (
    "write numbers, iterators and Integer parameters with +, - and *; what does not follow them by itself, as the link"
    " that closes a ring: connect(link[n].frame_b, link[1].frame_a);"
)


def neglected_subscripts(
    parts: Parts, scope: ClassInstance, library: ClassLibrary, iterators: Set[str]
) -> tuple[str, str] | None:
    """What is wrong with the subscripts of an end of a connection, and what to write; None if nothing is.

    Args:
        parts: the end.
        scope: the class in which the connection stands.
        library: the sources.
        iterators: of the loops around the connection.
    """
    subscripted = [number for number, (_, brackets) in enumerate(parts) if brackets]
    for number, ((name, brackets), component) in enumerate(zip(parts, _components(parts, scope), strict=True)):
        subscripts = _split(brackets[1:-1])
        for subscript in subscripts:
            if "{" in subscript or (subscript not in iterators and _is_vector(subscript, scope, library)):
                return f"{subscript} is a vector of subscripts", _BY_NUMBER
            if subscript == ":" and (len(subscripts) > 1 or len(subscripted) > 1):
                return f"{name}{brackets} names all elements by a colon beside other subscripts", _BY_RANGE
            if _END.search(subscript):
                return f"the subscript {subscript} counts from the end", _BY_SIZE
            if not _is_plain(subscript, scope, library, iterators):
                return f"the subscript {subscript} is no sum of numbers and parameters", _PLAIN
        declared = 0 if component is None else len(_sizes(component, library))
        if brackets and len(subscripts) < declared:
            return f"{name} has {declared} dimensions, and {brackets} names elements in {len(subscripts)}", _BY_RANGE
        if declared and not brackets and subscripted and subscripted[-1] > number:
            return f"{name} is an array without subscripts before others", _BY_RANGE
    return None


class SizedSubscript(NamedTuple):
    """A subscript of an array with a number of elements that is known."""

    array: str
    text: str
    size: int


def sized_subscripts(parts: Parts, scope: ClassInstance, library: ClassLibrary) -> list[SizedSubscript]:
    """Those of an end of a connection whose arrays' sizes the sources tell.

    Args:
        parts: the end.
        scope: the class in which the connection stands.
        library: the sources.
    """
    found = []
    holder: ClassInstance | None = scope
    for (name, brackets), component in zip(parts, _components(parts, scope), strict=True):
        if component is None or holder is None:
            break
        for subscript, text in zip(_split(brackets[1:-1]), _sizes(component, library), strict=False):
            size = whole_number(text, holder, library, {})
            if size is not None:
                found.append(SizedSubscript(name, subscript, size))
        holder = component.type
    return found


def number_beyond(
    subscript: SizedSubscript, scope: ClassInstance, library: ClassLibrary, known: Mapping[str, int]
) -> int | None:
    """A number that names none of an array's elements; None where there is none, or it depends on what is not known.

    Args:
        subscript: of the array.
        scope: the class in which it stands.
        library: the sources.
        known: values of iterators.
    """
    numbers = numbers_of_range(subscript.text, scope, library, known) or ()
    return next((each for each in numbers if not 1 <= each <= subscript.size), None)


def _components(parts: Parts, scope: ClassInstance) -> list[Component | None]:
    components: list[Component | None] = []
    found: ClassInstance | None = scope
    for name, _ in parts:
        component = None if found is None else _component(found, name)
        found = None if component is None else component.type
        components.append(component)
    return components


def _sizes(component: Component, library: ClassLibrary) -> list[str]:
    """The subscripts that a component is declared with, but for those of a type that is one of arrays."""
    text = library.text(component.declarations[0])
    head = _SIZES.match(text)
    own = "" if head is None else text[head.end() + 1 : end_of_bracket(text, head.end()) - 1]
    of_type = "" if component.sizes_of_type is None else library.text(component.sizes_of_type)
    return [*_split(own), *_split(of_type.strip().removeprefix("[").removesuffix("]"))]


def _split(subscripts: str) -> list[str]:
    """The subscripts between brackets; none of an empty text."""
    if not subscripts.strip():
        return []
    return [subscripts[first:last].strip() for first, last in parts_between_commas(subscripts, 0, len(subscripts))]


def _is_plain(subscript: str, scope: ClassInstance, library: ClassLibrary, iterators: Set[str]) -> bool:
    """= true, if the front end takes notice of a subscript."""
    if _TAKEN.fullmatch(subscript) is None or _CALL.search(subscript) or _WORD.search(subscript):
        return False
    for name in set(_NAME.findall(subscript)) - iterators:
        component = _component(scope, name.split(".")[0])
        if component is None and "." in name:
            return False  # a package's constant
        binding = None if component is None else component.binding
        if binding is not None and "[" in library.text(binding.extent):
            return False
    return True


def _is_vector(subscript: str, scope: ClassInstance, library: ClassLibrary) -> bool:
    component = _component(scope, subscript)
    return component is not None and len(_sizes(component, library)) > 0


def _component(scope: ClassInstance, name: str) -> Component | None:
    try:
        return scope.component(name)
    except (UnknownError, UnreadableError, RecursionError):
        return None
