"""Names the packages whose inherited classes a model uses by names with dots, as ``Water.Properties p``.

rumoca 0.10 loads what a text names, and looks for a class that a package inherits only once that package itself is
named: an import does that.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Final

from modelica2fmu.crosscheck.class_instances import ClassInstance, UnknownError
from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.class_syntax import ClassDefinition
from modelica2fmu.crosscheck.class_tokens import UnreadableError
from modelica2fmu.crosscheck.own_classes import own_classes_of

Insertion = tuple[int, str]

_ALIAS: Final = "cmbPackage"  # a name that no class has


def imports_of_packages(model: str, library: ClassLibrary, own: Path) -> dict[Path, Insertion]:
    """What to insert into files, in the line that it stands in: a place in bytes, and the text.

    Args:
        model: full name; classes that it does not use stay as they are.
        library: the sources.
        own: file or folder of the user's own classes.
    """
    packages: dict[Path, dict[str, None]] = {}
    for scope in own_classes_of(model, library, own):
        definition = scope.definition
        names = [component.type_name for component in definition.components.values()]
        names += [base.type_name for base in definition.bases]
        for name in names:
            package = _package_that_inherits(scope, name, library)
            if package is not None:
                packages.setdefault(definition.extent.file, {})[package] = None
    inserted: dict[Path, Insertion] = {}
    for file, found in packages.items():
        place = _behind_the_header(file, library)
        if place is not None:
            imports = (f" import {_ALIAS}{number} = {name};" for number, name in enumerate(found, 1))
            inserted[file] = place, "".join(imports)
    return inserted


def _package_that_inherits(scope: ClassInstance, name: tuple[str, ...], library: ClassLibrary) -> str | None:
    """The full name of the package from which a class is taken that it inherits."""
    if len(name) < 2 or name[0] == "":
        return None
    try:
        holder = scope.lookup(name[:-1])
        if library.member(holder.definition, name[-1]) is not None or holder.class_element(name[-1]) is None:
            return None
    except (UnknownError, UnreadableError, RecursionError):
        return None
    around = list(_around(holder))
    if any(each.kind != "package" for each in around):
        return None
    return ".".join(each.name for each in reversed(around))


def _around(instance: ClassInstance) -> Iterator[ClassDefinition]:
    each: ClassInstance | None = instance
    while each is not None:
        yield each.definition
        each = each.parent


def _behind_the_header(file: Path, library: ClassLibrary) -> int | None:
    """Where the elements of the first class of a file begin: behind its name and comment."""
    for definition in library.classes_of(file):
        if definition.is_short:
            continue
        tokens = library.tokens(definition.extent)
        number = next(at for at, token in enumerate(tokens) if token.text == definition.name) + 1
        while tokens[number].kind == "string" or tokens[number].text == "+":
            number += 1
        return definition.extent.start + tokens[number - 1].end
    return None


def with_imports(text: str, imports: Insertion | None) -> str:
    """A file's text with its imports."""
    if imports is None:
        return text
    at, addition = imports
    code = text.encode("utf-8", errors="surrogateescape")
    return (code[:at] + addition.encode() + code[at:]).decode("utf-8", errors="surrogateescape")
