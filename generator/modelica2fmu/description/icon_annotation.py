"""Reads the icon of a class: the Icon annotations of the class and of its bases (Modelica 3.6, section 18.6)."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final, Union

from modelica2fmu.library.class_text import ClassText, class_texts

_TOKEN: Final = re.compile(r'\s*("(?:[^"\\]|\\.)*"|[\d.]+(?:[eE][-+]?\d+)?|[A-Za-z_][\w.]*|.)', re.DOTALL)
_EXTENDS: Final = re.compile(r"\bextends\s+(\.?[A-Za-z_][\w.]*)")
_END: Final = re.compile(r"\bend\s+[A-Za-z_]\w*\s*;")
_DEPTH_LIMIT: Final = 10  # of bases, and of what is nested in an annotation
_LONGEST: Final = 200_000  # characters of an annotation

Item = Union[float, str, list["Item"], "Call"]


@dataclass(frozen=True)
class Call:
    """A record of an annotation: ``Name(positional, name = value)``."""

    name: str
    items: tuple[Item, ...] = ()
    named: dict[str, Item] = field(default_factory=dict)


@dataclass(frozen=True)
class Icon:
    """What an icon shows, bases first.

    Attributes:
        extent: left, bottom, right and top of the coordinate system.
        graphics: records ``Line``, ``Polygon``, ``Rectangle``, ``Ellipse``, ``Text`` and ``Bitmap``.
    """

    extent: tuple[float, float, float, float]
    graphics: tuple[Call, ...]


def read_icon(model: str, sources: Sequence[Path]) -> Icon | None:
    """The icon of a class with those it inherits; None where there is none.

    Args:
        model: full name.
        sources: Modelica files, package folders, and folders that contain packages, where bases are looked for too.
    """
    found = list(_annotations(model, sources, 0))
    graphics = tuple(shape for annotation in found for shape in _graphics(annotation))
    if not graphics:
        return None
    return Icon(_extent(found[-1]), graphics)


def read_annotation(text: str) -> Item:
    """The number, text (with its quotes), name, array or record that a text begins with.

    Raises:
        ValueError: it does not end.
        RecursionError: it is nested too deeply.
    """
    return _Reader(text).item()


def _annotations(name: str, sources: Sequence[Path], depth: int) -> Iterator[Call]:
    text = next(class_texts(name, sources), None)
    if text is None or depth > _DEPTH_LIMIT:
        return
    for base in _EXTENDS.findall(text.plain):
        resolved = _resolved(base, name, sources)
        if resolved is not None:
            yield from _annotations(resolved, sources, depth + 1)
    own = _own_annotation(text)
    if own is not None:
        yield own


def _resolved(base: str, inside: str, sources: Sequence[Path]) -> str | None:
    """Full name of a base: looked for in the packages around the class, from the inside out."""
    if base.startswith("."):
        return base[1:]
    scope = inside.split(".")[:-1]
    for count in range(len(scope), -1, -1):
        name = ".".join([*scope[:count], base])
        if name != inside and next(class_texts(name, sources), None) is not None:
            return name
    return None


def _own_annotation(text: ClassText) -> Call | None:
    """The last Icon, unless it belongs to a class inside of this one."""
    places = [match.start() for match in re.finditer(r"\bIcon\s*\(", text.plain)]
    if not places or _END.search(text.plain, places[-1]):
        return None
    try:
        item = read_annotation(text.text[places[-1] : places[-1] + _LONGEST])
    except (ValueError, RecursionError):
        return None  # an icon that cannot be read is none: the model is good without
    return item if isinstance(item, Call) else None


def _graphics(annotation: Call) -> list[Call]:
    shapes = annotation.named.get("graphics", [])
    return [shape for shape in shapes if isinstance(shape, Call)] if isinstance(shapes, list) else []


def _extent(annotation: Call) -> tuple[float, float, float, float]:
    systems = [item for item in annotation.items if isinstance(item, Call) and item.name == "coordinateSystem"]
    numbers = _flat(systems[0].named.get("extent", [])) if systems else []
    if len(numbers) != 4 or numbers[0] == numbers[2] or numbers[1] == numbers[3]:
        return -100.0, -100.0, 100.0, 100.0
    return min(numbers[::2]), min(numbers[1::2]), max(numbers[::2]), max(numbers[1::2])


def _flat(item: Item) -> list[float]:
    if isinstance(item, list):
        return [number for each in item for number in _flat(each)]
    return [item] if isinstance(item, float) else []


class _Reader:
    """Reads what annotations are made of; names and operators that are no numbers stay text."""

    def __init__(self, text: str) -> None:
        self._tokens = _TOKEN.finditer(text)
        self._next = ""
        self._depth = 0
        self._advance()

    def _advance(self) -> str:
        taken = self._next
        match = next(self._tokens, None)
        self._next = match[1] if match else ""
        return taken

    def item(self) -> Item:
        """A number, text, name, array or record; raises ValueError at the end of the text."""
        self._depth += 1
        if not self._next or self._depth > 4 * _DEPTH_LIMIT:
            raise ValueError("an annotation that does not end")
        token = self._advance()
        result: Item
        if token == "{":
            result = self._list("}")
        elif token in ("-", "+"):
            value = self.item()
            result = -value if isinstance(value, float) and token == "-" else value
        elif self._next == "(" and re.match(r"[A-Za-z_]", token):
            self._advance()
            result = self._record(token)
        elif token[0].isdigit() or (token[0] == "." and len(token) > 1):
            result = float(token)
        else:
            result = token
        self._depth -= 1
        return result

    def _list(self, end: str) -> list[Item]:
        items: list[Item] = []
        while self._next != end:
            items.append(self.item())
            self._skip_to(",", end)
        self._advance()
        return items

    def _record(self, name: str) -> Call:
        items: list[Item] = []
        named: dict[str, Item] = {}
        while self._next != ")":
            item = self.item()
            if self._next == "=" and isinstance(item, str):
                self._advance()
                named[item] = self.item()
            else:
                items.append(item)
            self._skip_to(",", ")")
        self._advance()
        return Call(name.rsplit(".", 1)[-1], tuple(items), named)

    def _skip_to(self, separator: str, end: str) -> None:
        """Passes over the rest of an expression that is no literal."""
        while self._next not in (separator, end):
            self.item()
        if self._next == separator:
            self._advance()
