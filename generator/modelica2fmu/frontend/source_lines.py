"""Lines of a model's text that the front end's messages mean, where they give no place themselves."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Final

from modelica2fmu.library.class_text import without_comments_and_strings

_SUBSCRIPTS: Final = re.compile(r"\[[^\]]*\]")
_QUOTED: Final = re.compile(r"['`]([A-Za-z_]\w*(?:\[[^\]]*\])?(?:\.\w+(?:\[[^\]]*\])?)*)['`]")
_CONNECTION: Final = re.compile(
    r"incompatible connector types in connection: (\S+)(?: \(dims: \[[\d, ]*\]\))? and (\S+)"
)


def code_of(file: Path) -> str:
    """The file's text with blanks for comments and strings; empty if there is no file."""
    return without_comments_and_strings(file.read_text(encoding="utf-8", errors="replace")) if file.is_file() else ""


def line_of_quoted_name(message: str, file: Path) -> int | None:
    """Line of the first mention of a name that a message quotes, or of the component that it begins with."""
    quoted = _QUOTED.search(message)
    if quoted is None:
        return None
    name = _SUBSCRIPTS.sub("", quoted[1])
    return line_of_name(name, file) or line_of_name(name.partition(".")[0], file)


def line_of_name(name: str, file: Path) -> int | None:
    """Line of the first mention of a component, with or without subscripts."""
    return line_of(re.compile(rf"(?<![\w.]){_subscripted(name)}(?!\w)"), file)


def line_of_modifier(name: str, file: Path) -> int | None:
    """Line in which a component of a component gets its value, or the component is declared."""
    component, _, element = _SUBSCRIPTS.sub("", name).rpartition(".")
    if not component:
        return line_of_name(element, file)
    code = code_of(file)
    given = re.search(rf"(?<![\w.]){_subscripted(component)}\s*(?:\[[^\]]*\])?\s*\([^;]*?\b{element}\s*=", code)
    return line_of_name(component, file) if given is None else code.count("\n", 0, given.end()) + 1


def line_of_connect(message: str, file: Path) -> int | None:
    """Line of the connect equation whose ends a message names."""
    ends = _CONNECTION.search(message)
    if ends is None:
        return None
    first, second = (_subscripted(_SUBSCRIPTS.sub("", end).partition(".")[0]) for end in ends.groups())
    pattern = rf"\bconnect\s*\((?=.*(?<![\w.]){first}(?!\w))(?=.*(?<![\w.]){second}(?!\w))"
    return line_of(re.compile(pattern), file)


def _subscripted(name: str) -> str:
    """A pattern for a name of components, each of which may have subscripts."""
    return r"\s*(?:\[[^\]]*\]\s*)?\.\s*".join(re.escape(part) for part in name.split("."))


def line_of(pattern: re.Pattern[str], file: Path) -> int | None:
    """First line of the file's code in which the pattern is found."""
    lines = code_of(file).splitlines()
    return next((number for number, line in enumerate(lines, start=1) if pattern.search(line)), None)
