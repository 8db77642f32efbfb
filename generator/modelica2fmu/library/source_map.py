"""From the front end's spans to file and line."""

from __future__ import annotations

import os
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from contact_foundation.errors import Place

_FNV_OFFSET = 0xCBF29CE484222325
_FNV_PRIME = 0x100000001B3


def source_number(path: str, number: int = _FNV_OFFSET) -> int:
    """The front end's number of a source file: FNV-1a (64 bit) of the path it was given.

    Args:
        path: its end where ``number`` is that of what stands before.
        number: that of an empty text.
    """
    for byte in path.encode():
        number = (number ^ byte) * _FNV_PRIME & 0xFFFFFFFFFFFFFFFF
    return number


@dataclass(frozen=True)
class Span:
    """Where in the sources something stands: the front end's number of the file and byte offsets."""

    source: int
    start: int
    end: int


class SourceMap:
    """Finds the file and the line of a span.

    Files are only looked for when a place is first asked for, that is, when there is something to report.

    Args:
        roots: files and folders that were given to the front end.
    """

    def __init__(self, roots: Sequence[Path]) -> None:
        self._roots = tuple(roots)
        self._copies: dict[int, Path] = {}
        self._views: dict[Path, Path] = {}
        self._texts: dict[Path, bytes] = {}
        self._files: dict[int, Path] | None = None

    def add_copy(self, given: Path, original: Path) -> None:
        """Tells that the front end was given ``given`` in place of ``original``, which may be a copy itself."""
        self._copies[source_number(str(given))] = self._original(original)
        self._files = None

    def add_text(self, original: Path, text: str) -> None:
        """Tells that the front end was given another text of the same lines in place of a file's."""
        self._texts[self._original(original)] = text.encode()

    def forget_texts(self) -> None:
        """Tells that the front end is given what stands in files, after all."""
        self._texts.clear()

    def _original(self, path: Path) -> Path:
        return self._copies.get(source_number(str(path)), path)

    def text(self, path: Path) -> bytes:
        """What the front end was given as the text of a file; it is read once."""
        if path not in self._texts:
            self._texts[path] = path.read_bytes()
        return self._texts[path]

    def add_view(self, given: Path, original: Path) -> None:
        """Tells that the front end was given a folder ``given`` that shows ``original``, which may be a view itself."""
        self._views[given] = self._views.get(original, original)
        self._files = None

    def place(self, span: Span | None, component: str | None = None) -> Place:
        """The place of ``span``; without file where it is not known."""
        if span is None:
            return Place(component=component)
        path = self._known_files().get(span.source)
        if path is None:
            return Place(component=component)
        line = self.text(path).count(b"\n", 0, span.start) + 1
        return Place(file=path, line=line, component=component)

    def excerpt(self, span: Span | None) -> str:
        """What stands there; empty where the file is not known."""
        path = None if span is None else self._known_files().get(span.source)
        if span is None or path is None:
            return ""
        return self.text(path)[span.start : span.end].decode(errors="replace")

    def source_text(self, span: Span) -> bytes:
        """The text of the file that it stands in; empty where that is not known."""
        path = self._known_files().get(span.source)
        return b"" if path is None else self.text(path)

    def _known_files(self) -> dict[int, Path]:
        if self._files is None:
            self._files = dict(self._copies)
            for given, original in self._views.items():
                self._files.update(_numbered(original, {given}))
            for root in self._roots:
                self._files.update(_numbered(root, {root, root.resolve()}))
        return self._files


def _numbered(root: Path, names: Collection[Path]) -> Iterator[tuple[int, Path]]:
    """A file, or the Modelica files below a folder, by their numbers where the root has other names."""
    if not root.is_dir():
        yield from ((source_number(str(name)), root) for name in names)
        return
    for folder, _, files in os.walk(root):
        below = Path(folder).relative_to(root)
        begun = [source_number(f"{name / below}{os.sep}") for name in names]
        for file in files:
            if file.endswith(".mo"):
                path = Path(folder, file)
                for number in begun:
                    yield source_number(file, number), path
                if path.is_symlink():
                    yield source_number(str(path.resolve())), path
