"""Which Modelica files a model is made of."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from contact_data import modelica_library
from contact_foundation.errors import InputError, Place

from cmb.input_file import check_input


def find_sources(model: str, given: Sequence[Path]) -> tuple[Path, ...]:
    """The sources the user names, the model's package if it lies in the working directory, and the contact library.

    Args:
        model: qualified name, e.g. ``ContactMultiBody.Examples.BallOnFloor``.
        given: Modelica files and package folders.

    Raises:
        InputError: one of them does not exist, or the model is named by its file.
    """
    if model.endswith(".mo"):
        name = Path(model).stem
        raise InputError(
            "is a file, where the model's name is asked for",
            place=Place(file=Path(model)),
            remedy=f"Give the name, and the file as its source: {name} --source {model}",
        )
    check_input(*given)
    package = model.split(".")[0]
    here = (path for path in (Path(package), Path(f"{package}.mo")) if path.exists())
    return tuple(dict.fromkeys(path.resolve() for path in (*given, *here, modelica_library())))
