"""Lets models call ``Modelica.Utilities.Files.loadResource``, whose meaning the language leaves to the tool.

Here a ``modelica://`` name stays as it is until geometry files are written out (:mod:`modelica2fmu.geometry_files`), so
the function returns its argument. The Standard Library's own one inherits from two functions, which the front end does
not take; models that call it see the library through links, with that one function in the tool's version.
"""

from __future__ import annotations

import re
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Final

_CALL: Final = re.compile(r"\bloadResource\s*\(\s*(?!\\)")  # \" is a text in a documentation
_FILE: Final = Path("Modelica", "Utilities", "Files.mo")
_IMPLEMENTATION: Final = re.compile(
    r"(\bfunction\s+loadResource\b(?:(?!\bend\s+loadResource\b).)*?)"
    r"extends\s+[\w.]+\.PartialLoadResource\s*;\s*extends\s+ModelicaServices\.ExternalReferences\.loadResource\s*;",
    re.DOTALL,
)
_RETURNS_ITS_ARGUMENT: Final = (
    r"\1input String uri; output String fileReference; algorithm fileReference := uri;"  # on one line: lines stay
)


@contextmanager
def library_with_resource_names(library: Path, sources: Sequence[Path]) -> Iterator[Path]:
    """Yields a folder of the library in which ``loadResource`` can be called, ``library`` itself where that will do.

    Args:
        library: folder that contains the package Modelica.
        sources: files and package folders of the model.
    """
    text = _own_version(library) if any(_calls(source) for source in sources) else None
    if text is None:
        yield library
        return
    with tempfile.TemporaryDirectory(prefix="cmb-msl-") as name:
        folder, original = Path(name), library
        for part in _FILE.parts:
            for path in original.iterdir():
                if path.name != part:
                    (folder / path.name).symlink_to(path.resolve())
            folder, original = folder / part, original / part
            if part != _FILE.name:
                folder.mkdir()
        folder.write_text(text, encoding="utf-8")
        yield Path(name)


def _own_version(library: Path) -> str | None:
    """The text of the library's package Files with the tool's function; None where there is nothing to replace."""
    file = library / _FILE
    if not file.is_file():
        return None
    text, count = _IMPLEMENTATION.subn(_RETURNS_ITS_ARGUMENT, file.read_text(encoding="utf-8"), count=1)
    return text if count else None


def _calls(source: Path) -> bool:
    files = sorted(source.rglob("*.mo")) if source.is_dir() else [source]
    return any(_CALL.search(file.read_text(encoding="utf-8", errors="replace")) for file in files)
