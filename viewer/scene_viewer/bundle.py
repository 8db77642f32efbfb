"""The bundled scripts: what pages embed or serve."""

from __future__ import annotations

from importlib.resources import files
from importlib.resources.abc import Traversable

from contact_foundation.errors import InputError

MISSING = "The viewer's scripts are not installed."
REMEDY = (
    "Call scripts/setup where npm's registry can be reached, or install the wheel of the project, which carries them."
)
NAMES = ("viewer.js", "plots.js", "plots.css")
"""The viewer (three.js; `contactViewer`), the plots (uPlot; `contactPlots`) and their style."""


def is_installed() -> bool:
    """Whether the scripts are there."""
    return all(_file(name).is_file() for name in NAMES)


def require_installed() -> None:
    """Refuses where the scripts are not there.

    Raises:
        InputError: they are not.
    """
    if not is_installed():
        raise InputError(MISSING.removesuffix("."), remedy=REMEDY)


def bundled(name: str) -> str:
    """Text of one of ``NAMES``.

    Raises:
        InputError: the scripts are not installed.
    """
    require_installed()
    return _file(name).read_text(encoding="utf-8")


def _file(name: str) -> Traversable:
    return files("scene_viewer").joinpath("bundle", name)
