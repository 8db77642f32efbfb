"""Names that resemble one that is not known."""

from __future__ import annotations

import difflib
from collections.abc import Iterable

_MOST = 3
_LEAST_LIKENESS = 0.5


def did_you_mean(name: str, known: Iterable[str]) -> str | None:
    """A question that names the known names nearest to a wrong one; ``None`` where none is near."""
    by_small = {each.lower(): each for each in known}
    near = difflib.get_close_matches(name.lower(), by_small, n=_MOST, cutoff=_LEAST_LIKENESS)
    return f"did you mean {', '.join(by_small[each] for each in near)}?" if near else None
