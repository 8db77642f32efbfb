"""The official releases of the Modelica Standard Library, and which of them a library is."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

from modelica2fmu.library.standard_library import StandardLibrary

ADDRESS: Final = "https://github.com/modelica/ModelicaStandardLibrary/archive/refs/tags/v{version}.zip"
"""Where the Modelica Association publishes the sources of a release."""

RELEASES: Final[Mapping[str, str]] = MappingProxyType(
    {
        "4.1.0": "8ea17aa919253bf454ead0667cd0466eadd56ec4f0477259a91518ff8dfab5e1",
        "4.0.0": "213e694322743f552102292e41ebb9d68b819a9164244015b8c92d3055c85724",
    }
)
"""``content_digest`` of each release that can be installed, computed from the release's tag; the latest comes first."""

LATEST: Final = next(iter(RELEASES))

_SUFFIXES: Final = (".mo", ".order", ".c", ".h")
_STAMP: Final = re.compile(rb'revisionId\s*=\s*"[^"]*"')
_PICTURES: Final = "Images"


def content_digest(library: StandardLibrary) -> str:
    """SHA-256 of everything in a library that gets into models: Modelica and C code, names and contents.

    Archives of one release differ in their bytes; the digest does not depend on the order of files, on line ends,
    on versions in folder names and on the stamp that is written into packages when an archive is made. Pictures are
    left out.

    Raises:
        OSError: a file cannot be read.
    """
    lines = []
    for part, place in library.parts().items():
        for path in sorted(place.rglob("*")) if place.is_dir() else [place]:
            inner = path.relative_to(place).parts if place.is_dir() else ()
            if path.suffix not in _SUFFIXES or _PICTURES in inner or not path.is_file():
                continue
            name = "/".join((part, *inner)) if inner else f"{part}.mo"
            text = _STAMP.sub(b'revisionId=""', path.read_bytes().replace(b"\r\n", b"\n"))
            lines.append(f"{name}\0{hashlib.sha256(text).hexdigest()}\n")
    return hashlib.sha256("".join(sorted(lines)).encode()).hexdigest()


def release_of(digest: str) -> str | None:
    """The version of the official release with a digest; None if there is none."""
    return next((version for version, known in RELEASES.items() if known == digest), None)
