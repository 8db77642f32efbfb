"""Whether the user's classes declare classes as ``outer``; rumoca 0.10 takes these themselves, not the inner ones."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from contact_foundation.errors import Place, UnsupportedModelError

from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.class_syntax import Extent
from modelica2fmu.crosscheck.own_classes import model_class, own_classes


def check_outer_classes(model: str, library: ClassLibrary, own: Path, place_of: Callable[[Extent], Place]) -> None:
    """Refuses outer classes (Modelica 3.6, section 5.4); outer components are right.

    Args:
        model: full name.
        library: the sources.
        own: file or folder of the user's own classes.
        place_of: the place of a range of a file.

    Raises:
        UnsupportedModelError: a class that the model uses declares one.
    """
    root = model_class(model, library)
    if root is None:
        return
    for scope in own_classes(root, own):
        for each in scope.definition.classes.values():
            if each.is_outer:
                raise UnsupportedModelError(
                    f"the front end does not carry an inner {each.kind} {each.name} through to the outer one of "
                    f"{scope.definition.name}",
                    place=replace(place_of(each.extent), component=model),
                    remedy=f"declare it there as replaceable {each.kind} {each.name} and redeclare it where "
                    f"{scope.definition.name} is used, or put it into an outer component: world.f(x)",
                )
