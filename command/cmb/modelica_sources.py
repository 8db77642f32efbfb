"""Which Modelica files a model is made of."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from cmb_base.errors import InputError, Place

from cmb.project import LIBRARY


def find_sources(model: str, given: Sequence[Path]) -> tuple[Path, ...]:
    """The package that holds a model, first, then the other sources and the contact library.

    Args:
        model: qualified name, e.g. ``ContactMultiBody.Examples.BallOnFloor``.
        given: Modelica files and package folders that the user names; the working directory is searched too.

    Raises:
        InputError: a given source does not exist, or no source holds the model's package.
    """
    for source in given:
        if not source.exists():
            raise InputError("does not exist", place=Place(file=source))
    top = model.split(".")[0]
    candidates = [*given, *(Path(name) for name in (top, f"{top}.mo")), *([LIBRARY] if top == LIBRARY.name else [])]
    holder = next((path for path in candidates if path.exists() and _holds(path, top)), None)
    if holder is None:
        raise InputError(
            f"no source holds the package {top}",
            place=Place(component=model),
            remedy=f"Name the file or folder with --source, or run cmb where {top} or {top}.mo lies.",
        )
    return tuple(dict.fromkeys([holder, *given, LIBRARY]))


def _holds(path: Path, package: str) -> bool:
    if path.is_dir():
        return path.resolve().name == package and (path / "package.mo").is_file()
    return path.stem == package or (path.name == "package.mo" and path.resolve().parent.name == package)
