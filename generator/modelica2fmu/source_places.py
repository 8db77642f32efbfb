"""Where the sources of an FMU stand.

The same sources elsewhere give the same FMU, but where it names their places, as a model does that reads a file while
it runs, or a warning that says in which line something is.
"""

from __future__ import annotations

import hashlib
import re
import zipfile
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

# As these are written the same in XML, C and JSON, they can be looked for.
_PLAIN: Final = re.compile(r"[A-Za-z0-9_./+,:@~-]+")


@dataclass(frozen=True)
class SourcePlaces:
    """Places of sources, in their order.

    Attributes:
        given: files and folders as they were given.
        folders: those they stand in, or are, in full.
    """

    given: tuple[str, ...] = ()
    folders: tuple[str, ...] = ()

    @classmethod
    def of(cls, sources: Iterable[Path]) -> SourcePlaces:
        """The places of files and folders."""
        given = [(str(source), source.resolve()) for source in sources]
        folders = tuple(str(whole if whole.is_dir() else whole.parent) for _, whole in given)
        return cls(tuple(name for name, _ in given), folders)

    @property
    def names(self) -> frozenset[str]:
        """What messages and FMUs may name them by."""
        return frozenset((*self.given, *self.folders))

    def named(self, fmu: Path, messages: Sequence[str]) -> tuple[str, ...]:
        """Those names that a file in an FMU or a message of its build has, or might have.

        Raises:
            OSError: the FMU cannot be read.
        """
        with zipfile.ZipFile(fmu) as archive:
            contents = [archive.read(name) for name in archive.namelist()]
        contents.extend(message.encode() for message in messages)
        return tuple(
            name
            for name in sorted(self.names)
            if not _PLAIN.fullmatch(name) or any(name.encode() in content for content in contents)
        )

    def digests(self, files: Iterable[Path]) -> list[tuple[int, str, str]]:
        """What files hold: the number of the source beside which each stands, or -1, its path from there, SHA-256.

        Raises:
            OSError: one cannot be read.
        """
        return [(*self._shortened(file.resolve()), file_digest(file)) for file in files]

    def unchanged(self, digests: Iterable[tuple[int, str, str]]) -> tuple[Path, ...] | None:
        """The files beside these sources, and those that stand elsewhere; None if one holds something else now."""
        result = []
        try:
            for number, path, digest in digests:
                result.append(Path(self.folders[number]) / path if number >= 0 else Path(path))
                if file_digest(result[-1]) != digest:
                    return None
        except (OSError, IndexError):
            return None
        return tuple(result)

    def _shortened(self, file: Path) -> tuple[int, str]:
        for number, folder in enumerate(self.folders):
            if file.is_relative_to(folder):
                return number, str(file.relative_to(folder))
        return -1, str(file)


def file_digest(path: Path) -> str:
    """SHA-256 of what a file holds, in hexadecimal."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
