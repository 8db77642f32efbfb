"""Reads the declarations of a Modelica file; expressions, equations and statements are passed over."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Final, NamedTuple

from modelica2fmu.class_syntax import (
    Base,
    ClassDefinition,
    ComponentDeclaration,
    Constraint,
    Extent,
    Import,
    Modifier,
)

_TOKEN: Final = re.compile(
    r'\s+|//[^\n]*|/\*.*?\*/|(?P<string>"(?:\\.|[^"\\])*")|(?P<name>[A-Za-z_]\w*|\'(?:\\.|[^\'\\])+\')'
    r"|(?P<number>\d+(?:\.(?!\*)\d*)?(?:[eE][+-]?\d+)?|\.\d+(?:[eE][+-]?\d+)?)|(?P<sign>:=|==|<>|<=|>=|\.[*/+^-]|.)",
    re.DOTALL,
)
_CLASS_KINDS: Final = frozenset(
    {"class", "model", "record", "block", "connector", "type", "package", "function", "operator"}
)
_CLASS_PREFIXES: Final = frozenset({"encapsulated", "partial", "pure", "impure", "expandable"})
_COMPONENT_PREFIXES: Final = frozenset({"flow", "stream", "discrete", "parameter", "constant", "input", "output"})
_ELEMENT_PREFIXES: Final = frozenset({"redeclare", "final", "inner", "outer", "replaceable"})
_ENDS_OF_EXPRESSIONS: Final = frozenset({"annotation", "constrainedby"})
# Keywords behind which an expression goes on.
_INSIDE_EXPRESSIONS: Final = frozenset({"if", "then", "else", "elseif", "and", "or", "not", "for", "in", "each"})
_SECTIONS: Final = frozenset({"public", "protected", "equation", "algorithm", "external"})
_OTHER_STATEMENTS: Final = frozenset({"connect", "assert", "terminate", "reinit", "Connections"})
_BLOCKS: Final = frozenset({"if", "for", "when", "while"})
_OPENING: Final = {"(": ")", "[": "]", "{": "}"}
_DEEPEST: Final = 200


class UnreadableError(Exception):
    """The text is no Modelica that this module understands; the front end says what is wrong with it."""


class _Token(NamedTuple):
    kind: str
    text: str
    start: int
    end: int


def parse(text: bytes, file: Path) -> dict[str, ClassDefinition]:
    """The classes of a file by their names; places are in bytes.

    Raises:
        UnreadableError: the text is not understood, or nested too deeply.
    """
    parser = _Parser(text.decode("latin-1"), file)
    try:
        return parser.file_classes()
    except (IndexError, RecursionError) as error:
        raise UnreadableError(f"{file} ends too early") from error


def call_arguments(text: bytes) -> list[tuple[str, int, int]]:
    """The arguments of a call such as ``R(1, b = 2)``: their names, empty where there is none, and places.

    An expression of another kind has none.
    """
    tokens = list(_tokens(text.decode("latin-1")))
    opening = next((number for number, token in enumerate(tokens) if token.text == "("), 0)
    if not opening or any(token.kind != "name" and token.text != "." for token in tokens[:opening]):
        return []
    result = []
    first, depth = opening + 1, 0
    for number, token in enumerate(tokens[opening:], start=opening):
        if token.kind == "sign":
            depth += (token.text in _OPENING) - (token.text in _OPENING.values())
            if (token.text == "," and depth == 1) or depth == 0:
                named = number - first > 1 and tokens[first + 1].text == "="
                start = first + 2 if named else first
                if number > start:
                    result.append((tokens[first].text if named else "", tokens[start].start, tokens[number - 1].end))
                first = number + 1
            if depth == 0:
                return result if number == len(tokens) - 1 else []
    return []


def _tokens(text: str) -> Iterator[_Token]:
    for match in _TOKEN.finditer(text):
        if match.lastgroup is not None:
            yield _Token(match.lastgroup, match[0], match.start(), match.end())


class _Parser:
    """Recursive descent; one method a production of the language's grammar (Modelica 3.6, appendix A)."""

    def __init__(self, text: str, file: Path) -> None:
        self._file = file
        self._tokens = list(_tokens(text))
        self._at = 0
        self._depth = 0
        self._in_modification = 0

    def file_classes(self) -> dict[str, ClassDefinition]:
        """stored-definition."""
        classes: dict[str, ClassDefinition] = {}
        if self._accept("within"):
            while not self._accept(";"):
                self._at += 1
        while self._at < len(self._tokens):
            self._accept("final")
            definition = self._class()
            classes[definition.name] = definition
            self._expect(";")
        return classes

    # --- tokens ---

    def _text(self, ahead: int = 0) -> str:
        return self._tokens[self._at + ahead].text

    def _accept(self, text: str) -> bool:
        if self._tokens[self._at].text != text:
            return False
        self._at += 1
        return True

    def _expect(self, text: str) -> None:
        if not self._accept(text):
            raise UnreadableError(f"{self._file}: {text!r} expected, {self._text()!r} found")

    def _identifier(self) -> str:
        token = self._tokens[self._at]
        if token.kind != "name":
            raise UnreadableError(f"{self._file}: a name expected, {token.text!r} found")
        self._at += 1
        return token.text

    def _name(self) -> tuple[str, ...]:
        parts = [""] if self._accept(".") else []
        parts.append(self._identifier())
        while self._text() == "." and self._tokens[self._at + 1].kind == "name":
            self._at += 1
            parts.append(self._identifier())
        return tuple(parts)

    def _extent(self, first: int, last: int | None = None) -> Extent:
        """From the token ``first`` to the one before ``last``."""
        end = max((self._at if last is None else last) - 1, first)
        return Extent(self._file, self._tokens[first].start, self._tokens[end].end)

    def _skip_brackets(self) -> None:
        """From an opening bracket to behind the one that closes it."""
        closing = [_OPENING[self._text()]]
        self._at += 1
        while closing:
            text = self._text()
            if self._tokens[self._at].kind == "sign":
                if text in _OPENING:
                    closing.append(_OPENING[text])
                elif text == closing[-1]:
                    closing.pop()
            self._at += 1

    def _skip_subscripts(self) -> None:
        if self._text() == "[":
            self._skip_brackets()

    def _skip_comment(self) -> None:
        while self._tokens[self._at].kind == "string" or self._text() == "+":
            self._at += 1
        if self._accept("annotation"):
            self._skip_brackets()

    def _expression(self) -> Extent:
        """An expression ends before a comma, a closing bracket, a semicolon, a comment, a condition, an annotation."""
        first = self._at
        operand = False  # = true, if the token before ends an operand
        while True:
            token = self._tokens[self._at]
            if token.kind == "sign" and token.text in _OPENING:
                self._skip_brackets()
                operand = True
                continue
            if token.text in (",", ")", ";", "]", "}") or token.text in _ENDS_OF_EXPRESSIONS:
                break
            if operand and (token.kind == "string" or (token.text == "if" and self._text(-1) != "else")):
                break
            operand = token.kind != "sign" and token.text not in _INSIDE_EXPRESSIONS
            self._at += 1
        return self._extent(first)

    # --- classes ---

    def _is_class(self) -> bool:
        return self._text() in _CLASS_PREFIXES or self._text() in _CLASS_KINDS

    def _class(self) -> ClassDefinition:
        """class-definition, and the short ones of modifications."""
        self._depth += 1
        if self._depth > _DEEPEST:
            raise UnreadableError(f"{self._file}: classes or modifiers are nested too deeply")
        first = self._at
        encapsulated = False
        while self._text() in _CLASS_PREFIXES:
            encapsulated |= self._text() == "encapsulated"
            self._at += 1
        kind = self._text()
        if kind not in _CLASS_KINDS:
            raise UnreadableError(f"{self._file}: a class expected, {kind!r} found")
        while self._text() in _CLASS_KINDS:
            self._at += 1
        definition = ClassDefinition("", kind, self._extent(first), is_encapsulated=encapsulated)
        definition.extends_inherited = self._accept("extends")
        definition.name = self._identifier()
        if definition.extends_inherited:
            definition.bases.append(Base((definition.name,), self._modifiers(), self._extent(first)))
        if self._accept("="):
            self._short(definition)
        else:
            self._composition(definition)
        definition.extent = self._extent(first)
        self._depth -= 1
        return definition

    def _short(self, definition: ClassDefinition) -> None:
        definition.is_short = True
        if self._text() in ("enumeration", "der") and self._text(1) == "(":
            definition.is_enumeration = self._text() == "enumeration"
            self._at += 1
            self._skip_brackets()
        else:
            while self._text() in _COMPONENT_PREFIXES:
                self._at += 1
            first = self._at
            name = self._name()
            self._skip_subscripts()
            definition.bases.append(Base(name, self._modifiers(), self._extent(first)))
        self._skip_comment()

    def _composition(self, definition: ClassDefinition) -> None:
        while self._tokens[self._at].kind == "string" or self._text() == "+":
            self._at += 1
        while True:
            text = self._text()
            if text == "end" and self._text(1) == definition.name:
                self._at += 2
                return
            if text in ("public", "protected"):
                self._at += 1
            elif text in ("equation", "algorithm") or (
                text == "initial" and self._text(1) in ("equation", "algorithm")
            ):
                self._section(definition)
            elif text == "external":
                definition.c_name = self._external() or definition.name
            elif text == "annotation":
                self._skip_comment()
                self._expect(";")
            else:
                self._element(definition)
                self._expect(";")

    def _section(self, definition: ClassDefinition) -> None:
        """An equation or algorithm section, of which places are kept."""
        first = self._at
        self._at += 2 if self._text() == "initial" else 1
        depth = 0
        block, opening = "", first
        while depth or not self._ends_section():
            text = self._text()
            if text == "end" and self._text(1) in _BLOCKS:
                self._at += 2
                depth -= 1
                self._expect(";")
                if block == "when" and not depth:
                    definition.equations.append(self._extent(opening))
            elif text == "else":
                self._at += 1
            elif text in _BLOCKS or text in ("elseif", "elsewhen"):
                if text in _BLOCKS:
                    depth += 1
                    block, opening = (text, self._at) if depth == 1 else (block, opening)
                self._skip_to("loop" if text in ("for", "while") else "then")
            else:
                start = self._at
                is_equation = self._skip_to(";")
                if is_equation and not depth and text not in _OTHER_STATEMENTS:
                    definition.equations.append(self._extent(start))
        definition.behaviour.append(self._extent(first))

    def _ends_section(self) -> bool:
        text = self._text()
        return (
            (text == "end" and self._text(1) not in _BLOCKS)
            or text in _SECTIONS
            or (text == "initial" and self._text(1) in ("equation", "algorithm"))
            or (text == "annotation" and self._text(1) == "(")
        )

    def _skip_to(self, text: str) -> bool:
        """Behind the next such token outside of brackets; = true, if there is an equals sign before it."""
        equals = False
        depth = 0  # of if-expressions, whose "then" ends no condition
        self._at += 1
        while depth or self._text() != text:
            if self._text() in _OPENING and self._tokens[self._at].kind == "sign":
                self._skip_brackets()
                continue
            equals |= self._text() in ("=", ":=")
            depth += text == "then" and self._text() == "if"
            depth -= text == "then" and depth > 0 and self._text() == "else"
            self._at += 1
        self._at += 1
        return equals

    def _external(self) -> str | None:
        """The C function that an external one calls, ``None`` if it is not written."""
        name = None
        while not self._accept(";"):
            if self._text() == "annotation":
                self._skip_comment()
                continue
            if self._text(1) == "(" and name is None:
                name = self._text()
            if self._text() in _OPENING:
                self._skip_brackets()
            else:
                self._at += 1
        return name

    # --- elements ---

    def _element(self, definition: ClassDefinition) -> None:
        """element, the semicolon excluded."""
        if self._accept("import"):
            definition.imports.extend(self._import())
        elif self._text() == "extends":
            first = self._at
            self._at += 1
            name = self._name()
            definition.bases.append(Base(name, self._modifiers(), self._extent(first)))
            self._skip_comment()
        else:
            for element in self._declarations():
                if isinstance(element, ClassDefinition):
                    definition.classes[element.name] = element
                else:
                    definition.components[element.name] = element

    def _import(self) -> list[Import]:
        if self._text(1) == "=":
            name = self._identifier()
            self._expect("=")
            imports = [Import(name, self._name())]
        else:
            path = self._name()
            if self._accept(".*"):
                imports = [Import(None, path)]
            elif self._text() == "." and self._text(1) == "{":
                self._at += 2
                imports = []
                while not self._accept("}"):
                    name = self._identifier()
                    imports.append(Import(name, (*path, name)))
                    self._accept(",")
            else:
                imports = [Import(path[-1], path)]
        self._skip_comment()
        return imports

    def _declarations(self) -> list[ClassDefinition | ComponentDeclaration]:
        """A class or components with their prefixes and constraining clause."""
        prefixes = set()
        while self._text() in _ELEMENT_PREFIXES:
            prefixes.add(self._text())
            self._at += 1
        elements: list[ClassDefinition | ComponentDeclaration]
        if self._is_class() and not (self._text() == "operator" and self._text(1) == "."):
            elements = [self._class()]
        else:
            elements = list(self._components("outer" in prefixes))
        constraint = None
        first = self._at
        if self._accept("constrainedby"):
            name = self._name()
            constraint = Constraint(name, self._modifiers(), self._extent(first))
        self._skip_comment()
        result: list[ClassDefinition | ComponentDeclaration] = []
        for element in elements:
            if isinstance(element, ClassDefinition):
                element.is_replaceable = "replaceable" in prefixes
                element.redeclares = "redeclare" in prefixes or element.extends_inherited
                element.constraint = constraint
                result.append(element)
            else:
                result.append(
                    replace(
                        element,
                        is_replaceable="replaceable" in prefixes,
                        redeclares="redeclare" in prefixes,
                        constraint=constraint,
                    )
                )
        return result

    def _components(self, is_outer: bool) -> Iterator[ComponentDeclaration]:
        """component-clause."""
        is_constant = False
        while self._text() in _COMPONENT_PREFIXES:
            is_constant |= self._text() == "constant"
            self._at += 1
        type_name = self._name()
        start = self._at
        self._skip_subscripts()
        may_all_be_absent = is_constant or self._at > start
        while True:
            first = self._at
            name = self._identifier()
            may_be_absent = may_all_be_absent or self._text() == "["
            self._skip_subscripts()
            arguments = self._modifiers()
            value = self._value()
            extent = self._extent(first)
            if self._accept("if"):
                may_be_absent = True
                self._expression()
            self._skip_comment()
            yield ComponentDeclaration(name, type_name, extent, arguments, value, is_outer, may_be_absent=may_be_absent)
            # In a modification a comma ends the argument.
            if self._text() != "," or self._in_modification:
                return
            self._at += 1

    # --- modifications ---

    def _value(self) -> Extent | None:
        return self._expression() if self._accept("=") or self._accept(":=") else None

    def _modifiers(self) -> tuple[Modifier, ...]:
        """class-modification, if there is one."""
        if not self._accept("("):
            return ()
        self._in_modification += 1
        self._depth += 1
        if self._depth > _DEEPEST:
            raise UnreadableError(f"{self._file}: classes or modifiers are nested too deeply")
        result: list[Modifier] = []
        while not self._accept(")"):
            result.append(self._argument())
            if self._text() != ")":
                self._expect(",")
        self._in_modification -= 1
        self._depth -= 1
        return tuple(result)

    def _argument(self) -> Modifier:
        first = self._at
        if self._accept("break"):
            name = self._name()
            if self._text() == "(":
                self._skip_brackets()
                name = ("connect",)
            return Modifier(name, self._extent(first), removes=True)
        redeclares = self._accept("redeclare")
        while self._text() in ("each", "final"):
            self._at += 1
        if redeclares or self._text() == "replaceable":
            (element,) = self._declarations()
            return Modifier((element.name,), self._extent(first), redeclared=element)
        path = self._name()
        self._skip_subscripts()
        arguments = self._modifiers()
        value = self._value()
        extent = self._extent(first)
        self._skip_comment()
        return Modifier(path, extent, arguments, value)
