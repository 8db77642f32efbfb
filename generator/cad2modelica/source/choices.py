"""What the user may say about the reading of a source."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class SourceChoices:
    """Choices of the reading.

    Attributes:
        package_paths: folders whose files may be read beside those of the source's own folder: packages that references
            name, or folders that hold such packages.
        allow_missing: whether geometry that is named but cannot be read, and mates that no joint stands for, are left
            out with a note, instead of an error.
        density: of bodies that have geometry and no mass, kg/m3; None: they have no mass.
        tessellation: largest distance of triangles from the faces of STEP parts, m; None: a thousandth of a part's
            size.
    """

    package_paths: tuple[Path, ...] = ()
    allow_missing: bool = False
    density: float | None = None
    tessellation: float | None = None


DEFAULT_CHOICES = SourceChoices()
