"""Finds the equation or binding that the front end refuses without a place.

What rumoca 0.10 finds only while it builds equations, such as arrays whose sizes do not fit, it tells without a line.
It is asked again about the model without some of its equations and bindings, until none of those left can be missed.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final

from contact_foundation.scratch import scratch_folder

from modelica2fmu.crosscheck.class_parser import parse
from modelica2fmu.crosscheck.class_syntax import (
    Base,
    ClassDefinition,
    ComponentDeclaration,
    Extent,
    Modifier,
    is_array,
)
from modelica2fmu.crosscheck.class_tokens import UnreadableError
from modelica2fmu.crosscheck.connections.connect_check import array_sizes
from modelica2fmu.frontend.assignments import neutral_assignments
from modelica2fmu.frontend.balance import unbalanced_form
from modelica2fmu.frontend.errors import COMPREHENSION, SHAPES
from modelica2fmu.frontend.library_names import about_a_copy
from modelica2fmu.frontend.piece import Piece
from modelica2fmu.frontend.runner import Answer, Request, ask

_STAGE: Final = re.compile(r" failed in ToDae: (.*)", re.DOTALL)
_BROKEN_OFF: Final = re.compile(rf"^({COMPREHENSION}.*)", re.DOTALL)
_GAP: Final = 200
_MOST_SUSPECTS: Final = 4
_GIVES: Final = re.compile(rb"(?::?=)\s*\Z")
_LEFT: Final = re.compile(r"\s*(\w+)\s*=")
# More than a name or a number, on which sizes may depend.
_NOT_PLAIN: Final = re.compile(rb"[\[{(*/+^:]|\w\s*-|-\s*[A-Za-z]")
# Sizes and branches depend on the values of such parameters, which are left as they are.
_COUNTS: Final = frozenset({"Integer", "Boolean", "String"})


@dataclass(frozen=True)
class _Model:
    """What the front end is asked about.

    Attributes:
        texts: of the files of the model.
        request: about it.
        file: that holds it.
    """

    texts: Mapping[Path, bytes]
    request: Request
    file: Path


def culprit(error: str, request: Request, file: Path, text: bytes) -> Piece | None:
    """The first of the few pieces that bring an error together; None if it is of another kind, or they are many.

    Args:
        error: of the front end.
        request: that it answers.
        file: that holds the model, as the request has it; ``package.mo`` stands for the files of its package.
        text: of that file.
    """
    said = _said(error)
    if said is None:
        return None
    texts = {each: each.read_bytes() for each in file.parent.rglob("*.mo")} if request.text is None else {file: text}
    try:
        classes = [each for name, text in texts.items() for each in parse(text, name).values()]
    except UnreadableError:
        return None
    pieces = [piece for each in classes for piece in _pieces(each, texts)]

    model = _Model(texts, request, file)

    def is_refused(left: Sequence[Extent]) -> bool:
        kept = set(left)
        return _said(_error_about(_without(texts, [each for each in pieces if each not in kept]), model)) == said

    if not pieces or is_refused(()):
        return None
    suspects = _conflict((), (), pieces, is_refused)
    if len(suspects) > _MOST_SUSPECTS or not is_refused(suspects):
        return None
    statement = None if SHAPES in said else _statement(classes, model, said)
    return _piece(statement or suspects[0], said, classes, model)


def _piece(found: Extent, said: str, classes: Sequence[ClassDefinition], model: _Model) -> Piece:
    """What is found, with what it is given to."""

    def text(extent: Extent) -> str:
        return model.texts[extent.file][extent.start : extent.end].decode(errors="replace")

    for each in _all(classes):
        elements: tuple[Base | ComponentDeclaration, ...] = (*each.bases, *each.components.values())
        for element in elements:
            argument = next((item for item in _values(element.arguments) if item.value == found), None)
            if argument is None:
                continue
            name = element.name if isinstance(element, ComponentDeclaration) else ""
            if isinstance(element, ComponentDeclaration) and is_array(element.sizes_of_type, text(element.extent)):
                return Piece(argument.extent, text(argument.extent), said, array=name)
            path = [name, *argument.path] if name else list(argument.path)
            is_direct = argument in element.arguments
            wanted = _size_without(found, "".join(f".{part}" for part in path), model) if is_direct else None
            return Piece(argument.extent, text(argument.extent), said, wanted=wanted)
        for name, component in each.components.items():
            of_equation = _LEFT.match(text(found)) if found in each.equations else None
            is_given = component.value == found or (of_equation is not None and of_equation[1] == name)
            kind = component.type_name[-1]
            if is_given and kind in _COUNTS and not is_array(component.sizes_of_type, text(component.extent)):
                return Piece(found, text(found), said, counted=(name, kind))
    return Piece(found, text(found), said)


def _size_without(piece: Extent, path: str, model: _Model) -> int | None:
    """The number of elements of the vector that a modifier is of, by the model without it; None where it is unknown."""
    answer = _answer_about(_without(model.texts, [piece]), model)
    if answer is None or answer.flat is None:
        return None
    sizes = {size for name, size in array_sizes(answer.flat["variables"]).items() if name.endswith(path)}
    return sizes.pop() if len(sizes) == 1 else None


def _all(classes: Iterable[ClassDefinition]) -> Iterator[ClassDefinition]:
    for each in classes:
        yield each
        yield from _all(each.classes.values())


def _values(arguments: Iterable[Modifier]) -> Iterator[Modifier]:
    """Modifiers with values, also those within others."""
    for argument in arguments:
        if argument.value is not None:
            yield argument
        yield from _values(argument.arguments)


def _conflict(
    kept: Sequence[Extent],
    added: Sequence[Extent],
    suspects: Sequence[Extent],
    is_refused: Callable[[Sequence[Extent]], bool],
) -> list[Extent]:
    """Pieces none of which can be left out for an error beside those that are kept, in order (Junker, AAAI 2004)."""
    if added and is_refused(kept):
        return []
    if len(suspects) == 1:
        return list(suspects)
    middle = len(suspects) // 2
    first, second = suspects[:middle], suspects[middle:]
    of_second = _conflict((*kept, *first), first, second, is_refused)
    return [*_conflict((*kept, *of_second), of_second, first, is_refused), *of_second]


def _statement(classes: Sequence[ClassDefinition], model: _Model, said: str) -> Extent | None:
    """The assignment in a function that brings the error to those who call it: zeros in its place end it."""
    texts = model.texts
    for extent, zeros in (each for one in classes for each in neutral_assignments(one, texts)):
        text = texts[extent.file]
        changed = {**texts, extent.file: text[: extent.start] + zeros + text[extent.end :]}
        if _said(_error_about(changed, model)) != said:
            return extent
    return None


def _said(error: str) -> str | None:
    """What an error says that the front end has no place for; None for other errors."""
    found = _STAGE.search(error) or _BROKEN_OFF.search(error)
    return None if found is None else found[1].split("\nRelated failures")[0].strip()


def _pieces(definition: ClassDefinition, texts: Mapping[Path, bytes]) -> Iterator[Extent]:
    """Equations, blocks of them, bindings and modifiers of a class and those in it, which it is a class without."""
    if definition.kind not in ("function", "package"):  # constants of packages belong to their users' sizes
        elements: tuple[Base | ComponentDeclaration, ...] = (*definition.bases, *definition.components.values())
        for argument in (each for element in elements for each in _values(element.arguments)):
            value = argument.value
            if value is not None and _NOT_PLAIN.search(texts[value.file][value.start : value.end]) is not None:
                yield value
        for component in definition.components.values():
            is_known = component.is_parameter and component.type_name[-1] in _COUNTS
            if component.value is not None and not is_known:
                yield component.value
        yield from definition.equations
        yield from definition.blocks
    for inner in definition.classes.values():
        yield from _pieces(inner, texts)


def _error_about(changed: Mapping[Path, bytes], model: _Model) -> str:
    """The front end's error about a model of other texts, in which equations may lack; empty if there is none."""
    answer = _answer_about(changed, model)
    return "" if answer is None else answer.error


def _answer_about(changed: Mapping[Path, bytes], model: _Model) -> Answer | None:
    request = model.request
    if request.text is not None:
        libraries = request.text[len(model.texts[model.file].decode()) :]
        return _answer(replace(request, text=changed[model.file].decode() + libraries))
    package = model.file.parent
    with scratch_folder("package") as folder:
        for original in package.rglob("*"):
            if original in changed or original.name == "package.order":
                copy = folder / package.name / original.relative_to(package)
                copy.parent.mkdir(parents=True, exist_ok=True)
                copy.write_bytes(changed.get(original) or original.read_bytes())
        return _answer(about_a_copy(request, package, folder))


def _answer(request: Request) -> Answer | None:
    form = unbalanced_form(request)
    return None if form is None else ask(form, lambda _remark: None)


def _without(texts: Mapping[Path, bytes], pieces: Sequence[Extent]) -> dict[Path, bytes]:
    """The texts with blanks for pieces, and for the equals signs before bindings; of the same lines."""
    changed = {file: bytearray(text) for file, text in texts.items()}
    for piece in pieces:
        text = changed[piece.file]
        gives = _GIVES.search(text, max(0, piece.start - _GAP), piece.start)
        start = piece.start if gives is None else gives.start()
        text[start : piece.end] = re.sub(rb"[^\n]", b" ", text[start : piece.end])
    return {file: bytes(text) for file, text in changed.items()}
