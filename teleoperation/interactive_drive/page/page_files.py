"""The files that the page is made of: its own, the report's style, and the viewer and plots of all pages."""

from __future__ import annotations

from importlib.resources import files

from fmu_regression.report.page import asset
from scene_viewer.bundle import NAMES, bundled

_TYPES = {"html": "text/html; charset=utf-8", "js": "text/javascript; charset=utf-8", "css": "text/css; charset=utf-8"}
_OWN = ("drive.html", "drive.css", "drive.js", "drive_link.js", "drive_controls.js")


def page_file(name: str) -> tuple[str, str] | None:
    """Text and media type of a file of the page, or None if it has no such file."""
    if name in NAMES:
        text = bundled(name)
    elif name == "report.css":
        text = asset(name)
    elif name in _OWN:
        text = files("interactive_drive.page").joinpath("assets", name).read_text(encoding="utf-8")
    else:
        return None
    return text, _TYPES[name.rpartition(".")[2]]
