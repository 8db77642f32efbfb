"""Where a Modelica text names something that is looked up: not what it declares, modifies or takes as an argument."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Final, NamedTuple

from modelica2fmu.crosscheck.class_syntax import Base, ClassDefinition, ComponentDeclaration, Modifier
from modelica2fmu.crosscheck.class_tokens import OPENING, Token

_CLASS_KINDS: Final = frozenset(
    {"class", "model", "record", "block", "connector", "type", "package", "function", "operator", "extends"}
)
# fmt: off
_KEYWORDS: Final = _CLASS_KINDS | {
    "algorithm", "and", "annotation", "break", "connect", "constant", "constrainedby", "der", "discrete", "each",
    "else", "elseif", "elsewhen", "encapsulated", "end", "enumeration", "equation", "expandable", "external",
    "false", "final", "flow", "for", "if", "import", "impure", "in", "initial", "inner", "input", "loop", "not",
    "or", "outer", "output", "parameter", "partial", "protected", "public", "pure", "redeclare", "replaceable",
    "return", "stream", "then", "true", "when", "while", "within", "Real", "Integer", "Boolean", "String",
}
# fmt: on
_BEFORE_MODIFIERS: Final = frozenset({"each", "final", "redeclare", "replaceable"})


class Reference(NamedTuple):
    """The first part of a name, with its place."""

    name: str
    start: int
    end: int


def references(tokens: Sequence[Token], declared: frozenset[int]) -> Iterator[Reference]:
    """The names in a text.

    Args:
        tokens: of the text.
        declared: where names stand that are declared or modified.
    """
    number = 0
    is_external = False
    while number < len(tokens):
        token = tokens[number]
        following = tokens[number + 1].text if number + 1 < len(tokens) else ""
        before = tokens[number - 1].text if number else ""
        if token.kind == "name":
            is_external |= token.text == "external"
            if token.text == "import":
                number = _behind(tokens, number, ";")
                continue
            if token.text in ("annotation", "enumeration") and following == "(":
                number = _behind_brackets(tokens, number + 1)
                continue
            is_argument = following == "=" and before in ("(", ",")
            is_c_function = is_external and following == "("
            is_function = before == "function" and following in ("(", ".")  # one that is an argument
            is_head = before == "end" or (before in _CLASS_KINDS - {"extends"} and not is_function)
            is_declared = is_head or token.start in declared
            if not (token.text in _KEYWORDS or before == "." or is_argument or is_c_function or is_declared):
                yield Reference(token.text, token.start, token.end)
        is_external &= token.text != ";"
        number += 1


def iterators(tokens: Sequence[Token]) -> frozenset[str]:
    """Names of the iterators in a text."""
    return frozenset(
        tokens[number - 1].text
        for number, token in enumerate(tokens)
        if number > 1 and token.text == "in" and tokens[number - 2].text in ("for", ",")
    )


def declared_names(elements: Iterable[ClassDefinition | ComponentDeclaration | Base | Modifier]) -> Iterator[int]:
    """Where the names of components and of what modifiers modify begin, or what stands directly before them."""
    waiting: list[ClassDefinition | ComponentDeclaration | Base | Modifier] = list(elements)
    while waiting:
        each = waiting.pop()
        if isinstance(each, ClassDefinition):
            waiting += [*each.bases, *each.components.values(), *each.classes.values()]
        elif isinstance(each, Modifier):
            yield each.extent.start
            waiting += each.arguments
            if each.redeclared is not None:
                waiting.append(each.redeclared)
        else:
            if isinstance(each, ComponentDeclaration):
                yield each.extent.start
            waiting += each.arguments
        if isinstance(each, ClassDefinition | ComponentDeclaration) and each.constraint is not None:
            waiting += each.constraint.arguments


def places_of_names(tokens: Sequence[Token], starts: Iterable[int]) -> frozenset[int]:
    """Where the names themselves begin, behind ``each`` and ``final``."""
    wanted = set(starts)
    places = set()
    for number, token in enumerate(tokens):
        if token.start in wanted:
            at = number
            while at < len(tokens) and tokens[at].text in _BEFORE_MODIFIERS:
                at += 1
            places.add(tokens[at].start)
    return frozenset(places)


def _behind(tokens: Sequence[Token], number: int, text: str) -> int:
    return next((at for at in range(number, len(tokens)) if tokens[at].text == text), len(tokens))


def _behind_brackets(tokens: Sequence[Token], opening: int) -> int:
    depth = 0
    for at in range(opening, len(tokens)):
        if tokens[at].kind == "sign":
            depth += (tokens[at].text in OPENING) - (tokens[at].text in OPENING.values())
        if depth == 0:
            return at + 1
    return len(tokens)
