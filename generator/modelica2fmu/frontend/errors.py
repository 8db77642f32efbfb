"""What the front end refuses, with the place in the model's text."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Final

from contact_foundation.errors import InputError, Place

from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.collider_order import MisplacedRow
from modelica2fmu.crosscheck.near_names import near_names
from modelica2fmu.frontend.call_errors import call_error
from modelica2fmu.frontend.piece import Piece
from modelica2fmu.frontend.runner import LAYOUT, Answer
from modelica2fmu.frontend.source_lines import (
    code_of,
    line_of,
    line_of_connect,
    line_of_modifier,
    line_of_name,
    line_of_quoted_name,
)
from modelica2fmu.library.brackets import end_of_bracket, parts_between_commas

# rumoca's whole message where an equation leaves out outputs of a function.
_NAMELESS: Final = "missing source scope for imports"
_OUTPUTS_LEFT_OUT: Final = re.compile(r"^\s*\((?:\s*,[^=()]*|[^=()]*,\s*(?:,[^=()]*)?)\)\s*=")

# Its word for records of all elements of an array of components, and where a model may have one.
_SLICE: Final = "record-array member slice"
_ARRAY: Final = re.compile(r"(?<![\w.])([A-Za-z_]\w*)\s*\[[^\]]*\]\s*[(;]")

_CRASH: Final = (
    "leave out parts of it to find what the front end does not take; known are `redeclare ... extends` in a model, in"
    " place of a package, and classes that stand for themselves"
)
# One of several errors: what is said, the file and the line.
_LOCATED: Final = re.compile(r"(?:^|; )((?:(?!\.mo:\d+:\d+\]; ).)*?) \[([^\[\]]+\.mo):(\d+):\d+\]", re.DOTALL)

_UNRESOLVED: Final = re.compile(r"unresolved (?:component|type|function) reference: '([^']+)'")
# Its words for the stage that failed, and about values and connections.
_STAGE: Final = re.compile(r"^\w+ failed: \S+ failed in \w+: ")
_OWN_TERMS: Final = re.compile(
    r"unsupported Flat semantic owner `[^`]*`: |canonical DAE construction rejected an invalid operation: "
    r"|(?<=unresolved )Flat "
)
_UNEVALUATED: Final = re.compile(r"`parameter binding`: `([^`]+)` cannot be evaluated: (.*)", re.DOTALL)
_SUBSCRIPTS: Final = re.compile(r"\[[^\]]*\]")

_PROBLEMS_SHOWN: Final = 3
_SHOWN: Final = 80

SHAPES: Final = "shape proof"
"""rumoca's words where sizes of arrays do not fit in arguments of functions."""

COMPREHENSION: Final = "analysis proves the exact comprehension occurrence"
"""Its words where a reduction over an iterator stands in a for-equation."""

# Its words about arguments and about expressions.
_ARGUMENT: Final = re.compile(
    rf"{SHAPES}`: `(?P<name>\w+)`: axis (?P<dimension>\d+) requires extent (?P<wanted>\d+) but .* (?P<given>\d+)$"
)
_RANK: Final = re.compile(
    rf"{SHAPES}`: `(?P<name>\w+)`: declared rank (?P<wanted>\d+) does not match call-site rank (?P<given>\d+)$"
)
_RANKS: Final = ("a number", "a vector", "a matrix")
_MISSHAPEN: Final = "expression shape mismatch"
# ... where a vector of records has another size than it is declared with.
_ROLE: Final = "has the wrong DAE coordinate role"
_IN_FUNCTION: Final = re.compile(r"unsupported Flat semantic owner `function [^`]*`: (?P<words>`.*)", re.DOTALL)
_SHAPE_ASSIGNED: Final = "assigns a value of shape"
_SIZES: Final = (
    "give both sides, and what is added, subtracted or chosen by if, the same sizes; a number is added to each element "
    "of an array by .+, and vectors are multiplied element by element by .*"
)

_KINDS: Final = {"Integer": "an Integer", "Boolean": "a Boolean", "String": "a String"}
_CONVERSIONS: Final = {
    "Integer": "write integer(...), which rounds down, or declare it as Real",
    "Boolean": "write a relation, as in x > 0",
    "String": "write String(...)",
}


class FrontEndError(Exception):
    """The front end's own words."""


def front_end_error(answer: Answer, model: str, file: Path, library: ClassLibrary) -> InputError:
    """The front end's message with the best place that can be found for it.

    Args:
        answer: with an error or a crash, in the names that the user knows.
        model: name of the model that was to be compiled.
        file: the file that holds it.
        library: the sources, for names like one that was not found.
    """
    message = answer.error
    if answer.crash:
        return InputError(
            f"the front end crashed ({answer.crash}) while it compiled the model",
            place=Place(file=file, component=model),
            remedy=_CRASH,
        )
    layout = LAYOUT.search(message)
    if layout:
        return _layout_error(Path(layout[1]), layout[2].split("; "))
    own = _own_mistake(message, model, file) or call_error(message, model, file, library)
    if own is not None:
        return own
    place = Place(file=file, component=model)
    text = "\n".join((*answer.diagnostics, message))
    located = re.search(r"\[([^\[\]\s]+\.mo):(\d+):\d+\]", text)
    line = None
    if located and Path(located[1]).is_relative_to(_own_root(file)):
        place = Place(file=Path(located[1]), line=int(located[2]), component=model)
    else:
        line = line_of_connect(message, file) or line_of_quoted_name(message, file)
    if line is not None:
        place = Place(file=file, line=line, component=model)
    elif located:
        place = Place(file=Path(located[1]), line=int(located[2]), component=model)
    left_out = line_of(_OUTPUTS_LEFT_OUT, file) if _NAMELESS in message else None
    if left_out is not None:
        return InputError(
            "outputs of a function are left out, which is not covered: give each a variable",
            place=Place(file=file, line=left_out, component=model),
        )
    if _SLICE in message and not located:
        return _slice_error(model, file)
    first = message.strip().split("\nRelated failures")[0]
    first = _STAGE.sub("", first.removeprefix(f"{model} could not be compiled: "))
    unevaluated = _UNEVALUATED.search(first)
    if unevaluated is not None:
        name, why = unevaluated.groups()
        place = replace(place, line=line_of_modifier(name, file) or place.line)
        return InputError(f"{name} cannot be evaluated: {why}", place=place)
    in_function = _IN_FUNCTION.search(first)
    first = first if in_function is None or SHAPES in first else f"the function {in_function['words']}"
    unresolved = _UNRESOLVED.search(message)
    parts = _SUBSCRIPTS.sub("", unresolved[1]).split(".") if unresolved else []
    return InputError(
        first or "the model cannot be compiled",
        place=place,
        remedy=near_names(parts, model, library) if parts else None,
    )


def is_vague(error: InputError) -> bool:
    """= true, if an error names no line, or the first that mentions a name where the front end compares sizes."""
    words = (SHAPES, _SHAPE_ASSIGNED, _ROLE)
    return error.place is None or error.place.line is None or any(each in error.message for each in words)


def in_plain_words(error: InputError) -> InputError:
    """The same error without what the front end calls its own parts."""
    return InputError(_OWN_TERMS.sub("", error.message), place=error.place, remedy=error.remedy)


def piece_error(piece: Piece, place: Place) -> InputError:
    """An equation, a binding or a modifier is refused.

    Args:
        piece: it, with the front end's words.
        place: where it stands.
    """
    said, text = piece.said, piece.text
    shown = " ".join(text.removesuffix(";").split())
    shown = f"{shown[:_SHOWN]} ..." if len(shown) > _SHOWN else shown
    argument = _ARGUMENT.search(said)
    if argument is not None:
        wants = f"{argument['name']} wants {argument['wanted']} elements in dimension {argument['dimension']}"
        return InputError(
            f"an argument has the wrong size in: {shown}", place=place, remedy=f"{wants}, not {argument['given']}"
        )
    rank = _RANK.search(said)
    if rank is not None:
        return InputError(
            f"an argument has the wrong number of dimensions in: {shown}",
            place=place,
            remedy=f"{rank['name']} wants {_of_rank(rank['wanted'])}, not {_of_rank(rank['given'])}",
        )
    if said.startswith(COMPREHENSION):
        return InputError(
            f"sum, product, min or max over an iterator in a for-equation is not covered: {shown}",
            place=place,
            remedy="Write the loop as one equation: y = {sum(x[j]*i for j in 1:n) for i in 1:n}.",
        )
    name, _, value = text.partition("=")
    given = _element_count(value.strip())
    is_of_sizes = given is not None or _MISSHAPEN in said or _ROLE in said
    if piece.wanted is not None and given != piece.wanted and is_of_sizes:
        has = "another size" if given is None else _counted(given)
        return InputError(
            f"{name.strip()} has {_counted(piece.wanted)}, and what it is given has {has}: {shown}",
            place=place,
            remedy="give each element its value, as many as there are",
        )
    if _MISSHAPEN not in said and _SHAPE_ASSIGNED not in said:
        return InputError(f"{shown}: {said}", place=place)
    if piece.array:
        prefix = "" if re.search(r"\btime\b", value) else "parameter "
        return InputError(
            f"of {shown} the front end does not give each element of the array {piece.array} its own",
            place=place,
            remedy=f"give the array a name, as in {prefix}Real values[:] = {' '.join(value.split())}; and write"
            f" {piece.array}({name.strip()} = values); or each {name.strip()} = ... where it is the same for all",
        )
    if piece.counted is not None:
        name, kind = piece.counted
        return InputError(
            f"{name} is {_KINDS[kind]}, and what it is given is of another type or size: {shown}",
            place=place,
            remedy=_CONVERSIONS[kind],
        )
    return InputError(f"sizes of arrays do not fit each other in: {shown}", place=place, remedy=_SIZES)


def _element_count(value: str) -> int | None:
    """How many elements an array has that is written out; None for other expressions."""
    if not value.startswith("{") or end_of_bracket(value, 0) != len(value) or " for " in value:
        return None
    return len(parts_between_commas(value, 1, len(value) - 1))


def _counted(count: int) -> str:
    return "one element" if count == 1 else f"{count} elements"


def _of_rank(rank: str) -> str:
    return _RANKS[int(rank)] if int(rank) < len(_RANKS) else f"an array of {rank} dimensions"


def _own_mistake(message: str, model: str, file: Path) -> InputError | None:
    """The first of several errors that lies in the model's own file or package; None if the message locates none there.

    One mistake in a model lets rumoca find fault with places of libraries, which it puts first.
    """
    root = _own_root(file)
    _, _, errors = message.partition(" failed in Typecheck: ")
    for said, name, line in _LOCATED.findall(errors):
        if Path(name).is_relative_to(root):
            return InputError(said, place=Place(file=Path(name), line=int(line), component=model))
    return None


def _slice_error(model: str, file: Path) -> InputError:
    """Records of all elements of an array are taken at once, which the front end does not resolve."""
    code = code_of(file)
    arrays = "|".join(sorted({re.escape(name) for name in _ARRAY.findall(code)}))
    slices = re.compile(rf"(?<![\w.])({arrays})\.(?!frame)([A-Za-z_]\w*)") if arrays else None
    found = next(slices.finditer(code), None) if slices else None
    example = f"{{{found[1]}[i].{found[2]} for i in 1:n}}" if found else "{body[i].collider for i in 1:n}"
    line = code.count("\n", 0, found.start()) + 1 if found else None
    named = f": {found[0]}" if found else ""
    return InputError(
        f"records of all elements of an array are taken at once{named}, which is not covered",
        place=Place(file=file, line=line, component=model),
        remedy=f"write {example}",
    )


def unconnected_error(frames: Sequence[str], model: str, file: Path) -> InputError:
    """Frames are connected to nothing, so nothing says where they are."""
    component = re.split(r"[.\[]", frames[0], maxsplit=1)[0]
    line = line_of_name(component, file)
    several = len(frames) > 1
    return InputError(
        f"{', '.join(frames)} {'are' if several else 'is'} connected to nothing: no equation says where "
        f"{'they are' if several else 'it is'}",
        place=Place(file=file, line=line, component=model),
        remedy=f"connect {'them' if several else 'it'}: connect(body.frame_a, {frames[0]});",
    )


def loose_error(component: str, model: str, file: Path) -> InputError:
    """A component has no connection to anything that has a place."""
    return InputError(
        f"{component} is connected to nothing that has a place: no equation says where it is",
        place=Place(file=file, line=line_of_name(component, file), component=model),
        remedy="connect one of its frames to the world or to a body",
    )


def not_inner_error(world: str, model: str, file: Path) -> InputError:
    """The world is not declared as inner, and parts look for one that is."""
    return InputError(
        f"{world} is declared without inner: parts do not find it",
        place=Place(file=file, line=line_of_name(world, file), component=model),
        remedy=f"write: inner Modelica.Mechanics.MultiBody.World {world}",
    )


def misplaced_error(row: MisplacedRow, model: str, file: Path) -> InputError:
    """A manager of contacts takes a body's geometry or material for another one."""
    line = line_of_name(row.taken, file)
    return InputError(
        row.message,
        place=Place(file=file, line=line, component=model),
        remedy="give colliders, geometries, materials and inertias in the order of the frames",
    )


def _layout_error(package: Path, problems: list[str]) -> InputError:
    """A package's files do not fit together."""
    shown = "; ".join(problems[:_PROBLEMS_SHOWN])
    more = f"; and {len(problems) - _PROBLEMS_SHOWN} more" if len(problems) > _PROBLEMS_SHOWN else ""
    return InputError(f"is no package: {shown}{more}", place=Place(file=package), remedy="Correct these files.")


def _own_root(file: Path) -> Path:
    """The file or the package's folder that the user wrote."""
    return file.parent if file.name == "package.mo" else file
