"""Arrays that modify all elements of an array of components, of which the front end gives each element a wrong piece.

``P o[3](k = [a, b, c])`` with vectors gives ``o[1].k`` the first row, and ``P o[2, 3](k = {i + j for i in 1:3, j in
1:2})`` is ``{{i + j for i in 1:3} for j in 1:2}`` (Modelica 3.6, sections 10.4.2 and 10.4.1.1). rumoca 0.10 takes the
elements that are written between commas for rows, and the first iterator for the outermost. Of ``P o[2, 2](k = {{1, 2},
ones(2)})``, lists beside rows of another kind, it gives all further elements the last one of the first list.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Final

from modelica2fmu.crosscheck.class_syntax import Extent

_NUMBER: Final = re.compile(r"(?<![\w.])(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?")
_NOT_PLAIN: Final = re.compile(r"[\w{\[\"]")
_ITERATORS: Final = re.compile(r"\bfor\s+\w+\s+in\b[^{}]*,\s*\w+\s+in\b[^{}]*\}$", re.DOTALL)
_VECTORS: Final = "give the array a name, parameter Real rows[:, :] = [a, b], and its name to the components"
_NESTED: Final = (
    "give the array a name, with the last iterator outermost, parameter Real rows[:, :] = {{... for i in ...} for j in"
    " ...}, and its name to the components"
)
_ROWS: Final = "give the array a name, parameter Real rows[:, :] = {{1, 2}, ones(2)}, and its name to the components"
_FOR: Final = re.compile(r"\bfor\b")


def remedy_of_pieces(text: str) -> str | None:
    """What to write in place of an array whose pieces are wrong; None for one that is taken apart rightly.

    Args:
        text: the whole array as written.
    """
    if text.startswith("[") and text.endswith("]"):
        return _VECTORS if _NOT_PLAIN.search(_NUMBER.sub("", text[1:-1])) else None
    return _NESTED if text.startswith("{") and _ITERATORS.search(text) else None


def remedy_of_rows(text: str, piece: int) -> str | None:
    """The same for numbers in rows that are not all of one kind.

    Args:
        text: the whole array as written.
        piece: where in it what a number is given begins.
    """
    rows = _rows(text)
    lists = [row for row in rows if row.startswith("{") and not _FOR.search(row)]
    before = text[:piece]
    is_in_row = before.count("{") - before.count("}") > 1
    return _ROWS if is_in_row and 0 < len(lists) < len(rows) else None


def _rows(text: str) -> list[str]:
    """What stands between the commas of an array in braces; none of a comprehension."""
    if not (text.startswith("{") and text.endswith("}")):
        return []
    rows, depth, begin = [], 0, 1
    for place, letter in enumerate(text):
        depth += (letter in "{([") - (letter in "})]")
        if (letter == "," and depth == 1) or (letter == "}" and depth == 0):
            rows.append(text[begin:place].strip())
            begin = place + 1
    return [] if any(_FOR.search(re.sub(r"\{.*\}|\(.*\)", "", row, flags=re.DOTALL)) for row in rows) else rows


def is_piece(places: Iterable[Extent], whole: Extent) -> bool:
    """= true, if an expression with these places is a part of what is written in a range, its brackets aside."""
    inner = [place for place in places if whole.holds(place.file, place.start)]
    if not inner:
        return False
    start, end = min(place.start for place in inner), max(place.end for place in inner)
    return start > whole.start + 1 or end < whole.end - 1
