"""Whether connected connectors have the same elements and sizes (Modelica 3.6, 9.3): not asked by the front end."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final

from contact_foundation.errors import InputError, Place, UnsupportedModelError

from modelica2fmu.crosscheck.class_instances import ClassInstance, UnknownError
from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.class_syntax import Extent
from modelica2fmu.crosscheck.class_tokens import UnreadableError
from modelica2fmu.crosscheck.connections.connect_loops import Loops, LoopsAround, rounds
from modelica2fmu.crosscheck.connections.connect_subscripts import neglected_subscripts, number_beyond, sized_subscripts
from modelica2fmu.crosscheck.own_classes import model_class, own_classes_of
from modelica2fmu.library.class_text import without_comments_and_strings

_BRACKETS: Final = r"\[(?:[^\[\]]|\[[^\[\]]*\])*\]"
_END: Final = rf"([A-Za-z_]\w*(?:{_BRACKETS})?(?:\s*\.\s*[A-Za-z_]\w*(?:{_BRACKETS})?)*)"
_CONNECT: Final = re.compile(rf"\bconnect\s*\(\s*{_END}\s*,\s*{_END}\s*\)")
_SUBSCRIPTS: Final = re.compile(rf"{_BRACKETS}|\s")
_PART: Final = re.compile(rf"([A-Za-z_]\w*)({_BRACKETS})?")
_SLICE: Final = re.compile(r"\[\s*(\d+)\s*:\s*(\d+)\s*\]")
_NUMBER: Final = re.compile(r"\[\s*\d+\s*\]")
_EXPANDABLE: Final = re.compile(r"\bexpandable\s+connector\b")


@dataclass(frozen=True)
class Connect:
    """A connect equation.

    Attributes:
        ends: as written.
        scope: the class in which it stands.
        extent: where.
        loops: around it.
    """

    ends: tuple[str, str]
    scope: ClassInstance
    extent: Extent
    loops: Loops


def check_connects(model: str, library: ClassLibrary, own: Path, place_of: Callable[[Extent], Place]) -> None:
    """Holds the connectors that the user connects against each other, as far as their classes are found.

    Args:
        model: full name.
        library: the sources.
        own: file or folder of the user's own classes; others are taken as right.
        place_of: the place of a range of a file.

    Raises:
        InputError: two connectors have different elements.
        UnsupportedModelError: the front end takes no notice of a subscript.
    """
    for scope in own_classes_of(model, library, own):
        for connect in connects(scope, library):
            _check_subscripts(model, connect, library, place_of)
            try:
                first, second = (_described(_class_of(scope, end), library) for end in connect.ends)
            except (UnknownError, UnreadableError, RecursionError):
                continue
            if first is None or second is None or first == second:
                continue
            raise InputError(
                f"{connect.ends[0]} has {', '.join(first)}, but {connect.ends[1]} has {', '.join(second)}: "
                "only connectors with the same elements can be connected",
                place=replace(place_of(connect.extent), component=model),
                remedy="connect each to a connector of its own kind",
            )


def _check_subscripts(model: str, connect: Connect, library: ClassLibrary, place_of: Callable[[Extent], Place]) -> None:
    place = replace(place_of(connect.extent), component=model)
    written = f"connect({', '.join(connect.ends)})"
    for end in connect.ends:
        neglected = neglected_subscripts(parts_of(end), connect.scope, library, connect.loops.iterators)
        if neglected is not None:
            wrong, remedy = neglected
            raise UnsupportedModelError(f"in {written} {wrong}, which is not covered", place=place, remedy=remedy)
    if connect.loops.is_conditional:
        return
    sized = [each for end in connect.ends for each in sized_subscripts(parts_of(end), connect.scope, library)]
    for known in rounds(connect.loops.heads, connect.scope, library) if sized else ():
        for subscript in sized:
            number = number_beyond(subscript, connect.scope, library, known)
            if number is None:
                continue
            name, size = subscript.array, subscript.size
            at = ", ".join(f"{iterator} = {value}" for iterator, value in known.items())
            raise InputError(
                f"{written} names {name}[{number}]{f' at {at}' if at else ''}, and {name} has {_elements(size)}",
                place=place,
                remedy=f"name elements from 1 to {size}" if size else f"give {name} elements",
            )


def check_connect_sizes(
    model: str,
    variables: Mapping[str, Mapping[str, Any]],
    library: ClassLibrary,
    place_of: Callable[[Extent], Place],
) -> None:
    """Holds sizes of arrays of connectors against each other that the model itself connects.

    Args:
        model: full name.
        variables: of the flattened model, with their dimensions.
        library: the sources.
        place_of: the place of a range of a file.

    Raises:
        InputError: two arrays of connectors have different sizes.
    """
    root = model_class(model, library)
    arrays = array_sizes(variables)
    for connect in connects(root, library) if root is not None and arrays else ():
        first, second = (_sizes(end, arrays) for end in connect.ends)
        if first is None or second is None or first == second:
            continue
        raise InputError(
            f"{connect.ends[0]} has {_counted(first)}, but {connect.ends[1]} has {_counted(second)}: "
            "only arrays of the same size can be connected",
            place=replace(place_of(connect.extent), component=model),
            remedy="name the elements that are meant, as in frame[1:3]",
        )


def array_sizes(variables: Mapping[str, Mapping[str, Any]]) -> dict[str, int | None]:
    """Sizes of all arrays of components and of variables, by their names without subscripts; None: matrices."""
    sizes: dict[str, int | None] = {}
    for name, variable in variables.items():
        path = ""
        for element, subscripts in _PART.findall(name.rpartition(".")[0]):
            path += f".{element}"
            if subscripts:
                number = None if "," in subscripts else int(subscripts[1:-1])
                known = sizes.get(path, 0)
                sizes[path] = None if number is None or known is None else max(number, known)
        lengths = variable["dims"]
        if lengths:
            sizes["".join(f".{element}" for element, _ in _PART.findall(name))] = (
                lengths[0] if len(lengths) == 1 else None
            )
    return sizes


def _sizes(end: str, arrays: Mapping[str, int | None]) -> list[int] | None:
    """Sizes of an array of connectors, none for a single one; None where they are not plain."""
    path, sizes = "", []
    for element, subscripts in _PART.findall(end):
        path += f".{element}"
        limits = _SLICE.fullmatch(subscripts)
        size = arrays.get(path, 0)
        is_plain = not subscripts or limits is not None or _NUMBER.fullmatch(subscripts) is not None
        if size is None or ("[" in subscripts and not size) or not is_plain:
            return None
        if limits is not None:
            sizes.append(int(limits[2]) - int(limits[1]) + 1)
        elif size and not subscripts:
            sizes.append(size)
    return sizes


def _counted(sizes: list[int]) -> str:
    return " x ".join(map(str, sizes)) + " elements" if sizes else "one element"


def _elements(count: int) -> str:
    return {0: "no elements", 1: "one element"}.get(count, f"{count} elements")


def parts_of(end: str) -> list[tuple[str, str]]:
    """Names of an end of a connection with their subscripts, which are empty where there are none."""
    return _PART.findall(end)


def connects(scope: ClassInstance, library: ClassLibrary) -> Iterator[Connect]:
    """The connections that stand in a class itself."""
    for section in scope.definition.behaviour:
        # One character a byte, so that places in the text are places in the file.
        text = without_comments_and_strings(library.text(section).encode().decode("latin-1"))
        loops = LoopsAround(text)
        for match in _CONNECT.finditer(text):
            extent = Extent(section.file, section.start + match.start(), section.start + match.end())
            yield Connect((match[1], match[2]), scope, extent, loops.at(match.start()))


def _class_of(scope: ClassInstance, end: str) -> ClassInstance:
    """The class of a component of components; raises UnknownError."""
    found = scope
    for name in _SUBSCRIPTS.sub("", end).split("."):
        component = found.component(name)
        if component is None:
            raise UnknownError(name)
        found = component.type
    return found


def _described(connector: ClassInstance, library: ClassLibrary) -> list[str] | None:
    """What a connector consists of, sorted: names, or its type if it is a single value; None if that can vary."""
    predefined = connector.predefined
    if predefined is not None:
        return ["an enumeration" if predefined.definition.is_enumeration else f"a {predefined.definition.name}"]
    if any(_EXPANDABLE.search(library.text(each.definition.extent)) for each in connector.chain()):
        return None
    return sorted(set(connector.component_names())) or None
