"""Variables of a flattened model, and which have in place of a name what that name is bound to."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any, Final

from modelica2fmu.crosscheck.class_instances import Value
from modelica2fmu.crosscheck.flattened.flat_reading import FlatReading, spans

FlatPath = tuple[str, ...]

_PART: Final = re.compile(r"'(?:\\.|[^'\\])*'|[^.\[\]]+(?:\[[^\]]*\])?")
_SUBSCRIPTS: Final = re.compile(r"\[[^\]]*\]")
_REFERENCE: Final = re.compile(r"\.?(?!(?:true|false)\b)[A-Za-z_][\w.\s\[\],:]*")


def is_reference(text: str) -> bool:
    """= true, if a text is the name of a component, perhaps with subscripts."""
    return _REFERENCE.fullmatch(text) is not None


def names_of(path: str) -> FlatPath:
    """The names of a path without subscripts."""
    return tuple(_SUBSCRIPTS.sub("", part.strip()) for part in _PART.findall(path))


def parts_of(path: str) -> FlatPath:
    """The names of a path with their subscripts."""
    return tuple(part.strip() for part in _PART.findall(path))


def without_subscripts(name: str) -> str:
    """A name without what stands in brackets."""
    return _SUBSCRIPTS.sub("", name)


class FlatVariables:
    """Those of a model, by their names without subscripts.

    Args:
        flat: as the front end gives it.
        reading: the sources.
    """

    def __init__(self, flat: Mapping[str, Any], reading: FlatReading) -> None:
        self._reading = reading
        self.by_path: dict[FlatPath, list[Mapping[str, Any]]] = {}
        for variable in flat["variables"].values():
            path = tuple(part["ident"] for part in variable["component_ref"]["parts"])
            self.by_path.setdefault(path, []).append(variable)

    def contains(self, path: FlatPath, name: FlatPath) -> bool:
        """= true, if a name that is written in a component or around it is that of a variable."""
        return any((*path[:length], *name) in self.by_path for length in range(len(path)))

    def is_copy(self, path: FlatPath, value: Value, places: Sequence[Mapping[str, int]], field: FlatPath = ()) -> bool:
        """= true, if the value is a name, and the front end put in its place what that name is bound to."""
        text = self._reading.text(value.extent)
        if not is_reference(text):
            return False
        found = {(span["source"], span["start"]) for span in places}
        for length in range(len(path)):
            for other in self.by_path.get((*path[:length], *names_of(text), *field), ()):
                if found & {(span["source"], span["start"]) for span in spans(other["binding"])}:
                    return True
        return False
