"""A Modelica text beside itself without comments and Strings, so that patterns find code alone."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from modelica2fmu.library.class_text import COMMENTS_AND_STRINGS


@dataclass(frozen=True)
class CodeText:
    """Three texts of the same length and the same lines.

    Attributes:
        text: as it was written.
        plain: with blanks for comments.
        code: with zero characters for Strings, too.
    """

    text: str
    plain: str = field(init=False)
    code: str = field(init=False)

    def __post_init__(self) -> None:
        plain = COMMENTS_AND_STRINGS.sub(
            lambda found: found[0] if found[0][0] == '"' else _filled(found[0], " "), self.text
        )
        object.__setattr__(self, "plain", plain)
        object.__setattr__(self, "code", COMMENTS_AND_STRINGS.sub(lambda found: _filled(found[0], "\0"), plain))

    def has_broken_string(self, start: int, end: int) -> bool:
        """= true, if a String of several lines lies between two places."""
        return any("\n" in found[0] for found in COMMENTS_AND_STRINGS.finditer(self.plain, start, end))

    def with_name_replaced(self, start: int, end: int, name: str, value: str) -> str:
        """What stands between two places, with another text for a name that is no member, function or argument."""
        own = re.compile(rf"(?<![\w.]){name}(?![\w(])(?!\s*=[^=])")
        result, done = [], start
        for found in own.finditer(self.code, start, end):
            result += [self.plain[done : found.start()], value]
            done = found.end()
        return "".join((*result, self.plain[done:end]))


def _filled(text: str, letter: str) -> str:
    return re.sub(r"[^\n]", lambda _found: letter, text)
