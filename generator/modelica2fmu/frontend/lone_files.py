"""Hands single files to the front end without the files beside them.

rumoca reads every Modelica file in the folder of a file that it loads, as if they were one package. A file that is no
part of a package structure is a model by itself, whatever lies beside it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from contact_foundation.scratch import scratch_folder

from modelica2fmu.library.source_map import SourceMap


@dataclass(frozen=True)
class LoneFiles:
    """What the front end is given instead.

    Attributes:
        file: stands for the model's file; a name in a folder of its own, with nothing behind it if it is a lone file.
        roots: the folders as they were, lone files by folders that hold nothing else.
        names: the original of each file that was replaced.
    """

    file: Path
    roots: tuple[Path, ...]
    names: tuple[tuple[Path, Path], ...]

    def restored(self, text: str) -> str:
        """A message of the front end with the names that the user knows."""
        for given, original in self.names:
            text = text.replace(str(given), str(original))
        return text


@contextmanager
def apart(file: Path, roots: Sequence[Path], source_map: SourceMap) -> Iterator[LoneFiles]:
    """Sets single files apart from those beside them, as long as the context lasts.

    Args:
        file: that of the model: a file by itself, or a package's ``package.mo``.
        roots: folders that contain packages, and single files.
        source_map: is told what the front end gets.
    """
    with scratch_folder("sources") as folder:
        names: list[tuple[Path, Path]] = []

        def alone(original: Path) -> Path:
            given = folder / str(len(names)) / original.name
            given.parent.mkdir()
            names.append((given, original))
            source_map.add_copy(given, original)
            return given

        given_file = file if file.name == "package.mo" else alone(file)
        given_roots = []
        for root in roots:
            if root.is_file():
                copy = alone(root)
                copy.symlink_to(root.resolve())
                root = copy.parent
            given_roots.append(root)
        yield LoneFiles(given_file, tuple(given_roots), tuple(names))
