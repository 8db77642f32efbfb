"""VRML97 text to nodes: syntax, DEF and USE, prototypes; nothing about what the nodes mean."""

from __future__ import annotations

import re
import threading
import zlib
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from contact_foundation.errors import InputError, Place
from lark import Lark, Token, Transformer, UnexpectedCharacters, UnexpectedInput, UnexpectedToken

from cad2modelica.geometry.spatial import Array

MAXIMUM_BYTES = 256 * 2**20
HEADER = "#VRML V2.0"


@dataclass(frozen=True, eq=False)
class Numbers:
    """A run of numbers and the line it starts on."""

    values: Array
    line: int


@dataclass(frozen=True, eq=False)
class Reference:
    """``field IS name`` in the body of a prototype."""

    name: str


Value = Any  # Numbers, str, bool, None, Node, Reference, or a list of these


@dataclass(eq=False)
class Node:
    """A node: its type, fields by name, DEF name, and the line it starts on.

    Attributes:
        document: where it stands, and whose prototypes it may name.
        inside: prototypes whose bodies this copy of a node belongs to, the outermost first.
    """

    type: str
    fields: dict[str, Value]
    line: int
    document: VrmlDocument = field(repr=False)
    name: str | None = None
    inside: tuple[Prototype, ...] = ()


@dataclass(frozen=True, eq=False)
class Prototype:
    """``PROTO``: default values of its fields, its body; only the body's first node is seen."""

    name: str
    defaults: dict[str, Value]
    body: list[Node]
    line: int


@dataclass(frozen=True, eq=False)
class ExternalPrototype:
    """``EXTERNPROTO``: declared here, defined in another file."""

    name: str
    urls: list[str]
    line: int


@dataclass(frozen=True, eq=False)
class VrmlDocument:
    """A file's root nodes and prototypes."""

    file: Path
    roots: list[Node] = field(default_factory=list)
    prototypes: dict[str, Prototype | ExternalPrototype] = field(default_factory=dict)


def read_vrml(file: Path) -> VrmlDocument:
    """Reads a VRML97 file, gzip-compressed or not.

    Raises:
        InputError: the file is too large, not VRML97, breaks its syntax (with line), ends too early, or
            uses a name before it is defined.
    """
    text = _read_text(file)
    if not text.startswith(HEADER):
        first = text.split("\n", 1)[0][:60].strip()
        remedy = "Export the geometry as VRML 2.0 (also called VRML97)."
        raise InputError(
            f"is not a VRML 2.0 file: it begins with {first!r}", place=Place(file=file, line=1), remedy=remedy
        )
    document = VrmlDocument(file)
    try:
        # The builder works while parsing: no tree, and no recursion on what is nested deeply.
        document.roots.extend(_PARSER.parse(text, document))
    except UnexpectedToken as error:
        if error.token.type == "$END":
            raise _truncated(text, file) from error
        message = f"unexpected {str(error.token)[:40]!r}"
        raise _syntax_error(message, file, error.line) from error
    except UnexpectedCharacters as error:
        position = error.pos_in_stream or 0
        rest = text[position:]
        if rest.startswith('"'):
            raise _truncated(text[:position], file, "a string") from error
        if re.fullmatch(r"[+\-.0-9eExX]*", rest):
            raise _truncated(text[:position], file, "a number") from error
        raise _syntax_error(f"unexpected {text[position]!r}", file, error.line) from error
    except UnexpectedInput as error:
        raise _syntax_error("syntax error", file, error.line) from error
    return document


class _Parser(threading.local):
    """A thread's parser, kept: to read the grammar takes longer than to parse most files."""

    def __init__(self) -> None:
        self._builder = _Builder()

    @cached_property
    def grammar(self) -> Lark:
        """The grammar, with the builder at work while it parses."""
        options = {"parser": "lalr", "lexer": "contextual", "transformer": self._builder}
        return Lark.open("vrml.lark", rel_to=__file__, **options)

    def parse(self, text: str, document: VrmlDocument) -> list[Node]:
        """Root nodes; prototypes go to the document."""
        self._builder.begin(document)
        roots: Any = self.grammar.parse(text)
        return list(roots)


class _Builder(Transformer[Token, Any]):
    """Builds nodes bottom-up in the order of the text, so that USE finds what DEF named before."""

    _document: VrmlDocument
    _named: dict[str, Node]

    def begin(self, document: VrmlDocument) -> None:
        """Builds the nodes of another document from now on."""
        self._document, self._named = document, {}

    def start(self, children: list[Any]) -> list[Node]:
        return [child for child in children if isinstance(child, Node)]

    def node(self, children: list[Any]) -> Node:
        fields: dict[str, Value] = {}
        for child in children[1:]:
            if isinstance(child, tuple):
                fields[child[0]] = child[1]
        return Node(str(children[0]), fields, int(children[0].line), self._document)

    def define(self, children: list[Any]) -> Node:
        node: Node = children[1]
        node.name = _second_word(children[0])
        self._named[node.name] = node
        return node

    def use(self, children: list[Any]) -> Node:
        name = _second_word(children[0])
        if name not in self._named:
            raise InputError(
                f"USE {name}: no node of that name is defined before",
                place=Place(file=self._document.file, line=children[0].line),
                remedy="Export the file again; DEF must come before USE and must not contain it.",
            )
        return self._named[name]

    def body(self, children: list[Any]) -> Any:
        return children[0] if children else None

    def field(self, children: list[Any]) -> tuple[str, Value]:
        return str(children[0]), children[1]

    def field_is(self, children: list[Any]) -> tuple[str, Value]:
        return str(children[0]), Reference(str(children[1]))

    def declaration(self, _children: list[Any]) -> None:
        return None

    def declaration_value(self, children: list[Any]) -> tuple[str, Value]:
        return str(children[2]), children[3]

    def declaration_is(self, children: list[Any]) -> tuple[str, Value]:
        return str(children[2]), Reference(str(children[3]))

    def external_declaration(self, _children: list[Any]) -> None:
        return None

    def prototype(self, children: list[Any]) -> None:
        name, *rest = children
        defaults = {child[0]: child[1] for child in rest if isinstance(child, tuple)}
        body = [child for child in rest if isinstance(child, Node)]
        self._document.prototypes[str(name)] = Prototype(str(name), defaults, body, int(name.line))

    def external_prototype(self, children: list[Any]) -> None:
        name, value = children[0], children[-1]
        urls = [url for url in (value if isinstance(value, list) else [value]) if isinstance(url, str)]
        self._document.prototypes[str(name)] = ExternalPrototype(str(name), urls, int(name.line))

    def route(self, _children: list[Any]) -> None:
        return None

    def value(self, children: list[Any]) -> Value:
        return children[0]

    def list_value(self, children: list[Any]) -> Value:
        if children and all(isinstance(child, Numbers) for child in children):
            return Numbers(np.concatenate([child.values for child in children]), children[0].line)
        return children

    def numbers(self, children: list[Any]) -> Numbers:
        (token,) = children
        return Numbers(_parse_numbers(str(token)), int(token.line))

    def string(self, children: list[Any]) -> str:
        text = str(children[0])[1:-1]
        return text.replace('\\"', '"').replace("\\\\", "\\")

    def boolean(self, children: list[Any]) -> bool:
        return str(children[0]) == "TRUE"

    def null(self, _children: list[Any]) -> None:
        return None


_PARSER = _Parser()


def _parse_numbers(text: str) -> Array:
    words = text.replace(",", " ").split()
    if "x" in text or "X" in text:
        return np.array([_whole_number(word) if "x" in word.lower() else float(word) for word in words])
    return np.array(words, dtype=np.float64)


def _whole_number(word: str) -> float:
    """A hexadecimal number; infinity where it is beyond all numbers."""
    try:
        return float(int(word, 0))
    except OverflowError:
        return float("inf")


def _second_word(token: Token) -> str:
    return str(token).replace(",", " ").split()[1]


def _read_text(file: Path) -> str:
    with file.open("rb") as stream:
        data = stream.read(MAXIMUM_BYTES + 1)
    if data[:2] == b"\x1f\x8b":
        data = _decompress(data, file)
    if len(data) > MAXIMUM_BYTES:
        raise InputError(
            f"is larger than {MAXIMUM_BYTES // 2**20} MiB", place=Place(file=file), remedy="Export coarser."
        )
    return data.decode("utf-8-sig", errors="replace")


def _decompress(data: bytes, file: Path) -> bytes:
    try:
        stream = zlib.decompressobj(zlib.MAX_WBITS | 16)
        text = stream.decompress(data, MAXIMUM_BYTES + 1)
        if not stream.eof and len(text) <= MAXIMUM_BYTES:
            raise EOFError
    except (zlib.error, EOFError) as error:
        raise InputError(
            "is compressed, and the compressed data is damaged or ends too early",
            place=Place(file=file),
            remedy="Copy or export the file again.",
        ) from error
    return text


def _syntax_error(message: str, file: Path, line: int) -> InputError:
    return InputError(
        f"is not valid VRML 2.0: {message}",
        place=Place(file=file, line=line if line and line > 0 else None),
        remedy="Export the file again, or repair it at this line.",
    )


def _truncated(text: str, file: Path, what: str | None = None) -> InputError:
    """The error for a text that ends inside a node, a list or a string: says where that began."""
    opened: list[tuple[str, int]] = []
    last = ""
    try:
        for token in _PARSER.grammar.lex(text, dont_ignore=False):
            if token.type in ("LBRACE", "LSQB"):
                opened.append((f"{last} {token}".strip(), token.line or 0))
            elif token.type in ("RBRACE", "RSQB") and opened:
                opened.pop()
            last = str(token)[:40]
    except UnexpectedInput:
        pass
    end = text.count("\n") + 1
    inside = what or "the scene"
    if opened:
        inside = (f"{what} of " if what else "") + f"{opened[-1][0]!r} that begins at line {opened[-1][1]}"
    return InputError(
        f"the file ends in the middle of {inside}",
        place=Place(file=file, line=end),
        remedy="The file is truncated; export or copy it again.",
    )
