"""Expressions, declarations and equations of Modelica classes, as far as the rules of portability need them."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Final

_TOKEN: Final = re.compile(
    r"""(?P<skip>\s+|//[^\n]*|/\*.*?\*/)
    |(?P<string>"(?:[^"\\]|\\.)*")
    |(?P<number>\d+(?:\.\d*)?(?:[eE][+-]?\d+)?|\.\d+(?:[eE][+-]?\d+)?)
    |(?P<name>\.?[A-Za-z_]\w*(?:\.[A-Za-z_]\w*)*|'(?:[^'\\]|\\.)*')
    |(?P<sign>:=|==|<>|<=|>=|\.[-+*/^]|[-+*/^<>=(){}\[\],;:.])""",
    re.VERBOSE | re.DOTALL,
)
_BINARY: Final = (
    ("or",),
    ("and",),
    ("<", "<=", ">", ">=", "==", "<>"),
    ("+", "-", ".+", ".-"),
    ("*", "/", ".*", "./"),
    ("^", ".^"),
)
_PREFIXES: Final = frozenset(
    {"final", "inner", "outer", "replaceable", "redeclare", "parameter", "constant", "discrete", "input", "output"}
)
_SECTIONS: Final = frozenset({"public", "protected", "equation", "algorithm", "initial", "external", "annotation"})
_CLASSES: Final = frozenset({"package", "model", "block", "function", "record", "class", "type", "connector"})
_CLASS_PREFIXES: Final = frozenset({"partial", "pure", "impure", "encapsulated", "expandable", "operator"})


@dataclass(frozen=True)
class Expression:
    """A node: ``kind`` is ref, call, array, comprehension, unary, binary, if, tuple, range, literal or colon."""

    kind: str
    text: str = ""
    parts: tuple[Expression, ...] = ()
    subscripts: int = 0
    """Of a reference: how many of its last part stand."""


@dataclass(frozen=True)
class Component:
    """A declared component."""

    name: str
    type_name: str
    prefixes: frozenset[str]
    dimensions: int
    binding: Expression | None
    is_protected: bool = False

    @property
    def is_fixed(self) -> bool:
        """= true, if it does not change during a simulation."""
        return bool(self.prefixes & {"parameter", "constant"})


@dataclass(frozen=True)
class Equation:
    """``left = right``, a call that stands alone (``right`` None) or one in an initial section."""

    left: Expression
    right: Expression | None
    initial: bool


@dataclass
class ModelicaClass:
    """One class of a file."""

    kind: str
    name: str
    prefixes: frozenset[str]
    bases: list[str] = field(default_factory=list)
    imports: dict[str, str] = field(default_factory=dict)
    components: dict[str, Component] = field(default_factory=dict)
    equations: list[Equation] = field(default_factory=list)
    conditions: list[Expression] = field(default_factory=list)
    external: str = ""
    annotations: str = ""


def tokens_of(text: str) -> list[str]:
    """Tokens of a text without blanks and comments.

    Raises:
        ValueError: a character belongs to no token.
    """
    tokens, at = [], 0
    while at < len(text):
        match = _TOKEN.match(text, at)
        if match is None:
            raise ValueError(f"no token at {text[at : at + 30]!r}")
        if match.lastgroup != "skip":
            tokens.append(match.group())
        at = match.end()
    return tokens


def read_class(text: str) -> ModelicaClass:
    """The class of a file.

    Raises:
        ValueError: the text is not understood.
    """
    return _Reader(tokens_of(text)).file()


class _Reader:
    """Recursive descent over the tokens."""

    def __init__(self, tokens: list[str]) -> None:
        self._tokens = [*tokens, "", "", ""]
        self._at = 0
        self._is_protected = False

    # --- tokens -----------------------------------------------------------------------------------------------------

    @property
    def _next(self) -> str:
        return self._tokens[self._at]

    def _take(self) -> str:
        self._at += 1
        return self._tokens[self._at - 1]

    def _accept(self, *texts: str) -> bool:
        if self._next in texts:
            self._at += 1
            return True
        return False

    def _expect(self, text: str) -> None:
        if not self._accept(text):
            raise ValueError(f"{text!r} expected at {' '.join(self._tokens[self._at : self._at + 8])!r}")

    def _skip_brackets(self) -> str:
        """Passes over a bracket and what it holds, which is returned."""
        first, depth = self._at, 0
        while True:
            token = self._take()
            depth += (token in "([{") - (token in ")]}") if len(token) == 1 else 0
            if not token:
                raise ValueError("a bracket is not closed")
            if not depth:
                return " ".join(self._tokens[first : self._at])

    def _skip_to_semicolon(self) -> None:
        while self._next != ";":
            if self._next == "(":
                self._skip_brackets()
            elif not self._take():
                raise ValueError("a semicolon is missing")
        self._at += 1

    # --- classes ----------------------------------------------------------------------------------------------------

    def file(self) -> ModelicaClass:
        if self._accept("within"):
            while not self._accept(";"):
                self._at += 1
        return self._class()

    def _class(self) -> ModelicaClass:
        prefixes = set()
        while self._next in _CLASS_PREFIXES:
            prefixes.add(self._take())
        result = ModelicaClass(self._take(), self._take(), frozenset(prefixes))
        if self._next == "=":  # a short class: nothing the rules are about
            while self._next not in (";", ""):
                self._at += 1
            return result
        self._comment()
        while not self._accept("end"):
            self._element(result)
        self._at += 1
        return result

    def _comment(self) -> None:
        while self._next.startswith('"'):
            self._at += 1
            self._accept("+")

    def _element(self, result: ModelicaClass) -> None:
        if self._next in ("public", "protected"):
            self._is_protected = self._take() == "protected"
            return
        if self._next == "initial" or self._next in ("equation", "algorithm"):
            initial = self._accept("initial")
            is_equation = self._take() == "equation"
            if is_equation:
                while not self._ends_section():
                    self._equation(result, initial)
            else:
                self._pass_over_statements()
        elif self._accept("external"):
            first = self._at
            self._skip_to_semicolon()
            result.external = " ".join(self._tokens[first : self._at])
        elif self._accept("annotation"):
            result.annotations = self._skip_brackets()
            self._expect(";")
        elif self._accept("extends"):
            result.bases.append(self._take())
            self._skip_to_semicolon()
        elif self._accept("import"):
            name = self._take()
            full = self._take() if self._accept("=") else name
            result.imports[name.split(".")[-1]] = full
            self._skip_to_semicolon()
        elif self._next in _CLASSES or self._next in _CLASS_PREFIXES:
            self._class()
            self._accept(";")
        else:
            self._declarations(result)

    def _ends_section(self) -> bool:
        return self._next in _SECTIONS or self._next in ("end", "")

    def _pass_over_statements(self) -> None:
        depth = 0
        while depth or not self._ends_section():
            if self._accept("end"):
                depth -= 1
                self._at += 1
            elif self._next in ("if", "for", "while", "when"):
                # An if-expression ends without "end": statements begin behind ";", "then", "loop" or "else".
                statement = self._tokens[self._at - 1] in (";", "then", "loop", "else", "algorithm")
                depth += statement
                self._at += 1
            elif self._next == "(":
                self._skip_brackets()
            elif not self._take():
                raise ValueError("an algorithm does not end")

    def _declarations(self, result: ModelicaClass) -> None:
        prefixes = set()
        while self._next in _PREFIXES:
            prefixes.add(self._take())
        if self._next in _CLASSES or self._next in _CLASS_PREFIXES:  # a replaceable class
            self._class()
            self._accept(";")
            return
        type_name = self._take()
        shared = self._dimensions()
        while True:
            name = self._take()
            dimensions = shared + self._dimensions()
            if self._next == "(":
                self._skip_brackets()
            binding = self._expression() if self._accept("=", ":=") else None
            if self._accept("if"):
                self._expression()
            self._comment()
            if self._accept("annotation"):
                self._skip_brackets()
            result.components[name] = Component(
                name, type_name, frozenset(prefixes), dimensions, binding, self._is_protected
            )
            if self._accept(";"):
                return
            self._expect(",")

    def _dimensions(self) -> int:
        return len(self._subscripts()) if self._next == "[" else 0

    # --- equations --------------------------------------------------------------------------------------------------

    def _equation(self, result: ModelicaClass, initial: bool) -> None:
        if self._accept("for"):
            while not self._accept("loop"):
                self._at += 1
            self._until_end(result, initial)
        elif self._next in ("if", "when"):
            self._take()
            result.conditions.append(self._expression())
            self._expect("then")
            self._until_end(result, initial)
        else:
            left = self._expression()
            right = self._expression() if self._accept("=") else None
            self._comment()
            if self._accept("annotation"):
                self._skip_brackets()
            self._expect(";")
            result.equations.append(Equation(left, right, initial))

    def _until_end(self, result: ModelicaClass, initial: bool) -> None:
        while not self._accept("end"):
            if self._accept("elseif", "elsewhen"):
                result.conditions.append(self._expression())
                self._expect("then")
            elif not self._accept("else"):
                self._equation(result, initial)
        self._at += 1
        self._expect(";")

    # --- expressions ------------------------------------------------------------------------------------------------

    def _expression(self) -> Expression:
        if self._accept("if"):
            parts = [self._expression()]
            self._expect("then")
            parts.append(self._expression())
            while self._accept("elseif"):
                parts.append(self._expression())
                self._expect("then")
                parts.append(self._expression())
            self._expect("else")
            parts.append(self._expression())
            return Expression("if", "", tuple(parts))
        first = self._binary(0)
        if self._next != ":":
            return first
        parts = [first]
        while self._accept(":"):
            parts.append(self._binary(0))
        return Expression("range", "", tuple(parts))

    def _binary(self, level: int) -> Expression:
        if level == len(_BINARY):
            return self._primary()
        if level == 2 and self._accept("not"):
            return Expression("unary", "not", (self._binary(level),))
        if level == 3 and self._next in ("-", "+"):
            left = Expression("unary", self._take(), (self._binary(level + 1),))
        else:
            left = self._binary(level + 1)
        while self._next in _BINARY[level]:
            left = Expression("binary", self._take(), (left, self._binary(level + 1)))
        return left

    def _primary(self) -> Expression:
        token = self._take()
        if token == "(":
            parts = self._list(")")
            return parts[0] if len(parts) == 1 else Expression("tuple", "", tuple(parts))
        if token == "{":
            parts = self._list("}")
            is_comprehension = bool(parts) and parts[-1].kind == "for"
            return (
                Expression("comprehension", "", (parts[0],))
                if is_comprehension
                else Expression("array", "", tuple(parts))
            )
        if token == "[":
            return Expression("array", "", tuple(self._list("]")))
        if token.startswith('"') or token[:1].isdigit() or token in ("true", "false", "end", "time"):
            return Expression("literal", token)
        if not re.match(r"[.A-Za-z_']", token):
            raise ValueError(f"an expression expected at {token!r} {' '.join(self._tokens[self._at : self._at + 5])!r}")
        return self._reference(token)

    def _reference(self, name: str) -> Expression:
        subscripts: tuple[Expression, ...] = ()
        inner: tuple[Expression, ...] = ()
        while True:
            if self._next == "[":
                subscripts = tuple(self._subscripts())
                inner += subscripts
            elif self._next == "." or (self._next.startswith(".") and self._next[1:2].isalpha() and subscripts):
                token = self._take()
                name += token if token != "." else "." + self._take()
                subscripts = ()
            else:
                break
        if self._accept("("):
            parts = tuple(part for part in self._list(")") if part.kind != "for")
            return Expression("call", name, parts)
        return Expression("ref", name, inner, len(subscripts))

    def _list(self, close: str) -> list[Expression]:
        parts: list[Expression] = []
        while not self._accept(close):
            if self._accept(",", ";"):
                continue
            if self._accept("for"):
                while self._next not in (close, ""):
                    self._skip_brackets() if self._next in ("(", "{", "[") else self._take()
                parts.append(Expression("for"))
            elif self._tokens[self._at + 1] == "=":  # a named argument
                self._at += 2
                parts.append(self._expression())
            else:
                parts.append(self._expression())
        return parts

    def _subscripts(self) -> list[Expression]:
        self._expect("[")
        parts = []
        while not self._accept("]"):
            if self._next == ":" and self._tokens[self._at + 1] in (",", "]"):
                self._at += 1
                parts.append(Expression("colon"))
            else:
                parts.append(self._expression())
            self._accept(",")
        return parts
