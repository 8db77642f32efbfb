"""``cardinality`` of connectors that are connected as whole arrays; rumoca 0.10 takes them for connected to nothing.

Elementary joints of the Standard Library assert that they are connected. Forces along a line choose their equations so.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

from contact_foundation.errors import Place, UnsupportedModelError

from modelica2fmu.crosscheck.class_instances import ClassInstance, Component, UnknownError
from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.class_syntax import Extent, is_array
from modelica2fmu.crosscheck.class_tokens import UnreadableError
from modelica2fmu.crosscheck.connections.connect_check import Connect, connects, parts_of
from modelica2fmu.crosscheck.flattened.flat_reading import FlatReading
from modelica2fmu.crosscheck.own_classes import own_classes_of
from modelica2fmu.library.class_text import without_comments_and_strings

_ASSERTED: Final = re.compile(r"cardinality ?\( ?(\w+) ?\) ?> ?0")
_KINDS: Final = ("assert_equations", "initial_assert_equations")
_INDEX: Final = "i"


def drop_miscounted_assertions(flat: dict[str, Any], reading: FlatReading) -> None:
    """Takes assertions that a connector is connected out of a flattened model where it is connected.

    Args:
        flat: as the front end gives it; it is changed.
        reading: the sources.
    """
    loose: set[str] | None = None
    for kind in _KINDS:
        kept = []
        for item in flat[kind]:
            names = _asserted(item, reading)
            if names and loose is None:
                loose = _unconnected(flat)
            if loose is None or not names or all(name in loose for name in names):
                kept.append(item)
        flat[kind] = kept


def _asserted(item: Mapping[str, Any], reading: FlatReading) -> list[str]:
    """The connectors of which a false assertion says that one is connected; none for other assertions."""
    literal = item["condition"].get("Literal")
    if literal is None or literal["value"] != {"Boolean": False}:
        return []
    origin, extent = item["origin"], reading.extent(literal["span"])
    if extent is None or not isinstance(origin, dict) or "ComponentEquation" not in origin:
        return []
    terms = [_ASSERTED.fullmatch(term.strip()) for term in reading.text(extent).split(" or ")]
    around = origin["ComponentEquation"]["component"]
    return [f"{around}.{term[1]}" for term in terms if term is not None] if all(terms) else []


def _unconnected(flat: Mapping[str, Any]) -> set[str]:
    origins = (equation["origin"] for equation in flat["equations"])
    flows = (each["UnconnectedFlow"]["variable"] for each in origins if "UnconnectedFlow" in each)
    return {flow.rpartition(".")[0] for flow in flows}


def check_counted_arrays(model: str, library: ClassLibrary, own: Path, place_of: Callable[[Extent], Place]) -> None:
    """Refuses connections of whole arrays to parts whose equations depend on the number of connections.

    Args:
        model: full name.
        library: the sources.
        own: file or folder of the user's own classes.
        place_of: the place of a range of a file.

    Raises:
        UnsupportedModelError: there is one.
    """
    for scope in own_classes_of(model, library, own):
        for connect in connects(scope, library):
            for end in connect.ends:
                counting = _counting(scope, end, library)
                if counting is not None:
                    raise UnsupportedModelError(
                        f"{end} is connected as a whole array, and {counting} asks with cardinality how often it is"
                        " connected, which the front end then takes for never",
                        place=replace(place_of(connect.extent), component=model),
                        remedy=f"connect the elements: {_written_out(connect, library)}",
                    )


def _counting(scope: ClassInstance, end: str, library: ClassLibrary) -> str | None:
    """Name of the class whose equations count the connections of an array that is an end; None if none does."""
    try:
        found, is_whole, component = scope, False, None
        parts = parts_of(end)
        for name, subscripts in parts[:-1]:
            component = found.component(name)
            if component is None:
                return None
            is_whole = is_whole or _is_whole(component, subscripts, library)
            found = component.type
        connector = parts[-1][0]
        last = found.component(connector)
        if last is None or component is None or not (is_whole or _is_whole(last, parts[-1][1], library)):
            return None
        counts = re.compile(rf"(?<!assert\()\bcardinality\s*\(\s*{connector}\s*[)\[]")
        for each in found.chain():
            for section in each.definition.behaviour:
                if counts.search(re.sub(r"\bassert\s*\(\s*", "assert(", _code(library, section))):
                    return each.definition.name
    except (UnknownError, UnreadableError, RecursionError):
        return None
    return None


def _code(library: ClassLibrary, extent: Extent) -> str:
    return without_comments_and_strings(library.text(extent))


def _is_whole(component: Component, subscripts: str, library: ClassLibrary) -> bool:
    """= true, if a component is an array of which all elements, or several, are meant."""
    whole = not subscripts or ":" in subscripts
    return whole and is_array(component.sizes_of_type, library.text(component.declarations[-1]))


def _written_out(connect: Connect, library: ClassLibrary) -> str:
    """The connection by elements, of arrays that are named as a whole."""

    def element(end: str) -> str:
        words, found = [], connect.scope
        for name, subscripts in parts_of(end):
            component = found.component(name)
            if component is None:
                return end
            whole = not subscripts and _is_whole(component, subscripts, library)
            words.append(f"{name}[{_INDEX}]" if whole else f"{name}{subscripts}")
            found = component.type
        return ".".join(words)

    try:
        first, second = (element(end) for end in connect.ends)
    except (UnknownError, UnreadableError, RecursionError):
        first, second = connect.ends
    return f"for {_INDEX} in 1:n loop connect({first}, {second}); end for;"
