"""Whether the user's classes write operators between operator records, which rumoca 0.10 takes for those of numbers."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Final

from contact_foundation.errors import Place, UnsupportedModelError

from modelica2fmu.crosscheck.class_instances import ClassInstance
from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.class_syntax import Extent
from modelica2fmu.crosscheck.own_classes import found_class, own_classes_of

_KIND: Final = "operator"  # of operator records, and of operators, which no component is
_OPERATOR: Final = r"\.?[-+*/^]"


def check_record_operators(model: str, library: ClassLibrary, own: Path, place_of: Callable[[Extent], Place]) -> None:
    """Refuses them (Modelica 3.6, chapter 14); constructors and functions of such records are right.

    Args:
        model: full name.
        library: the sources.
        own: file or folder of the user's own classes.
        place_of: the place of a range of a file.

    Raises:
        UnsupportedModelError: a class that the model uses writes one.
    """
    for scope in own_classes_of(model, library, own):
        names, types = _records(scope)
        if not names:
            continue
        operands = "|".join(map(re.escape, names))
        calls = "|".join(map(re.escape, types))
        # A name alone, no field or element; a constructor's call.
        written = re.compile(
            rf"{_OPERATOR}\s*(?:(?:{operands})\b(?!\s*[.\[(])|(?:{calls})\s*\()"
            rf"|(?<![\w.])(?:{operands})\s*{_OPERATOR}|(?<![\w.])(?:{calls})\s*\([^()]*\)\s*{_OPERATOR}"
        )
        for extent in _expressions(scope):
            if written.search(library.text(extent)) is not None:
                kind = types[0]
                raise UnsupportedModelError(
                    f"operators between records of {kind} are not taken: {' '.join(library.text(extent).split())}",
                    place=replace(place_of(extent), component=model),
                    remedy=f"call the functions of the operators: {kind}.'*'.multiply(a, b) in place of a*b",
                )


def _records(scope: ClassInstance) -> tuple[list[str], list[str]]:
    """Names of components that are operator records, and of their types."""
    names, types = [], []
    for component in scope.definition.components.values():
        found = found_class(scope, component.type_name)
        if found is not None and found.definition.kind == _KIND:
            names.append(component.name)
            types.append(".".join(part for part in component.type_name if part))
    return names, list(dict.fromkeys(types))


def _expressions(scope: ClassInstance) -> Iterator[Extent]:
    yield from (each.value for each in scope.definition.components.values() if each.value is not None)
    yield from scope.definition.equations
    yield from scope.definition.blocks
