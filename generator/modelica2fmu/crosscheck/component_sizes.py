"""Whether the user's classes ask for the size of an array of components by ``size``, which rumoca 0.10 does not know.

It makes one component of such an array, whose variables are arrays, and breaks off where they are connectors.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Final

from contact_foundation.errors import Place, UnsupportedModelError

from modelica2fmu.crosscheck.class_instances import ClassInstance, UnknownError
from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.class_syntax import ComponentDeclaration, Extent
from modelica2fmu.crosscheck.class_tokens import UnreadableError
from modelica2fmu.crosscheck.own_classes import found_class, own_classes_of

SIZE_OF_COMPONENTS: Final = (
    "name the number, parameter Integer n = 3; parameter Real k[n] = {1, 2, 3}; and write it as the size: g[n](k = k)"
)
RECORDS: Final = ("record", "operator")
_SIZES: Final = re.compile(r"\w+\s*\[([^\]]*)\]")
_ASKED: Final = re.compile(r"\bsize\s*\(")
_NAME: Final = re.compile(r"[A-Za-z_]\w*")


def check_component_sizes(model: str, library: ClassLibrary, own: Path, place_of: Callable[[Extent], Place]) -> None:
    """Refuses arrays of components, records aside, with such sizes.

    Args:
        model: full name.
        library: the sources.
        own: file or folder of the user's own classes.
        place_of: the place of a range of a file.

    Raises:
        UnsupportedModelError: a class that the model uses declares one.
    """
    for scope in own_classes_of(model, library, own):
        for component in scope.definition.components.values():
            if _is_asked(component, scope, library) and _is_of_components(scope, component):
                raise UnsupportedModelError(
                    f"the front end does not know how many elements the array of components {component.name} has",
                    place=replace(place_of(component.extent), component=model),
                    remedy=SIZE_OF_COMPONENTS,
                )


def _is_asked(component: ComponentDeclaration, scope: ClassInstance, library: ClassLibrary) -> bool:
    """Whether a size is that of another array, or a parameter that is."""
    sizes = _SIZES.match(library.text(component.extent))
    text = "" if sizes is None else sizes[1]
    if component.sizes_of_type is not None:
        text += " " + library.text(component.sizes_of_type)
    named = (scope.definition.components.get(name) for name in _NAME.findall(text))
    values = (library.text(each.value) for each in named if each is not None and each.value is not None)
    return any(_ASKED.search(each) is not None for each in (text, *values))


def _is_of_components(scope: ClassInstance, component: ComponentDeclaration) -> bool:
    try:
        found = found_class(scope, component.type_name)
        return found is not None and found.predefined is None and found.definition.kind not in RECORDS
    except (UnknownError, UnreadableError, RecursionError):
        return False
