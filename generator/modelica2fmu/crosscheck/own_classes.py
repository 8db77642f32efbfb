"""The classes of a model that its user wrote, and those that their components have."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from modelica2fmu.crosscheck.class_instances import ClassInstance, Names, UnknownError
from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.class_tokens import UnreadableError


def model_class(model: str, library: ClassLibrary) -> ClassInstance | None:
    """The class of a full name; ``None`` if it is not found."""
    try:
        return Names(library).find(tuple(model.split(".")))
    except (UnknownError, UnreadableError, RecursionError):
        return None


def own_classes_of(model: str, library: ClassLibrary, own: Path) -> Iterator[ClassInstance]:
    """``own_classes`` of a full name; none if it is not found.

    Args:
        model: full name.
        library: the sources.
        own: file or folder of the user's own classes; others are left out.
    """
    root = model_class(model, library)
    if root is not None:
        yield from own_classes(root, own)


def own_classes(root: ClassInstance, own: Path) -> Iterator[ClassInstance]:
    """The model, what it extends and the classes of its components, each once; what is not found is left out.

    Args:
        root: the model.
        own: file or folder of the user's own classes; others are left out.
    """
    waiting, seen = [root], set()
    while waiting:
        for each in _with_bases(waiting.pop(0), own):
            if each.definition.extent in seen:
                continue
            seen.add(each.definition.extent)
            yield each
            types = (found_class(each, component.type_name) for component in each.definition.components.values())
            waiting += [found for found in types if found is not None]


def found_class(scope: ClassInstance, name: tuple[str, ...]) -> ClassInstance | None:
    """The class that a name means; ``None`` if it is not found."""
    try:
        return scope.lookup(name)
    except (UnknownError, UnreadableError, RecursionError):
        return None


def _with_bases(instance: ClassInstance, own: Path) -> Iterator[ClassInstance]:
    if not instance.definition.extent.file.is_relative_to(own):
        return
    yield instance
    try:
        bases = instance.bases
    except (UnknownError, UnreadableError, RecursionError):
        return
    for base in bases:
        yield from _with_bases(base, own)
