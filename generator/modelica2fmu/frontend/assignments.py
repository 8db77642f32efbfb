"""Assignments in functions, and such of zeros that could stand in their place."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Final

from modelica2fmu.crosscheck.class_syntax import ClassDefinition, Extent

_TARGET: Final = re.compile(r"\s*(?P<name>[A-Za-z_]\w*)\s*(?P<subscripts>\[[^\[\]]*\])?\s*:=")


def neutral_assignments(definition: ClassDefinition, texts: Mapping[Path, bytes]) -> Iterator[tuple[Extent, bytes]]:
    """Assignments to Real variables that stand directly in functions of a class, each with one of zeros of its size.

    Args:
        definition: the class; functions in it count, and itself if it is one.
        texts: of the files that hold it.

    Yields:
        Where the assignment stands, its semicolon with it, and the text that could stand there.
    """
    if definition.kind == "function":
        for extent in definition.equations:
            text = texts[extent.file][extent.start : extent.end].decode(errors="replace")
            zeros = _zeros(text, definition, texts)
            if zeros is not None:
                yield extent, zeros.encode()
    for inner in definition.classes.values():
        yield from neutral_assignments(inner, texts)


def _zeros(assignment: str, function: ClassDefinition, texts: Mapping[Path, bytes]) -> str | None:
    target = _TARGET.match(assignment)
    component = None if target is None else function.components.get(target["name"])
    if target is None or component is None or component.type_name != ("Real",):
        return None
    if target["subscripts"] is not None:  # of an element; how large a slice is stands nowhere
        return None if ":" in target["subscripts"] else f"{target[0]} 0.0;"
    declared = texts[component.extent.file][component.extent.start : component.extent.end].decode(errors="replace")
    sizes = re.search(rf"\bReal\s*\[([^\[\]]*)\]|\b{target['name']}\s*\[([^\[\]]*)\]", declared)
    if sizes is None:
        return f"{target[0]} 0.0;"
    return f"{target[0]} fill(0.0, {sizes[1] or sizes[2]});"
