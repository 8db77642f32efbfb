"""Whether records that the user writes as calls have the fields that are named there; the front end does not ask."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from contact_foundation.errors import InputError, Place
from contact_foundation.near_names import did_you_mean

from modelica2fmu.crosscheck.class_instances import ClassInstance, UnknownError
from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.class_syntax import ComponentDeclaration, Extent, Modifier
from modelica2fmu.crosscheck.class_tokens import Call, UnreadableError, calls_of
from modelica2fmu.crosscheck.own_classes import found_class, own_classes_of


def check_constructors(model: str, library: ClassLibrary, own: Path, place_of: Callable[[Extent], Place]) -> None:
    """Holds named arguments of records' constructors against the records' fields.

    Args:
        model: full name.
        library: the sources.
        own: file or folder of the user's own classes; others are taken as right.
        place_of: the place of a range of a file.

    Raises:
        InputError: an argument names no field.
    """
    check = _ConstructorCheck(model, library, place_of)
    for scope in own_classes_of(model, library, own):
        for extent in _expressions(scope):
            check.expression(extent, scope)


@dataclass(frozen=True)
class _ConstructorCheck:
    model: str
    library: ClassLibrary
    place_of: Callable[[Extent], Place]

    def expression(self, extent: Extent, scope: ClassInstance) -> None:
        """Raises InputError at the first argument of nothing in the calls of an expression."""
        # One character a byte, so that places in the text are places in the file.
        for call in calls_of(self.library.text(extent).encode()):
            fields = _fields(call, scope)
            wrong = next((each for each in call.arguments if fields and each.name and each.name not in fields), None)
            if wrong is not None:
                place = self.place_of(Extent(extent.file, extent.start + wrong.start, extent.start + wrong.end))
                raise InputError(
                    f"{'.'.join(call.name)} has no {wrong.name}",
                    place=Place(file=place.file, line=place.line, component=self.model),
                    remedy=did_you_mean(wrong.name, fields) or f"it has {', '.join(fields)}",
                )


def _fields(call: Call, scope: ClassInstance) -> list[str]:
    """Fields of the record that is called; none if it is no record, or one that is yet to be chosen."""
    try:
        found = found_class(scope, call.name)
        return found.fields() if found is not None and _is_record(found) else []
    except (UnknownError, UnreadableError, RecursionError):
        return []


def _is_record(found: ClassInstance) -> bool:
    return any(each.definition.kind == "record" for each in found.chain())


def _expressions(scope: ClassInstance) -> Iterator[Extent]:
    """Bindings, values of modifiers, equations and algorithms of a class."""
    definition = scope.definition
    for base in definition.bases:
        yield from _values(base.arguments)
    for component in definition.components.values():
        yield from _declared(component)
    yield from definition.behaviour


def _declared(component: ComponentDeclaration) -> Iterator[Extent]:
    if component.value is not None:
        yield component.value
    yield from _values(component.arguments)


def _values(arguments: Iterable[Modifier]) -> Iterator[Extent]:
    for argument in arguments:
        if argument.value is not None:
            yield argument.value
        if isinstance(argument.redeclared, ComponentDeclaration):
            yield from _declared(argument.redeclared)
        yield from _values(argument.arguments)
