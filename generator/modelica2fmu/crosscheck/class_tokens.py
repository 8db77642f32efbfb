"""Words of Modelica's text, and what is passed over: brackets, expressions, comments."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Final, NamedTuple

from modelica2fmu.crosscheck.class_syntax import Extent

_TOKEN: Final = re.compile(
    r'\s+|//[^\n]*|/\*.*?\*/|(?P<string>"(?:\\.|[^"\\])*")|(?P<name>[A-Za-z_]\w*|\'(?:\\.|[^\'\\])+\')'
    r"|(?P<number>\d+(?:\.(?!\*)\d*)?(?:[eE][+-]?\d+)?|\.\d+(?:[eE][+-]?\d+)?)|(?P<sign>:=|==|<>|<=|>=|\.[*/+^-]|.)",
    re.DOTALL,
)
_ENDS_OF_EXPRESSIONS: Final = frozenset({"annotation", "constrainedby"})
# Keywords behind which an expression goes on.
_INSIDE_EXPRESSIONS: Final = frozenset({"if", "then", "else", "elseif", "and", "or", "not", "for", "in", "each"})
OPENING: Final = {"(": ")", "[": "]", "{": "}"}


class UnreadableError(Exception):
    """The text is no Modelica that this module understands; the front end says what is wrong with it."""


class Token(NamedTuple):
    """A word: what it is (``string``, ``name``, ``number`` or ``sign``), its text and place."""

    kind: str
    text: str
    start: int
    end: int


class Argument(NamedTuple):
    """An argument of a call: its name, empty where there is none, and the place of its expression."""

    name: str
    start: int
    end: int


class Call(NamedTuple):
    """A call such as ``R(1, b = 2)``: what is called, where it begins and ends, and with which arguments.

    The name begins with an empty part where it is written with a leading dot.
    """

    name: tuple[str, ...]
    start: int
    end: int
    arguments: tuple[Argument, ...]


def calls_of(text: bytes) -> Iterator[Call]:
    """All calls in a text, those within arguments of others as well; modifiers of declarations look the same."""
    tokens = list(tokens_of(text.decode("latin-1")))
    for opening, token in enumerate(tokens):
        first = _start_of_name(tokens, opening) if token.text == "(" else opening
        if first < opening:
            call = _call(tokens, first, opening)
            if call is not None:
                yield call


def call_arguments(text: bytes) -> list[Argument]:
    """The arguments of a call such as ``R(1, b = 2)``; an expression of another kind has none."""
    call = next(calls_of(text), None)
    is_whole = call is not None and text[: call.start].strip() == b"" and text[call.end :].strip() == b""
    return list(call.arguments) if call is not None and is_whole else []


def _start_of_name(tokens: Sequence[Token], end: int) -> int:
    """Number of the first token of a name with dots that ends before a token; that token's if there is none."""
    first = end
    while first > 0 and tokens[first - 1].kind == "name":
        first -= 1
        if first == 0 or tokens[first - 1].text != ".":
            break
        first -= 1
    return first


def _call(tokens: Sequence[Token], first: int, opening: int) -> Call | None:
    """The call whose name begins at a token and whose parenthesis opens at another; None where none closes it."""
    arguments = []
    begins, depth = opening + 1, 0
    for number in range(opening, len(tokens)):
        token = tokens[number]
        if token.kind != "sign":
            continue
        depth += (token.text in OPENING) - (token.text in OPENING.values())
        if (token.text == "," and depth == 1) or depth == 0:
            named = number - begins > 1 and tokens[begins + 1].text == "="
            start = begins + 2 if named else begins
            if number > start:
                name = tokens[begins].text if named else ""
                arguments.append(Argument(name, tokens[start].start, tokens[number - 1].end))
            begins = number + 1
        if depth == 0:
            parts = "".join(each.text for each in tokens[first:opening]).split(".")
            return Call(tuple(parts), tokens[first].start, token.end, tuple(arguments))
    return None


def tokens_of(text: str) -> Iterator[Token]:
    """The words of a text; blanks and comments are left out."""
    for match in _TOKEN.finditer(text):
        if match.lastgroup is not None:
            yield Token(match.lastgroup, match[0], match.start(), match.end())


class TokenReader:
    """Steps through the tokens of a text; an IndexError means that it ends too early.

    Args:
        text: one character a byte.
        file: that it is from.

    Attributes:
        at: number of the next token.
    """

    def __init__(self, text: str, file: Path) -> None:
        self.file = file
        self.tokens = list(tokens_of(text))
        self.at = 0

    def text(self, ahead: int = 0) -> str:
        """The next token, or one further on."""
        return self.tokens[self.at + ahead].text

    def accept(self, text: str) -> bool:
        """Steps over the next token if it is this one."""
        if self.tokens[self.at].text != text:
            return False
        self.at += 1
        return True

    def expect(self, text: str) -> None:
        """Steps over the next token, which must be this one."""
        if not self.accept(text):
            raise UnreadableError(f"{self.file}: {text!r} expected, {self.text()!r} found")

    def identifier(self) -> str:
        """A single name."""
        token = self.tokens[self.at]
        if token.kind != "name":
            raise UnreadableError(f"{self.file}: a name expected, {token.text!r} found")
        self.at += 1
        return token.text

    def name(self) -> tuple[str, ...]:
        """A name with dots; it begins with an empty part if it begins with a dot."""
        parts = [""] if self.accept(".") else []
        parts.append(self.identifier())
        while self.text() == "." and self.tokens[self.at + 1].kind == "name":
            self.at += 1
            parts.append(self.identifier())
        return tuple(parts)

    def extent(self, first: int, last: int | None = None) -> Extent:
        """From the token ``first`` to the one before ``last``."""
        end = max((self.at if last is None else last) - 1, first)
        return Extent(self.file, self.tokens[first].start, self.tokens[end].end)

    def skip_brackets(self) -> None:
        """From an opening bracket to behind the one that closes it."""
        closing = [OPENING[self.text()]]
        self.at += 1
        while closing:
            text = self.text()
            if self.tokens[self.at].kind == "sign":
                if text in OPENING:
                    closing.append(OPENING[text])
                elif text == closing[-1]:
                    closing.pop()
            self.at += 1

    def skip_subscripts(self) -> None:
        """Subscripts, if there are some."""
        if self.text() == "[":
            self.skip_brackets()

    def skip_comment(self) -> None:
        """A description and an annotation, if there are some."""
        while self.tokens[self.at].kind == "string" or self.text() == "+":
            self.at += 1
        if self.accept("annotation"):
            self.skip_brackets()

    def expression(self) -> Extent:
        """An expression ends before a comma, a closing bracket, a semicolon, a comment, a condition, an annotation."""
        first = self.at
        operand = False  # = true, if the token before ends an operand
        while True:
            token = self.tokens[self.at]
            if token.kind == "sign" and token.text in OPENING:
                self.skip_brackets()
                operand = True
                continue
            if token.text in (",", ")", ";", "]", "}") or token.text in _ENDS_OF_EXPRESSIONS:
                break
            if operand and (token.kind == "string" or (token.text == "if" and self.text(-1) != "else")):
                break
            operand = token.kind != "sign" and token.text not in _INSIDE_EXPRESSIONS
            self.at += 1
        return self.extent(first)
