"""A self-contained HTML page of sections with tiles, plots, tables and an animation."""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from dataclasses import dataclass
from importlib import metadata
from importlib.resources import files
from typing import Any

from jinja2 import Environment, StrictUndefined
from markupsafe import Markup
from scene_viewer.bundle import MISSING, REMEDY, bundled, is_installed

from fmu_regression.report.plots import Plot, encode_plots

_END_OF_SCRIPT = re.compile(r"<(/script|!--)", re.IGNORECASE)
_SPEEDS: tuple[tuple[float, str], ...] = (
    (0.01, "1/100 speed"),
    (0.05, "1/20 speed"),
    (0.1, "1/10 speed"),
    (0.25, "1/4 speed"),
    (0.5, "1/2 speed"),
    (1.0, "real time"),
    (2.0, "2 × speed"),
    (5.0, "5 × speed"),
)


@dataclass(frozen=True)
class Tile:
    """A number with its name; state is "good", "bad" or ""."""

    name: str
    value: str
    unit: str = ""
    more: str = ""
    state: str = ""


@dataclass(frozen=True)
class Cell:
    """A cell of a table; kind is a blank-separated list of "text", "good", "bad"."""

    text: str
    kind: str = ""


@dataclass(frozen=True)
class Column:
    """A column's heading; kind "text" aligns left."""

    title: str
    kind: str = ""


@dataclass(frozen=True)
class Row:
    """A row of a table; with a time, a click on it shows that moment in the animation."""

    cells: tuple[Cell, ...]
    time: str | None = None


@dataclass(frozen=True)
class Table:
    """A table."""

    columns: tuple[Column, ...]
    rows: tuple[Row, ...]


@dataclass(frozen=True)
class ColorKey:
    """What a colour stands for; color in CSS."""

    label: str
    color: str


@dataclass(frozen=True)
class Animation:
    """The animation of a page: data for the viewer and playback.js, and the key of colours; duration in s."""

    data: dict[str, Any]
    key: tuple[ColorKey, ...]
    duration: float


@dataclass(frozen=True)
class Section:
    """A part of a page; what it does not have is left out."""

    identity: str
    title: str
    lead: str = ""
    tiles: tuple[Tile, ...] = ()
    animation: Animation | None = None
    plots: tuple[Plot, ...] = ()
    tables: tuple[Table, ...] = ()
    notes: tuple[str, ...] = ()


def render_page(title: str, subtitle: str, sections: Sequence[Section]) -> str:
    """The page's HTML; no part of it comes from elsewhere, and the same input gives the same text.

    Where the viewer's scripts are not installed, the page says so in place of animation and plots.
    """
    animation = next((section.animation for section in sections if section.animation is not None), None)
    plots = [plot for section in sections for plot in section.plots]
    drawn, installed = bool(plots or animation), is_installed()
    style, scripts = [asset("report.css")], []
    data: dict[str, Any] = {"plots": encode_plots(plots)}
    if animation is not None:
        data["animation"] = animation.data
    if drawn and installed:
        style.append(bundled("plots.css"))
        viewer = [bundled("viewer.js"), asset("playback.js")] if animation is not None else []
        scripts = [bundled("plots.js"), *viewer, asset("report.js")]
    environment = Environment(autoescape=True, undefined=StrictUndefined, keep_trailing_newline=True)
    template = environment.from_string(asset("report.html.j2"))
    text = template.render(
        title=title,
        subtitle=subtitle,
        sections=[
            {
                "id": section.identity,
                "title": section.title,
                "lead": section.lead,
                "tiles": section.tiles,
                "animation": section.animation,
                "plots": [plot.identity for plot in section.plots],
                "tables": section.tables,
                "notes": section.notes,
            }
            for section in sections
        ],
        speeds=_SPEEDS,
        speed=_default_speed(animation.duration) if animation is not None else 1.0,
        missing=f"{MISSING} {REMEDY}" if drawn and not installed else "",
        style=Markup("\n".join(style)),
        script=Markup(_END_OF_SCRIPT.sub(r"<\\\1", "\n".join(scripts))),
        # "<" never appears in the data, so that it cannot end the script element.
        data=Markup(json.dumps(data, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")),
        footer=f"ContactMultiBody {_version()}. Drag across a plot to zoom, double-click to show all; "
        "click to move the animation there.",
    )
    return text.encode("utf-8", "replace").decode("utf-8")  # names of files may hold bytes that are no characters


def _default_speed(duration: float) -> float:
    """The fastest speed, at most real time, at which the animation lasts five seconds."""
    return max((value for value, _ in _SPEEDS if value <= min(1.0, duration / 4)), default=_SPEEDS[0][0])


def asset(name: str) -> str:
    """Text of a file of the page: a style, a script or the template."""
    return files("fmu_regression.report").joinpath("assets", name).read_text(encoding="utf-8")


def _version() -> str:
    try:
        return metadata.version("contactmultibody")
    except metadata.PackageNotFoundError:
        return ""
