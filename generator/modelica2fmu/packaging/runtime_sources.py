"""The C sources of the FMU runtime, which lie in folders by layer here and side by side in an FMU."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path
from typing import Final

_RUNTIME: Final = Path(str(files("modelica2fmu") / "runtime"))


def runtime_folders() -> tuple[Path, ...]:
    """The folders of the layers, among which the runtime's headers are found."""
    return tuple(sorted(path for path in _RUNTIME.iterdir() if path.is_dir()))


def runtime_files() -> tuple[Path, ...]:
    """All C files and headers, by name; no two have the same."""
    return tuple(sorted(_RUNTIME.glob("*/*.[ch]"), key=lambda path: path.name))


def runtime_file(name: str) -> Path:
    """The C file or header of a name.

    Raises:
        KeyError: there is none.
    """
    return {path.name: path for path in runtime_files()}[name]
