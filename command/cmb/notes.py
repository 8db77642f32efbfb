"""Notes on many parts in few lines."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Final

_NAME: Final = re.compile(r"'[^']*'")
_SHOWN: Final = 3


def grouped(notes: Iterable[str]) -> list[str]:
    """The notes, each once; those that differ in the first name they quote alone are one, in the place of the first.

    Its line has the first three of the names and how many more there are.
    """
    groups: dict[tuple[str, str], list[str]] = {}
    for note in dict.fromkeys(notes):
        name = _NAME.search(note)
        before, quoted, after = (note[: name.start()], name[0], note[name.end() :]) if name else (note, "", "")
        groups.setdefault((before, after), []).append(quoted)
    return [_line(before, names, after) for (before, after), names in groups.items()]


def _line(before: str, names: list[str], after: str) -> str:
    if len(names) == 1:
        return f"{before}{names[0]}{after}"
    more = f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else ""
    return f"{len(names)} times: {before}{', '.join(names[:_SHOWN])}{more}{after}"
