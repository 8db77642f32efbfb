"""Files that a model names: geometry, and tables."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from contact_foundation.errors import InputError

from modelica2fmu.library.external_code import SCHEME, resource_path


class NamedFiles:
    """Finds the files that a model names, and knows afterwards which these were.

    Args:
        roots: folders that contain the packages of ``modelica://`` names, or are packages themselves.
        model_file: that holds the model.
    """

    def __init__(self, roots: Sequence[Path], model_file: Path) -> None:
        self._roots = roots
        self._folder = model_file.parent
        self._found: dict[Path, None] = {}

    def find(self, name: str) -> Path:
        """The file that a ``modelica://`` or ``file://`` name means, or a path, relative to the model's folder.

        Raises:
            InputError: no package has such a file.
        """
        if name.lower().startswith(SCHEME):
            found = resource_path(name, self._roots)
            if found is None:
                raise InputError(f"there is no file {name}", remedy="check the name of the package and of the file")
        else:
            found = self._folder / name.removeprefix("file://")
        self._found[found] = None
        return found

    @property
    def found(self) -> tuple[Path, ...]:
        """The files so far that exist, each once."""
        return tuple(path for path in self._found if path.is_file())
