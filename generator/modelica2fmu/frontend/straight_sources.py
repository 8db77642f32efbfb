"""What the front end is given of a model whose functions it does not follow."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from typing import Final

from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.frontend.rewriting.straight_line import straight_line
from modelica2fmu.frontend.written_sources import Sources, with_texts
from modelica2fmu.library.library_repairs import library_with
from modelica2fmu.library.source_map import SourceMap

# Where it does not understand what functions do, or how they are called.
_REFUSED: Final = re.compile(r"failed in ToDae|invalid call of function")
_STANDARD_FUNCTION: Final = re.compile(r"`(Modelica\.[\w.]+)`")


class StraightSources:
    """Sources with functions without control flow: the user's, and those of the Standard Library that are refused.

    Args:
        given: the sources as they are.
        file: the user's file that holds the model.
        folder: an empty one.
        source_map: is told what the front end gets.
    """

    def __init__(self, given: Sources, file: Path, folder: Path, source_map: SourceMap) -> None:
        self._given = given
        self._file = file
        self._folder = folder
        self._source_map = source_map
        self._own: dict[Path, str] | None = None
        self._library: dict[Path, str] = {}

    def after(self, words: str) -> Sources | None:
        """What to give next.

        Args:
            words: the front end's own after the last refusal.

        Returns:
            None where it says nothing of functions, or nothing of other functions than before.
        """
        if _REFUSED.search(words) is None:
            return None
        is_new = self._add_library_file(words)
        if self._own is None:
            self._own = self._own_texts()
            is_new |= bool(self._own)
        return self._sources(self._own) if is_new else None

    def _own_texts(self) -> dict[Path, str]:
        if self._given.library.own is None:
            return {}
        if self._given.request.text is None:
            files = sorted(self._given.file.parent.rglob("*.mo"))
            texts = {each: each.read_text(encoding="utf-8", errors="surrogateescape") for each in files}
        else:
            texts = {self._file: self._source_map.text(self._file).decode("utf-8", errors="replace")}
        return {each: after for each, text in texts.items() if (after := straight_line(text)) != text}

    def _add_library_file(self, words: str) -> bool:
        """= true, if a function of another file of the Standard Library is refused."""
        found = _STANDARD_FUNCTION.search(words)
        place = None if found is None else self._library_file(found[1])
        if place is None or place[1] in self._library:
            return False
        root, path = place
        self._library[path] = straight_line((root / path).read_text(encoding="utf-8", errors="surrogateescape"))
        return True

    def _library_file(self, name: str) -> tuple[Path, Path] | None:
        """The root and the file below it that holds a function."""
        for root in self._given.roots:
            if not (root / "Modelica" / "package.mo").is_file():
                continue
            path = Path()
            for part in name.split("."):
                if (root / path / f"{part}.mo").is_file():
                    return root, path / f"{part}.mo"
                if not (root / path / part / "package.mo").is_file():
                    break
                path /= part
            return root, path / "package.mo"
        return None

    def _sources(self, own: dict[Path, str]) -> Sources:
        given = self._given
        if self._library:
            roots = tuple(
                library_with(self._library, root, self._source_map) if (root / "Modelica").is_dir() else root
                for root in given.roots
            )
            text = self._source_map.text(self._file)
            request = replace(given.request, roots=tuple(map(str, roots)))
            given = replace(given, request=request, roots=roots, library=ClassLibrary(given.file, text, roots))
        folder = self._folder / f"straight{len(self._library)}"
        return with_texts(given, own, folder, self._source_map) if own else given
