"""Whether the user's classes declare as ``outer`` what rumoca 0.10 does not take from the inner one.

It takes outer classes themselves; outer variables are left without an equation; and a name of an element that is
``inner outer`` means the inner one.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from contact_foundation.errors import Place, UnsupportedModelError

from modelica2fmu.crosscheck.class_instances import ClassInstance, UnknownError
from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.class_syntax import ComponentDeclaration, Extent
from modelica2fmu.crosscheck.class_tokens import UnreadableError
from modelica2fmu.crosscheck.own_classes import found_class, own_classes_of


def check_outer_elements(model: str, library: ClassLibrary, own: Path, place_of: Callable[[Extent], Place]) -> None:
    """Refuses outer classes and variables (Modelica 3.6, section 5.4); other outer components are right.

    Args:
        model: full name.
        library: the sources.
        own: file or folder of the user's own classes.
        place_of: the place of a range of a file.

    Raises:
        UnsupportedModelError: a class that the model uses declares one.
    """
    for scope in own_classes_of(model, library, own):
        for each in scope.definition.classes.values():
            if each.is_outer:
                raise UnsupportedModelError(
                    f"the front end does not carry an inner {each.kind} {each.name} through to the outer one of "
                    f"{scope.definition.name}",
                    place=replace(place_of(each.extent), component=model),
                    remedy=f"declare it there as replaceable {each.kind} {each.name} and redeclare it where "
                    f"{scope.definition.name} is used, or put it into an outer component: world.f(x)",
                )
        for component in scope.definition.components.values():
            if component.is_outer:
                _check_component(component, scope, model, place_of)


def _check_component(
    component: ComponentDeclaration, scope: ClassInstance, model: str, place_of: Callable[[Extent], Place]
) -> None:
    name, around = component.name, scope.definition.name
    kind = ".".join(component.type_name)
    if component.is_inner:
        raise UnsupportedModelError(
            f"{name} of {around} is inner and outer: the front end takes its name in {around} for the inner one, the"
            " language for the outer one",
            place=replace(place_of(component.extent), component=model),
            remedy=f"declare it as outer {kind} {name} alone, and put what is to find other values into a class with"
            f" inner {kind} {name}",
        )
    if not component.is_parameter and _is_predefined(found_class(scope, component.type_name)):
        raise UnsupportedModelError(
            f"the front end does not carry an inner variable {name} through to the outer one of {around}",
            place=replace(place_of(component.extent), component=model),
            remedy=f"put it into a record: record Shared {kind} {name}; end Shared; then inner Shared shared({name} ="
            f" ...) and outer Shared shared, which {around} reads as shared.{name}",
        )


def _is_predefined(found: ClassInstance | None) -> bool:
    try:
        return found is not None and found.predefined is not None
    except (UnknownError, UnreadableError, RecursionError):
        return False
