"""Names that are there beside one that is not."""

from __future__ import annotations

from collections.abc import Sequence

from contact_foundation.near_names import did_you_mean

from modelica2fmu.crosscheck.class_instances import ClassInstance, Names, UnknownError
from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.class_tokens import UnreadableError


def near_names(parts: Sequence[str], model: str, library: ClassLibrary) -> str | None:
    """A question that names what is there in place of a name that is not; ``None`` if nothing is near.

    Args:
        parts: the name, of a class or of a component, as written in the model.
        model: full name of the model.
        library: the sources.
    """
    try:
        scope = Names(library).find(tuple(model.split(".")))
        for number, part in enumerate(parts):
            inner = _element(scope, part, is_first=number == 0)
            if inner is None:
                known = {*scope.component_names(), *library.members(scope.definition)}
                full = [".".join((*parts[:number], each)) for each in sorted(known)]
                return did_you_mean(".".join(parts[: number + 1]), full)
            scope = inner
    except (UnknownError, UnreadableError, RecursionError):
        pass
    return None


def _element(scope: ClassInstance, name: str, is_first: bool) -> ClassInstance | None:
    component = scope.component(name)
    if component is not None:
        return component.type
    try:
        return scope.lookup((name,)) if is_first else scope.class_element(name)
    except UnknownError:
        return None
