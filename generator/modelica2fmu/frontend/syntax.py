"""Errors of syntax: what stands in the text, and what the front end's parser would have taken."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Final

from contact_foundation.errors import InputError, Place
from contact_foundation.modelica_keywords import KEYWORDS

from modelica2fmu.crosscheck.class_tokens import tokens_of
from modelica2fmu.frontend.runner import Answer

# One finding of the parser: its words, the place, a frame with the text, and what it would have taken.
_FINDING: Final = re.compile(
    r"EP\d+\s+× (?P<said>.*?)\n\s*╭─\[(?P<file>[^\[\]]+):(?P<line>\d+):\d+\].*?\n\s*╰─+"
    r"(?:\n\s*help: expected (?:one of: )?(?P<wanted>.*?))?(?:\n\s*\n|\s*\Z)",
    re.DOTALL,
)
# rumoca says so of each keyword that it does not expect, be it meant as a name or not.
_RESERVED: Final = re.compile(r"(`\w+`) is a reserved keyword in Modelica .*")
_FRAME: Final = re.compile(r"\s*\n\s*│\s*")
# rumoca's dump of what it has read: `: SimpleEquation { ...`.
_DUMP: Final = re.compile(r": \w+ \{.*", re.DOTALL)
_NO_EQUATION: Final = "Modelica only allows functional call statement as equation"
_FEW: Final = 3
# Keywords that can follow a name.
_BEHIND_NAME_TEXT: Final = """
algorithm and annotation constrainedby else elseif elsewhen end equation extends external for if in loop not or then
"""
_BEHIND_NAME: Final = frozenset(_BEHIND_NAME_TEXT.split())
# What follows the name of a component, beside a description.
_BEHIND_COMPONENT: Final = frozenset("([=,;")


def syntax_error(answer: Answer, model: str) -> InputError | None:
    """The first error of syntax that the front end tells of; None if it tells of none.

    Args:
        answer: with an error, in the names that the user knows.
        model: name of the model that was to be compiled.
    """
    found = next((match for each in answer.diagnostics for match in _FINDING.finditer(each)), None)
    if found is None:
        return None
    file = Path(found["file"])
    place = Place(file=file, line=int(found["line"]), component=model)
    keyword = _keyword_for_name(file)
    if keyword is not None:
        name, line = keyword
        return InputError(
            f"syntax error: {name} is a keyword of Modelica, and no name",
            place=Place(file=file, line=line, component=model),
            remedy="take another name",
        )
    said = _DUMP.sub("", _FRAME.sub(" ", found["said"])).removeprefix("parse error: ")
    said = _RESERVED.sub(r"unexpected \1", said)
    if said.startswith(_NO_EQUATION):
        return InputError(
            "syntax error: this is no equation",
            place=place,
            remedy="write left = right, or call a function; == compares",
        )
    return InputError(f"syntax error: {said}", place=place, remedy=_remedy(found["wanted"]))


def _remedy(wanted: str | None) -> str | None:
    """What the parser would have taken, if that tells a reader anything."""
    words = [word for word in re.split(r",?\s+", wanted or "") if word]
    if ";" in words:
        return "a ; may be missing before it, or a bracket that closes"
    return f"expected here: {' or '.join(words)}" if 0 < len(words) <= _FEW else None


def _keyword_for_name(file: Path) -> tuple[str, int] | None:
    """The first keyword that stands where a component has its name, and its line."""
    if not file.is_file():
        return None
    text = file.read_text(encoding="utf-8", errors="replace")
    return next(_keywords_for_names(text), None)


def _keywords_for_names(text: str) -> Iterator[tuple[str, int]]:
    tokens = list(tokens_of(text))
    for before, token, behind in zip(tokens, tokens[1:], tokens[2:], strict=False):
        if before.kind != "name" or before.text in KEYWORDS or token.text not in KEYWORDS - _BEHIND_NAME:
            continue
        if behind.text in _BEHIND_COMPONENT or behind.kind == "string":
            yield token.text, text.count("\n", 0, token.start) + 1
