"""Pieces of Modelica files with other texts in some places."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import replace
from typing import NamedTuple

from modelica2fmu.crosscheck.class_instances import ClassInstance
from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.class_syntax import Extent
from modelica2fmu.library.class_text import COMMENTS_AND_STRINGS


class CannotError(Exception):
    """A package is written in a way that is not written out here."""


class Edit(NamedTuple):
    """Another text between two places of a file, in bytes."""

    start: int
    end: int
    text: str


def edited(library: ClassLibrary, extent: Extent, edits: Iterable[Edit]) -> str:
    """What stands in a range, with its edits; those outside of it are left out."""
    pieces, at = list[str](), extent.start
    for start, end, text in sorted(edits):
        if start < at or end > extent.end:
            continue
        pieces += [library.text(replace(extent, start=at, end=start)), text]
        at = end
    return "".join((*pieces, library.text(replace(extent, start=at))))


def full_name(instance: ClassInstance) -> str:
    """The name of a class that means the same everywhere; raises CannotError if there is none."""
    path = list[str]()
    each: ClassInstance | None = instance
    while each is not None:
        if each.is_modified or (each is not instance and each.definition.kind != "package"):
            raise CannotError(each.definition.name)
        path.append(each.definition.name)
        each = each.parent
    return "." + ".".join(reversed(path))


def lies_in(inner: Extent, outer: Extent) -> bool:
    """= true, if a range is part of another one."""
    return inner.file == outer.file and outer.start <= inner.start and inner.end <= outer.end


def in_one_line(text: str) -> str:
    """The same without comments and line breaks."""
    code = COMMENTS_AND_STRINGS.sub(lambda found: _in_one_line(found[0]) if found[0][0] == '"' else " ", text)
    return re.sub(r"\s*[\r\n]\s*", " ", code).strip()


def _in_one_line(string: str) -> str:
    return string.replace("\r", "").replace("\n", "\\n")
