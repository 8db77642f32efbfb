"""Calls of functions whose arguments are not those that the function takes."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Final

from contact_foundation.errors import InputError, Place
from contact_foundation.near_names import did_you_mean

from modelica2fmu.crosscheck.class_instances import Names, UnknownError
from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.class_tokens import UnreadableError, call_arguments
from modelica2fmu.frontend.source_lines import code_of

_INVALID: Final = re.compile(r"invalid call of function `(?P<name>[^`]+)`: (?P<what>.*)")
_NOT_THERE: Final = re.compile(r"named argument `(?P<input>\w+)` does not match any input")
_TOO_MANY: Final = re.compile(r"(?P<given>\d+) positional argument\(s\) for (?P<taken>\d+) input slot")
_MISSING: Final = re.compile(r"input `(?P<input>\w+)` has no argument and no default")
_TWICE: Final = re.compile(r"input slot `(?P<input>\w+)` is filled more than once")
_FEW: Final = 8


def call_error(message: str, model: str, file: Path, library: ClassLibrary) -> InputError | None:
    """The error of a call with wrong arguments; None if the front end says nothing of one.

    Args:
        message: of the front end.
        model: name of the model that was to be compiled.
        file: the file that holds it.
        library: the sources, for the inputs that the function has.
    """
    invalid = _INVALID.search(message)
    if invalid is None:
        return None
    name, what = invalid["name"], invalid["what"]
    inputs = _inputs(name, model, library)
    remedy = f"it takes {', '.join(inputs)}" if inputs else None
    if (found := _NOT_THERE.search(what)) is not None:
        text = f"{name} has no input {found['input']}"
        if len(inputs) > _FEW:
            remedy = did_you_mean(found["input"], inputs) or remedy
    elif (found := _TOO_MANY.search(what)) is not None:
        text = f"{name} takes at most {found['taken']} arguments, not {found['given']}"
    elif (found := _MISSING.search(what)) is not None:
        text = f"a call of {name} gives no value to {found['input']}"
    elif (found := _TWICE.search(what)) is not None:
        text = f"a call of {name} gives a value to {found['input']} more than once"
    else:
        text = f"{name} cannot be called so: {what}"
    wrong = found.groupdict().get("input") if _MISSING.search(what) is None and found is not None else None
    return InputError(text, place=Place(file=file, line=_line(name, wrong, file), component=model), remedy=remedy)


def _inputs(name: str, model: str, library: ClassLibrary) -> list[str]:
    """Names of a function's inputs in their order; empty if it is not found."""
    try:
        function = Names(library).find(tuple(model.split("."))).lookup(tuple(name.split(".")))
        are_inputs = {
            each.name for scope in function.chain() for each in scope.definition.components.values() if each.is_input
        }
        return [each for each in function.fields() if each in are_inputs]
    except (UnknownError, UnreadableError, RecursionError):
        return []


def _line(name: str, wrong: str | None, file: Path) -> int | None:
    """Line of the first call; of the first that names an argument, where it is known which one is wrong."""
    code = code_of(file)
    places = [start for start, text in _calls(name, code) if wrong is None or _names(text, wrong)]
    return code.count("\n", 0, places[0]) + 1 if places else None


def _calls(name: str, code: str) -> Iterator[tuple[int, str]]:
    """Start and text of calls of a function by its full name or the end of it."""
    parts = [re.escape(part) for part in name.split(".")]
    optional = "".join(rf"(?:{part}\s*\.\s*)?" for part in parts[:-1])
    for found in re.finditer(rf"(?<![\w.]){optional}{parts[-1]}\s*(?=\()", code):
        depth = 0
        for position in range(found.end(), len(code)):
            depth += (code[position] == "(") - (code[position] == ")")
            if depth == 0:
                yield found.start(), code[found.start() : position + 1]
                break


def _names(call: str, argument: str) -> bool:
    return any(name == argument for name, _, _ in call_arguments(call.encode("latin-1", errors="replace")))
