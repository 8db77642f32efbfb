"""Writes functions without control flow, where the front end does not take it.

rumoca 0.10 reads every function, but refuses those that leave a loop or themselves under a condition, whose loops or
elements it cannot count, and calls with named arguments that give several outputs. So it is given a list of assignments
to numbers in their place, one for each part of a statement::

    if x < x0[i] then    cmbIf := noEvent(size({x < x0[i]}, 1));
      k := i;            cmbTarget := noEvent(size({k}, 1)); cmbValue := noEvent(size({i}, 1));
      break;             cmbBreak := 1;
    end if;              cmbEnd := 1;

It looks up the names in them; what they are good for it does not ask. :mod:`modelica2fmu.frontend.control_flow` makes
statements of them again. Outputs are said to be what an external function gives, which the front end cannot evaluate
either: nothing is computed from such a function before its statements are there again.
"""

from __future__ import annotations

from collections.abc import Container, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

from modelica2fmu.crosscheck.class_tokens import TokenReader, UnreadableError

# Variables that stand for parts of statements.
BEGIN: Final = "cmbBegin"
TARGET: Final = "cmbTarget"
NO_TARGET: Final = "cmbNoTarget"
VALUE: Final = "cmbValue"
IF: Final = "cmbIf"
ELSE_IF: Final = "cmbElseIf"
ELSE: Final = "cmbElse"
FOR: Final = "cmbFor"
ITERATOR: Final = "cmbIterator"
WHILE: Final = "cmbWhile"
END: Final = "cmbEnd"
BREAK: Final = "cmbBreak"
RETURN: Final = "cmbReturn"
MARKS: Final = (
    BEGIN, TARGET, NO_TARGET, VALUE, IF, ELSE_IF, ELSE, FOR, ITERATOR, WHILE, END, BREAK, RETURN,
)  # fmt: skip

_ANY: Final = "cmbAny"
_PREFIXES: Final = frozenset({"final", "input", "output", "constant", "parameter", "discrete", "replaceable"})
_CLASSES: Final = frozenset(
    {"function", "record", "package", "model", "block", "class", "type", "connector", "operator"}
)
_SECTIONS: Final = frozenset({"public", "protected"})

_BLOCK_ENDS: Final = frozenset({"else", "elseif", "end"})


class _NotStraightError(Exception):
    """A function that is not understood, or has no algorithm."""


@dataclass(frozen=True)
class _Variable:
    name: str
    type: str
    sizes: tuple[str, ...]
    is_input: bool
    has_default: bool


@dataclass
class _Written:
    """A text that grows and keeps the lines of its source."""

    source: str
    position: int
    parts: list[str] = field(default_factory=list)

    def add(self, text: str, start: int | None = None, end: int | None = None) -> None:
        """Adds a text in the line of ``start``; ``end`` is where the source goes on behind it."""
        start = self.position if start is None else start
        self.parts.append("\n" * self.source.count("\n", self.position, start))
        self.parts.append(text)
        self.position = max(start if end is None else end, self.position)


def straight_line(text: str, names: Container[str] | None = None) -> str:
    """A Modelica text of the same lines in which functions have no control flow.

    Args:
        text: of a file.
        names: of the functions, without those of their packages; all that it can be written for if not given.
    """
    reader = _FunctionReader(text, Path())
    result, done = [], 0
    while reader.at < len(reader.tokens):
        if not reader.is_at_function() or (names is not None and reader.text(1) not in names):
            reader.at += 1
            continue
        first = reader.at
        try:
            start, end, written = reader.function()
        except (_NotStraightError, UnreadableError, IndexError):
            reader.at = first + 1
            continue
        result += [text[done:start], written]
        done = end
    return "".join((*result, text[done:]))


def _hidden(text: str) -> str:
    """A number that the front end does not compute, which holds an expression."""
    return f"noEvent(size({{{text}}}, 1))"


class _FunctionReader(TokenReader):
    """Reads functions and writes them as straight lines."""

    def __init__(self, text: str, file: Path) -> None:
        super().__init__(text, file)
        self._text = text
        self._iterators: dict[str, str] = {}
        self._variables: list[_Variable] = []
        self._errors: set[str] = set()  # names of the function that stops with a message
        self._scopes: list[tuple[str, int, int]] = []  # iterators, and the tokens between which they are known

    def is_at_function(self) -> bool:
        """= true, if a function with declarations of its own begins here."""
        tokens, at = self.tokens, self.at
        return (
            tokens[at].text == "function"
            and tokens[at].kind == "name"
            and (at == 0 or tokens[at - 1].text != "end")
            and at + 2 < len(tokens)
            and tokens[at + 1].kind == "name"
            and tokens[at + 1].text != "extends"
            and tokens[at + 2].text not in ("=", "(")
        )

    def function(self) -> tuple[int, int, str]:
        """Where the algorithm is, and what stands in its place."""
        self._iterators, self._variables, self._errors, self._scopes = {}, [], set(), []
        first = self.at
        self.at += 1
        name = self.identifier()
        while self.tokens[self.at].kind == "string":
            self.at += 1
        self._declarations()
        written = _Written(self._text, self.tokens[self.at].start)
        self.expect("algorithm")
        body = _Written(self._text, self.tokens[self.at - 1].end)
        self._statements(body, {"end", "annotation", "external", "algorithm", *_SECTIONS})
        if self.text() not in ("end", "annotation"):
            raise _NotStraightError
        end = self.tokens[self.at - 1].end
        body.add("", end)
        if self.accept("annotation"):
            self.skip_brackets()
            self.expect(";")
        self.expect("end")
        self.expect(name)
        self._require_own_iterators(first, self.at)
        any_of = dict(self._functions())
        declared = " ".join(f"{type_name} {each} = 0;" for each, type_name in self._iterators.items())
        iterators = " ".join(f"{ITERATOR} := {_hidden(each)};" for each in self._iterators)
        definitions = " ".join(self._definitions(any_of))
        written.add(
            f"protected Integer {', '.join(MARKS)}; {declared} {' '.join(self._function_texts(any_of))} algorithm "
            f"{definitions} {iterators} {BEGIN} := 1;"
        )
        return written.position, end, "".join((*written.parts, *body.parts))

    def _require_own_iterators(self, first: int, last: int) -> None:
        """Raises _NotStraightError where an iterator has the name of something else that the function uses."""
        scopes = [*self._scopes, *self._scopes_in_brackets(first, last)]
        for at in range(first, last):
            token, before, behind = self.tokens[at], self.tokens[at - 1].text, self.tokens[at + 1].text
            if token.text not in self._iterators or token.kind != "name" or before == "." or behind in ("=", "in"):
                continue
            if not any(name == token.text and start <= at < end for name, start, end in scopes):
                raise _NotStraightError

    def _scopes_in_brackets(self, first: int, last: int) -> Iterator[tuple[str, int, int]]:
        """Iterators of expressions, and the tokens between which they are known."""
        opened: list[int] = []
        for at in range(first, last):
            token = self.tokens[at]
            if token.kind == "sign" and token.text in "([{":
                opened.append(at)
            elif token.kind == "sign" and token.text in ")]}":
                opened.pop()
            elif opened and self.tokens[at + 1].text == "in" and token.kind == "name":
                yield token.text, opened[-1], at

    # --- declarations ---

    def _declarations(self) -> None:
        is_protected = False
        while self.text() != "algorithm":
            if self.text() in _SECTIONS:
                is_protected = self.text() == "protected"
                self.at += 1
            elif self.text() in ("extends", "import"):
                first = self.at
                self._skip_element()
                names = "".join(token.text for token in self.tokens[first + 1 : self.at - 1])
                if names.endswith("Streams.error"):
                    self._errors.add(names.partition("=")[0] if "=" in names else "error")
            elif self.text() in _CLASSES or self.text() in ("external", "end", "equation", "annotation"):
                raise _NotStraightError
            else:
                self._component_clause(is_protected)

    def _skip_element(self) -> None:
        while not self.accept(";"):
            if self.tokens[self.at].kind == "sign" and self.text() in "([{":
                self.skip_brackets()
            else:
                self.at += 1

    def _component_clause(self, is_protected: bool) -> None:
        prefixes = set()
        while self.text() in _PREFIXES:
            prefixes.add(self.text())
            self.at += 1
        type_name = ".".join(self.name())
        common = self._sizes()
        while True:
            name = self.identifier()
            sizes = (*self._sizes(), *common)
            has_default = False
            if self.text() == "(":
                self.skip_brackets()
            if self.text() in ("=", ":="):
                self.at += 1
                self.expression()
                has_default = True
            if self.text() == "if":
                raise _NotStraightError
            self.skip_comment()
            if "output" in prefixes or "input" in prefixes or is_protected:
                self._variables.append(_Variable(name, type_name, sizes, "input" in prefixes, has_default))
            if self.accept(";"):
                return
            self.expect(",")

    def _sizes(self) -> tuple[str, ...]:
        if self.text() != "[":
            return ()
        self.at += 1
        sizes = []
        while True:
            if self.text() == ":":
                self.at += 1
                sizes.append(":")
            else:
                extent = self.expression()
                sizes.append(" ".join(self._text[extent.start : extent.end].split()))
            if self.accept("]"):
                return tuple(sizes)
            self.expect(",")

    # --- what the front end is told of outputs and local variables ---

    def _undefined(self) -> list[_Variable]:
        return [each for each in self._variables if not (each.is_input or each.has_default)]

    def _functions(self) -> Iterator[tuple[str, str]]:
        """A number for each type that something has to be defined of."""
        types = dict.fromkeys(each.type for each in self._undefined())
        return ((type_name, f"{_ANY}{number}") for number, type_name in enumerate(types))

    def _function_texts(self, any_of: dict[str, str]) -> Iterator[str]:
        for type_name, name in any_of.items():
            yield f'function {name} output {type_name} y; external "C" {name}(y); end {name};'

    def _definitions(self, any_of: dict[str, str]) -> Iterator[str]:
        for each in self._undefined():
            value = f"{any_of[each.type]}()"
            if ":" in each.sizes:
                raise _NotStraightError
            filled = f"fill({', '.join((value, *each.sizes))})" if each.sizes else value
            yield f"{each.name} := {filled};"

    # --- statements ---

    def _part(self, written: _Written, mark: str, start: int, end: int) -> None:
        """A part of a statement between two tokens."""
        first, last = self.tokens[start].start, self.tokens[end - 1].end
        written.add(f"{mark} := {_hidden(self._with_plain_iterators(start, end))}; ", first, last)

    def _with_plain_iterators(self, start: int, end: int) -> str:
        """The text between two tokens, in which iterators go through ranges of whole numbers alone.

        The front end looks for them among the variables of the function where they are arguments of functions.
        """
        parts, done = [], self.tokens[start].start
        for at in range(start, end):
            if self.tokens[at].text != "for" or self.tokens[at].kind != "name":
                continue
            domain = at + 1
            while self.tokens[domain - 1].text not in ")]}":
                name = self.tokens[domain].text
                if self.tokens[domain + 1].text != "in":
                    raise _NotStraightError
                first = domain + 2
                domain = self._end_of_domain(first)
                if not self._is_range(first, domain):
                    opens, closes = self.tokens[first].start, self.tokens[domain - 1].end
                    if opens < done:
                        raise _NotStraightError
                    parts += [self._text[done:opens], f"1:size({{{self._text[opens:closes]}}}, 1)"]
                    done = closes
                if all(each.name != name for each in self._variables):
                    self._iterators.setdefault(name, "Integer")
                domain += 1
        return "".join((*parts, self._text[done : self.tokens[end - 1].end]))

    def _end_of_domain(self, at: int) -> int:
        """Number of the token behind what an iterator goes through."""
        before = self.at
        self.at = at
        self.expression()
        at, self.at = self.at, before
        return at

    def _is_range(self, start: int, end: int) -> bool:
        """= true, if a colon stands between two tokens that is in no brackets."""
        depth = 0
        for token in self.tokens[start:end]:
            depth += (token.text in "([{") - (token.text in ")]}") if token.kind == "sign" else 0
            if token.text == ":" and depth == 0:
                return True
        return False

    def _mark(self, written: _Written, mark: str) -> None:
        written.add(f"{mark} := 1; ", self.tokens[self.at].start)

    def _statements(self, written: _Written, ends: set[str] | frozenset[str]) -> None:
        while self.text() not in ends:
            self._statement(written)

    def _statement(self, written: _Written) -> None:
        match self.text():
            case "if":
                self._if(written)
            case "for":
                self._for(written)
            case "while":
                self.at += 1
                start = self.at
                self._to("loop")
                self._part(written, WHILE, start, self.at - 1)
                self._block(written, "while")
            case "break" | "return" as word:
                self._mark(written, BREAK if word == "break" else RETURN)
                self.at += 1
                self.skip_comment()
                self.expect(";")
            case "when":
                raise _NotStraightError
            case _:
                self._simple_statement(written)

    def _if(self, written: _Written) -> None:
        mark = IF
        while True:
            self.at += 1
            start = self.at
            self._to("then")
            self._part(written, mark, start, self.at - 1)
            self._statements(written, _BLOCK_ENDS)
            if self.text() != "elseif":
                break
            mark = ELSE_IF
        if self.text() == "else":
            self._mark(written, ELSE)
            self.at += 1
            self._statements(written, {"end"})
        self._end(written, "if")

    def _for(self, written: _Written) -> None:
        self.at += 1
        names: list[str] = []
        while True:
            name = self.identifier()
            self.expect("in")
            start = self.at
            while self.text() not in (",", "loop"):
                if self.text() in "([{":
                    self.skip_brackets()
                else:
                    self.at += 1
            type_name = "Integer" if self._is_range(start, self.at) else "Real"
            if any(each.name == name for each in self._variables) or self._iterators.get(name, type_name) != type_name:
                raise _NotStraightError
            self._iterators[name] = type_name
            self._part(written, FOR, start, self.at)
            written.add(f"{ITERATOR} := {_hidden(name)}; ")
            names.append(name)
            if self.accept("loop"):
                break
            self.expect(",")
        begin = self.at
        self._statements(written, {"end"})
        self._scopes += [(name, begin, self.at) for name in names]
        for _ in names[1:]:
            self._mark(written, END)
        self._end(written, "for")

    def _block(self, written: _Written, kind: str) -> None:
        self._statements(written, {"end"})
        self._end(written, kind)

    def _end(self, written: _Written, kind: str) -> None:
        self._mark(written, END)
        self.expect("end")
        self.expect(kind)
        self.skip_comment()
        self.expect(";")

    def _to(self, word: str) -> None:
        """Behind the next such keyword that belongs to the statement, not to an expression within it."""
        depth = 0
        while depth or self.text() != word:
            if self.tokens[self.at].kind == "sign" and self.text() in "([{":
                self.skip_brackets()
                continue
            depth += self.text() == "if"
            depth -= self.text() == "else" and depth > 0
            self.at += 1
        self.at += 1

    def _simple_statement(self, written: _Written) -> None:
        start = self.at
        while self.text() not in (":=", ";"):
            if self.tokens[self.at].kind == "sign" and self.text() in "([{":
                self.skip_brackets()
            else:
                self.at += 1
        if self.text() == ";":  # a call for its effect
            self.at += 1
            self._call(written, start)
            return
        self._targets(written, start, self.at)
        self.at += 1
        value = self.at
        self.expression()
        self._part(written, VALUE, value, self.at)
        self.skip_comment()
        self.expect(";")

    def _call(self, written: _Written, start: int) -> None:
        """A call for its effect. An error of a function is an assertion that never holds."""
        first, last = self.tokens[start].start, self.tokens[self.at - 1].end
        text = self._text[first:last]
        opening = next((at for at in range(start, self.at) if self.tokens[at].text == "("), start)
        name = "".join(token.text for token in self.tokens[start:opening])
        if name.endswith("Streams.error") or name in self._errors:
            text = f"assert(false, {self._text[self.tokens[opening].end : last]}"
        written.add(f"{text} ", first, last)

    def _targets(self, written: _Written, start: int, end: int) -> None:
        if self.tokens[start].text != "(":
            self._part(written, TARGET, start, end)
            return
        first, depth = start + 1, 0
        for at in range(start, end):
            text = self.tokens[at].text
            depth += (text in "([{") - (text in ")]}") if self.tokens[at].kind == "sign" else 0
            if (text == "," and depth == 1) or depth == 0:
                if at > first:
                    self._part(written, TARGET, first, at)
                else:
                    written.add(f"{NO_TARGET} := 1; ", self.tokens[at].start)
                first = at + 1
