"""Which Modelica file holds a model, and which folders hold what it uses."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from contact_foundation.errors import InputError, Place


def locate(model: str, sources: Sequence[Path]) -> tuple[Path, list[Path]]:
    """The file to load for ``model``, and what else to load: folders with packages, and single files of other packages.

    Raises:
        InputError: a source does not exist, or none holds the model's package.
    """
    package = model.split(".")[0]
    file: Path | None = None
    roots: dict[Path, None] = {}
    for source in sources:
        if not source.exists():
            raise InputError("this source does not exist", place=Place(file=source))
        path = source.parent if source.name == "package.mo" else source
        if path.is_dir():
            inner = path if (path / "package.mo").is_file() else path / package
            if inner.name == package and (inner / "package.mo").is_file():
                file = file or inner / "package.mo"
            # The package's own folder: a front end may read every Modelica file below a root.
            roots[inner if (inner / "package.mo").is_file() else path] = None
        elif path.suffix == ".mo":
            if path.stem == package or _declares(path, package):
                file = file or path
            else:
                roots[path] = None  # not its folder, of which other files are no part of the model
        else:
            raise InputError("a source is a .mo file or a folder of a package", place=Place(file=source))
    if file is None:
        names = ", ".join(str(source) for source in sources)
        part = f", of which {model} is a part" if model != package else ""
        raise InputError(f"no source holds {package}{part}", remedy=f"these were given: {names or 'none'}")
    return file.resolve(), [root.resolve() for root in roots]


def _declares(file: Path, name: str) -> bool:
    pattern = re.compile(
        rf"^\s*(?:(?:encapsulated|partial)\s+)*(?:package|model|block|class)\s+{re.escape(name)}\b", re.MULTILINE
    )
    return pattern.search(file.read_text(encoding="utf-8", errors="replace")) is not None
