"""The files that code generation hands to packaging."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class GeneratedSource:
    """One generated file: C that is compiled, or a header.

    Attributes:
        name: file name without folder, ending in ``.c`` or ``.h``.
        text: its content.
    """

    name: str
    text: str
